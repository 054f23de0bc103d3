#include "text/material_presets.h"

#include <algorithm>

#include "num/decimal.h"

namespace strahl {

// The common values are all given, since a defaultmaterial may have others; its patterns and coats stay.
constexpr std::array<MaterialPreset, 6> material_presets{
    {{"matt",
      [](const std::string& color, const std::string&) {
          return "rgb " + color + "  reflection 0  refraction 0  diffuse .8  ambient .12  specular 0";
      }},
     {"lacquer",
      [](const std::string& color, const std::string&) {
          return "rgb " + color + "  reflection .12  refraction 0  diffuse .75  ambient .1  specular .9  pow 150";
      }},
     {"glass",
      [](const std::string&, const std::string&) {
          return std::string(
              "rgb <1, 1, 1>  reflection .1  refraction .9  ior 1.5  diffuse 0  ambient 0  specular .9  "
              "pow 200");
      }},
     {"mirror",
      [](const std::string&, const std::string&) {
          return std::string(
              "rgb <.95, .96, .97>  reflection .9  refraction 0  diffuse .05  ambient 0  specular .9  "
              "pow 200");
      }},
     {"gold",
      [](const std::string&, const std::string&) {
          return std::string(
              "rgb <1, .72, .28>  reflection .45  refraction 0  diffuse .5  ambient .12  specular .8  "
              "pow 60  metallic 1  gilding 1");
      }},
     {"stone", [](const std::string&, const std::string& size) {
          return "rgb marble { turbulence 1.2  octaves 5  colors { 0 <.94, .92, .88>  .6 <.78, .76, .74>  1 <.3, .29, "
                 ".32> }  scale " +
                 size + " }  reflection .04  refraction 0  diffuse .75  ambient .12  specular .4  pow 40";
      }}}};

std::string with_material(const std::string& text, const BodyText& body, const MaterialPreset& preset, double size) {
    DVec3 color(.8);
    const auto own = std::ranges::find(body.values, "rgb", &BodyValue::name);
    if (own != body.values.end() && own->numbers.size() == 3)
        color = {own->numbers[0], own->numbers[1], own->numbers[2]};
    const bool added = body.material->begin == body.material->end;
    const std::string block = "material { " + preset.values(text_of(color), text_of(size)) + " }";
    return with_changes(text, {{*body.material, added ? " " + block + " " : block}});
}

}  // namespace strahl

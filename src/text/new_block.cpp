#include "text/new_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "num/decimal.h"

namespace strahl {
namespace {

/// Numbers as a person would write them.
struct Decimals {
    int count;
    std::string operator()(double value) const {
        return text_of(rounded(value, std::numeric_limits<double>::infinity(), count) + 0.);  // no -0
    }
    std::string operator()(const DVec3& v) const {
        return "<" + (*this)(v.x) + ", " + (*this)(v.y) + ", " + (*this)(v.z) + ">";
    }
};
/// Directions need no more than this.
constexpr Decimals for_directions{3};

/// A matt grey, whatever the defaultmaterial.
std::string body(const char* word, const std::string& arguments, const std::string& placed = {}) {
    return std::string(word) + " { " + arguments +
           "  material { rgb <.8, .8, .8>  reflection 0  refraction 0  diffuse .8  ambient .1  specular .3 }" + placed +
           " }";
}
/// Stands with its middle at the origin before it is moved to `centre`, so that turning and scaling leave it there.
std::string body_at(const std::string& centre, const char* word, const std::string& arguments) {
    return body(word, arguments, "  translate " + centre);
}

std::string sphere(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    return body_at(text(point + size * normal), "sphere", "<0, 0, 0>, " + text(size));
}

/// Returns the axis of the world that is nearest to a direction.
int steepest_axis(const DVec3& direction) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(direction[i]) > std::abs(direction[axis])) axis = i;
    return axis;
}

/// A box lies along the axes, with one side on the surface.
std::string box(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    const int axis = steepest_axis(normal);
    DVec3 centre = point;
    centre[axis] += std::copysign(size, normal[axis]);
    return body_at(text(centre), "box", text(DVec3(-size)) + ", " + text(DVec3(size)));
}

/// A wall is a box that stands on the surface and is long along another axis.
std::string wall(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    const int up = steepest_axis(normal), along = up == 0 ? 1 : 0;
    DVec3 half(size / 8);
    half[up] = 3 * size, half[along] = 8 * size;
    DVec3 centre = point;
    centre[up] += std::copysign(half[up], normal[up]);
    return body_at(text(centre), "box", text(-half) + ", " + text(half));
}

std::string cylinder(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    const DVec3 half = size * normal;
    return body_at(text(point + half), "cylinder", text(-half) + ", " + text(half) + ", " + text(size / 2));
}

std::string cone(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    const DVec3 half = size * normal;
    return body_at(text(point + half), "cone", text(-half) + ", " + text(size) + ", " + text(half) + ", 0");
}

std::string torus(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    return body_at(text(point + size / 4 * normal), "torus",
                   "<0, 0, 0>, " + for_directions(normal) + ", " + text(size) + ", " + text(size / 4));
}

/// A disc is a little above the surface, which would hide parts of it else.
std::string disc(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    return body_at(text(point + size / 20 * normal), "disc",
                   "<0, 0, 0>, " + for_directions(normal) + ", " + text(size));
}

/// A plane through the point, parallel to the surface there.
std::string plane(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    const DVec3 other = std::abs(normal.x) < .9 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
    const DVec3 u = normalize(cross_product(other, normal)), v = cross_product(normal, u), at = point + size * normal;
    return body("plane", text(at) + ", " + text(at + size * u) + ", " + text(at + size * v));
}

std::string light(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    return "light { position " + text(point + 4. * size * normal) + "  color <.7, .7, .7> }";
}

std::string spotlight(const DVec3& point, const DVec3& normal, double size, int decimals) {
    const Decimals text{decimals};
    return "light { position " + text(point + 6. * size * normal) + "  color <.9, .9, .9>  spot { look_at " +
           text(point) + "  radius 20  falloff 30 } }";
}

}  // namespace

constexpr std::array<NewBlock, 10> new_blocks{{{"sphere", TopBlock::body, sphere},
                                               {"box", TopBlock::body, box},
                                               {"cylinder", TopBlock::body, cylinder},
                                               {"cone", TopBlock::body, cone},
                                               {"torus", TopBlock::body, torus},
                                               {"disc", TopBlock::body, disc},
                                               {"plane", TopBlock::body, plane},
                                               {"wall", TopBlock::body, wall},
                                               {"light", TopBlock::light, light},
                                               {"spotlight", TopBlock::light, spotlight}}};

std::string with_new_block(const std::string& text, const NewBlock& added, int count, const DVec3& point,
                           const DVec3& normal, double size, int decimals) {
    return with_block(text, added.what, count - 1, added.block(point, normal, size, decimals));
}

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

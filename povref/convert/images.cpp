#include "povref/convert/images.h"

#include <bit>
#include <cstdio>
#include <map>

#include "num/decimal.h"
#include "povref/convert/layout.h"
#include "text/reading/opacity.h"

namespace strahl {
namespace {

/// Returns a name that depends only on the content, so that equal pictures have one name.
std::string name_of(const Pixels& pixels) {
    std::uint64_t hash = 0;
    const auto add = [&](std::uint64_t value) {
        hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 29;
    };
    add(static_cast<unsigned>(pixels.width)), add(static_cast<unsigned>(pixels.height));
    for (const float value : pixels.values) add(std::bit_cast<std::uint32_t>(value));
    char name[40];
    std::snprintf(name, sizeof name, "picture-%016llx", static_cast<unsigned long long>(hash));
    return name + std::string(pixels.linear ? ".exr" : ".png");
}

}  // namespace

std::vector<PovPicture> pictures_of(const Scene& scene) {
    std::map<std::string, std::shared_ptr<const Pixels>> all;
    const auto add = [&](const std::shared_ptr<const Pattern>& pattern) {
        if (!pattern) return;
        each_nested(*pattern, [&](const Pattern& own) {
            std::shared_ptr<const Pixels> pixels;
            if (const auto* const image = std::get_if<ImagePattern>(&own.kind)) pixels = image->pixels;
            if (const Opacity* const opacity = opacity_of(own)) pixels = opacity->picture().pixels;
            if (pixels) all[name_of(*pixels)] = pixels;
        });
    };
    add(scene.background.pattern);
    for (const Pigment& coat : scene.background_coats) add(coat.pattern);
    for (const Material& material : scene.materials) {
        add(material.rgb.pattern), add(material.bump.pattern);
        for (const Material& coat : material.coats) add(coat.rgb.pattern);
    }
    std::vector<PovPicture> pictures;
    for (const auto& [name, pixels] : all)
        pictures.push_back({name,
                            {pixels->width,
                             pixels->height,
                             3,
                             {pixels->values.begin(), pixels->values.end()},
                             pixels->linear ? 32 : 16}});
    return pictures;
}

std::string image_text(const ImagePattern& image, const std::string& more, bool as_it_is) {
    const bool linear = image.pixels->linear;
    const std::string of_all =
        more.empty() ? "" : more.substr(0, more.find(' ', 1)) + " all" + more.substr(more.find(' ', 1));
    // POV-Ray would divide colours of an .exr by the opacity that "all" gives them.
    const std::string colors = linear && !more.empty() ? " premultiplied off" : "";
    const std::string map = "image_map { " + std::string(linear ? "exr" : "png") + " \"" + name_of(*image.pixels) +
                            "\" " +
                            (as_it_is ? "As_It_Is()"
                             : linear ? "Floats()"
                                      : "gamma srgb") +
                            colors + " map_type " + std::to_string(static_cast<int>(image.map)) +
                            (image.once ? " once" : "") + (image.sharp ? "" : " interpolate 2") + of_all + " }";
    const bool flat = image.map == ImageMap::planar;
    // POV-Ray's poles are at -y and y, and it turns from x to z.
    const std::string poles = flat ? "" : " matrix <1,0,0, 0,0,1, 0,1,0, 0,0,0>";
    std::string warps;
    for (const std::size_t axis : {std::size_t(0), std::size_t(1)})
        if (flat && !image.once && image.wrap[axis] == ImageWrap::mirror)
            warps += axis == 0 ? " warp { repeat x flip x }" : " warp { repeat y flip y }";
    if (!image.once || image.map == ImageMap::spherical) return map + warps + poles;
    const std::string inside = "min(y, 1 - 1e-10 - y" + std::string(flat ? ", x, 1 - 1e-10 - x)" : ")");
    return "function { select(" + inside + ", 0, 1) } pigment_map { [0.5 rgb " + text_of(*image.once) + more +
           "] [0.5 " + map + "] }" + poles;
}

std::string gamma_word(double gamma) { return gamma == 0 ? "srgb" : gamma == 1 ? "1.0" : text_of(gamma); }

std::string image_macro(double gamma) {
    const auto macro = [](const char* name, double of) {
        return std::string("#macro ") + name + "() gamma " + gamma_word(of) + " #end\n";
    };
    return comment("Heights are taken as they are, and so are floats unless values are only a power of light.") +
           macro("As_It_Is", gamma) + macro("Floats", gamma == 0 ? 0 : 1);
}

}  // namespace strahl

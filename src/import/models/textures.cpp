#include "import/models/textures.h"

#include <algorithm>
#include <cmath>

#include "files/error.h"
#include "import/models/model.h"

namespace strahl {

std::shared_ptr<const FilePixels> Textures::read(const std::string& path, const std::string& where) {
    const auto [place, is_new] = known.try_emplace(path);
    if (!is_new) return place->second;
    try {
        if (!read_pixels) throw FileError("cannot read '" + path + "': pictures are not read here");
        place->second = std::make_shared<const FilePixels>(read_pixels(path));
        files.push_back(path);
    } catch (const FileError& error) {
        warnings.push_back(where + ": a picture is left out: " + error.what());
    }
    return place->second;
}

namespace {

/// Returns the steps that take a picture to its place: the inverse of what takes places into it.
std::vector<Transformation> steps_of(const TexturePlace& place) {
    std::vector<Transformation> steps;
    if (place.offset != DVec3(0)) steps.push_back(Translate{-place.offset});
    if (place.degrees != 0) steps.push_back(Rotate{{0, 0, -place.degrees}});
    const DVec3 inverse{1 / place.scale.x, 1 / place.scale.y, 1};
    if (inverse != DVec3(1)) steps.push_back(Scale{inverse});
    return steps;
}

}  // namespace

Pattern picture_by_uv(const std::shared_ptr<const FilePixels>& pixels, const std::string& file,
                      const TexturePlace& place, const Color& factor, bool clear) {
    std::shared_ptr<const Pixels> shown = pixels;
    std::string name = pixels->opacity.empty() || clear ? file : "";
    if (factor != Color(1)) {
        auto changed = std::make_shared<Pixels>(*pixels);
        // The factors are of linear light.
        for (std::size_t i = 0; i < changed->values.size(); ++i)
            changed->values[i] =
                pixels->linear ? pixels->values[i] : static_cast<float>(linear_light(double(pixels->values[i])));
        for (std::size_t i = 0; i < changed->values.size(); ++i)
            changed->values[i] *= static_cast<float>(factor[static_cast<int>(i % 3)]);
        changed->linear = true, changed->largest = Color(0);
        for (std::size_t i = 0; i < changed->values.size(); ++i) {
            double& most = changed->largest[static_cast<int>(i % 3)];
            most = std::max(most, double(changed->values[i]));
        }
        shown = changed, name.clear();
    }
    return {.kind = ImagePattern{.file = name,
                                 .pixels = shown,
                                 .once = place.clamped ? std::optional(place.around) : std::nullopt,
                                 .wrap = place.wrap},
            .colors = {},
            .transformations = steps_of(place),
            .by_uv = true};
}

Pigment partly_clear(const Pigment& opaque, Opacity opacity, const TexturePlace& place) {
    opacity.once = place.clamped, opacity.wrap = place.wrap;
    return partly_clear(opaque, std::make_shared<const Opacity>(std::move(opacity)), steps_of(place), true);
}

}  // namespace strahl

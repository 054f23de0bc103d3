#include "import/models/textures.h"

#include <algorithm>
#include <cmath>

#include "import/models/model.h"
#include "scene/error.h"

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

/// The opacity at places in a picture, bilinear between the middles of pixels.
struct OpacityFunction : SolidFunction {
    Opacity opacity;
    bool once;
    std::vector<float> values;  // row by row from the top

    OpacityFunction(const Opacity& own, bool once) : opacity(own), once(once) {
        const FilePixels& pixels = *own.pixels;
        if (!own.of_colors && !pixels.opacity.empty()) {
            values = pixels.opacity;
            return;
        }
        values.resize(std::size_t(pixels.width) * std::size_t(pixels.height), 1);
        for (std::size_t i = 0; own.of_colors && i < values.size(); ++i) {
            values[i] = 0;
            for (std::size_t c = 0; c < 3; ++c) values[i] += float(brightness[c]) * pixels.values[3 * i + c];
        }
    }
    double value_at(const DVec3& point) const override {
        const double width = opacity.pixels->width, height = opacity.pixels->height;
        const auto within = [&](double place) { return once ? std::clamp(place, 0., 1.) : place - std::floor(place); };
        const double x = within(point.x) * width - .5, y = (1 - within(point.y)) * height - .5;
        const auto at = [&](double column, double row) {
            const auto wrapped = [&](double place, double size) {
                return std::size_t(place < 0 ? (once ? 0 : size - 1) : place >= size ? (once ? size - 1 : 0) : place);
            };
            return double(values[wrapped(row, height) * std::size_t(width) + wrapped(column, width)]);
        };
        if (!std::isfinite(x + y)) return 1;
        const double left = std::floor(x), top = std::floor(y), u = x - left, v = y - top;
        const double mean = (1 - v) * ((1 - u) * at(left, top) + u * at(left + 1, top)) +
                            v * ((1 - u) * at(left, top + 1) + u * at(left + 1, top + 1));
        const double value = std::clamp(mean * opacity.factor, 0., 1.);
        return opacity.limit > 0 ? (value >= opacity.limit ? 1 : 0) : value;
    }
};

}  // namespace

Pattern picture_by_uv(const std::shared_ptr<const FilePixels>& pixels, const std::string& file,
                      const TexturePlace& place, const Color& factor) {
    std::shared_ptr<const Pixels> shown = pixels;
    std::string name = file;
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
    return {.kind =
                ImagePattern{
                    .file = name, .pixels = shown, .once = place.clamped ? std::optional(place.around) : std::nullopt},
            .colors = {},
            .transformations = steps_of(place),
            .by_uv = true};
}

bool make_opaque(Pigment& pigment) {
    const auto* const values = pigment.pattern ? std::get_if<SolidPattern>(&pigment.pattern->kind) : nullptr;
    if (!values || !dynamic_cast<const OpacityFunction*>(values->function.get())) return false;
    const std::shared_ptr<const Pattern> whole = pigment.pattern;
    const ColorStop& full = whole->colors.back();
    pigment = full.pattern ? Pigment(*full.pattern) : Pigment(full.color);
    return true;
}

Pigment partly_clear(const Pigment& opaque, const Opacity& opacity, const TexturePlace& place) {
    const ColorStop clear{0, Color(1), 0, 1}, full{1, opaque.color, 0, 0, opaque.pattern};
    SolidPattern values;
    values.frequency = 0;
    values.function = std::make_shared<const OpacityFunction>(opacity, place.clamped);
    return Pigment(Pattern{.kind = values, .colors = {clear, full}, .transformations = steps_of(place), .by_uv = true});
}

}  // namespace strahl

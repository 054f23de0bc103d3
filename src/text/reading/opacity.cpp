#include "text/reading/opacity.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strahl {

Opacity::Opacity(const FilePixels& pixels, bool grey)
    : width(pixels.width), height(pixels.height), values(pixels.opacity) {
    if (!values.empty()) return;
    values.resize(std::size_t(width) * std::size_t(height), grey ? 0 : 1);
    for (std::size_t i = 0; grey && i < values.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) values[i] += float(brightness[c]) * pixels.values[3 * i + c];
}

ImagePattern Opacity::picture() const {
    auto grey = std::make_shared<Pixels>(Pixels{width, height, false, {}, Color(factor)});
    for (const float value : values) grey->values.insert(grey->values.end(), 3, value * static_cast<float>(factor));
    ImagePattern result{.file = "", .pixels = std::move(grey)};
    if (once) result.once = Color(factor);
    result.wrap = wrap;
    return result;
}

double Opacity::value_at(const DVec3& point) const {
    const bool beyond = once && !(point.x >= 0 && point.x <= 1 && point.y >= 0 && point.y <= 1);
    const bool ends[2]{once || wrap[0] != ImageWrap::repeat, once || wrap[1] != ImageWrap::repeat};
    const auto within = [&](int axis, double place) {
        if (!ends[axis]) return place - std::floor(place);
        if (!once && wrap[std::size_t(axis)] == ImageWrap::mirror) place = std::abs(place - 2 * std::round(place / 2));
        return std::clamp(place, 0., 1.);
    };
    const double x = within(0, point.x) * width - .5, y = (1 - within(1, point.y)) * height - .5;
    const auto at = [&](double column, double row) {
        const auto wrapped = [](double place, double size, bool end) {
            return std::size_t(place < 0 ? (end ? 0 : size - 1) : place >= size ? (end ? size - 1 : 0) : place);
        };
        return double(values[wrapped(row, height, ends[1]) * std::size_t(width) + wrapped(column, width, ends[0])]);
    };
    if (!std::isfinite(x + y)) return 1;
    const double left = std::floor(x), top = std::floor(y), u = x - left, v = y - top;
    const double mean = (1 - v) * ((1 - u) * at(left, top) + u * at(left + 1, top)) +
                        v * ((1 - u) * at(left, top + 1) + u * at(left + 1, top + 1));
    const double value = std::clamp((beyond ? 1 : mean) * factor, 0., 1.);
    return limit > 0 ? (value >= limit ? 1 : 0) : value;
}

Pigment partly_clear(const Pigment& opaque, std::shared_ptr<const Opacity> opacity, std::vector<Transformation> steps,
                     bool by_uv) {
    const ColorStop clear{0, Color(1), 0, 1}, full{1, opaque.color, 0, 0, opaque.pattern};
    SolidPattern values;
    values.frequency = 0;
    values.function = std::move(opacity);
    return Pigment(
        Pattern{.kind = values, .colors = {clear, full}, .transformations = std::move(steps), .by_uv = by_uv});
}

const Opacity* opacity_of(const SolidPattern& pattern) { return dynamic_cast<const Opacity*>(pattern.function.get()); }
const Opacity* opacity_of(const Pattern& pattern) {
    const auto* const values = std::get_if<SolidPattern>(&pattern.kind);
    return values ? opacity_of(*values) : nullptr;
}
const Opacity* opacity_of(const Pigment& pigment) { return pigment.pattern ? opacity_of(*pigment.pattern) : nullptr; }

Pigment opaque_part(const Pigment& pigment) {
    const ColorStop& full = pigment.pattern->colors.back();
    return full.pattern ? Pigment(*full.pattern) : Pigment(full.color);
}

bool has_text(const Pigment& pigment) {
    const Pattern* const shown = pigment.pattern->colors.back().pattern.get();
    return shown && std::holds_alternative<ImagePattern>(shown->kind) &&
           (!pigment.pattern->by_uv || shown->transformations == pigment.pattern->transformations);
}

}  // namespace strahl

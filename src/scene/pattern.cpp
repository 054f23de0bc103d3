#include "scene/pattern.h"

#include <utility>

namespace strahl {
namespace {

using Shared = std::shared_ptr<const Pattern>;
bool same(const Shared& a, const Shared& b) { return a == b || (a && b && *a == *b); }

}  // namespace

bool ColorStop::operator==(const ColorStop& other) const {
    return same(pattern, other.pattern) && at == other.at && color == other.color && filter == other.filter &&
           transmit == other.transmit;
}

Pigment::Pigment(Pattern own) : pattern(std::make_shared<const Pattern>(std::move(own))) {
    const auto include = [&](const Color& own) {
        for (int c = 0; c < 3; ++c) color[c] = std::max(color[c], own[c]);
    };
    const auto add = [&](const auto& most) {
        include(most.color);
        filter = std::max(filter, most.filter), transmit = std::max(transmit, most.transmit);
    };
    for (const ColorStop& stop : pattern->colors) stop.pattern ? add(Pigment(*stop.pattern)) : add(stop);
    if (const ImagePattern* const image = std::get_if<ImagePattern>(&pattern->kind)) {
        include(image->pixels->largest);
        if (image->once) include(*image->once);
    }
}

bool Pigment::operator==(const Pigment& other) const {
    return color == other.color && filter == other.filter && transmit == other.transmit && same(pattern, other.pattern);
}

bool Relief::operator==(const Relief& other) const { return height == other.height && same(pattern, other.pattern); }

}  // namespace strahl

#include "trace/world/mip_maps.h"

#include <algorithm>
#include <cmath>

namespace strahl {
namespace {

/// Returns the linear light of an sRGB-encoded value (IEC 61966-2-1).
float decoded(float v) { return static_cast<float>(v <= .04045 ? v / 12.92 : std::pow((v + .055) / 1.055, 2.4)); }

/// The pixels, of `size` side by side, that pixel `i` of `smaller` ones covers, and its share of 1 in each.
struct Covered {
    std::int32_t first, count = 0;
    double shares[4];
    Covered(std::int64_t i, std::int64_t size, std::int64_t smaller) {
        const std::int64_t begin = i * size, end = begin + size;  // in units of which a pixel has `smaller`
        first = static_cast<std::int32_t>(begin / smaller);
        for (std::int64_t at = first; at * smaller < end; ++at)
            shares[count++] = static_cast<double>(std::min((at + 1) * smaller, end) - std::max(at * smaller, begin)) /
                              static_cast<double>(size);
    }
};

void shrink(const MipLevel& from, std::int32_t width, std::int32_t height, float* to) {
    std::vector<Covered> columns;
    for (std::int32_t x = 0; x < width; ++x) columns.emplace_back(x, from.width, width);
    for (std::int32_t y = 0; y < height; ++y) {
        const Covered rows(y, from.height, height);
        for (const Covered& own : columns) {
            double sum[3] = {};
            for (int j = 0; j < rows.count; ++j) {
                const float* pixel = from.pixels + 3 * (std::ptrdiff_t(rows.first + j) * from.width + own.first);
                for (int i = 0; i < own.count; ++i)
                    for (double& value : sum) value += rows.shares[j] * own.shares[i] * double(*pixel++);
            }
            for (const double value : sum) *to++ = static_cast<float>(value);
        }
    }
}

}  // namespace

MipMap::MipMap(const float* values, std::int32_t width, std::int32_t height) : levels{{values, width, height}} {
    const auto half = [](std::int32_t size) { return std::max(size / 2, 1); };
    std::size_t pixels = 0;
    for (std::int32_t w = width, h = height; w > 1 || h > 1;)
        w = half(w), h = half(h), pixels += static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
    smaller.resize(3 * pixels);
    for (float* next = smaller.data(); levels.back().width > 1 || levels.back().height > 1;) {
        const MipLevel from = levels.back();
        const std::int32_t w = half(from.width), h = half(from.height);
        shrink(from, w, h, next);
        levels.push_back({next, w, h});
        next += 3 * (std::ptrdiff_t(w) * h);
    }
}

int Images::add(const std::shared_ptr<const Pixels>& pixels, double gamma, bool colors) {
    if (gamma == 1 && pixels->linear) gamma = 0;
    const auto same = [&](const Image& image) { return image.given == pixels && image.gamma == gamma; };
    const auto known = std::ranges::find_if(images, same);
    const auto number = static_cast<int>(known - images.begin());
    if (known == images.end()) {
        std::shared_ptr<const Pixels> own = pixels;
        if (gamma != 0) {
            const auto copy = std::make_shared<Pixels>(*pixels);
            for (float& value : copy->values) {
                if (!pixels->linear) value = decoded(value);
                if (gamma != 1) value = static_cast<float>(std::pow(value, 1 / gamma));
            }
            own = copy;
        }
        images.push_back({pixels, own, gamma, false});
    }
    images[number].colors |= colors;
    return number;
}

const MipMapKernel* Images::mip_maps() {
    if (std::ranges::none_of(images, &Image::colors)) return nullptr;
    if (kernels.size() == images.size()) return kernels.data();
    maps.clear(), kernels.clear();
    maps.reserve(images.size());
    for (const Image& image : images) {
        const Pixels& own = *image.own;
        if (image.colors) maps.emplace_back(own.values.data(), own.width, own.height);
        kernels.push_back(image.colors ? maps.back().kernel() : MipMapKernel{});
    }
    return kernels.data();
}

}  // namespace strahl

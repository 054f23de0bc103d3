#include "main/proof.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "image/transfer.h"

namespace strahl {

namespace {

/// Would the file hold the same for all values that are no further than `bound` from this one?
bool decided(double value, double bound, const FileFormat& format) {
    if (format.bits == 32) return same_code(value, bound, [](double v) { return static_cast<float>(v); });
    return same_code(value, bound, [&](double v) { return quantise(v, format.linear, (1 << format.bits) - 1); });
}

}  // namespace

Proof::Proof(const Lattice& own_part, const FileFormat& own_format)
    : part(own_part), format(own_format), bounds(std::size_t(part.columns) * part.rows), proved(bounds.size()) {}

void Proof::keep(const Tile& tile) {
    const auto& rgb = std::get<std::span<const double>>(tile.rgb);
    const Lattice& own = tile.lattice;
    for (int i = 0; i < own.columns * own.rows; ++i) {
        const std::size_t at =
            std::size_t(own.y - part.y + i / own.columns) * part.columns + (own.x - part.x + i % own.columns);
        bounds[at] = tile.bounds[i];
        proved[at] = std::all_of(rgb.begin() + 3 * i, rgb.begin() + 3 * i + 3,
                                 [&](double value) { return decided(value, tile.bounds[i], format); });
    }
}

ProofCounts Proof::counts() const {
    const std::int64_t all = std::ssize(proved), decided = std::count(proved.begin(), proved.end(), 1);
    std::vector<double> sorted = bounds;
    std::nth_element(sorted.begin(), sorted.begin() + all / 2, sorted.end());
    return {format.bits, decided, all - decided, sorted[all / 2]};
}

void Proof::write(const std::string& path) const {
    Picture picture{part.columns, part.rows, 3, std::vector<double>(3 * proved.size())};
    for (std::size_t i = 0; i < proved.size(); ++i) {
        // From 1 at a bound of 1e-16 to .25 at 1.
        const double bright = std::clamp(.25 - std::log10(bounds[i] + 1e-16) * (.75 / 16), .25, 1.);
        double* const rgb = &picture.values[3 * i];
        proved[i] ? (rgb[0] = .2 * bright, rgb[1] = .8 * bright, rgb[2] = .4 * bright)
                  : (rgb[0] = 1, rgb[1] = 0, rgb[2] = 0);
    }
    write_picture(picture, path, {.bits = 8});
}

}  // namespace strahl

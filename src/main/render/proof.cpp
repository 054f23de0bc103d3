#include "main/render/proof.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "image/transfer.h"

namespace strahl {

namespace {

const double* values_of(const Tile& tile) { return std::get<std::span<const double>>(tile.rgb).data(); }

}  // namespace

Proof::Proof(const Lattice& own_part, const FileFormat& own_format)
    : part(own_part), format(own_format), bounds(std::size_t(part.columns) * part.rows), proved(bounds.size()) {}

bool Proof::decided(const Tile& tile, int i) const {
    return strahl::decided(values_of(tile) + 3 * i, tile.bounds[i], format.bits, format.gamma);
}

void Proof::put(const Pixel& pixel, const double* rgb, PictureWriter& writer) const {
    writer.put(pixel.x - part.x, pixel.y - part.y, 1, 1, rgb);
}

void Proof::keep(const Tile& tile, PictureWriter& writer) {
    const double* const rgb = values_of(tile);
    const Lattice& own = tile.lattice;
    bool all = true;
    for (int y = 0, i = 0; y < own.rows; ++y) {
        std::size_t at = place_of(own.x, own.y + y);
        for (int x = 0; x < own.columns; ++x, ++i, ++at) {
            const bool known = decided(tile, i);
            bounds[at] = tile.bounds[i];
            proved[at] = known ? By::in_double : By::nothing;
            all &= known;
        }
    }
    if (all) return writer.put(own.x - part.x, own.y - part.y, own.columns, own.rows, rgb);
    const std::lock_guard lock(mutex);
    for (int i = 0; i < own.columns * own.rows; ++i) {
        const Pixel pixel{own.x + i % own.columns, own.y + i / own.columns};
        if (proved[place_of(pixel.x, pixel.y)] == By::nothing)
            undecided.push_back({pixel, {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]}});
        else
            put(pixel, rgb + 3 * i, writer);
    }
}

std::vector<Pixel> Proof::open() const {
    std::vector<Pixel> pixels;
    for (const auto& [pixel, rgb] : undecided)
        if (proved[place_of(pixel.x, pixel.y)] == By::nothing) pixels.push_back(pixel);
    return pixels;
}

bool Proof::settle(const Tile& pixel, By by, PictureWriter& writer) {
    if (!decided(pixel, 0)) return false;
    const Lattice& own = pixel.lattice;
    const std::size_t at = place_of(own.x, own.y);
    bounds[at] = pixel.bounds[0];
    proved[at] = by;
    put({own.x, own.y}, values_of(pixel), writer);
    return true;
}

void Proof::close(PictureWriter& writer) {
    for (const auto& [pixel, rgb] : undecided)
        if (proved[place_of(pixel.x, pixel.y)] == By::nothing) put(pixel, rgb.data(), writer);
    undecided.clear();
}

ProofCounts Proof::counts() const {
    const std::int64_t all = std::ssize(proved), left = std::ranges::count(proved, By::nothing);
    std::vector<double> sorted = bounds;
    std::nth_element(sorted.begin(), sorted.begin() + all / 2, sorted.end());
    return {format.bits, all - left, std::ranges::count(proved, By::in_extended), left, sorted[all / 2]};
}

void Proof::write(const std::string& path) const {
    PictureWriter writer(part.columns, part.rows, 3, path, {.bits = 8});
    std::vector<double> row(3 * std::size_t(part.columns));  // not the whole picture: memory is slow when first used
    for (int y = 0; y < part.rows; ++y) {
        for (int x = 0; x < part.columns; ++x) {
            const std::size_t i = std::size_t(y) * part.columns + x;
            // The brightness falls from 1 for a bound of 1e-16 to .25 for 1.
            const double bright = std::clamp(.25 - std::log10(bounds[i] + 1e-16) * (.75 / 16), .25, 1.);
            constexpr double colors[3][3]{{1, 0, 0}, {.2, .8, .4}, {.2, .4, 1}};
            for (int c = 0; c < 3; ++c)
                row[3 * x + c] = colors[int(proved[i])][c] * (proved[i] == By::nothing ? 1 : bright);
        }
        writer.put(0, y, part.columns, 1, row.data());
    }
    writer.write(path);
}

}  // namespace strahl

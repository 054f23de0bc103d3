#include "trace/cells/lattice_cells.h"

#include <algorithm>
#include <bit>

#include "trace/cells/z_curve.h"

namespace strahl {
namespace {

constexpr int most_seen = 3;  // different signatures in a cell that is worth dividing
constexpr int coarsest = 8;   // the side of cells that a tile begins with

int count_signatures(const std::array<const CellSample*, 4>& corners, const CellSample& middle) {
    std::array<std::uint32_t, 5> seen{middle.signature};
    for (int k = 0; k < 4; ++k) seen[k + 1] = corners[k]->signature;
    std::ranges::sort(seen);
    return static_cast<int>(std::ranges::unique(seen).begin() - seen.begin());
}

/// Returns the largest difference of colours in a channel.
int range_of(const std::array<std::uint32_t, 5>& colors) {
    int most = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        int low = 255, high = 0;
        for (const std::uint32_t color : colors) {
            const int own = static_cast<int>(color >> shift & 255);
            low = std::min(low, own), high = std::max(high, own);
        }
        most = std::max(most, high - low);
    }
    return most;
}

/// Two channels of a colour, with 16 bits for each.
constexpr std::uint32_t channels = 0x00ff00ff;
constexpr int off_middle = 2;  // steps by which the mean of a cell's corners and its middle may differ

/// Returns the mean of two colours, each channel rounded down.
std::uint32_t mean(std::uint32_t a, std::uint32_t b) { return (a & b) + ((a ^ b) >> 1 & 0x7f7f7f7f); }

}  // namespace

void LatticeCells::ask(std::initializer_list<std::pair<int, int>> pixels) {
    for (const auto& [column, row] : pixels) {
        int& sample = sample_at(column, row);
        if (sample >= 0) continue;
        sample = static_cast<int>(places.size());
        places.push_back({static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row)});
    }
}

/// Asks for a cell's corners and its middle.
void LatticeCells::ask(const LatticeCell& cell) {
    const int x = cell.x, y = cell.y, n = cell.size;
    ask({{x, y}, {x + n / 2, y + n / 2}, {x + n, y}, {x, y + n}, {x + n, y + n}});
}

void LatticeCells::look(const Look& look) {
    const std::size_t before = samples.size();
    if (before == places.size()) return;
    samples.resize(places.size()), colors.resize(places.size());
    look(std::span(places).subspan(before), samples.data() + before);
    for (std::size_t i = before; i < places.size(); ++i) {
        colors[i] = lattice->encode(samples[i].rgb);
        if (const auto [x, y] = places[i]; within(x, y)) *color_at(x, y) = colors[i];
    }
}

/// Returns a cell's samples: its corners, in order around it, and its middle.
std::array<int, 5> LatticeCells::samples_of(const LatticeCell& cell) {
    const int x = cell.x, y = cell.y, n = cell.size;
    return {sample_at(x, y), sample_at(x + n, y), sample_at(x + n, y + n), sample_at(x, y + n),
            sample_at(x + n / 2, y + n / 2)};
}

std::array<std::uint32_t, 5> LatticeCells::colors_of(const std::array<int, 5>& own) const {
    return {colors[own[0]], colors[own[1]], colors[own[2]], colors[own[3]], colors[own[4]]};
}

/// Returns whether a cell may hide a thin body.
bool LatticeCells::hides(const LatticeCell& cell, const Corners& corners) const {
    const int x = cell.x, y = cell.y, n = cell.size;
    const double left = tile.x + .5 + x * tile.step_x, right = left + n * tile.step_x;
    const double top = tile.y + .5 + y * tile.step_y, bottom = top + n * tile.step_y;
    const double pixels = double(n) * n * tile.step_x * tile.step_y;
    return thin->hides_in(
        {{{left, top, corners[0]}, {right, top, corners[1]}, {right, bottom, corners[2]}, {left, bottom, corners[3]}}},
        lattice->contrast / 16 / pixels);
}

/// Returns whether the middles of the sides, too, are smooth between the corners.
bool LatticeCells::even_sides(const LatticeCell& cell, const Corners& corners) {
    const int x = cell.x, y = cell.y, n = cell.size, half = n / 2;
    const std::array<std::pair<int, int>, 4> middles{
        {{x + half, y}, {x + n, y + half}, {x + half, y + n}, {x, y + half}}};
    for (std::size_t k = 0; k < 4; ++k) {
        const CellSample &one = *corners[k], &other = *corners[(k + 1) % 4];
        const CellSample& middle = samples[sample_at(middles[k].first, middles[k].second)];
        if (!looks_smooth({&one, &other, &one, &other}, middle, lattice->contrast)) return false;
    }
    return true;
}

/// Interpolates between the colours of four corners, two channels at a time.
void LatticeCells::fill(int x, int y, int size, const std::array<std::uint32_t, 4>& corners) {
    if (!within(x, y)) return;
    const int shift = std::countr_zero(static_cast<unsigned>(size)), columns = std::min(size, tile.columns - x);
    const std::uint32_t n = size, half = n / 2 * 0x00010001;
    const auto along = [&](int a, int b, int row) {
        const auto pair = [&](int bits) {
            const std::uint32_t from = corners[a] >> bits & channels, to = corners[b] >> bits & channels;
            return (from * (n - row) + to * row + half) >> shift & channels;
        };
        return std::pair(pair(0), pair(8));
    };
    for (int row = 0; row < std::min(size, tile.rows - y); ++row) {
        const auto [left, left_other] = along(0, 3, row);
        const auto [right, right_other] = along(1, 2, row);
        std::uint32_t sum = left * n + half, other = left_other * n + half;
        const std::uint32_t step = right - left, other_step = right_other - left_other;  // may wrap; sums are right
        std::uint32_t* to = color_at(x, y + row);
        for (int column = 0; column < columns; ++column, sum += step, other += other_step)
            to[column] = (sum >> shift & channels) | (other >> shift & channels) << 8;
    }
}

/// Fills a cell between its corners, and its middle where that is off.
void LatticeCells::fill(const LatticeCell& cell) {
    const auto [a, b, c, d, middle] = colors_of(samples_of(cell));
    const int x = cell.x, y = cell.y, half = cell.size / 2;
    const std::uint32_t flat = mean(mean(a, c), mean(b, d));
    if (range_of({middle, middle, middle, middle, flat}) <= off_middle) return fill(x, y, cell.size, {a, b, c, d});
    const std::uint32_t ab = mean(a, b), bc = mean(b, c), cd = mean(c, d), da = mean(d, a);
    fill(x, y, half, {a, ab, middle, da});
    fill(x + half, y, half, {ab, b, bc, middle});
    fill(x + half, y + half, half, {middle, bc, c, cd});
    fill(x, y + half, half, {da, middle, cd, d});
}

/// Leaves a cell to be traced in the end, with all its pixels that are not known.
void LatticeCells::leave(const LatticeCell& cell) {
    for (int i = 0; i < cell.size * cell.size; ++i) {
        const int x = cell.x + z_curve[i].x, y = cell.y + z_curve[i].y;
        if (!within(x, y) || sample_at(x, y) >= 0) continue;
        rest.push_back({static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y)});
    }
}

/// Fills, leaves or divides a cell whose samples are known.
void LatticeCells::advance(const LatticeCell& cell) {
    const int x = cell.x, y = cell.y, size = cell.size, half = size / 2;
    const std::array<int, 5> own = samples_of(cell);
    const Corners corners{&samples[own[0]], &samples[own[1]], &samples[own[2]], &samples[own[3]]};
    const CellSample& middle = samples[own[4]];
    const bool alike = cell.sides ? even_sides(cell, corners) : looks_smooth(corners, middle, lattice->contrast);
    if (alike && (cell.sides || !hides(cell, corners))) {
        if (cell.sides || !middle.uneven) return filled.push_back(cell);
        parts.push_back({x, y, size, true});
        return ask({{x + half, y}, {x + size, y + half}, {x + half, y + size}, {x, y + half}});
    }
    if (size == 4 || count_signatures(corners, middle) > most_seen) return leave(cell);
    for (const LatticeCell& part :
         {LatticeCell{x, y, half}, {x + half, y, half}, {x, y + half, half}, {x + half, y + half, half}})
        if (within(part.x, part.y)) parts.push_back(part), ask(part);
}

void LatticeCells::trace(const Lattice& own, const FilledLattice& of, const ThinBodies& bodies, const Look& look_at,
                         const Trace& trace) {
    tile = own, lattice = &of, thin = &bodies;
    const Lattice& all = of.lattice;
    first = of.colors + std::ptrdiff_t((tile.y - all.y) / all.step_y) * all.columns + (tile.x - all.x) / all.step_x;
    known.fill(-1);
    samples.clear(), places.clear(), rest.clear(), parts.clear(), filled.clear();
    constexpr int across_tile = side / coarsest;
    for (const auto [column, row] : std::span(z_curve).first<across_tile * across_tile>()) {
        const LatticeCell cell{column * coarsest, row * coarsest, coarsest};
        if (within(cell.x, cell.y)) parts.push_back(cell), ask(cell);
    }
    while (!parts.empty()) {
        look(look_at);
        std::swap(cells, parts);
        parts.clear();
        for (const LatticeCell& cell : cells) advance(cell);
    }
    traced.resize(rest.size());
    if (!rest.empty()) trace(rest, traced.data());
    for (std::size_t i = 0; i < rest.size(); ++i) *color_at(rest[i].x, rest[i].y) = traced[i];
    // Filled colours replace those that neighbours asked for: a pixel depends on its own cell alone.
    for (const LatticeCell& cell : filled) fill(cell);
}

}  // namespace strahl

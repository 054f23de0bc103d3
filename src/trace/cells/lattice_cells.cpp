#include "trace/cells/lattice_cells.h"

#include <algorithm>

#include "trace/cells/z_curve.h"

namespace strahl {
namespace {

constexpr int coarsest = 8, finest = 4;  // cells of 2 pixels save 12 % of the rays and cost 10 % of the time
constexpr int most_seen = 3;             // different signatures in a cell that is worth dividing

int count_signatures(const std::array<const CellSample*, 4>& corners, const CellSample& middle) {
    std::array<std::uint32_t, 5> seen{middle.signature};
    for (int k = 0; k < 4; ++k) seen[k + 1] = corners[k]->signature;
    std::ranges::sort(seen);
    return static_cast<int>(std::ranges::unique(seen).begin() - seen.begin());
}

}  // namespace

template <class Out>
void LatticeCells<Out>::ask(std::initializer_list<std::pair<int, int>> pixels) {
    for (const auto& [column, row] : pixels) {
        int& sample = sample_at(column, row);
        if (sample >= 0) continue;
        sample = static_cast<int>(places.size());
        places.push_back({static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row)});
    }
}

/// Asks for a cell's corners and its middle.
template <class Out>
void LatticeCells<Out>::ask(const LatticeCell& cell) {
    const int x = cell.x, y = cell.y, n = cell.size;
    ask({{x, y}, {x + n / 2, y + n / 2}, {x + n, y}, {x, y + n}, {x + n, y + n}});
}

template <class Out>
void LatticeCells<Out>::look(const Look& look) {
    const std::size_t before = samples.size();
    if (before == places.size()) return;
    samples.resize(places.size());
    look(std::span(places).subspan(before), samples.data() + before);
    for (std::size_t i = before; i < places.size(); ++i) {
        const auto [x, y] = places[i];
        if (!within(x, y)) continue;
        for (int c = 0; c < 3; ++c)
            rgb[3 * (std::size_t(y) * tile.columns + x) + c] = static_cast<Out>(samples[i].rgb[c]);
    }
}

template <class Out>
auto LatticeCells<Out>::corners_of(const LatticeCell& cell) -> Corners {
    const int x = cell.x, y = cell.y, n = cell.size;
    return {&samples[sample_at(x, y)], &samples[sample_at(x + n, y)], &samples[sample_at(x + n, y + n)],
            &samples[sample_at(x, y + n)]};
}

template <class Out>
const CellSample& LatticeCells<Out>::middle_of(const LatticeCell& cell) {
    return samples[sample_at(cell.x + cell.size / 2, cell.y + cell.size / 2)];
}

template <class Out>
bool LatticeCells<Out>::smooth(const LatticeCell& cell, const Corners& corners, double contrast,
                               const ThinBodies& thin) {
    if (!looks_smooth(corners, middle_of(cell), contrast)) return false;
    const int x = cell.x, y = cell.y, n = cell.size;
    const double left = tile.x + .5 + x * tile.step_x, right = left + n * tile.step_x;
    const double top = tile.y + .5 + y * tile.step_y, bottom = top + n * tile.step_y;
    const double pixels = double(n) * n * tile.step_x * tile.step_y;
    return !thin.hides_in(
        {{{left, top, corners[0]}, {right, top, corners[1]}, {right, bottom, corners[2]}, {left, bottom, corners[3]}}},
        contrast / 16 / pixels);
}

/// Returns whether the middles of the sides, too, are smooth between the corners.
template <class Out>
bool LatticeCells<Out>::even_sides(const LatticeCell& cell, const Corners& corners, double contrast) {
    const int x = cell.x, y = cell.y, n = cell.size, half = n / 2;
    const std::array<std::pair<int, int>, 4> middles{
        {{x + half, y}, {x + n, y + half}, {x + half, y + n}, {x, y + half}}};
    for (std::size_t k = 0; k < 4; ++k) {
        const CellSample &first = *corners[k], &second = *corners[(k + 1) % 4];
        if (!looks_smooth({&first, &second, &first, &second}, samples[sample_at(middles[k].first, middles[k].second)],
                          contrast))
            return false;
    }
    return true;
}

template <class Out>
void LatticeCells<Out>::fill(const LatticeCell& cell, const Corners& corners) {
    interpolate(corners, cell.size, std::min(cell.size, tile.columns - cell.x), std::min(cell.size, tile.rows - cell.y),
                Out(0), &rgb[3 * (std::size_t(cell.y) * tile.columns + cell.x)], std::size_t(3) * tile.columns);
}

/// Leaves a cell to be traced in the end, with all its pixels that are not known.
template <class Out>
void LatticeCells<Out>::leave(const LatticeCell& cell) {
    for (int i = 0; i < cell.size * cell.size; ++i) {
        const int x = cell.x + z_curve[i].x, y = cell.y + z_curve[i].y;
        if (!within(x, y) || sample_at(x, y) >= 0) continue;
        rest.push_back({static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y)});
    }
}

/// Fills, leaves or divides a cell whose samples are known.
template <class Out>
void LatticeCells<Out>::advance(const LatticeCell& cell, double contrast, const ThinBodies& thin) {
    const int x = cell.x, y = cell.y, size = cell.size, half = size / 2;
    const Corners corners = corners_of(cell);
    const CellSample& middle = middle_of(cell);
    if (cell.sides ? even_sides(cell, corners, contrast) : smooth(cell, corners, contrast, thin)) {
        if (cell.sides || !middle.uneven) return filled.push_back(cell);
        parts.push_back({x, y, size, true});
        return ask({{x + half, y}, {x + size, y + half}, {x + half, y + size}, {x, y + half}});
    }
    if (size == finest || count_signatures(corners, middle) > most_seen) return leave(cell);
    for (const LatticeCell& part :
         {LatticeCell{x, y, half}, {x + half, y, half}, {x, y + half, half}, {x + half, y + half, half}})
        if (within(part.x, part.y)) parts.push_back(part), ask(part);
}

template <class Out>
void LatticeCells<Out>::trace(const Lattice& own, double contrast, const ThinBodies& thin, const Look& look_at,
                              const Trace& trace) {
    tile = own;
    rgb.resize(std::size_t(3) * tile.columns * tile.rows);
    known.fill(-1);
    samples.clear(), places.clear(), rest.clear(), parts.clear(), filled.clear();
    constexpr int across_tile = side / coarsest;
    for (const auto [column, row] : std::span(z_curve).template first<across_tile * across_tile>()) {
        const LatticeCell cell{column * coarsest, row * coarsest, coarsest};
        if (within(cell.x, cell.y)) parts.push_back(cell), ask(cell);
    }
    while (!parts.empty()) {
        look(look_at);
        std::swap(cells, parts);
        parts.clear();
        for (const LatticeCell& cell : cells) advance(cell, contrast, thin);
    }
    traced.resize(3 * rest.size());
    if (!rest.empty()) trace(rest, traced.data());
    const Out* from = traced.data();
    for (const auto [x, y] : rest) {
        Out* const to = &rgb[3 * (std::size_t(y) * tile.columns + x)];
        for (int c = 0; c < 3; ++c) to[c] = *from++;
    }
    // Over what neighbours asked for, so that a pixel depends on its own cell alone.
    for (const LatticeCell& cell : filled) fill(cell, corners_of(cell));
}

template class LatticeCells<float>;
template class LatticeCells<double>;

}  // namespace strahl

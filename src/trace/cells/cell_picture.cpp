#include "trace/cells/cell_picture.h"

#include <algorithm>
#include <array>
#include <utility>

#include "trace/cells/checked_pixels.h"

namespace strahl {

namespace {

/// Returns the begins and the ends of tiles along a side of a view, of which a region takes a part. Tiles and cells are
/// those of the whole view, or of the halves before and from `half` on; of a crop those that it touches.
std::vector<std::array<int, 2>> tiles_along(int first, int last, int half, int side) {
    std::vector<std::array<int, 2>> tiles;
    for (const auto& [begin, end] : {std::array{0, half}, std::array{half, side}}) {
        const int from = std::max(first, begin), to = std::min(last, end);
        if (from >= to) continue;
        const auto down = [begin = begin](int at, int step) { return begin + (at - begin) / step * step; };
        for (int at = down(from, tile_pixels); at < to; at += tile_pixels)
            tiles.push_back({std::max(at, down(from, coarsest_cell)),
                             std::min({at + tile_pixels, down(to + coarsest_cell - 1, coarsest_cell), end})});
    }
    return tiles;
}

}  // namespace

void CellPicture::begin(const Scene& scene, const View& view, const Lattice& new_region, double new_error,
                        int largest) {
    region = new_region, error = new_error, most_contrast = contrast_for(error), largest_filled = largest;
    for (auto& tile : made)
        if (tile) spare.push_back(std::move(tile));
    places.clear(), made.clear(), begun.clear();
    camera = view.camera;
    moments = view.moments ? static_cast<int>(view.moments->size()) : 0;
    const auto flies = [&](const Shot& moment) { return moment.camera != camera; };
    const bool layers_in_time = view.moments && view.layers.any();  // which only nets can average
    thin.reset();
    if (!has_lens(camera) && !layers_in_time && (!view.moments || std::ranges::none_of(*view.moments, flies)))
        thin.emplace(scene, view);
    sum = {}, done = 0;
    const EyeHalves halves = halves_of(view);
    const auto columns = tiles_along(region.x, region.x + region.columns, halves.column, view.width);
    for (const auto& [top, bottom] : tiles_along(region.y, region.y + region.rows, halves.row, view.height))
        for (const auto& [left, right] : columns) places.push_back({left, top, right - left, bottom - top});
    made.resize(places.size());
    begun.resize(places.size());
}

std::unique_ptr<CellPicture::InWork> CellPicture::make() {
    const std::lock_guard lock(mutex);
    if (spare.empty()) return std::make_unique<InWork>();
    std::unique_ptr<InWork> tile = std::move(spare.back());
    spare.pop_back();
    return tile;
}

void CellPicture::refine(int i, int finest, const Job& job, const TraceAt& trace, const TraceLensRays& trace_lens,
                         const BrightSpots& spots, LayerTile* layers) {
    const TilePlace& place = places[i];
    if (std::exchange(begun[i], true) && !made[i]) return;  // an earlier pass has finished it
    const bool first = !made[i];
    if (first) made[i] = make();
    auto& [cells, nets, by_nets] = *made[i];
    if (layers) layers->begin(place.columns * place.rows);
    const auto begin_nets = [&] {
        by_nets = true;
        nets.begin(place.x, place.y, place.columns, place.rows, error, camera, moments, &spots);
    };
    if (first && thin) {
        by_nets = false;
        cells.begin(place.x, place.y, place.columns, place.rows, most_contrast, largest_filled, *thin, layers);
    } else if (first) {
        begin_nets();
    }
    if (!by_nets) {
        cells.refine(finest, [&](std::span<const Point> points, CellSample* samples) {
            trace(place.x, place.y, points, 0, samples);
        });
        if (moments > 0 && finest == 0 && !job.stopped())
            begin_nets(), nets.keep_still(cells.values(), cells.counts(), trace_lens);
    }
    if (by_nets) nets.refine(finest == 0, trace_lens);
    if (job.stopped()) return;
    // Only the part of the tile that is in the crop is handed on.
    const int left = std::max(place.x, region.x), right = std::min(place.x + place.columns, region.x + region.columns);
    const int top = std::max(place.y, region.y), bottom = std::min(place.y + place.rows, region.y + region.rows);
    const Lattice part{.x = left, .y = top, .columns = right - left, .rows = bottom - top};
    const std::span<const double> rgb = by_nets ? nets.values() : cells.values();
    const std::vector<float> layered = layers ? layers->values(rgb) : std::vector<float>();
    // Returns the values of the part, which may be a piece of `memory`.
    const auto cut_out = [&](const auto& all, auto& memory) {
        const std::size_t each = all.size() / place.columns / place.rows;
        const auto row = [&](int y) { return each * place.columns * (y - place.y); };
        if (part.columns == place.columns) return std::span(all).subspan(row(top), each * part.columns * part.rows);
        for (int y = top; y < bottom; ++y) {
            const auto first = all.begin() + std::ptrdiff_t(row(y) + each * (left - place.x));
            memory.insert(memory.end(), first, first + std::ptrdiff_t(each * part.columns));
        }
        return std::span(std::as_const(memory));
    };
    std::vector<double> some_rgb;
    std::vector<float> some_layers;
    const std::span<const double> own_rgb = cut_out(rgb, some_rgb);
    job.sink({part, own_rgb, {}, cut_out(layered, some_layers)});
    if (by_nets ? nets.finished() : cells.finished() && moments == 0) {
        const std::vector<std::uint32_t> counts = by_nets ? nets.counts() : cells.counts();
        const double share = checked / (double(region.columns) * region.rows);
        MeasuredError off;
        if (checked > 0 && by_nets)
            off = nets.measured(std::min(1., 32 * share), trace_lens);
        else if (checked > 0)
            off = measured_error({place.columns, rgb, counts}, share,
                                 static_cast<std::uint32_t>(place.y * 65536 + place.x + 1),
                                 [&](std::span<const Point> points, double side, CellSample* samples) {
                                     trace(place.x, place.y, points, side, samples);
                                 });
        if (job.stopped()) return;
        const std::lock_guard lock(mutex);
        sum.add(counts), sum.measured += off;
        spare.push_back(std::move(made[i]));
        ++done;
    }
}

}  // namespace strahl

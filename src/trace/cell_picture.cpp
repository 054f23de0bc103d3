#include "trace/cell_picture.h"

#include <algorithm>
#include <utility>

namespace strahl {

CellPicture::CellPicture(const Scene& scene, const View& view, const Lattice& own_region, double error,
                         int largest)
    : region(own_region), most_contrast(contrast_for(error)), largest_filled(largest), thin(scene, view) {
    // Tiles and cells are those of the whole view; of a crop those that it touches.
    const auto down = [](int x) { return x / coarsest_cell * coarsest_cell; };
    const int right = region.x + region.columns, bottom = region.y + region.rows;
    for (int y = region.y / tile_pixels * tile_pixels; y < bottom; y += tile_pixels)
        for (int x = region.x / tile_pixels * tile_pixels; x < right; x += tile_pixels) {
            const int left = std::max(x, down(region.x)), top = std::max(y, down(region.y));
            const int end_x = std::min({x + tile_pixels, down(right + coarsest_cell - 1), view.width});
            const int end_y = std::min({y + tile_pixels, down(bottom + coarsest_cell - 1), view.height});
            places.push_back({left, top, end_x - left, end_y - top});
        }
    made.resize(places.size());
    begun.resize(places.size());
}

void CellPicture::refine(int i, int finest, const Sink& sink, const std::atomic<bool>* stop, const TraceAt& trace) {
    const TilePlace& place = places[i];
    if (std::exchange(begun[i], true) && !made[i]) return;  // finished before
    if (!made[i])
        made[i] = std::make_unique<Cells>(place.x, place.y, place.columns, place.rows, most_contrast, largest_filled, thin);
    Cells& cells = *made[i];
    cells.refine(finest, [&](std::span<const Point> points, CellSample* samples) {
        trace(place.x, place.y, points, samples);
    });
    if (stop && *stop) return;
    std::vector<double> rgb(std::size_t(3) * place.columns * place.rows);
    cells.store(rgb.data());
    // Of tiles at the border of a crop only what is in it.
    const int left = std::max(place.x, region.x), right = std::min(place.x + place.columns, region.x + region.columns);
    const int top = std::max(place.y, region.y), bottom = std::min(place.y + place.rows, region.y + region.rows);
    std::vector<double> part;
    for (int y = top; y < bottom; ++y) {
        const auto row = rgb.begin() + 3 * (std::ptrdiff_t(y - place.y) * place.columns + left - place.x);
        part.insert(part.end(), row, row + 3 * (right - left));
    }
    if (cells.finished()) {
        Sampled own;
        cells.add_to(own);
        made[i].reset();
        ++done;
        const std::lock_guard lock(counting);
        sum += own;
    }
    sink({{.x = left, .y = top, .columns = right - left, .rows = bottom - top}, std::span<const double>(part)});
}

}  // namespace strahl

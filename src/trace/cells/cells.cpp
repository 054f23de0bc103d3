#include "trace/cells/cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trace/cells/z_curve.h"

namespace strahl {
namespace {

constexpr std::int32_t least_cell = Point::unit / 32;
constexpr int side = tile_pixels + 1;      // of the lattice
constexpr double steepest_gradient = .06;  // across a cell of one signature
/// The error of the loosest filter of patterns over the deviation of samples from each other, found by experiment.
constexpr double filter_off = .85;
/// Means of patterns are assumed to be off by so many standard deviations, found by experiment.
constexpr double most_doubt = 1.7;
/// How much less contrast cells may have in which patterns vary, for there are many of them; found by experiment.
constexpr double patterned = .8;
std::uint64_t key_of(Point p) { return std::uint64_t(std::uint32_t(p.x)) << 32 | std::uint32_t(p.y); }

Point on_side(std::int32_t x, std::int32_t y, std::int32_t size, int number, std::int32_t along) {
    switch (number) {
        case 0:
            return {x + along, y};
        case 1:
            return {x + size, y + along};
        case 2:
            return {x + size - along, y + size};
        default:
            return {x, y + size - along};
    }
}

/// Returns by how much the colour of a pattern is multiplied, about: at most 1, as other light may be seen beside it.
double light_of(const CellSample& sample) {
    const double light = sample.rgb[0] + sample.rgb[1] + sample.rgb[2];
    const double color = double(sample.color[0]) + double(sample.color[1]) + double(sample.color[2]);
    return std::min(light / std::max(color, 1e-6), 1.);
}

/// Returns the chord between the middles of the stretches where an edge crosses two sides of a cell.
ChordParts chord_of(const std::array<Crossing, 2>& crossings, std::int32_t size) {
    const auto& [first, second] = crossings;
    const auto position = [&](const Crossing& c) { return (c.low + c.high) / (2. * size); };
    return parts_of({first.number, second.number}, {position(first), position(second)});
}

}  // namespace

void Cells::begin(int x, int y, int new_columns, int new_rows, double new_contrast, int largest_filled,
                  const ThinBodies& bodies, LayerTile* own_layers) {
    layers = own_layers, channels = layers && layers->layers().alpha ? 4 : 3;
    left = x, top = y, columns = new_columns, rows = new_rows;
    contrast = new_contrast, largest = largest_filled * unit, thin = &bodies;
    samples.clear(), points.clear(), between.clear(), active.clear(), waiting.clear(), searches.clear(),
        part_searches.clear();
    lattice.assign(side * side, -1);
    sums.assign(std::size_t(3) * columns * rows, 0);
    constexpr int in_tile = tile_pixels / coarsest_cell;
    for (const auto [column, row] : std::span(z_curve).first<in_tile * in_tile>()) {
        Cell cell{column * coarsest_cell * unit, row * coarsest_cell * unit, coarsest_cell * unit, {}};
        if (!within(cell.x, cell.y)) continue;
        for (int k = 0; k < 4; ++k) cell.corners[k] = sample_at(on_side(cell.x, cell.y, cell.size, k, 0));
        waiting.push_back(cell);
    }
}

double side_of(Point point) {
    const std::int32_t all = point.x | point.y | Point::unit, step = all & -all;  // the last bit set
    const bool middle = point.x & step && point.y & step;
    return std::min(double(middle ? 2 * step : step) / Point::unit, 1.);
}

int Cells::sample_at(Point point) {
    const auto add = [&] { return points.push_back(point), static_cast<int>(points.size()) - 1; };
    if ((point.x | point.y) % unit == 0) {
        int& known = lattice[point.y / unit * side + point.x / unit];
        return known >= 0 ? known : known = add();
    }
    const auto [place, is_new] = between.try_emplace(key_of(point));
    return is_new ? place->second = add() : place->second;
}

bool Cells::within(std::int32_t x, std::int32_t y) const { return x < columns * unit && y < rows * unit; }

/// Divides a cell into quarters, which share their corners with each other and some with the cell.
void Cells::divide(const Cell& cell) {
    const std::int32_t half = cell.size / 2, x = cell.x + half, y = cell.y + half;
    const bool right = within(x, cell.y), below = within(cell.x, y);
    const auto [corner_0, corner_1, corner_2, corner_3] = cell.corners;
    const int centre = cell.middle >= 0 ? cell.middle : sample_at({x, y});
    const int on_top = sample_at({x, cell.y}), on_left = sample_at({cell.x, y});
    const int on_right = right ? sample_at({cell.x + cell.size, y}) : -1;
    const int on_bottom = below ? sample_at({x, cell.y + cell.size}) : -1;
    active.push_back({cell.x, cell.y, half, {corner_0, on_top, centre, on_left}});
    if (right) active.push_back({x, cell.y, half, {on_top, corner_1, on_right, centre}});
    if (below) active.push_back({cell.x, y, half, {on_left, centre, on_bottom, corner_3}});
    if (right && below) active.push_back({x, y, half, {centre, on_right, corner_2, on_bottom}});
}

void Cells::refine(int pixels, const TracePoints& trace) {
    const int finest = pixels * unit;
    std::vector<Cell> round = std::exchange(waiting, {});
    for (const Cell& cell : round)  // takes back what stood for an unfinished cell
        if (cell.size == unit) std::fill_n(&sums[pixel_of(cell)], 3, 0);
    while (!round.empty()) {
        for (Cell& cell : round)
            if (cell.size > std::max(unit, finest) && cell.middle < 0) ask_middle(cell);
        const std::size_t known = samples.size();
        samples.resize(points.size());
        if (known < points.size()) trace(std::span(points).subspan(known), samples.data() + known);
        for (Cell& cell : round) advance(cell, finest);
        round.clear();
        std::swap(round, active);
    }
    for (const Cell& cell : waiting) fill(cell);
}

/// Goes on with a cell whose samples are known: it is filled, divided, held back, or asks for further samples.
void Cells::advance(Cell& cell, int finest) {
    switch (cell.stage) {
        case Stage::corners:
            if (cell.size <= unit) return look_at_corners(cell, finest);
            return cell.size > finest ? look_at_large(cell) : waiting.push_back(cell);
        case Stage::middle:
            return look_at_middle(cell);
        case Stage::ends:
            return search(cell);
        case Stage::beside:
            return look_beside(cell);
        case Stage::part:
            return look_at_part(cell);
    }
}

bool Cells::hides_something(const Cell& cell, std::optional<FlatPart>* part) const {
    const double s = double(cell.size) / unit, least = contrast / 8 / (s * s);
    std::array<CellCorner, 4> corners;
    for (int k = 0; k < 4; ++k) {
        const Point& p = points[cell.corners[k]];
        corners[k] = {left + p.x / double(unit), top + p.y / double(unit), &samples[cell.corners[k]]};
    }
    return thin->hides_in(corners, least, part);
}

/// Returns the difference of colour that a pixel in this cell may have.
double Cells::contrast_in(const Cell& cell) const {
    const auto detailed = [&](int k) { return samples[k].detailed(); };
    return std::ranges::any_of(cell.corners, detailed) ? patterned * contrast : contrast;
}

std::array<const CellSample*, 4> Cells::corners_of(const Cell& cell) const {
    const auto of = [&](int k) { return &samples[cell.corners[k]]; };
    return {of(0), of(1), of(2), of(3)};
}

void Cells::ask_middle(Cell& cell) { cell.middle = sample_at({cell.x + cell.size / 2, cell.y + cell.size / 2}); }

/// Fills or divides a cell of more than a pixel, whose middle is known.
void Cells::look_at_large(const Cell& cell) {
    const auto corners = corners_of(cell);
    const CellSample& middle = samples[cell.middle];
    if (cell.size > largest) return divide(cell);
    const auto detailed = [](const CellSample* sample) { return sample->detailed(); };
    if (std::ranges::any_of(corners, detailed)) return divide(cell);  // half of the pattern lies between footprints
    looks_smooth(corners, middle, contrast, channels) && !hides_something(cell) ? fill(cell) : divide(cell);
}

/// Decides by the corners what happens to a cell of a pixel or less.
void Cells::look_at_corners(Cell& cell, int finest) {
    const bool equal = equal_signatures(cell);
    const double s = double(cell.size) / unit, share = s * s;
    std::optional<FlatPart> part;
    const bool glints = !(glint_range(corners_of(cell)) * share <= most_glint), hidden = hides_something(cell, &part);
    const double difference = spread(cell) * share, allowed = contrast_in(cell);
    const bool rough =
        glints || hidden || !(equal ? difference <= std::min(16 * allowed, steepest_gradient) : difference <= allowed);
    const bool small = equal ? cell.size <= unit / 4 && !shows_pattern(cell) : cell.size < unit / 2;
    if (!rough && small) return finish_smooth(cell);
    if (cell.size <= finest) return waiting.push_back(cell);
    if (part && begin_part(cell, *part)) return active.push_back(cell);
    if (rough) return !hidden && begin_search(cell) ? active.push_back(cell) : go_on(cell);
    ask_middle(cell);
    cell.stage = Stage::middle;
    active.push_back(cell);
}

/// Divides a cell that is neither smooth nor crossed by one edge, or finishes it if it is one of the smallest.
void Cells::go_on(Cell& cell) {
    if (cell.size > least_cell) return divide(cell);
    finish_smooth(cell);
}

void Cells::look_at_middle(Cell& cell) {
    const double s = double(cell.size) / unit, off = off_corners(cell);
    if (off * s * s <= contrast_in(cell)) return finish_smooth(cell);
    cell.middle = -1;
    if (begin_search(cell)) return active.push_back(cell);
    go_on(cell);
}

/// Sets out to find where an edge crosses the cell's sides, if there seems to be just one.
bool Cells::begin_search(Cell& cell) {
    std::array<std::uint32_t, 4> signatures;
    for (int k = 0; k < 4; ++k) signatures[k] = samples[cell.corners[k]].signature;
    const auto sides = changing_sides(signatures);
    if (!sides) return false;
    Search search;
    for (int i = 0; i < 2; ++i) {
        const int number = (*sides)[i];
        search.crossings[i] = {number, 0, cell.size, cell.corners[number], cell.corners[(number + 1) % 4]};
        search.probes[i] = sample_at(on_side(cell.x, cell.y, cell.size, number, cell.size / 2));
    }
    cell.search = static_cast<int>(searches.size());
    searches.push_back(search);
    cell.stage = Stage::ends;
    return true;
}

/// Halves the stretches in which the signature changes.
void Cells::search(Cell& cell) {
    const double s = double(cell.size) / unit;
    const auto fine = static_cast<std::int32_t>(std::max(2., std::min(.25 * s, contrast / (spread(cell) * s)) * unit));
    auto& [crossings, probes] = searches[cell.search];
    bool found = true;
    for (int i = 0; i < 2; ++i) {
        Crossing& crossing = crossings[i];
        if (probes[i] < 0) continue;
        const std::int32_t half = (crossing.low + crossing.high) / 2;
        const std::uint32_t signature = samples[probes[i]].signature;
        if (signature == samples[crossing.low_sample].signature)
            crossing.low = half, crossing.low_sample = probes[i];
        else if (signature == samples[crossing.high_sample].signature)
            crossing.high = half, crossing.high_sample = probes[i];
        else
            return go_on(cell);
        probes[i] = -1;
        if (crossing.high - crossing.low <= fine) continue;
        probes[i] = sample_at(on_side(cell.x, cell.y, cell.size, crossing.number, (crossing.low + crossing.high) / 2));
        found = false;
    }
    if (found) {
        const ChordParts parts = chord_of(crossings, cell.size);
        const double aside = std::min(fine / double(cell.size), parts.length / 4);
        for (int i = 0; i < 2; ++i) {
            const double away = i == 0 ? -aside : aside;
            const auto place = [&](double at) {
                return std::clamp(static_cast<std::int32_t>(std::lround(at * cell.size)), 0, cell.size);
            };
            probes[i] = sample_at({cell.x + place(parts.middle_x + away * parts.normal_x),
                                   cell.y + place(parts.middle_y + away * parts.normal_y)});
        }
        cell.stage = Stage::beside;
    }
    active.push_back(cell);
}

/// Finishes a cell if its edge is as straight as the chord between the ends: both parts have the colours of their
/// samples then.
void Cells::look_beside(Cell& cell) {
    const auto& [crossings, probes] = searches[cell.search];
    const auto& [first, second] = crossings;
    const int ends[2][2] = {{first.high_sample, second.low_sample}, {first.low_sample, second.high_sample}};
    for (int part = 0; part < 2; ++part)
        if (samples[probes[part]].signature != samples[ends[part][0]].signature) return go_on(cell);

    const double first_area = chord_of(crossings, cell.size).first_area;
    const double s = double(cell.size) / unit, allowed = contrast_in(cell);
    // Footprints of patterns reach beyond edges, so that both parts may be off in the same way.
    const double most = allowed < contrast ? allowed : 2 * allowed;
    std::array<double, 3> color{};
    std::vector<int> used[2];  // samples of each part, for layers
    for (int part = 0; part < 2; ++part) {
        double sum[4] = {}, low[4], high[4], count = 0;
        const auto add = [&](int sample) {
            if (layers) used[part].push_back(sample);
            for (int c = 0; c < channels; ++c) {
                const double value = samples[sample].rgb[c];
                sum[c] += value;
                low[c] = count > 0 ? std::min(low[c], value) : value;
                high[c] = count > 0 ? std::max(high[c], value) : value;
            }
            ++count;
        };
        for (int k = 0; k < 4; ++k)
            if ((k > first.number && k <= second.number) == (part == 0)) add(cell.corners[k]);
        for (const int end : ends[part]) add(end);
        add(probes[part]);
        const double area = part == 0 ? first_area : 1 - first_area;
        for (int c = 0; c < channels; ++c) {
            if (!((high[c] - low[c]) * area * s * s <= most)) return go_on(cell);
            if (c < 3) color[c] += area * sum[c] / count;
        }
    }
    finish(cell, color);
    if (layers) average_part(cell, used[0], first_area), average_part(cell, used[1], 1 - first_area);
}

/// Asks for samples of a thin body's part of a cell, if the corners beside it show one thing, and those in it others.
bool Cells::begin_part(Cell& cell, const FlatPart& part) {
    constexpr unsigned all = 15;
    if (part.corners == all) return false;
    PartSearch search{.part = part};
    for (int k = 0; k < 4; ++k)
        if (!(part.corners >> k & 1)) search.beside = samples[cell.corners[k]].signature;
    for (int k = 0; k < 4; ++k)
        if ((samples[cell.corners[k]].signature == search.beside) == bool(part.corners >> k & 1)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto place = [&](double at) {
            return std::clamp(static_cast<std::int32_t>(std::lround(at * cell.size)), 0, cell.size);
        };
        search.probes[i] = sample_at({cell.x + place(part.places[i].x), cell.y + place(part.places[i].y)});
    }
    cell.search = static_cast<int>(part_searches.size());
    part_searches.push_back(search);
    cell.stage = Stage::part;
    return true;
}

/// Finishes a cell with a thin body's part of it if no sample in the part shows what is beside it, with the part's
/// area.
void Cells::look_at_part(Cell& cell) {
    const auto& [part, probes, beside] = part_searches[cell.search];
    const double s = double(cell.size) / unit;
    std::array<double, 3> color{};
    std::vector<int> both[2];
    for (const bool in : {false, true}) {
        std::vector<int>& own = both[in];
        for (int k = 0; k < 4; ++k)
            if (bool(part.corners >> k & 1) == in) own.push_back(cell.corners[k]);
        if (in) own.insert(own.end(), probes.begin(), probes.end());
        const double area = in ? part.share : 1 - part.share;
        for (int c = 0; c < channels; ++c) {
            double sum = 0, low = samples[own[0]].rgb[c], high = low;
            for (const int sample : own) {
                if ((samples[sample].signature == beside) == in) return go_on(cell);
                const double value = samples[sample].rgb[c];
                sum += value, low = std::min(low, value), high = std::max(high, value);
            }
            // Samples in the part may be on several sides of the body, of which nothing says how large each is.
            if (!((high - low) * area * s * s <= (in ? .25 : 1) * contrast_in(cell))) return go_on(cell);
            if (c < 3) color[c] += area * sum / static_cast<double>(own.size());
        }
    }
    finish(cell, color);
    if (layers) average_part(cell, both[0], 1 - part.share), average_part(cell, both[1], part.share);
}

bool Cells::equal_signatures(const Cell& cell) const {
    const auto of = [&](int k) { return samples[cell.corners[k]].signature; };
    return of(0) == of(1) && of(1) == of(2) && of(2) == of(3);
}

/// Returns whether all samples show the same, with a pattern in which some see detail.
bool Cells::shows_pattern(const Cell& cell) const {
    const CellSample& first = samples[cell.corners[0]];
    bool detailed = false;
    const auto same = [&](int k) {
        detailed = detailed || samples[k].detailed();
        return samples[k].filtered && samples[k].signature == first.signature;
    };
    return std::ranges::all_of(cell.corners, same) && (cell.middle < 0 || same(cell.middle)) && detailed;
}

/// Calls use(value), where value(k, c) is channel c of corner k or, for k = 4, of the middle if it is known. In cells
/// that show a pattern values are as if it had one colour.
template <class Use>
auto Cells::with_values(const Cell& cell, const Use& use) const {
    if (!shows_pattern(cell))
        return use([&](int k, int c) { return samples[k < 4 ? cell.corners[k] : cell.middle].rgb[c]; });
    std::array<const CellSample*, 5> all{};
    std::ranges::copy(corners_of(cell), all.begin());
    if (cell.middle >= 0) all[4] = &samples[cell.middle];
    const auto values = without_pattern(std::span(all).first(cell.middle < 0 ? 4 : 5));
    return use([&](int k, int c) { return values[k][c]; });
}

/// Returns the largest difference of a channel between two corners.
double Cells::spread(const Cell& cell) const {
    return with_values(cell, [this](const auto& value) {
        double most = 0;
        for (int c = 0; c < channels; ++c) {
            double low = value(0, c), high = low;
            for (int k = 1; k < 4; ++k) low = std::min(low, value(k, c)), high = std::max(high, value(k, c));
            most = std::max(most, high - low);
        }
        return most;
    });
}

std::array<double, 3> Cells::mean(const Cell& cell) const {
    return with_values(cell, [&](const auto& value) {
        std::array<double, 3> color{};
        for (int c = 0; c < 3; ++c) {
            for (int k = 0; k < 4; ++k) color[c] += value(k, c);
            color[c] *= .25;
            // Takes the mean of the four triangles around the middle where that is known.
            if (cell.middle >= 0) color[c] = (2 * color[c] + value(4, c)) / 3;
        }
        return color;
    });
}

/// Returns the largest difference of a channel between the middle and the mean of the corners. If they show a pattern
/// the middle has seen its mean, and the filter is assumed to be off by a share of the samples' deviation, or by its
/// doubt.
double Cells::off_corners(const Cell& cell) const {
    const CellSample& middle = samples[cell.middle];
    const auto corners = corners_of(cell);
    if (!shows_pattern(cell)) return middle_off(corners, middle, channels);
    return with_values(cell, [&](const auto& value) {
        double loose = middle.loose;
        for (const CellSample* corner : corners) loose = std::max(loose, double(corner->loose));
        double off =
            std::max(filter_off * loose * deviation_of(corners, middle), most_doubt * light_of(middle) * middle.doubt);
        for (int c = 0; c < 3; ++c)
            off = std::max(off, std::abs(.25 * (value(0, c) + value(1, c) + value(2, c) + value(3, c)) - value(4, c)));
        return off;
    });
}

/// Adds a cell of a pixel or less to its pixel.
void Cells::finish(const Cell& cell, const std::array<double, 3>& color) {
    const double area = double(cell.size) / unit * (double(cell.size) / unit);
    double* const sum = &sums[pixel_of(cell)];
    for (int c = 0; c < 3; ++c) sum[c] += area * color[c];
}

void Cells::finish_smooth(const Cell& cell) {
    finish(cell, mean(cell));
    if (layers) average_layers(cell);
}

/// Averages layers by the weights that mean() gives the samples' light.
void Cells::average_layers(const Cell& cell) {
    const double s = double(cell.size) / unit, of_corner = s * s * (cell.middle < 0 ? 1. / 4 : 1. / 6);
    std::array<int, 5> all{cell.corners[0], cell.corners[1], cell.corners[2], cell.corners[3], cell.middle};
    const int count = cell.middle < 0 ? 4 : 5, pixel = static_cast<int>(pixel_of(cell) / 3);
    const auto weight = [&](int k) { return k < 4 ? of_corner : s * s / 3; };
    // Changes the weights of samples so that their sum is the mean of without_pattern().
    std::array<double, 3> off{}, color{}, per{};
    const bool patterned = count == 5 && shows_pattern(cell);
    const auto color_of = [&](int k, std::size_t c) { return double(samples[all[k]].color[c]); };
    for (std::size_t c = 0; c < 3 && patterned; ++c) {
        double variance = 0;
        for (int k = 0; k < 5; ++k) color[c] += color_of(k, c) / 5;
        for (int k = 0; k < 5; ++k) variance += (color_of(k, c) - color[c]) * (color_of(k, c) - color[c]);
        for (int k = 0; k < 4; ++k) off[c] += weight(k) * (color_of(k, c) - color_of(4, c));
        per[c] = variance > 0 ? 1 / variance : 0;
    }
    for (int k = 0; k < count; ++k) {
        std::array<double, 3> light{weight(k), weight(k), weight(k)};
        for (std::size_t c = 0; c < 3 && patterned; ++c) light[c] -= off[c] * per[c] * (color_of(k, c) - color[c]);
        layers->average(pixel, all[k], weight(k), light);
    }
}

/// Averages layers over a part of a cell with this share of its area, in which these samples lie.
void Cells::average_part(const Cell& cell, std::span<const int> part, double share) {
    const double s = double(cell.size) / unit, weight = share * s * s / static_cast<double>(part.size());
    for (const int sample : part) layers->average(static_cast<int>(pixel_of(cell) / 3), sample, weight);
}

/// Interpolates in a cell of a pixel or more.
void Cells::fill(const Cell& cell) {
    const int n = cell.size / unit, x = cell.x / unit, y = cell.y / unit;
    interpolate(corners_of(cell), n, std::min(n, columns - x), std::min(n, rows - y), .5, &sums[pixel_of(cell)],
                std::size_t(3) * columns);
    if (layers) fill_layers(cell);
}

void Cells::fill_layers(const Cell& cell) {
    const int n = cell.size / unit, x = cell.x / unit, y = cell.y / unit;
    for (int row = 0; row < std::min(n, rows - y); ++row)
        for (int column = 0; column < std::min(n, columns - x); ++column) {
            const double u = (column + .5) / n, v = (row + .5) / n;
            const double weights[4]{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
            const int pixel = (y + row) * columns + x + column;
            for (int k = 0; k < 4; ++k) layers->average(pixel, cell.corners[k], weights[k]);
        }
}

std::vector<std::uint32_t> Cells::counts() const {
    std::vector<std::uint32_t> counts(std::size_t(columns) * rows);
    for (const Point& p : points)
        if (p.x < columns * unit && p.y < rows * unit) ++counts[std::size_t(p.y / unit) * columns + p.x / unit];
    return counts;
}

double contrast_for(double error) {
    const double aim = std::max(error, least_sampling_error);
    return 8 * aim * std::min(1., 510 * aim);
}

}  // namespace strahl

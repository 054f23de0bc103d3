#include "trace/lights/light_buffer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "num/buffer.h"
#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "trace/lights/light_faces.h"

namespace strahl {
namespace {

constexpr double cells_per_item = 4;
constexpr std::int32_t band_rows = 32;  // one thread's piece of a face

/// Returns the number of items in the hierarchy.
template <class T>
std::int64_t items_in_hierarchy(const World<T>& world) {
    std::int64_t count = 0;
    world.groups.each([&](const auto& group) { count += group.in_hierarchy; });
    return count;
}

}  // namespace

template <class T>
struct LightBuffers<T>::Arrays {
    /// A ball around an item as the light sees it.
    struct SeenItem {
        DVec3 centre;  // relative to the light
        double radius, near;
        std::int32_t item, form;
    };
    /// The part of a face that an item covers.
    struct Print {
        Slopes u, v;
        std::int32_t seen;  // index of the item in `seen`
    };
    /// The cells of a face that an item covers.
    struct Cover {
        std::int32_t left, right, top, bottom;
        std::int32_t seen;  // index of the item in `seen`
    };
    /// Rows of a face.
    struct Band {
        std::int32_t face, first_row, last_row;
        std::int32_t first_cell, end_cell;  // the numbers of its cells, and behind them
        std::int64_t begin = 0;             // place in `candidates` of its cells' bodies beyond the first ones
        std::int64_t more = 0;              // how many these are
        std::int64_t squares = 0;           // sum over cells of the square of the number of candidates
    };
    static constexpr double float_epsilon = std::numeric_limits<float>::epsilon();
    static constexpr double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
    static constexpr Candidate<float> none{std::numeric_limits<float>::infinity(), 0, 0, 0};

    std::vector<SeenItem> seen;
    std::vector<std::vector<Print>> prints;  // by face, furthest item first
    std::vector<BufferFace<T>> faces;
    std::vector<std::vector<Cover>> covers;  // by face, furthest item first
    std::vector<Band> bands;
    Buffer<std::int32_t> counts, ends;  // by cell: of candidates, and behind those beyond the first one
    Buffer<Candidate<float>> candidates;
    std::int64_t cells = 1, covered = 0, size = 0;  // covered: candidates of all cells
    double reach = 0;

    void see(const World<T>& world, const LightKernel<T>& light, bool proves);
    void look(const LightKernel<T>& light);
    void add_face(const Basis& basis, double limit, double slack, bool parallel);
    void divide(double area);
    std::int64_t most_candidates() const { return most_per_item * static_cast<std::int64_t>(seen.size()); }
    template <class Visit>
    void each_cover(const Band& band, const Visit& visit) const;
    void count(Band& band);
    bool make_room();
    void fill(const Band& band);
};

/// Collects the items' bounding balls, widened by rounding errors, furthest from the light first.
template <class T>
void LightBuffers<T>::Arrays::see(const World<T>& world, const LightKernel<T>& light, bool proves) {
    reach = static_cast<double>(world.rounding) / (32 * epsilon);  // see WorldArrays::rounding
    const bool parallel = light.finite == 0;
    const DVec3 place(light.position);
    const double margin = (256 * epsilon + (proves ? proving_margin : 0)) * reach;
    seen.reserve(items_in_hierarchy(world));
    std::int32_t form = 0;
    world.groups.each([&](const auto& group) {
        if constexpr (requires { group.items[0].shape.ball(); })
            for (int i = 0; i < group.in_hierarchy; ++i) {
                const Ball ball = group.items[i].shape.ball();
                const DVec3 centre = parallel ? ball.centre : ball.centre - place;
                const double away = parallel ? -dot_product(place, centre) : std::sqrt(dot_product(centre, centre));
                const double radius = ball.radius + margin;
                seen.push_back(
                    {centre, radius, away - radius - 16 * float_epsilon * (std::abs(away) + radius), i, form});
            }
        ++form;
    });
    std::sort(seen.begin(), seen.end(), [](const SeenItem& a, const SeenItem& b) {
        return a.near != b.near ? a.near > b.near : a.form != b.form ? a.form > b.form : a.item > b.item;
    });
}

/// Chooses faces: one if all items are in front of the light, else those of a cube.
template <class T>
void LightBuffers<T>::Arrays::look(const LightKernel<T>& light) {
    if (light.finite == 0) {
        add_face(basis_around(DVec3(light.position)), std::numeric_limits<T>::max(), 64 * epsilon * 4 * reach, true);
    } else {
        constexpr double most_on_one_face = 3;
        DVec3 sum(0);
        for (const SeenItem& s : seen) sum = sum + s.centre;
        const DVec3 axis = length(sum) > 0 ? normalize(sum) : DVec3(0, 0, 1);
        double steepest = 0;
        for (const SeenItem& s : seen) steepest = std::max(steepest, steepest_slope(s.centre, s.radius, axis));
        const bool one = steepest < most_on_one_face;
        const double limit = one ? 1.1 * steepest : 1;
        for (const Basis& basis : one ? std::vector<Basis>{basis_around(axis)} : cube_around(basis_around(axis)))
            add_face(basis, limit, 16 * epsilon * (1 + limit) * (1 + limit), false);
    }
    double area = 0;
    for (const BufferFace<T>& face : faces) area += static_cast<double>(face.columns) * static_cast<double>(face.rows);
    divide(area);
}

/// Adds a face, if any item covers some of it. Its columns and rows are its width and height until it is divided.
template <class T>
void LightBuffers<T>::Arrays::add_face(const Basis& basis, double limit, double slack, bool parallel) {
    const double wide = 1.001 * limit;  // a little more, for rounding
    std::vector<Print> own;
    Slopes u{wide, -wide}, v = u;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto& [centre, radius, near, item, form] = seen[i];
        const double x = dot_product(basis.right, centre), y = dot_product(basis.up, centre);
        Print print{{x - radius, x + radius}, {y - radius, y + radius}, static_cast<std::int32_t>(i)};
        if (!parallel) {
            const double z = dot_product(basis.axis, centre);
            if (z < -radius) continue;
            print.u = slopes_of(x, z, radius, wide), print.v = slopes_of(y, z, radius, wide);
            if (!(print.u.low <= print.u.high && print.v.low <= print.v.high)) continue;
        }
        print.u = {print.u.low - slack, print.u.high + slack}, print.v = {print.v.low - slack, print.v.high + slack};
        u = {std::min(u.low, print.u.low), std::max(u.high, print.u.high)};
        v = {std::min(v.low, print.v.low), std::max(v.high, print.v.high)};
        own.push_back(print);
    }
    if (own.empty()) return;
    prints.push_back(std::move(own));
    faces.push_back({cast<T>(basis.right), cast<T>(basis.up), cast<T>(basis.axis), static_cast<T>(limit),
                     static_cast<T>(u.low), static_cast<T>(v.low), T(0), T(0), static_cast<T>(u.high - u.low),
                     static_cast<T>(v.high - v.low), T(0)});
}

/// Divides faces into cells and bands, and finds the cells that items cover.
template <class T>
void LightBuffers<T>::Arrays::divide(double area) {
    const double per = std::sqrt(cells_per_item * static_cast<double>(seen.size()) / area);
    for (BufferFace<T>& face : faces) {
        const auto cut = [per](T& count, T& per_slope) {
            constexpr double most = 4096;
            const double width = static_cast<double>(count), cells = std::clamp(std::ceil(width * per), 1., most);
            count = static_cast<T>(cells), per_slope = static_cast<T>(cells / width);
        };
        cut(face.columns, face.per_u), cut(face.rows, face.per_v);
        face.first = static_cast<T>(cells);
        cells += static_cast<std::int64_t>(face.columns) * static_cast<std::int64_t>(face.rows);
        const auto rows = static_cast<std::int32_t>(face.rows), columns = static_cast<std::int32_t>(face.columns);
        const auto number = static_cast<std::int32_t>(&face - faces.data());
        const auto start = static_cast<std::int32_t>(face.first);
        for (std::int32_t row = 0, end = band_rows; row < rows; row = end, end += band_rows) {
            end = std::min(end, rows);
            bands.push_back({number, row, end - 1, start + row * columns, start + end * columns});
        }
    }
    counts = uninitialized_buffer<std::int32_t>(cells), ends = uninitialized_buffer<std::int32_t>(cells);
    constexpr double off = 1. / 64;  // margin for rounding, in cells
    const auto cell = [](double slope, T low, T per, double off) {
        const double cells = (slope - static_cast<double>(low)) * static_cast<double>(per);
        return static_cast<std::int32_t>(std::floor(cells + off));
    };
    covers.resize(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const BufferFace<T>& face = faces[i];
        const auto columns = static_cast<std::int32_t>(face.columns), rows = static_cast<std::int32_t>(face.rows);
        covers[i].reserve(prints[i].size());
        for (const Print& print : prints[i]) {
            const Cover cover{std::max(cell(print.u.low, face.low_u, face.per_u, -off), 0),
                              std::min(cell(print.u.high, face.low_u, face.per_u, off), columns - 1),
                              std::max(cell(print.v.low, face.low_v, face.per_v, -off), 0),
                              std::min(cell(print.v.high, face.low_v, face.per_v, off), rows - 1), print.seen};
            covered += std::int64_t(cover.right - cover.left + 1) * (cover.bottom - cover.top + 1);
            covers[i].push_back(cover);
        }
    }
    if (covered > most_candidates()) bands = {};
    prints = {};
}

/// Calls visit(first cell, last cell, item) for each row that an item covers of a band.
template <class T>
template <class Visit>
void LightBuffers<T>::Arrays::each_cover(const Band& band, const Visit& visit) const {
    const auto columns = static_cast<std::int32_t>(faces[band.face].columns);
    const auto start = static_cast<std::int32_t>(faces[band.face].first);
    for (const Cover& cover : covers[band.face]) {
        const std::int32_t bottom = std::min(cover.bottom, band.last_row);
        for (std::int32_t row = std::max(cover.top, band.first_row); row <= bottom; ++row)
            visit(start + row * columns + cover.left, start + row * columns + cover.right, seen[cover.seen]);
    }
}

/// Counts the candidates of a band's cells.
template <class T>
void LightBuffers<T>::Arrays::count(Band& band) {
    std::fill(counts.get() + band.first_cell, counts.get() + band.end_cell, 0);
    each_cover(band, [&](std::int32_t left, std::int32_t right, const SeenItem&) {
        for (std::int32_t c = left; c <= right; ++c) ++counts[c];
    });
    for (std::int32_t c = band.first_cell; c < band.end_cell; ++c) {
        band.more += std::max(counts[c] - 1, 0);
        band.squares += std::int64_t(counts[c]) * counts[c];
    }
}

/// Allocates the memory for all candidates and gives bands their places in it. Returns false if there are too many, or
/// if usual cells, those that most candidates are in, have so many that the hierarchy is faster.
template <class T>
bool LightBuffers<T>::Arrays::make_room() {
    size = cells;
    std::int64_t squares = 0;
    for (Band& band : bands) {
        band.begin = size;
        size += band.more, squares += band.squares;
    }
    if (std::max(size, covered) > most_candidates() || static_cast<double>(size) > World<float>::capacity ||
        squares > most_per_cell * covered)
        return false;
    candidates = uninitialized_buffer<Candidate<float>>(size);
    candidates[0] = none;
    return true;
}

/// Puts items into the cells of a band, each in front of those that are further away: the last one is what the cell
/// begins with, the others come one after the other.
template <class T>
void LightBuffers<T>::Arrays::fill(const Band& band) {
    auto end = static_cast<std::int32_t>(band.begin);
    for (std::int32_t c = band.first_cell; c < band.end_cell; ++c) {
        candidates[c] = none;
        ends[c] = end += std::max(counts[c] - 1, 0);
    }
    each_cover(band, [&](std::int32_t left, std::int32_t right, const SeenItem& s) {
        Candidate<float> candidate{static_cast<float>(s.near), static_cast<float>(s.item), static_cast<float>(s.form),
                                   0};
        for (std::int32_t c = left; c <= right; ++c) {
            const std::int32_t place = --counts[c] > 0 ? --ends[c] : c;
            candidate.next = std::exchange(candidates[c].next, static_cast<float>(place));
            candidates[place] = candidate;
        }
    });
}

template <class T>
bool LightBuffers<T>::pay(const World<T>& world, std::int64_t pixels, bool proves) {
    if (!world.nodes || world.transparent) return false;
    const std::int64_t items = items_in_hierarchy(world);
    std::int64_t slow = 0;
    bool known = true;
    world.groups.each([&](const auto& group) {
        if (group.in_hierarchy == 0) return;
        known &= requires { group.items[0].shape.ball(); };
        if (!std::remove_cvref_t<decltype(group)>::Form::hot) slow += group.in_hierarchy;
    });
    constexpr std::int64_t one_slow_of = 8;
    return known && (proves ? slow == 0 : one_slow_of * slow <= items) && pixels >= pixels_per_item * items;
}

template <class T>
LightBuffers<T>::LightBuffers(const World<T>& world, ThreadPool& pool, bool proves)
    : list(world.light_count), arrays(world.light_count) {
    const std::int64_t items = items_in_hierarchy(world);
    share_out(pool, world.light_count, 1, [&](std::int32_t i, std::int32_t) {
        if (world.lights[i].area || (i + 1) * items > most_items) return;
        arrays[i] = std::make_unique<Arrays>();
        arrays[i]->see(world, world.lights[i], proves);
        arrays[i]->look(world.lights[i]);
    });
    std::vector<std::pair<Arrays*, typename Arrays::Band*>> bands;
    const auto each_band = [&](const auto& work) {
        bands.clear();
        for (const auto& own : arrays)
            if (own)
                for (auto& band : own->bands) bands.push_back({own.get(), &band});
        share_out(pool, static_cast<std::int32_t>(bands.size()), 1,
                  [&](std::int32_t i, std::int32_t) { work(*bands[i].first, *bands[i].second); });
    };
    each_band([](Arrays& own, auto& band) { own.count(band); });
    for (auto& own : arrays)
        if (own && !own->make_room()) own.reset();
    each_band([](Arrays& own, auto& band) { own.fill(band); });
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        if (!arrays[i]) continue;
        Arrays& own = *arrays[i];
        list[i] = {own.faces.data(), static_cast<int>(own.faces.size()), static_cast<T>(4 * own.reach),
                   own.candidates.get()};
        own.counts.reset(), own.ends.reset(), own.seen = {}, own.covers = {}, own.bands = {};
    }
}
template <class T>
LightBuffers<T>::~LightBuffers() = default;
template <class T>
std::int64_t LightBuffers<T>::candidates() const {
    std::int64_t sum = 0;
    for (const auto& own : arrays) sum += own ? own->size : 0;
    return sum;
}

template class LightBuffers<float>;
template class LightBuffers<double>;
template class LightBuffers<long double>;

}  // namespace strahl

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
    /// Rows of a face, and the candidates of its cells beyond the first ones, numbered from 1; 0 is none.
    struct Band {
        std::int32_t face, first_row, last_row;
        std::vector<Candidate<T>> more;
        std::int64_t begin = 0;  // place of these in `candidates`
        double squares = 0;      // sum over cells of the square of the number of candidates
    };
    static constexpr double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
    static constexpr T none = std::numeric_limits<T>::infinity();

    std::vector<SeenItem> seen;
    std::vector<std::vector<Print>> prints;  // by face, furthest item first
    std::vector<BufferFace<T>> faces;
    std::vector<Band> bands;
    Buffer<Candidate<T>> first, candidates;  // those that cells begin with, and all
    std::int64_t cells = 1, size = 0;
    double reach = 0;

    void see(const World<T>& world, const LightKernel<T>& light, bool proves);
    void look(const LightKernel<T>& light);
    void add_face(const Basis& basis, double limit, double slack, bool parallel);
    void divide(double area);
    void fill(Band& band);
    bool make_room();
    void join(Band& band);
    bool slow() const;
};

/// Lists the items, furthest from the light first. The errors of coordinates and rays are added to their balls.
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
                seen.push_back({centre, radius, away - radius - 16 * epsilon * std::abs(away), i, form});
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

/// Divides faces into cells and bands.
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
        const auto rows = static_cast<std::int32_t>(face.rows);
        const auto number = static_cast<std::int32_t>(&face - faces.data());
        for (std::int32_t row = 0; row < rows; row += band_rows)
            bands.push_back({number, row, std::min(row + band_rows, rows) - 1, {}});
    }
    first = uninitialized_buffer<Candidate<T>>(cells);
    first[0] = {none, T(0), T(0), T(0)};
}

/// Puts items into the cells of a band, each in front of those that are further away.
template <class T>
void LightBuffers<T>::Arrays::fill(Band& band) {
    const BufferFace<T>& face = faces[band.face];
    const auto columns = static_cast<std::int32_t>(face.columns);
    Candidate<T>* const own = &first[static_cast<std::int64_t>(face.first)];
    std::fill(own + band.first_row * columns, own + (band.last_row + 1) * columns,
              Candidate<T>{none, T(0), T(0), T(0)});
    const auto cell = [](double slope, T low, T per, double off) {
        const double cells = (slope - static_cast<double>(low)) * static_cast<double>(per);
        return static_cast<std::int32_t>(std::floor(cells + off));
    };
    constexpr double off = 1. / 64;  // of a cell, for rounding
    for (const Print& print : prints[band.face]) {
        const std::int32_t top = std::max(cell(print.v.low, face.low_v, face.per_v, -off), band.first_row);
        const std::int32_t bottom = std::min(cell(print.v.high, face.low_v, face.per_v, off), band.last_row);
        if (top > bottom) continue;
        const std::int32_t left = std::max(cell(print.u.low, face.low_u, face.per_u, -off), 0);
        const std::int32_t right = std::min(cell(print.u.high, face.low_u, face.per_u, off), columns - 1);
        const SeenItem& s = seen[print.seen];
        for (std::int32_t row = top; row <= bottom; ++row)
            for (Candidate<T>* c = own + row * columns + left; c <= own + row * columns + right; ++c) {
                if (c->near < none) band.more.push_back(*c);
                const T next = c->near < none ? static_cast<T>(band.more.size()) : T(0);
                *c = {static_cast<T>(s.near), static_cast<T>(s.item), static_cast<T>(s.form), next};
            }
        if (band.more.size() > most_per_item * seen.size()) return;  // see make_room
    }
}

/// Allocates the memory for all candidates and gives bands their places in it. Returns false if there are too many.
template <class T>
bool LightBuffers<T>::Arrays::make_room() {
    size = cells;
    for (Band& band : bands) band.begin = size, size += static_cast<std::int64_t>(band.more.size());
    if (size > static_cast<std::int64_t>(most_per_item * seen.size()) ||
        static_cast<double>(size) > World<T>::capacity)
        return false;
    candidates = uninitialized_buffer<Candidate<T>>(size);
    candidates[0] = first[0];
    return true;
}

/// Copies a band's candidates to where they stay: those of a cell beyond the first one after the other.
template <class T>
void LightBuffers<T>::Arrays::join(Band& band) {
    const BufferFace<T>& face = faces[band.face];
    const auto columns = static_cast<std::int64_t>(face.columns), start = static_cast<std::int64_t>(face.first);
    std::int64_t at = band.begin;
    for (std::int64_t i = start + band.first_row * columns; i < start + (band.last_row + 1) * columns; ++i) {
        double count = first[i].near < none;
        Candidate<T>* last = &(candidates[i] = first[i]);
        for (; last->next > 0; ++at, ++count) {
            candidates[at] = band.more[static_cast<std::size_t>(last->next) - 1];
            last->next = static_cast<T>(at);
            last = &candidates[at];
        }
        band.squares += count * count;
    }
}

/// Returns true if usual cells, those that most candidates are in, have so many that the hierarchy is faster.
template <class T>
bool LightBuffers<T>::Arrays::slow() const {
    double squares = 0, sum = 0;
    for (const Band& band : bands) squares += band.squares;
    for (std::int64_t i = 1; i < size; ++i) sum += candidates[i].near < none;
    return squares > most_per_cell * sum;
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
    each_band([](Arrays& own, auto& band) { own.fill(band); });
    for (auto& own : arrays)
        if (own && !own->make_room()) own.reset();
    each_band([](Arrays& own, auto& band) { own.join(band); });
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        if (arrays[i] && arrays[i]->slow()) arrays[i].reset();
        if (!arrays[i]) continue;
        Arrays& own = *arrays[i];
        list[i] = {own.faces.data(), static_cast<int>(own.faces.size()), static_cast<T>(4 * own.reach),
                   own.candidates.get()};
        own.first.reset(), own.seen = {}, own.prints = {}, own.bands = {};
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

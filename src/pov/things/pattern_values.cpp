#include "pov/things/pattern_values.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "num/lattice_noise.h"
#include "num/vec_math.h"
#include "pov/things/pictures.h"
#include "pov/things/solids.h"
#include "scene/pattern.h"

namespace strahl::pov {
namespace {

constexpr double nearly = 1e-10;  // POV-Ray's EPSILON

int whole(double x) { return static_cast<int>(std::clamp(std::floor(x), -1e9, 1e9)); }
int modulo(int number, int of) { return (number % of + of) % of; }

/// Values from 0 to 1 of `function(point)`.
template <class Function>
struct ComputedValues : SolidFunction {
    explicit ComputedValues(Function function) : function(std::move(function)) {}
    double value_at(const DVec3& point) const override { return function(point); }
    const Function function;
};
template <class Function>
std::shared_ptr<const SolidFunction> make_values(Function function) {
    return std::make_shared<const ComputedValues<Function>>(std::move(function));
}

/// Values of a function that a scene declares; those above 1 begin anew.
struct FunctionValues : SolidFunction {
    explicit FunctionValues(std::shared_ptr<const FunctionThing> function) : function(std::move(function)) {}
    static double begun_anew(double value) { return value > 1 ? std::fmod(value, 1) : value; }
    double value_at(const DVec3& point) const override { return begun_anew(function->at(point)); }
    void values_at(const DVec3* points, int count, double* values, const SolidLanes& lanes) const override {
        constexpr int few = 3;  // points, for which lanes do not pay
        if (count < few) return SolidFunction::values_at(points, count, values, lanes);
        function->evaluate_all({points, static_cast<std::size_t>(count)}, values, lanes.noise);
        for (int i = 0; i < count; ++i) values[i] = begun_anew(values[i]);
    }
    const std::shared_ptr<const FunctionThing> function;
};

struct MovedValues : SolidFunction {
    MovedValues(Moves given, SolidPattern values)
        : moves(std::move(given)), normals(moves), values(std::move(values)) {}
    double value_at(const DVec3& point) const override { return strahl::value_at(values, moved(moves, point)); }
    void values_at(const DVec3* points, int count, double* found, const SolidLanes& lanes) const override {
        std::vector<DVec3> own(points, points + count);
        move_points(moves, own, lanes.noise);
        lanes.values(values, own.data(), count, found);
    }
    std::optional<DVec3> bend_at(const DVec3& point, const DVec3& normal) const override {
        return normals.unmoved(strahl::bend_at(values, moved(moves, point), normals.moved(normal)), normal);
    }
    const Moves moves;
    const MovedNormals normals;
    const SolidPattern values;
};

struct TurnedBends : SolidFunction {
    TurnedBends(const Moves& turn, std::shared_ptr<const SolidFunction> bends)
        : normals(turn), bends(std::move(bends)) {}
    double value_at(const DVec3& point) const override { return bends->value_at(point); }
    std::optional<DVec3> bend_at(const DVec3& point, const DVec3& normal) const override {
        const std::optional<DVec3> own = bends->bend_at(point, normals.moved(normal));
        return own ? std::optional(normals.unmoved(*own, normal)) : own;
    }
    const MovedNormals normals;
    const std::shared_ptr<const SolidFunction> bends;
};

struct QuiltedValues : SolidFunction {
    explicit QuiltedValues(std::array<double, 2> controls) : controls(controls) {}
    double value_at(const DVec3& point) const override { return quilt_value(quilt(point, controls[0], controls[1])); }
    std::optional<DVec3> bend_at(const DVec3& point, const DVec3&) const override {
        return quilt(point, controls[0], controls[1]);
    }
    const std::array<double, 2> controls;
};

struct FractalValues : SolidFunction {
    explicit FractalValues(const FractalForm& form) : form(form) {}
    double value_at(const DVec3& p) const override { return fractal_value(form, p.x, p.y); }
    void values_at(const DVec3* points, int count, double* values, const SolidLanes& lanes) const override {
        lanes.fractal(form, points, count, values);
    }
    const FractalForm form;
};

int hexagon_at(const DVec3& p) {
    // Finds the nearest of the middles i (1.5, sqrt 3 / 2) + j (0, sqrt 3); if two are, the upper one.
    const double height = std::numbers::sqrt3;
    const double column = p.x / 1.5, row = p.z / height - column / 2;
    const int left = whole(column), below = whole(row);
    double nearest = 1e300;
    int found = 0;
    for (int i = left; i <= left + 1; ++i)
        for (int j = below - 1; j <= below + 1; ++j) {
            const double x = p.x - 1.5 * i, z = p.z - height * (j + i / 2.);
            if (x * x + z * z <= nearest) nearest = x * x + z * z, found = modulo(j + 2 * i, 3);
        }
    return found;
}
int square_at(const DVec3& p) {
    const int x = modulo(whole(p.x), 2), z = modulo(whole(p.z), 2);
    return x == 0 ? z : 3 - z;
}
/// Triangles with sides of 1, six of which make a hexagon.
int triangular_at(const DVec3& p) {
    const double height = std::numbers::sqrt3;
    double x = p.x - 3 * std::floor(p.x / 3), z = p.z - height * std::floor(p.z / height);
    const int column = static_cast<int>(x);
    x -= column;
    const bool upper = z >= height / 2;
    if (upper) z = height - z;
    int number = 1;
    if (x != 0) number = z < height * x ? z < height * (1 - x) ? 0 : 3 : 1;
    number = modulo(number % 2 == 1 ? number + 2 * column : number - 2 * column, 6);
    return upper ? 5 - number : number;
}
int cubic_at(const DVec3& p) {
    const double x = std::fabs(p.x), y = std::fabs(p.y), z = std::fabs(p.z);
    if (p.x >= 0 && x >= y && x >= z) return 0;
    if (p.y >= 0 && y >= x && y >= z) return 1;
    if (p.z >= 0 && z >= x && z >= y) return 2;
    if (p.x < 0 && p.x <= -y && p.x <= -z) return 3;
    return p.y < 0 && p.y <= -x && p.y <= -z ? 4 : 5;
}
int checker_at(const DVec3& p) { return modulo(whole(p.x + nearly) + whole(p.y + nearly) + whole(p.z + nearly), 2); }
int brick_at(const DVec3& size, double joint, const DVec3& p) {
    const DVec3 q = (p + DVec3(nearly + joint)) / size, mortar = DVec3(joint) / size;
    const auto fraction = [](double x) { return x - std::floor(x); };
    const bool even = fraction(q.y / 2) > .5;
    return fraction(q.y) > mortar.y && fraction(q.x + (even ? .5 : 0)) > mortar.x &&
           fraction(q.z + (even ? 0 : .5)) > mortar.z;
}

/// Returns the sum of the distances to the three nearest of points that are spread one to a cell; `power` has the power
/// of a way along an axis, and `root` makes a sum of these a distance.
template <class Power, class Root>
double crackle_value(const CrackleForm& own, int generator, const DVec3& p, const Power& power, const Root& root) {
    constexpr int near_first[]{0, -1, 1, -2, 2};
    const int cell[3]{whole(p.x - nearly), whole(p.y - nearly), whole(p.z - nearly)};
    double least[3][5];  // powers of the least way into the cells along each axis
    for (int c = 0; c < 3; ++c)
        for (const int i : near_first) {
            const double from = p[c] - (cell[c] + i);
            least[c][i + 2] = power(std::max({0., -from, from - 1}));
        }
    double nearest[3]{1e300, 1e300, 1e300};
    DVec3 closest(0);
    for (const int i : near_first)
        for (const int j : near_first)
            for (const int k : near_first) {
                if ((std::abs(i) == 2) + (std::abs(j) == 2) + (std::abs(k) == 2) > 1) continue;
                const double bound = least[0][i + 2] + least[1][j + 2] + least[2][k + 2];
                if (bound * (1 - 1e-9) > nearest[2]) continue;
                const int x = cell[0] + i, y = cell[1] + j, z = cell[2] + k;
                const DVec3 point = DVec3(x, y, z) + random_at_cell(x, y, z), way = point - p;
                double sum = power(way.x) + power(way.y) + power(way.z);
                if (sum < nearest[0]) closest = point;
                for (double& known : nearest)
                    if (sum < known) std::swap(sum, known);
            }
    if (own.solid) return lattice::noise(closest, generator);
    const double offset = power(own.offset);
    double value = 0;
    for (int i = 0; i < 3; ++i) value += own.form[i] * root(nearest[i] + offset);
    return std::clamp(value, 0., 1.);
}
double crackle_value(const CrackleForm& own, int generator, const DVec3& p) {
    const auto value = [&](const auto& power, const auto& root) {
        return crackle_value(own, generator, p, power, root);
    };
    const double metric = own.metric;
    if (metric == 2) return value([](double way) { return way * way; }, [](double sum) { return std::sqrt(sum); });
    if (metric == 1) return value([](double way) { return std::fabs(way); }, [](double sum) { return sum; });
    return value([=](double way) { return std::pow(std::fabs(way), metric); },
                 [=](double sum) { return std::pow(sum, 1 / metric); });
}

/// Bends normals of cells alike: to the point nearest to the normal itself, or by noise at that nearest to its place.
struct FacetBends : SolidFunction {
    FacetBends(const FacetForm& form, double metric, int generator)
        : form(form), metric(metric), noise{.solid = Solid::bumps, .generator = double(generator)} {}
    double value_at(const DVec3&) const override { return 0; }
    std::optional<DVec3> bend_at(const DVec3& point, const DVec3& normal) const override {
        const DVec3 p = (form.coords != 0 ? point : normal) / std::max(form.size, 1e-6);
        const DVec3 near = nearest(p);
        if (form.coords == 0) return near - normal;
        const DVec3 pushed = strahl::bend_at(noise, near, normal);
        return form.coords * (pushed - dot_product(pushed, normal) * normal);
    }
    /// Returns the nearest of points that are spread one to a cell. By the metric 1 it is that furthest down all axes,
    /// as in POV-Ray.
    DVec3 nearest(const DVec3& p) const {
        DVec3 found(0);
        double least = 1e300;
        for (int i = -2; i <= 2; ++i)
            for (int j = -2; j <= 2; ++j)
                for (int k = -2; k <= 2; ++k) {
                    if ((std::abs(i) == 2) + (std::abs(j) == 2) + (std::abs(k) == 2) > 1) continue;
                    const int x = whole(p.x - nearly) + i, y = whole(p.y - nearly) + j, z = whole(p.z - nearly) + k;
                    const DVec3 own = DVec3(x, y, z) + random_at_cell(x, y, z), way = own - p;
                    const auto power = [&](double v) {
                        return metric == 1 ? v : metric == 2 ? v * v : std::pow(std::fabs(v), metric);
                    };
                    const double sum = power(way.x) + power(way.y) + power(way.z);
                    if (sum < least) least = sum, found = own;
                }
        return found;
    }
    const FacetForm form;
    const double metric;
    const SolidPattern noise;
};

/// Two entries of a map between which a value lies, and the share of the second one. They are the same at an entry. As
/// in POV-Ray that is the first entry that is not below the value, and the one before it, in whatever order they are.
struct MapPlace {
    const MapEntry *before, *after;
    double share;
};
MapPlace place_in(const std::vector<MapEntry>& entries, double value) {
    if (!(value < entries.back().at)) return {&entries.back(), &entries.back(), 1};
    const auto found = std::ranges::find_if(entries, [&](const MapEntry& own) { return own.at >= value; });
    if (found == entries.begin() || found->at == value) return {&*found, &*found, 1};
    const auto before = found - 1;
    return {&*before, &*found, (value - before->at) / (found->at - before->at)};
}

/// Heights by a slope_map, as a function of another pattern's values.
struct SlopeValues : SolidFunction {
    SlopeValues(SolidPattern values, std::vector<MapEntry> entries)
        : values(std::move(values)), entries(std::move(entries)) {}
    double value_at(const DVec3& point) const override {
        const double value = strahl::value_at(values, point);
        const auto [before, after, share] = place_in(entries, value);
        if (before == after) return after->height;
        // A cubic between two values with these slopes, which are per unit of the share.
        const double h = share, g = 1 - h, rise = after->height - before->height;
        return before->height + h * h * (3 - 2 * h) * rise + h * g * (g * before->slope - h * after->slope);
    }
    /// The slope of heights that may be beyond 0 and 1, where values of patterns end.
    std::optional<DVec3> bend_at(const DVec3& point, const DVec3&) const override {
        DVec3 sum(0);
        for (const DVec3& corner : Bump::corners) sum = sum - 5 * value_at(point + .02 * corner) * corner;
        return sum;
    }
    const SolidPattern values;
    const std::vector<MapEntry> entries;
};

/// Bends normals as a normal { ... } says: by its own pattern, or by a map. Its parts each bend the normal themselves,
/// and the normals of length 1 that these make are blended by a pattern.
struct Bends : SolidFunction {
    double value_at(const DVec3&) const override { return 0; }
    std::optional<DVec3> bend_at(const DVec3& point, const DVec3& normal) const override {
        return bent(point, normal) - normal;
    }
    DVec3 bent(const DVec3& given, const DVec3& normal) const {
        const DVec3 point = moved(moves, given), own = normals.moved(normal);
        DVec3 sum(0);
        if (parts.empty()) {
            sum = own + amount * strahl::bend_at(pattern, point, own);
        } else if (total > 0) {
            for (std::size_t i = 0; i < parts.size(); ++i) sum += entries[i].at / total * parts[i]->bent(point, own);
        } else {
            const auto [before, after, share] = place_in(entries, strahl::value_at(pattern, point));
            const auto part = [&](const MapEntry* entry) {
                return parts[std::size_t(entry - &entries[0])]->bent(point, own);
            };
            sum = share * part(after);
            if (before != after) sum += (1 - share) * part(before);
        }
        return quick_unit(normal + normals.unmoved(sum - own, normal));
    }
    Moves moves;
    MovedNormals normals;
    SolidPattern pattern;
    double amount = 1;
    std::vector<MapEntry> entries;
    std::vector<std::shared_ptr<const Bends>> parts;  // of the entries
    double total = 0;                                 // the sum of the weights, if the mean is taken
};

/// Returns the pattern without its warps and the turbulence that moves points.
std::optional<SolidPattern> still_solid_of(const Blend& blend, bool bends, int generator) {
    Blend still = blend;
    still.warps.clear(), still.values = nullptr;
    if (moves_points(blend)) still.turbulence = DVec3(0);
    std::optional<SolidPattern> solid = solid_of(still, bends, generator);
    const bool spiral = blend.word == word("spiral1") || blend.word == word("spiral2");
    if (!spiral || blend.turbulence == DVec3(0) || !solid || solid->function) return solid;
    // The turbulence of a spiral counts in its values as well.
    return of_function(make_values([own = *solid, noise = turbulence_of(blend)](const DVec3& p) {
        const double more = noise.by.x * lattice::turbulence(p, noise.octaves, static_cast<float>(noise.omega),
                                                             static_cast<float>(noise.lambda), own.generator);
        return strahl::value_at(own, {p.x, p.y, p.z + more});
    }));
}

/// Returns the entries of a map. Those of a list get the values at which the pattern shows them.
std::vector<MapEntry> entries_of(const Blend& blend) {
    if (!blend.map || blend.map->entries.empty()) return usual_entries(blend);
    std::vector<MapEntry> own = blend.map->entries;
    const int count = listed_colors(blend.word);
    if (count == 0) return own;
    std::vector<MapEntry> entries = usual_entries(blend);
    for (std::size_t i = 0; i < std::min(entries.size(), own.size()); ++i)
        own[i].at = entries[i].at, entries[i] = own[i];
    return entries;
}

std::shared_ptr<Bends> bends_of(const NormalThing& normal, bool last, int generator) {
    const Blend& blend = normal.blend;
    auto made = std::make_shared<Bends>();
    made->amount = static_cast<float>(normal.amount);
    if (!blend) return made->amount = 0, made;
    if (blend.uv) return nullptr;
    made->moves = moves_of(blend, last), made->normals = MovedNormals(made->moves);
    if (blend.word == word("bump_map") || blend.word == word("facets")) {
        std::shared_ptr<const SolidFunction> bends;
        if (blend.image)
            bends = bends_of(*blend.image, made->amount);
        else
            bends = std::make_shared<FacetBends>(blend.facets, blend.crackle.metric, generator);
        if (!bends) return nullptr;
        made->pattern = of_function(std::move(bends)), made->amount = 1;
        return made;
    }
    const bool average = blend.word == word("average");
    if (!average) {
        const auto own = still_solid_of(blend, !blend.map, generator);
        if (!own) return nullptr;
        made->pattern = *own;
    }
    if (!blend.map) return average ? nullptr : made;
    made->entries = entries_of(blend);
    for (const MapEntry& entry : made->entries) {
        const auto* const nested = dynamic_cast<const NormalThing*>(entry.thing.get());
        made->parts.push_back(nested ? bends_of(*nested, true, generator) : nullptr);
        if (!made->parts.back()) return nullptr;
        if (average) made->total += entry.at;
    }
    return !average || made->total > 0 ? made : nullptr;
}

/// A pigment: a colour, or a pattern with what it shows at its values.
struct PigmentFunction : FunctionThing {
    PigmentFunction() { results = 5; }
    void evaluate(const double* given, double* result) const override {
        const auto put = [](const FilterColor& color, double* numbers) {
            for (const float part : {color.red, color.green, color.blue, color.filter, color.transmit})
                *numbers++ = double(part);
        };
        if (!pattern && !picture) return put(color, result);
        const DVec3 point = moved(moves, {given[0], given[1], given[2]});
        const double place[3]{point.x, point.y, point.z};
        if (picture) return picture->evaluate(place, result);
        const auto add = [&](const MapEntry& entry, double weight) {
            double own[5];
            if (const auto* const nested = dynamic_cast<const FunctionThing*>(entry.thing.get())) {
                nested->evaluate(place, own);
            } else {
                put(entry.color, own);
            }
            for (int i = 0; i < 5; ++i) result[i] += weight * own[i];
        };
        std::fill_n(result, 5, 0.);
        if (total > 0) {
            for (const MapEntry& entry : entries) add(entry, entry.at / total);
            return;
        }
        const auto [before, after, share] = place_in(entries, strahl::value_at(*pattern, point));
        add(*after, share);
        if (before != after) add(*before, 1 - share);
    }
    FilterColor color{};
    std::optional<SolidPattern> pattern;
    std::shared_ptr<const FunctionThing> picture;  // picture that replaces the function
    Moves moves;
    std::vector<MapEntry> entries;  // their things are functions
    double total = 0;               // the sum of the weights, if the colour is a mean
};

}  // namespace

int listed_colors(std::uint16_t pattern) {
    switch (pattern) {
        case word("checker"):
        case word("brick"):
        case word("object"):
            return 2;
        case word("hexagon"):
            return 3;
        case word("square"):
            return 4;
        case word("triangular"):
        case word("cubic"):
            return 6;
        default:
            return 0;
    }
}

namespace {

/// Returns what a map shows at a value between two entries, as an entry.
MapEntry between(const MapEntry& before, const MapEntry& after, double at) {
    const double share = (at - before.at) / (after.at - before.at);
    MapEntry own{.at = at, .thing = nullptr};
    if (!before.thing && !after.thing) {
        for (const auto part :
             {&FilterColor::red, &FilterColor::green, &FilterColor::blue, &FilterColor::filter, &FilterColor::transmit})
            own.color.*part = std::lerp(before.color.*part, after.color.*part, static_cast<float>(share));
        return own;
    }
    auto both = std::make_shared<MapThing>();
    both->entries = {before, after};
    both->entries[0].at = 1 - share, both->entries[1].at = share;
    auto pigment = std::make_shared<PigmentThing>();
    pigment->blend.word = word("average"), pigment->blend.map = std::move(both);
    own.thing = std::move(pigment);
    return own;
}

/// Returns entries with ascending places that show the same.
std::vector<MapEntry> ascending(const std::vector<MapEntry>& entries) {
    if (std::ranges::is_sorted(entries, {}, &MapEntry::at)) return entries;
    const double last = entries.back().at;
    std::vector<MapEntry> sorted{entries.front()};
    sorted[0].at = std::min(sorted[0].at, last);
    for (std::size_t i = 1; i < entries.size() && sorted.back().at < last; ++i) {
        const MapEntry &before = entries[i - 1], &own = entries[i];
        const double from = sorted.back().at;
        if (!(own.at > from)) continue;  // all values up to there are taken by entries before it
        if (before.at < from) sorted.push_back(between(before, own, from));
        if (before.at == from) sorted.push_back(before);
        sorted.push_back(own.at > last ? between(before, own, last) : own);
    }
    sorted.push_back(entries.back());
    return sorted;
}

}  // namespace

std::vector<MapEntry> in_order(const std::vector<MapEntry>& entries) {
    std::vector<MapEntry> own = ascending(entries);
    if (std::ranges::none_of(own, [](const MapEntry& entry) { return entry.thing != nullptr; })) return own;
    for (std::size_t i = 1; i < own.size(); ++i) {
        if (own[i - 1].at < 0 && own[i].at > 0) own[i - 1] = between(own[i - 1], own[i], 0);
        if (own[i - 1].at < 1 && own[i].at > 1) own[i] = between(own[i - 1], own[i], 1);
    }
    return own;
}

std::shared_ptr<const SolidFunction> moved_values(Moves moves, const SolidPattern& values) {
    return std::make_shared<const MovedValues>(std::move(moves), values);
}

bool moves_points(const Blend& blend) {
    return blend.turbulence != DVec3(0) && blend.word != word("marble") && blend.word != word("wood");
}

Moves moves_of(const Blend& blend, bool last) {
    Moves all;
    const auto add = [&](const Steps& steps) {
        if (!steps.empty()) all.push_back(glm::inverse(matrix_of(steps)));
    };
    if (last) add(blend.steps);
    for (auto own = blend.warps.rbegin(); own != blend.warps.rend(); ++own) {
        all.push_back(own->warp);
        add(own->before);
    }
    if (moves_points(blend)) all.push_back(Warp(turbulence_of(blend)));
    return all;
}

std::shared_ptr<const SolidFunction> own_values_of(const Blend& blend, int generator) {
    if (blend.function) return std::make_shared<const FunctionValues>(blend.function);
    if (blend.image) return blend.word == word("image_pattern") ? values_of(*blend.image) : nullptr;
    if (blend.pigment) {
        auto colors = colors_of(*blend.pigment, generator);
        if (!colors) return nullptr;
        return make_values([colors](const DVec3& p) {
            const double given[3]{p.x, p.y, p.z};
            double c[5];
            colors->evaluate(given, c);
            return brightness[0] * c[0] + brightness[1] * c[1] + brightness[2] * c[2];
        });
    }
    const auto listed = [count = listed_colors(blend.word)](auto number_at) {
        return make_values([=](const DVec3& p) { return double(number_at(p)) / (count - 1); });
    };
    switch (blend.word) {
        case word("mandel"):
        case word("julia"):
        case word("magnet"):
            return std::make_shared<const FractalValues>(blend.fractal);
        case word("crackle"):
            if (blend.crackle == CrackleForm{}) return nullptr;
            return make_values(
                [own = blend.crackle, generator](const DVec3& p) { return crackle_value(own, generator, p); });
        case word("agate"): {
            if (blend.agate_turbulence == 1) return nullptr;
            const TurbulenceWarp noise = turbulence_of(blend);
            return make_values([noise, strength = blend.agate_turbulence, generator](const DVec3& p) {
                const double turns = 1.3 * strength *
                                         lattice::turbulence(p, noise.octaves, static_cast<float>(noise.omega),
                                                             static_cast<float>(noise.lambda), generator) +
                                     1.1 * p.z;
                const double value = .5 * (std::sin(2 * std::numbers::pi * (turns - std::floor(turns))) + 1);
                return std::pow(std::clamp(value, 0., 1.), .77);
            });
        }
        case word("quilted"):
            if (blend.controls == std::array{1., 1.}) return nullptr;
            return std::make_shared<QuiltedValues>(blend.controls);
        case word("checker"):
            return listed(checker_at);
        case word("brick"):
            return listed(
                [size = blend.brick_size, joint = blend.mortar](const DVec3& p) { return brick_at(size, joint, p); });
        case word("hexagon"):
            return listed(hexagon_at);
        case word("square"):
            return listed(square_at);
        case word("triangular"):
            return listed(triangular_at);
        case word("cubic"):
            return listed(cubic_at);
        default:
            return nullptr;
    }
}

std::shared_ptr<const SolidFunction> powers_of(const SolidPattern& values, double exponent) {
    return make_values([=](const DVec3& p) { return std::pow(strahl::value_at(values, p), exponent); });
}

std::shared_ptr<const SolidFunction> slope_values(const SolidPattern& values, const std::vector<MapEntry>& entries) {
    return std::make_shared<const SlopeValues>(values, entries);
}

std::shared_ptr<const SolidFunction> bends_of(const NormalThing& normal, int generator) {
    return bends_of(normal, false, generator);
}

std::shared_ptr<const SolidFunction> turned_bends(const glm::dmat4& turn, std::shared_ptr<const SolidFunction> bends) {
    return std::make_shared<const TurnedBends>(Moves{turn}, std::move(bends));
}

std::shared_ptr<const FunctionThing> colors_of(const PigmentThing& pigment, int generator, MadeColors* known) {
    auto made = std::make_shared<PigmentFunction>();
    made->color = pigment.color;
    const Blend& blend = pigment.blend;
    if (!blend) return made;
    if (blend.uv) return nullptr;
    made->moves = moves_of(blend, true);
    if (blend.word == word("image_map")) return (made->picture = colors_of(*blend.image)) ? made : nullptr;
    const bool average = blend.word == word("average");
    made->pattern = average ? SolidPattern() : still_solid_of(blend, false, generator);
    if (!made->pattern) return nullptr;
    made->entries = entries_of(blend);
    for (MapEntry& entry : made->entries) {
        if (average) made->total += entry.at;
        if (!entry.thing) continue;
        const auto* const nested = dynamic_cast<const PigmentThing*>(entry.thing.get());
        if (!nested) return nullptr;
        std::shared_ptr<const FunctionThing> colors;
        if (known) colors = (*known)[entry.thing];
        if (!colors) colors = colors_of(*nested, generator, known);
        if (known) (*known)[entry.thing] = colors;
        entry.thing = std::move(colors);
        if (!entry.thing) return nullptr;
    }
    if (average && !(made->total > 0)) return nullptr;
    return made;
}

const std::vector<MapEntry>& usual_entries(const Blend& blend) {
    using Entries = std::vector<MapEntry>;
    const auto entry = [](double at, float r, float g, float b) {
        return MapEntry{.at = static_cast<float>(at), .color = {r, g, b, 0, 0}, .thing = nullptr};
    };
    const auto list = [&](int count) {
        const Entries all{entry(0, 1, 0, 0), entry(0, 0, 1, 0), entry(0, 0, 0, 1),
                          entry(0, 1, 1, 0), entry(0, 0, 1, 1), entry(0, 1, 0, 1)};
        Entries own(all.begin(), all.begin() + count);
        for (int i = 0; i < count; ++i) own[std::size_t(i)].at = double(i) / (count - 1);
        return own;
    };
    static const Entries gray{entry(0, 0, 0, 0), entry(1, 1, 1, 1)};
    static const std::map<std::uint16_t, Entries> known{
        {word("bozo"),
         {entry(.4, 1, 1, 1), entry(.4, 0, 1, 0), entry(.6, 0, 1, 0), entry(.6, 0, 0, 1), entry(.8, 0, 0, 1),
          entry(.8, 1, 0, 0)}},
        {word("wood"), {entry(.6, .666f, .312f, .2f), entry(.6, .4f, .1333f, .066f)}},
        {word("mandel"),
         {entry(.001, 0, 0, 0), entry(.001, 0, 1, 1), entry(.012, 1, 1, 0), entry(.015, 1, 0, 1), entry(.1, 0, 1, 1)}},
        {word("agate"),
         {entry(0, 1, 1, 1), entry(.5, .95f, .75f, .5f), entry(.5, .9f, .7f, .5f), entry(.6, .9f, .7f, .4f),
          entry(.6, 1, .7f, .4f), entry(1, .6f, .3f, 0)}},
        {word("radial"), {entry(0, 0, 1, 1), entry(.333, 1, 1, 0), entry(.666, 1, 0, 1), entry(1, 0, 1, 1)}},
        {word("marble"), {entry(0, .9f, .8f, .8f), entry(.9, .9f, .08f, .08f), entry(.9, 0, 0, 0)}},
        {word("brick"), {entry(0, .5f, .5f, .5f), entry(1, .6f, .15f, .15f)}},
        {word("checker"), {entry(0, 0, 0, 1), entry(1, 0, 1, 0)}},
        {word("hexagon"), {entry(0, 0, 0, 1), entry(.5, 0, 1, 0), entry(1, 1, 0, 0)}},
        {word("square"), list(4)},
        {word("triangular"), list(6)},
        {word("cubic"), list(6)},
    };
    // Fractals of other powers are other patterns in POV-Ray.
    const bool other = blend.word == word("mandel") && blend.fractal.exponent != 2;
    const auto found = known.find(blend.word);
    return other || found == known.end() ? gray : found->second;
}

}  // namespace strahl::pov

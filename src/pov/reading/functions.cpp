// Reads functions that are made of things of this layer.
#include <algorithm>
#include <glm/matrix.hpp>

#include "num/vec_math.h"
#include "pov/reading/reader.h"
#include "pov/things/solids.h"

namespace strahl::pov {
namespace {

struct TransformFunction : FunctionThing {
    explicit TransformFunction(const glm::dmat4& m) : m(m) { results = 3; }
    void evaluate(const double* given, double* result) const override {
        const glm::dvec4 p = m * glm::dvec4(given[0], given[1], given[2], 1);
        for (int i = 0; i < 3; ++i) result[i] = p[i];
    }
    const glm::dmat4 m;
};

/// A function that returns the same values for all arguments.
struct ConstantFunction : FunctionThing {
    ConstantFunction(int count, std::shared_ptr<std::atomic<bool>> used) : used(std::move(used)) { results = count; }
    void evaluate(const double*, double* result) const override {
        *used = true;
        for (int i = 0; i < results; ++i) result[i] = i < 3 ? .5 : 0;
    }
    const std::shared_ptr<std::atomic<bool>> used;
};

/// The value of a solid pattern or, with a map, its colour.
struct PatternFunction : FunctionThing {
    PatternFunction(const SolidPattern& solid, const Blend& blend, bool colored)
        : solid(solid), inverse(glm::inverse(matrix_of(blend.steps))) {
        results = colored ? 5 : 1;
        if (blend.map) entries = blend.map->entries;
        if (entries.empty()) entries = {{0, {}, nullptr}, {1, {1, 1, 1, 0, 0}, nullptr}};
    }
    void evaluate(const double* given, double* result) const override {
        const double value = value_at(solid, transform_point(inverse, {given[0], given[1], given[2]}));
        if (results == 1) {
            *result = value;
            return;
        }
        const auto after = std::ranges::find_if(entries, [&](const MapEntry& own) { return own.at >= value; });
        const MapEntry& high = after == entries.end() ? entries.back() : *after;
        const MapEntry& low = after == entries.end() || after == entries.begin() ? high : *(after - 1);
        const double share = high.at > low.at ? (value - low.at) / (high.at - low.at) : 1;
        const auto mix = [&](float FilterColor::*part) {
            return share * double(high.color.*part) + (1 - share) * double(low.color.*part);
        };
        int i = 0;
        for (float FilterColor::*const part : {&FilterColor::red, &FilterColor::green, &FilterColor::blue,
                                               &FilterColor::filter, &FilterColor::transmit})
            result[i++] = mix(part);
    }
    const SolidPattern solid;
    const glm::dmat4 inverse;
    std::vector<MapEntry> entries;
};

}  // namespace

std::shared_ptr<const FunctionThing> PovReader::read_function(Interpreter& in) {
    if (in.at("transform")) {
        Steps steps;
        read_step(in, steps);
        return std::make_shared<TransformFunction>(matrix_of(steps));
    }
    const bool pattern = in.at("pattern");
    in.skip();
    const TextPlace place = in.last_place();
    PigmentThing own;
    if (!pattern) {
        own = default_texture->layers.back().pigment;
        read_pigment(in, own);
    } else {
        in.begin_block();
        while (read_pattern_word(in, own.blend, ValueKind::none) || read_modifier(in, own.blend, ValueKind::none)) {
        }
        in.end_block();
    }
    const auto of_color = [](const MapEntry& entry) { return !entry.thing; };
    if (const auto solid = solid_of(own.blend, false, in.noise_generator);
        solid && (pattern || !own.blend.map || std::ranges::all_of(own.blend.map->entries, of_color))) {
        if (own.blend.warped) in.remark(Remark::Kind::approximated, place, "a function of a pattern without its warps");
        return std::make_shared<PatternFunction>(*solid, own.blend, !pattern);
    }
    pattern_functions.emplace_back(place, std::make_shared<std::atomic<bool>>(false));
    return std::make_shared<ConstantFunction>(pattern ? 1 : 5, pattern_functions.back().second);
}

}  // namespace strahl::pov

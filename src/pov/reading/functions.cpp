// Reads functions that are made of things of this layer.
#include <algorithm>
#include <glm/matrix.hpp>

#include "num/vec_math.h"
#include "pov/reading/reader.h"
#include "pov/things/pattern_values.h"
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

/// The value of a pattern; of one with a list of colours, the number of the colour.
struct PatternFunction : FunctionThing {
    PatternFunction(const SolidPattern& solid, const Blend& blend)
        : solid(solid),
          factor(std::max(1, listed_colors(blend.word) - 1)),
          inverse(glm::inverse(matrix_of(blend.steps))) {}
    void evaluate(const double* given, double* result) const override {
        *result = factor * value_at(solid, transform_point(inverse, {given[0], given[1], given[2]}));
    }
    const SolidPattern solid;
    const int factor;
    const glm::dmat4 inverse;
};

}  // namespace

/// Reads a body, and transformations: the function is 1 inside of it, and 0 outside.
std::shared_ptr<const FunctionThing> PovReader::read_inside(Interpreter& in) {
    auto object = in.accept_thing<ObjectThing>(ValueKind::object);
    if (!object) object = read_object(in);
    if (!object) in.expected("a body");
    Steps steps;
    while (read_step(in, steps)) {
    }
    return inside_of(in, *object, glm::inverse(matrix_of(steps)));
}

std::shared_ptr<const FunctionThing> PovReader::read_function(Interpreter& in) {
    if (in.at("transform")) {
        Steps steps;
        read_step(in, steps);
        return std::make_shared<TransformFunction>(matrix_of(steps));
    }
    const bool pattern = in.at("pattern");
    in.take();
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
    if (!pattern) {
        if (auto colors = colors_of(own, in.noise_generator)) return colors;
    } else if (const auto solid = solid_of(own.blend, false, in.noise_generator)) {
        return std::make_shared<PatternFunction>(*solid, own.blend);
    }
    pattern_functions.emplace_back(place, std::make_shared<std::atomic<bool>>(false));
    return std::make_shared<ConstantFunction>(pattern ? 1 : 5, pattern_functions.back().second);
}

}  // namespace strahl::pov

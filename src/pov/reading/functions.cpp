// Reads functions that are made of things of this layer.
#include <glm/matrix.hpp>

#include "pov/reading/reader.h"

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

}  // namespace

std::shared_ptr<const FunctionThing> PovReader::read_function(Interpreter& in) {
    if (in.at("transform")) {
        Steps steps;
        read_step(in, steps);
        return std::make_shared<TransformFunction>(matrix_of(steps));
    }
    const bool pattern = in.at("pattern");
    in.skip();
    pattern_functions.emplace_back(in.last_place(), std::make_shared<std::atomic<bool>>(false));
    in.skip_block();
    return std::make_shared<ConstantFunction>(pattern ? 1 : 5, pattern_functions.back().second);
}

}  // namespace strahl::pov

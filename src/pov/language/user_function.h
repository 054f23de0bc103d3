// Functions of numbers that a scene declares: function { ... }.
#pragma once
#include <array>
#include <span>

#include "num/lattice_noise.h"
#include "pov/language/value.h"

namespace strahl::pov {

/// A function of numbers. `function { E }` has the three arguments x, y and z. Never throws: outside its domain it
/// gives an infinity or no number, as POV-Ray's functions do.
struct FunctionThing : Thing {
    int arguments = 3;
    int results = 1;  // 3 for a transformation, 2 to 5 for a spline, 5 for a pigment
    /// Evaluates the function; `given` has `arguments` numbers, `result` room for `results`. Safe in several threads.
    virtual void evaluate(const double* given, double* result) const = 0;
    /// Eight values, of as many evaluations at once.
    using Lanes = std::array<double, 8>;
    /// Evaluates the function for eight lists of arguments.
    virtual void evaluate_lanes(const Lanes* given, Lanes* result, const lattice::NoiseLanes& noise) const;
    /// Writes the values at points, of a function with one result.
    void evaluate_all(std::span<const DVec3> points, double* values,
                      const lattice::NoiseLanes& noise = lattice::noise_by_points) const;
    /// The value at a point, of a function with one result.
    double at(const DVec3& point) const {
        const double given[3]{point.x, point.y, point.z};
        double result;
        evaluate(given, &result);
        return result;
    }
};

}  // namespace strahl::pov

// Splines of the scene language: values by a parameter.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "pov/language/value.h"

namespace strahl::pov {

/// A spline through vectors of up to five components.
struct SplineThing : Thing {
    enum class Type : std::uint8_t { linear, quadratic, cubic, natural } type = Type::linear;
    struct Knot {
        double at;
        std::array<double, 5> value;
    };

    int components = 2;
    std::vector<Knot> knots;                        // ascending
    std::vector<std::array<double, 5>> curvatures;  // second derivatives at the knots, of a natural spline

    /// Adds a knot in its place; an equal parameter overwrites.
    void add(double at, const std::array<double, 5>& value);
    /// To be called after the last knot.
    void finish();
    std::array<double, 5> at(double parameter, Type as) const;
    /// Returns the type that a word stands for; false if it is none.
    static bool type_of(std::uint16_t word, Type& type);
};

}  // namespace strahl::pov

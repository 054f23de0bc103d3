// The parameters of blocks: names, ranges of values, and the text of the manual about them.
#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <variant>

#include "scene/pattern.h"

namespace strahl {

/// The values that a number may have, with the words for them in messages and in the manual.
struct NumberRange {
    double low, high;
    const char* words;
    bool whole = false;  // whole numbers only
    bool contains(double v) const { return v >= low && v <= high && (!whole || v == std::floor(v)); }
};

inline constexpr double largest_number = std::numeric_limits<double>::max();
inline constexpr double smallest_positive = std::numeric_limits<double>::min();  // denormals lose digits
inline constexpr double largest_coordinate = 1e9;
inline constexpr NumberRange coordinates{-largest_coordinate, largest_coordinate, "from -1e9 to 1e9"};
inline constexpr NumberRange lengths{smallest_positive, largest_coordinate, "greater than 0 and at most 1e9"};
inline constexpr NumberRange seconds{0, largest_coordinate, "from 0 to 1e9"};
inline constexpr NumberRange shares{0, 1, "from 0 to 1"};
// Products of three of these are numbers in float too.
inline constexpr NumberRange not_negative{0, 1e9, "from 0 to 1e9"};
inline constexpr NumberRange strengths{-1e9, 1e9, "from -1e9 to 1e9"};
inline constexpr NumberRange positive{1e-9, 1e9, "from 1e-9 to 1e9"};
// Up to the largest doubles below 90 and 180.
inline constexpr NumberRange half_angles{smallest_positive, 90 - 1e-14, "greater than 0 and less than 90 degrees"};
inline constexpr NumberRange angles{2 * smallest_positive, 180 - 2e-14, "greater than 0 and less than 180 degrees"};
inline constexpr NumberRange wide_angles{2 * smallest_positive, 720, "greater than 0 and at most 720 degrees"};
inline constexpr NumberRange depths{1, 256, "a whole number from 1 to 256", true};
inline constexpr NumberRange quarter_turns{0, 90, "from 0 to 90 degrees"};
inline constexpr NumberRange octave_counts{1, 10, "a whole number from 1 to 10", true};
inline constexpr NumberRange step_counts{1, 1000, "a whole number from 1 to 1000", true};
inline constexpr NumberRange grid_sizes{1, 64, "a whole number from 1 to 64", true};
inline constexpr NumberRange grid_levels{0, 100, "a whole number from 0 to 100", true};
inline constexpr NumberRange blade_counts{3, 64, "a whole number from 3 to 64", true};
inline constexpr NumberRange row_counts{1, 256, "a whole number from 1 to 256", true};
inline constexpr NumberRange gammas{1, 5, "from 1 to 5"};
inline constexpr NumberRange directions{-largest_coordinate, largest_coordinate, "from -1e9 to 1e9, not all 0"};
inline constexpr NumberRange anything{-largest_number, largest_number, "a number"};

/// The values of a coefficient in this range.
constexpr NumberRange range_of(Range range) {
    switch (range) {
        case Range::coordinate:
            return coordinates;
        case Range::positive:
            return positive;
        case Range::length:
            return lengths;
        case Range::length_or_zero:
        case Range::zero_or_more:
            return not_negative;
        case Range::zero_to_one:
            return shares;
        case Range::direction:
            return directions;
        case Range::quarter_turn:
            return quarter_turns;
        case Range::octaves:
            return octave_counts;
        case Range::steps:
            return step_counts;
        case Range::levels:
            return grid_levels;
        default:
            return anything;
    }
}
/// The values of a body's argument in this range: arguments are points, directions and lengths.
constexpr NumberRange argument_range(Range range) {
    return range == Range::positive ? lengths : range == Range::any ? coordinates : range_of(range);
}

inline constexpr std::string_view required = "required";

/// A parameter: `name value` in a block; the name alone if it is a bool.
struct Parameter {
    std::string_view name;
    std::variant<double*, DVec3*, Scale*, Pigment*, NormalMap*, Bump*, bool*, std::optional<double>*,
                 std::optional<DVec3>*>
        value;
    NumberRange range = anything;
    const char* help = "";
    std::string_view otherwise{};    // its default in words; empty: the value as it is before reading
    std::string_view alternative{};  // the name of a parameter that may be given in place of this one
    std::string_view at{};           // the name in the text, once it is read
    bool given() const { return at.data() != nullptr; }
};

/// The parameters that the field table of a struct lists, for reading them into `own`.
template <class Struct>
auto field_parameters(Struct& own) {
    return std::apply(
        [&](const auto&... field) {
            return std::array<Parameter, sizeof...(field)>{
                Parameter{field.name, &(own.*field.member), range_of(field.range), field.help, field.otherwise}...};
        },
        Struct::fields);
}

}  // namespace strahl

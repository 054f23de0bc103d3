// One parameter of a block: what it is called, which values it may have, and what the manual says of it.
#pragma once
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>

#include "scene/pattern.h"

namespace strahl {

/// The values a number may have, with the words that say so in messages and in the manual.
struct Bounds {
    double low, high;
    const char* words;
    bool whole = false;  // whole numbers only
    bool contains(double v) const { return v >= low && v <= high && (!whole || v == std::floor(v)); }
};

inline constexpr double largest_number = std::numeric_limits<double>::max();
inline constexpr double smallest_positive = std::numeric_limits<double>::min();  // denormals lose digits
inline constexpr double largest_coordinate = 1e9;
inline constexpr Bounds coordinates{-largest_coordinate, largest_coordinate, "from -1e9 to 1e9"};
inline constexpr Bounds lengths{smallest_positive, largest_coordinate,
                                "greater than 0 (at least 2.3e-308) and at most 1e9"};
inline constexpr Bounds lengths_or_zero{0, largest_coordinate, "from 0 to 1e9"};
inline constexpr Bounds seconds{0, largest_coordinate, "from 0 to 1e9"};
inline constexpr Bounds shares{0, 1, "from 0 to 1"};
// Products of three of these are numbers in float too.
inline constexpr Bounds not_negative{0, 1e9, "from 0 to 1e9"};
inline constexpr Bounds positive{1e-9, 1e9, "from 1e-9 to 1e9"};
// Up to the largest doubles below 90 and 180.
inline constexpr Bounds half_angles{smallest_positive, 90 - 1e-14, "greater than 0 and less than 90 degrees"};
inline constexpr Bounds angles{2 * smallest_positive, 180 - 2e-14, "greater than 0 and less than 180 degrees"};
inline constexpr Bounds depths{1, 256, "a whole number from 1 to 256", true};
inline constexpr Bounds quarter_turns{0, 90, "from 0 to 90 degrees"};
inline constexpr Bounds octave_counts{1, 10, "a whole number from 1 to 10", true};
inline constexpr Bounds grid_sizes{1, 64, "a whole number from 1 to 64", true};
inline constexpr Bounds row_counts{1, 256, "a whole number from 1 to 256", true};
inline constexpr Bounds only_one{1, 1, "1, the only value known"};
inline constexpr Bounds directions{-largest_coordinate, largest_coordinate, "from -1e9 to 1e9, not all 0"};
inline constexpr Bounds anything{-largest_number, largest_number, "a number"};

/// The bounds of a coefficient.
constexpr Bounds bounds_of(Range range) {
    switch (range) {
        case Range::positive:
            return positive;
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
        default:
            return anything;
    }
}
/// Those of a body's arguments, which are points, directions and lengths.
constexpr Bounds argument_bounds(Range range) {
    return range == Range::positive         ? lengths
           : range == Range::length_or_zero ? lengths_or_zero
           : range == Range::any            ? coordinates
                                            : bounds_of(range);
}

inline constexpr std::string_view required = "required";

/// `name value` in a block; of a bool the name alone.
struct Parameter {
    std::string_view name;
    std::variant<double*, DVec3*, Scale*, Pigment*, NormalMap*, Bump*, bool*, std::optional<double>*,
                 std::optional<DVec3>*>
        value;
    Bounds bounds = anything;
    const char* help = "";
    std::string_view otherwise{};    // what holds if it is not given; empty: the value as it is before reading
    std::string_view alternative{};  // the name of a parameter that may be given in place of this one
    std::string_view at{};           // becomes the place of the name
    bool given() const { return at.data() != nullptr; }
};

}  // namespace strahl

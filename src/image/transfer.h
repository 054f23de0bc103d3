// Converts computed values to those of a screen or an 8- or 16-bit file. For 8 bits there is a table of it
// (transfer_table.h).
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace strahl {

/// The sRGB encoding of linear light (IEC 61966-2-1), 0 <= v <= 1.
inline constexpr double srgb_slope = 12.92, srgb_bend = .0031308;  // up to the bend it is a straight line
inline double srgb(double v) { return v <= srgb_bend ? srgb_slope * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

/// Shows a value v from 0 to 1 of a scene as a screen and files of 8 and 16 bits do: as v, or if the scene declares an
/// `assumed_gamma` above 0 as the sRGB encoding of v^gamma.
inline double shown(double v, double gamma) {
    if (gamma == 0) return v;
    return srgb(gamma == 1 ? v : std::pow(v, gamma));
}
/// Returns the slope of shown() where it is steepest: at the bend, or for a gamma above 2 perhaps at 1. `gamma` is 0 or
/// from 1.
inline double steepest(double gamma) {
    if (gamma == 0) return 1;
    const double bend = std::pow(srgb_bend, 1 / gamma);
    return std::max(srgb_slope * gamma * std::pow(bend, gamma - 1), 1.055 / 2.4 * gamma);
}

/// How bright a screen shows light: the power of two by which it is multiplied. What is then above 0.8 is compressed,
/// so that it comes near to white, 1, and never reaches it. Without one, light is shown as it is, and what is brighter
/// than white is white.
using Exposure = std::optional<double>;
inline constexpr double most_exposure = 20;  // either way

/// Light as it is shown with an exposure of so many stops. Its slope is continuous.
inline double exposed(double v, double stops) {
    constexpr double shoulder = 0.8, rest = 1 - shoulder;
    const double light = v * std::exp2(stops), over = (light - shoulder) / rest;
    return over > 0 ? shoulder + rest * over / (1 + over) : light;
}
/// The most by which an exposure enlarges differences; not below 1.
inline double gain_of(const Exposure& exposure) { return std::exp2(std::max(exposure.value_or(0), 0.)); }

/// round(steps * shown(clamp(v, 0, 1))), halves up. NaN becomes 0.
inline std::uint16_t quantise(double v, double gamma, int steps) {
    const double clamped = v > 0 ? std::min(v, 1.0) : 0.0;
    return static_cast<std::uint16_t>(static_cast<int>(shown(clamped, gamma) * steps + 0.5));
}

/// Is code(v) the same for all values no further than `bound` from v? False if either is infinite or not a number.
template <class Code>
bool same_code(double v, double bound, const Code& code) {
    if (!std::isfinite(v) || !std::isfinite(bound)) return false;
    const double off = bound + 0x1p-50 * (std::fabs(v) + bound);  // adding rounds, and so does encoding
    return code(v - off) == code(v + off);
}

/// Does a file of `bits` (8, 16, or 32 for float) hold the same for all values no further than `bound` from a pixel's?
inline bool decided(const double* rgb, double bound, int bits, double gamma) {
    const auto same = [&](const auto& code) {
        return same_code(rgb[0], bound, code) && same_code(rgb[1], bound, code) && same_code(rgb[2], bound, code);
    };
    if (bits == 32) return same([](double v) { return static_cast<float>(v); });
    const int steps = (1 << bits) - 1;
    if (gamma != 0) return same([&](double v) { return quantise(v, gamma, steps); });
    return same([&](double v) { return quantise(v, 0, steps); });
}

}  // namespace strahl

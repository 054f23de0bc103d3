// POV-Ray's noise, bit for bit: the same scene must give the same marble.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "num/vec.h"

namespace strahl::lattice {

/// The tables that POV-Ray makes at its start. Lattice noise as in K. Perlin, "An image synthesizer" (1985), with
/// tables of POV-Ray's own.
struct NoiseTables {
    NoiseTables();
    std::array<double, 267> random;                   // -1 to 1
    std::array<std::uint16_t, 8192> hash;             // a permutation of 0 to 4095, twice
    std::array<DVec3, 2 * (2048 + 2)> gradients;      // of generator 3
    std::array<std::uint16_t, 2 * (2048 + 2)> order;  // of generator 3
    std::array<std::uint8_t, 8192> low;               // the last eight bits of `hash`
    std::array<std::array<double, 4>, 259> vectors;   // random[i], random[i + 4], random[i + 8] and 0
};
const NoiseTables& noise_tables();

/// Noise at several points at once, in the lanes of the caller's SIMD level.
struct NoiseLanes {
    void (*noise)(const DVec3* points, int count, int generator, double* values);
    void (*vector_turbulence)(const DVec3* points, int count, int octaves, float omega, float lambda, DVec3* ways);
};
/// Computes these noises one point after the other.
extern const NoiseLanes noise_by_points;

/// Noise from 0 to 1 at a point; `generator` is 1, 2 or 3.
double noise(const DVec3& point, int generator);
/// Three independent noises without an offset.
DVec3 vector_noise(const DVec3& point);
/// Sums of noise in 1 to 10 octaves, each `lambda` times as fine as the one before and `omega` times as strong. Octaves
/// too fine for points that are `step` apart fade to their means.
double turbulence(const DVec3& point, int octaves, float omega, float lambda, int generator, double step = 0);
DVec3 vector_turbulence(const DVec3& point, int octaves, float omega, float lambda, double step = 0);

/// Returns how much of a noise is left, from 1 to 0, if points are `step` of its cells apart: all of it if its cells
/// have two points, none if they are smaller than one and a half steps (A. Apodaca and L. Gritz, "Advanced RenderMan",
/// 1999, chapter 12, on frequency clamping).
inline double left_of_noise(double step) { return std::clamp(1.5 - step, 0., 1.); }
/// Fades a value to its mean; `value` is not called if nothing of it is left.
template <class S, class Value>
S faded(double step, const S& mean, const Value& value) {
    const double left = left_of_noise(step);
    return left == 1 ? value() : left > 0 ? mean + S(left) * (value() - mean) : mean;
}

}  // namespace strahl::lattice

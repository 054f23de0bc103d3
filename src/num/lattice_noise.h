// POV-Ray's noise, bit for bit: the same scene must give the same marble.
#pragma once
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
};
const NoiseTables& noise_tables();

/// Noise from 0 to 1 at a point; `generator` is 1, 2 or 3.
double noise(const DVec3& point, int generator);
/// Three independent noises without an offset.
DVec3 vector_noise(const DVec3& point);
/// Sums of noise in 1 to 10 octaves, each `lambda` times as fine as the one before and `omega` times as strong.
double turbulence(const DVec3& point, int octaves, float omega, float lambda, int generator);
DVec3 vector_turbulence(const DVec3& point, int octaves, float omega, float lambda);

}  // namespace strahl::lattice

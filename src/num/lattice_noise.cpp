#include "num/lattice_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "num/noise_lanes.h"

namespace strahl::lattice {
namespace {

/// CRC-16 of a double's bytes, most significant first, three times.
unsigned checksum(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    unsigned crc = 0;
    for (int i = 0; i < 24; ++i) {
        crc ^= static_cast<unsigned>(bits >> (56 - 8 * (i % 8))) & 255;
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >> 1) ^ 0xA001 : crc >> 1;
    }
    return crc;
}

}  // namespace

NoiseTables::NoiseTables() {
    for (int i = 0; i < static_cast<int>(random.size()); ++i) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.6g", checksum(i * .12345) * 2. / 65535 - 1);
        random[i] = std::strtod(digits, nullptr);
    }
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = {random[i], random[i + 4], random[i + 8], 0};
    std::uint32_t state = 0;
    const auto draw = [&] {
        state = 1812433253u * state + 12345u;
        return static_cast<int>(state >> 16 & 32767);
    };
    for (int i = 0; i < 4096; ++i) hash[i] = static_cast<std::uint16_t>(i);
    for (int i = 4095; i >= 0; --i) {
        const int j = draw() % 4096;
        std::swap(hash[i], hash[j]);
    }
    std::copy_n(hash.begin(), 4096, hash.begin() + 4096);
    for (std::size_t i = 0; i < hash.size(); ++i) low[i] = static_cast<std::uint8_t>(hash[i] & 255);

    constexpr int size = 2048;
    state = 1;
    gradients.fill(DVec3(0));
    order.fill(0);
    for (int i = 0; i < size; ++i) {
        DVec3 v(0);
        double square;
        do {
            for (int a = 0; a < 3; ++a) v[a] = static_cast<double>(draw() % (2 * size) - size) / size;
            square = v.x * v.x + v.y * v.y + v.z * v.z;
        } while (square > 1 || square < 1e-5);
        gradients[i] = v * (1 / std::sqrt(square));
        order[i] = static_cast<std::uint16_t>(i);
    }
    for (int i = size; i > 0; i -= 2) {
        const int j = draw() % size;
        std::swap(order[i], order[j]);
    }
    for (int i = 0; i < size + 2; ++i) {
        order[size + i] = order[i];
        gradients[size + i] = gradients[i];
    }
}

const NoiseTables& noise_tables() {
    static const NoiseTables tables;
    return tables;
}

const NoiseLanes noise_by_points = noise_lanes<double>;

double noise(const DVec3& point, int generator) { return lattice_noise(point, generator); }

DVec3 vector_noise(const DVec3& point) { return lattice_vector_noise(point); }

double turbulence(const DVec3& point, int octaves, float omega, float lambda, int generator, double step) {
    return lattice_turbulence(point, octaves, omega, lambda, generator, step);
}

DVec3 vector_turbulence(const DVec3& point, int octaves, float omega, float lambda, double step) {
    return lattice_vector_turbulence(point, octaves, omega, lambda, step);
}

}  // namespace strahl::lattice

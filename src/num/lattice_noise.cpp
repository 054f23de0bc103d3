#include "num/lattice_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

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

double smooth(double u) { return u * u * (3 - 2 * u); }

/// A cell of the lattice along one axis: its number, and the fraction within it.
struct LatticePlace {
    int cell;
    double fraction;
};
LatticePlace lattice_place(double x) {
    const auto limited = std::clamp(x, -1e9, 1e9);  // beyond, POV-Ray's integers overflow
    const int k = limited >= 0 ? static_cast<int>(limited) : static_cast<int>(limited - (1 - 1e-10));
    return {(k + 10000) & 4095, x - k};
}

/// Calls `add(index of the table, weight, offset to the corner)` for the corners of a cell, in this order.
template <class Add>
void each_corner(const DVec3& p, const std::array<int, 8>& order, const Add& add) {
    const auto& hash = noise_tables().hash;
    const auto [ix, x] = lattice_place(p.x);
    const auto [iy, y] = lattice_place(p.y);
    const auto [iz, z] = lattice_place(p.z);
    const double sx = smooth(x), sy = smooth(y), sz = smooth(z), tx = 1 - sx, ty = 1 - sy, tz = 1 - sz;
    for (const int corner : order) {
        const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        const int column = hash[hash[ix + i] ^ (iy + j)];
        add(hash[column ^ (iz + k)] & 255, (i ? sx : tx) * (j ? sy : ty) * (k ? sz : tz), x - i, y - j, z - k);
    }
}

double corner_value(int m, double weight, double x, double y, double z) {
    const auto& random = noise_tables().random;
    return weight * (random[m] * .5 + random[m + 1] * x + random[m + 2] * y + random[m + 3] * z);
}

/// Generator 3: gradients on a lattice of 2048 cells.
double gradient_noise(const DVec3& point) {
    const NoiseTables& tables = noise_tables();
    int low[3], high[3];
    double r0[3], s[3];
    for (int a = 0; a < 3; ++a) {
        const double t = std::clamp(point[a], -1e9, 1e9) + 10000000.023157213, whole = std::floor(t);
        low[a] = static_cast<int>(static_cast<std::int64_t>(whole) & 2047);
        high[a] = (low[a] + 1) & 2047;
        r0[a] = t - whole;
        s[a] = smooth(r0[a]);
    }
    const auto mix = [](double t, double a, double b) { return a + t * (b - a); };
    const auto at = [&](int i, int j, int k) {
        const int column = tables.order[tables.order[i ? high[0] : low[0]] + (j ? high[1] : low[1])];
        const DVec3& g = tables.gradients[column + (k ? high[2] : low[2])];
        return (r0[0] - i) * g.x + (r0[1] - j) * g.y + (r0[2] - k) * g.z;
    };
    double planes[2];
    for (int k = 0; k < 2; ++k)
        planes[k] = mix(s[1], mix(s[0], at(0, 0, k), at(1, 0, k)), mix(s[0], at(0, 1, k), at(1, 1, k)));
    return mix(s[2], planes[0], planes[1]);
}

}  // namespace

NoiseTables::NoiseTables() {
    for (int i = 0; i < static_cast<int>(random.size()); ++i) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.6g", checksum(i * .12345) * 2. / 65535 - 1);
        random[i] = std::strtod(digits, nullptr);
    }
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

double noise(const DVec3& point, int generator) {
    if (generator == 3) return std::clamp(.5 * (1.59 * gradient_noise(point) + .985), 0., 1.);
    double sum = 0;
    each_corner(point, {0, 1, 2, 3, 4, 5, 6, 7},
                [&](int m, double w, double x, double y, double z) { sum += corner_value(m, w, x, y, z); });
    return std::clamp(generator == 1 ? sum + .5 : (sum + 1.05242) * .48985582, 0., 1.);
}

DVec3 vector_noise(const DVec3& point) {
    DVec3 sum(0);
    each_corner(point, {0, 1, 3, 2, 6, 7, 5, 4}, [&](int m, double w, double x, double y, double z) {
        for (int a = 0; a < 3; ++a) sum[a] += corner_value(m + 4 * a, w, x, y, z);
    });
    return sum;
}

double turbulence(const DVec3& point, int octaves, float omega, float lambda, int generator, double step) {
    const auto at = [&](const DVec3& p, double fine) {
        return faded(fine * step, .5,
                     [&] { return generator > 1 ? 2 * noise(p, generator) - .5 : noise(p, generator); });
    };
    double sum = at(point, 1), l = lambda, o = omega;
    if (generator > 1) sum = std::clamp(sum, 0., 1.);
    for (int i = 2; i <= octaves; ++i, l *= lambda, o *= omega) sum += o * at(point * l, l);
    return sum;
}

DVec3 vector_turbulence(const DVec3& point, int octaves, float omega, float lambda, double step) {
    DVec3 sum = left_of_noise(step) * vector_noise(point);
    double l = lambda, o = omega;
    for (int i = 2; i <= octaves; ++i, l *= lambda, o *= omega) {
        const double left = left_of_noise(l * step);
        if (left > 0) sum += vector_noise(point * l) * (o * left);
    }
    return sum;
}

}  // namespace strahl::lattice

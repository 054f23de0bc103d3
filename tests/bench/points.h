// Points, repeatable random numbers and the sphere flake, for the programs that write worlds.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

namespace strahl::bench {

struct Point {
    double x = 0, y = 0, z = 0;
};
inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Point cross(const Point& a, const Point& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Point unit(const Point& a) { return 1 / std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z) * a; }
/// Sets u and v to directions at right angles to `a` and to each other.
inline void across(const Point& a, Point& u, Point& v) {
    u = unit(cross(a, std::fabs(a.x) < .6 ? Point{1, 0, 0} : Point{0, 1, 0}));
    v = cross(a, u);
}

/// A number from 0 to 1 that looks random, the same for the same state everywhere (S. Vigna's SplitMix64, whose states
/// are multiples of `next_state` apart).
inline constexpr std::uint64_t next_state = 0x9E3779B97F4A7C15u;
inline double chance(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// Calls put(centre, radius) for 9^generations + ... + 1 balls. Around each ball are nine, a third as large: six around
/// its waist, three above. The layout of the sphere flake in E. Haines, "A Proposal for Standard Graphics
/// Environments", 1987: the corners of a cuboctahedron except the three that point back.
void flake(const auto& put, const Point& centre, double radius, const Point& outwards, int generations) {
    put(centre, radius);
    if (generations == 0) return;
    Point u, v;
    across(outwards, u, v);
    for (int i = 0; i < 9; ++i) {
        const bool waist = i < 6;
        const double turn = std::numbers::pi / 3 * (waist ? i : 2 * i + .5);
        const double up = waist ? 0 : std::sqrt(2. / 3), out = std::sqrt(1 - up * up);
        const Point d = unit(up * outwards + out * std::cos(turn) * u + out * std::sin(turn) * v);
        flake(put, centre + 4. / 3 * radius * d, radius / 3, d, generations - 1);
    }
}

}  // namespace strahl::bench

// Points of a scrambled net, which fill the unit cube of up to five dimensions evenly.
#pragma once
#include <array>
#include <cstdint>

namespace strahl {

inline constexpr std::uint32_t most_net_dimensions = 5;
using NetDirections = std::array<std::array<std::uint32_t, most_net_dimensions>, 32>;  // by bit, then by dimension
/// Makes the direction numbers: of the first dimension they are those of van der Corput's sequence, of the others
/// they follow from the polynomials x + 1, x^2 + x + 1, x^3 + x + 1 and x^3 + x^2 + 1 (S. Joe and F. Kuo, 2008).
constexpr NetDirections net_directions() {
    NetDirections all{};
    constexpr std::array<std::uint32_t, most_net_dimensions> degree{0, 1, 2, 3, 3}, inner{0, 0, 1, 1, 2};
    constexpr std::array<std::array<std::uint32_t, 3>, most_net_dimensions> first{
        {{}, {1}, {1, 3}, {1, 3, 1}, {1, 1, 1}}};
    for (std::uint32_t d = 0; d < most_net_dimensions; ++d)
        for (std::uint32_t k = 0; k < 32; ++k) {
            std::uint32_t& own = all[k][d];
            if (d == 0 || k < degree[d]) {
                own = (d == 0 ? 1 : first[d][k]) << (31 - k);
                continue;
            }
            own = all[k - degree[d]][d] ^ all[k - degree[d]][d] >> degree[d];
            for (std::uint32_t j = 1; j < degree[d]; ++j) own ^= (inner[d] >> (degree[d] - 1 - j) & 1) * all[k - j][d];
        }
    return all;
}
inline constexpr NetDirections directions_of_nets = net_directions();

/// The first dimensions of Sobol's sequence, scrambled by A. Owen's method: each seed gives other points, which
/// are as evenly spread, and their mean is right on average ("Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences",
/// 1995). Bits are scrambled by a hash (B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020).
class ScrambledNet {
  public:
    explicit ScrambledNet(std::uint32_t from) : seed(from) {}

    /// Returns point i, with coordinates in [0, 1). The first 2^k points are a net.
    template <std::uint32_t dimensions = 4>
    std::array<double, dimensions> point(std::uint32_t i) const {
        const std::uint32_t shuffled = scrambled(i, seed);
        std::array<std::uint32_t, dimensions> bits{};
        for (std::uint32_t k = 0; k < 32; ++k)
            for (std::uint32_t d = 0; d < dimensions; ++d)
                bits[d] ^= (0u - (shuffled >> k & 1)) & directions_of_nets[k][d];
        std::array<double, dimensions> place;
        for (std::uint32_t d = 0; d < dimensions; ++d)
            place[d] = scrambled(bits[d], mix(seed + 0x9e3779b9u * (d + 1))) * 0x1p-32;
        return place;
    }

    /// Returns a number that hides how its argument was made.
    static constexpr std::uint32_t mix(std::uint32_t x) {
        x ^= x >> 16, x *= 0x7feb352du, x ^= x >> 15, x *= 0x846ca68bu;  // C. Wellons, "Hash Prospector", 2018
        return x ^ x >> 16;
    }

  private:
    static constexpr std::uint32_t reversed(std::uint32_t x) {
        x = x >> 16 | x << 16;
        x = (x & 0xff00ff00u) >> 8 | (x & 0x00ff00ffu) << 8;
        x = (x & 0xf0f0f0f0u) >> 4 | (x & 0x0f0f0f0fu) << 4;
        x = (x & 0xccccccccu) >> 2 | (x & 0x33333333u) << 2;
        return (x & 0xaaaaaaaau) >> 1 | (x & 0x55555555u) << 1;
    }
    /// Changes each bit by a hash of those below it alone (S. Laine and T. Karras, "Stratified Sampling for Stochastic
    /// Transparency", 2011).
    static constexpr std::uint32_t mixed(std::uint32_t x, std::uint32_t by) {
        x += by, x ^= x * 0x6c50b47cu, x ^= x * 0xb82f1e52u, x ^= x * 0xc7afe638u, x ^= x * 0x8d22f6e6u;
        return x;
    }
    static constexpr std::uint32_t scrambled(std::uint32_t x, std::uint32_t by) {
        return reversed(mixed(reversed(x), by));
    }

    std::uint32_t seed;
};

}  // namespace strahl

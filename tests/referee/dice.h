// Random numbers for random scenes. Only the generator's raw bits are used, because the standard's distributions differ
// between libraries.
#pragma once
#include <cmath>
#include <cstdint>
#include <random>

#include "num/vec.h"

namespace strahl {

class Dice {
  public:
    explicit Dice(std::uint64_t seed) : bits(seed) {}
    double in(double low, double high) { return low + (high - low) * (bits() >> 11) * 0x1p-53; }
    int upto(int last) { return static_cast<int>(bits() % (last + 1)); }
    bool chance(double p) { return in(0, 1) < p; }
    DVec3 vector(double low, double high) {
        const double x = in(low, high), y = in(low, high), z = in(low, high);
        return {x, y, z};
    }
    DVec3 direction() {
        while (true) {
            const DVec3 v = vector(-1, 1);
            const double square = v.x * v.x + v.y * v.y + v.z * v.z;
            if (square > .01 && square < 1) return v / std::sqrt(square);
        }
    }
    DVec3 arrow(double shortest, double longest) {
        const double length = in(shortest, longest);
        return length * direction();
    }

  private:
    std::mt19937_64 bits;
};

}  // namespace strahl

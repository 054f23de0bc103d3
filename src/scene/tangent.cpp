#include "scene/tangent.h"

#include <cmath>

namespace strahl {
namespace {

/// The sum of two numbers of which the second is a rounding error of the first: twice the digits (T. J. Dekker, "A
/// Floating-Point Technique for Extending the Available Precision", 1971).
struct Twofold {
    double high, low;
};
Twofold sum(double large, double small) {
    const double high = large + small;
    return {high, small - (high - large)};
}
Twofold operator*(const Twofold& a, const Twofold& b) {
    const double high = a.high * b.high;
    return sum(high, std::fma(a.high, b.high, -high) + (a.high * b.low + a.low * b.high));
}
Twofold operator/(const Twofold& a, const Twofold& b) {
    const double high = a.high / b.high;
    return sum(high, (std::fma(-high, b.high, a.high) + a.low - high * b.low) / b.high);
}

/// 1 - y / (n (n + 1)) (1 - y / ((n + 2) (n + 3)) (1 - ...)), for y up to (pi/4)^2.
Twofold series(const Twofold& y, int n) {
    Twofold result{1, 0};
    for (int k = n + 24; k >= n; k -= 2) {
        const Twofold term = y * result / Twofold{double(k * (k + 1)), 0}, rest = sum(1, -term.high);
        result = sum(rest.high, rest.low - term.low);
    }
    return result;
}

}  // namespace

// The C library's tangent differs from one machine to the next, in its last bit or in the digits of its long double.
double tangent(double degrees) {
    constexpr Twofold radians_per_degree{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
    const bool steep = degrees > 45;
    const Twofold x = Twofold{steep ? 90 - degrees : degrees, 0} * radians_per_degree, y = x * x;
    const Twofold sine = x * series(y, 2), cosine = series(y, 1);
    return (steep ? cosine / sine : sine / cosine).high;
}

}  // namespace strahl

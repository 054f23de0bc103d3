#include "tests/attack/renderer/wild_values.h"

#include <algorithm>
#include <cmath>

namespace strahl {

double WildValues::tame() {
    switch (dice.upto(3)) {
        case 0:
            return dice.upto(4) - 2;
        case 1:
            return (dice.upto(12) - 6) / 4.;
        default:
            return dice.in(-3, 3);
    }
}

double WildValues::extreme(const NumberRange& bounds) {
    const double sign = dice.chance(.5) ? -1 : 1;
    const auto power = [&](double from, double to) { return sign * std::pow(10, dice.in(from, to)); };
    const double most = std::log10(bounds.high), least = bounds.low > 0 ? std::log10(bounds.low) : -307;
    switch (dice.upto(7)) {
        case 0:
            return bounds.low;
        case 1:
            return bounds.high;
        case 2:
            return power(least, most);
        case 3:
            return power(std::max(-15., least), most);
        case 4:
            return power(-4, 4);
        case 5:
            return dice.chance(.2) ? 5e-324 : 0;
        default: {
            if (numbers.empty()) return 1;
            const double earlier = numbers[dice.upto(static_cast<int>(numbers.size()) - 1)];
            return dice.chance(.5) ? earlier * (1 + power(-17, -1)) : std::nextafter(earlier, sign * bounds.high);
        }
    }
}

double WildValues::number(const NumberRange& bounds) {
    for (int i = 0; i < 30; ++i) {
        const bool again = !numbers.empty() && dice.chance(.2);
        double value = again ? numbers[dice.upto(static_cast<int>(numbers.size()) - 1)]
                             : (dice.chance(wildness) ? extreme(bounds) : tame());
        if (bounds.low >= 0) value = std::fabs(value);
        if (!bounds.contains(value)) continue;
        numbers.push_back(value);
        return value;
    }
    return bounds.high;
}

double WildValues::usual_or(const NumberRange& bounds, double low, double high) {
    return dice.chance(wildness) ? number(bounds) : dice.in(low, high);
}

DVec3 WildValues::point() {
    DVec3 p{0};
    if (!points.empty() && dice.chance(.25)) {
        p = points[dice.upto(static_cast<int>(points.size()) - 1)];
        if (dice.chance(.7)) p[dice.upto(2)] = number(coordinates);
    } else {
        for (int i = 0; i < 3; ++i) p[i] = number(coordinates);
    }
    points.push_back(p);
    return p;
}

Color WildValues::color() {
    const auto part = [&] { return usual_or(not_negative, 0, 1); };
    const double red = part(), green = part(), blue = part();
    return {red, green, blue};
}

}  // namespace strahl

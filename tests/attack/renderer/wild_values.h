// Values as the language allows them, usual and extreme ones.
#pragma once
#include <vector>

#include "tests/referee/dice.h"
#include "text/blocks/blocks.h"

namespace strahl {

class WildValues {
  public:
    explicit WildValues(std::uint64_t seed) : dice(seed) {
        constexpr double shares[]{0, .03, .2, .7};
        wildness = shares[dice.upto(3)];
    }

    double number(const NumberRange& bounds);
    /// Mostly of this interval.
    double usual_or(const NumberRange& bounds, double low, double high);
    DVec3 point();
    Color color();

    Dice dice;
    double wildness;  // share of the values that are extreme

  private:
    double tame();
    double extreme(const NumberRange& bounds);

    std::vector<double> numbers;  // that were chosen, to be chosen again: so bodies touch and coincide
    std::vector<DVec3> points;
};

}  // namespace strahl

#include "show/session/divider.h"

#include <algorithm>
#include <cmath>

namespace strahl {

void Divider::next() {
    second = second == SecondKind::extended ? SecondKind::none : static_cast<SecondKind>(static_cast<int>(second) + 1);
}

bool Divider::reached(const ScreenArea& picture, double x, double y, double reach) const {
    return shown() && std::abs(x - column(picture)) <= reach && y >= picture.y && y < picture.y + picture.height;
}

void Divider::pull(const ScreenArea& picture, double x) {
    at = std::clamp((x - picture.x) / std::max(picture.width, 1), 0., 1.);
}

int Divider::column(const ScreenArea& picture) const {
    return picture.x + static_cast<int>(std::lround(at * picture.width));
}

std::string second_name(SecondKind kind) {
    switch (kind) {
        case SecondKind::povray:
            return "POV-Ray";
        case SecondKind::one_ray:
            return "one ray in each pixel";
        case SecondKind::extended:
            return "long double";
        default:
            return "";
    }
}

}  // namespace strahl

#include "show/session/divider.h"

#include <algorithm>
#include <cmath>

namespace strahl {

void Divider::next() {
    second = second >= SecondKind::flight ? SecondKind::none : static_cast<SecondKind>(static_cast<int>(second) + 1);
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

ScreenArea Divider::second_area(const ScreenArea& picture) const {
    ScreenArea part = picture;
    part.x = column(picture), part.width -= part.x - picture.x;
    if (!other_view()) return part;
    part.height = part.width * picture.height / std::max(picture.width, 1);
    part.y += (picture.height - part.height) / 2;
    return part;
}

std::string second_name(SecondKind kind) {
    switch (kind) {
        case SecondKind::povray:
            return "POV-Ray";
        case SecondKind::one_ray:
            return "one ray in each pixel";
        case SecondKind::extended:
            return "long double";
        case SecondKind::in_motion:
            return "in motion";
        case SecondKind::flight:
            return "the camera of the flight";
        case SecondKind::depth:
            return "depth";
        case SecondKind::normals:
            return "normals";
        default:
            return "";
    }
}

}  // namespace strahl

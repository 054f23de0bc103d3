// The divider of the window: to its right another picture of the same view is seen.
#pragma once
#include <string>

#include "show/session/framing.h"

namespace strahl {

/// The second picture, to the right of the divider: by POV-Ray, or as Strahl shows the same view otherwise; or what the
/// camera of the flight sees, while the first picture is from outside; or a layer of it. Commands name their numbers.
enum class SecondKind { none, povray, one_ray, extended, in_motion, flight, depth, normals };

struct Divider {
    SecondKind second = SecondKind::none;
    bool difference = false;  // is the amplified difference of both shown in place of the second picture?
    double at = .5;           // share of the picture's width to its left

    /// Goes on to the next kind of second picture; after the last one, and before the first, there is none.
    void next();
    /// Is the second picture of another view?
    bool other_view() const { return second == SecondKind::flight; }
    /// Returns the part of the window where the second picture is seen: all to the right of the divider, or the whole
    /// other view in the middle of that.
    ScreenArea second_area(const ScreenArea& picture) const;
    /// Is the second picture of a layer, depth or normals, in place of the scene's light?
    bool layer() const { return second >= SecondKind::depth; }
    bool shown() const { return second != SecondKind::none; }
    /// Is this point of the window so near to it that the pointer takes hold of it there? All in pixels.
    bool reached(const ScreenArea& picture, double x, double y, double reach) const;
    /// Moves it to this column of the window.
    void pull(const ScreenArea& picture, double x);
    /// Returns the column of the window where it is.
    int column(const ScreenArea& picture) const;
};

/// Names the second picture, for the window.
std::string second_name(SecondKind kind);

}  // namespace strahl

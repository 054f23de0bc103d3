// The handles with which the user moves, turns and scales what is chosen: where they are seen, and what a drag of one
// means.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "num/ray.h"
#include "num/vec.h"
#include "scene/scene.h"
#include "text/place_body.h"
#include "trace/world/view.h"

namespace strahl {

/// Returns where a point is seen in a view's picture, in pixels from its top left corner; nothing if it is not in front
/// of the camera.
std::optional<glm::dvec2> place_in(const View& view, const DVec3& point);

/// Returns the circle around a spotlight's target that its light reaches up to this angle, in degrees, 80 at most.
std::vector<DVec3> cone_circle(const DVec3& light, const Spot& spot, double angle);

/// Returns the largest of 1, 2 and 5 times a power of ten that is not above a length.
double round_length(double length);
/// Returns how many decimals of coordinates can be seen where a pixel is so large.
int decimals_of(double pixel);

enum class HandleMode { move, turn, scale };

/// A handle: one of three axes, or all of them: moves in the plane of the view, turns about the line of sight, scales
/// evenly.
enum class Handle { x, y, z, all };

/// Says what a drag snaps to: round distances, angles and factors, or surfaces of other bodies.
enum class Snap { none, grid, surface };

class Handles {
  public:
    /// Places handles around a point of the world, along these axes, which reach as far as this many pixels in the
    /// view. With `only_even` there is none to scale along a single axis.
    Handles(HandleMode mode, const DVec3& centre, const std::array<DVec3, 3>& axes, double pixels, const View& view,
            bool only_even = false);

    /// Places two circles around a spotlight's target, which open and close its cone: `all` where its light ends, `y`
    /// where it begins to fade.
    Handles(const DVec3& light, const Spot& spot, const View& view);

    struct HandleLine {
        Handle handle;
        std::vector<glm::dvec2> points;  // in pixels of the view's picture
        bool filled = false;             // it is the edge of an area
    };
    /// Returns the lines to be drawn; none if the centre is not in front of the camera.
    const std::vector<HandleLine>& lines() const { return drawn; }
    /// Returns the handle at a point of the picture, if one is no further than this.
    std::optional<Handle> at(const glm::dvec2& point, double reach) const;

    /// Returns what a drag of a handle from one point to another does. With `steps` it moves the centre to a grid of
    /// round coordinates, turns by 15 degrees, and scales by tenths. Circles of a cone scale evenly.
    Placing drag(Handle handle, const glm::dvec2& from, const glm::dvec2& to, bool steps) const;
    HandleMode handle_mode() const { return mode; }
    /// Returns the ray through a point of the view.
    Ray<double> ray(const glm::dvec2& point) const;
    /// Returns how many decimals of coordinates can be seen here.
    int decimals() const;

  private:
    DVec3 axis(Handle handle) const { return axes[static_cast<std::size_t>(handle)]; }
    DVec3 sight_of_centre() const;
    double along_axis(Handle handle, const glm::dvec2& point) const;
    DVec3 in_plane(const glm::dvec2& point) const;
    double turn_degrees(Handle handle, const glm::dvec2& from, const glm::dvec2& to) const;
    void add_line(Handle handle, const std::vector<DVec3>& points, bool filled = false);
    void add_square(Handle handle, const DVec3& at, double side);

    HandleMode mode;
    bool cone = false;  // circles, which scale in all directions
    DVec3 centre;
    std::array<DVec3, 3> axes{};
    View view;
    DVec3 right{0}, down{0}, forward{0};
    double pixel = 0, reach = 0;  // their sizes at the centre, in units of the world
    std::vector<HandleLine> drawn;
};

}  // namespace strahl

// Moves of the points at which a pattern is evaluated: by warps, turbulence and transformations.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "num/lattice_noise.h"
#include "pov/things/steps.h"

namespace strahl::pov {

struct TurbulenceWarp {
    DVec3 by{0};
    int octaves = 6;
    double omega = .5, lambda = 2;
};
/// Repeats the slab from 0 to `width` along an axis; the n-th one is moved by n times `offset`, and every second one is
/// multiplied by `flip`.
struct RepeatWarp {
    int axis = 0;
    double width = 1;
    DVec3 offset{0}, flip{1};
};
/// Draws points within a ball to its centre, or with `inverse` away from it. `repeat` is the distance of more such
/// balls along each axis, 0 for none, and `uncertain` how far these are moved at random.
struct BlackHoleWarp {
    DVec3 centre{0};
    double radius = 1, strength = 1, falloff = 2;
    bool inverse = false, repeats = false;
    DVec3 repeat{0}, uncertain{0};
};
/// Wraps the plane z = 0 around a cylinder, a ball or a torus: a point gets its angles, from 0 to 1, and its distance.
/// The angles are multiplied by the distance to the power of `exponent`.
struct RoundWarp {
    enum class Shape { cylinder, ball, torus } shape = Shape::cylinder;
    DVec3 orientation{0, 0, 1};  // of the plane, of length 1
    double exponent = 0, major_radius = 1;
};
struct PlanarWarp {
    DVec3 orientation{0, 0, 1};
    double offset = 0;
};
/// Wraps the unit square around a cube.
struct CubicWarp {};
/// Gives a point its angle around the y axis, from 0 to 1, and what `height` says of its distance from it and of y.
struct TurnedWarp {
    std::shared_ptr<const std::function<double(double away, double y)>> height;
};
struct PlaceMoves;
/// Makes a point the place by uv that its x and y are once it has been moved.
struct PlaceWarp {
    std::shared_ptr<const PlaceMoves> moves;
};
using Warp =
    std::variant<TurbulenceWarp, RepeatWarp, BlackHoleWarp, RoundWarp, PlanarWarp, CubicWarp, TurnedWarp, PlaceWarp>;

/// A matrix, or a warp. Moves are applied to points in the order in which they stand.
using Move = std::variant<glm::dmat4, Warp>;
using Moves = std::vector<Move>;
struct PlaceMoves {
    Moves list;
};

DVec3 moved(std::span<const Move> moves, DVec3 point);
/// Moves several points at once.
void move_points(std::span<const Move> moves, std::span<DVec3> points, const lattice::NoiseLanes& noise);

/// Turns normals to the space of moved points. As in POV-Ray they have length 1 in either space, and warps leave them
/// as they are.
class MovedNormals {
  public:
    explicit MovedNormals(std::span<const Move> moves = {});
    DVec3 moved(const DVec3& normal) const;
    /// Returns what is added to a normal where a change is added to it in the space of moved points.
    DVec3 unmoved(const DVec3& change, const DVec3& normal) const;

  private:
    glm::dmat3 there{1}, back{1};
};

}  // namespace strahl::pov

// Turns bodies that a function defines into meshes.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <span>

#include "num/bounding_box.h"
#include "scene/kinds/mesh_data.h"

namespace strahl::pov {

/// A function of points that is below 0 inside a body; writes the values of all points that it is given.
using Inside = std::function<void(std::span<const DVec3> points, double* values)>;

/// Returns the surface on which a function is 0, within a box that is divided into so many cells along each axis, an
/// even number. The normals are those of the function's slope. A part of the surface may be missed if it is smaller
/// than two cells and apart from all others.
MeshData level_surface(const Inside& inside, const Box& box, int cells);

/// A body that becomes a mesh once it is shown: standard include files declare many that no scene uses.
struct LevelSurface {
    std::function<MeshData(int cells)> make;
    mutable std::map<int, std::shared_ptr<const MeshData>> made{};  // by their cells

    const std::shared_ptr<const MeshData>& mesh(int cells) const {
        std::shared_ptr<const MeshData>& own = made[cells];
        if (!own) own = std::make_shared<const MeshData>(make(cells));
        return own;
    }
};

/// Returns the value of a polynomial, whose coefficients stand in POV-Ray's order: of falling powers of x, then of y,
/// then of z.
double polynomial(int order, std::span<const double> coefficients, const DVec3& p);

/// Returns a box around all places where a function of a box is below 0, as far as a coarse grid shows them.
Box region_of(const Inside& inside, const Box& within);

}  // namespace strahl::pov

// Colours that are given at the corners of triangles, as a picture in which each triangle has pixels of its own.
#pragma once
#include <span>

#include "mesh/mesh_look.h"
#include "scene/kinds/mesh_data.h"
#include "scene/pattern.h"

namespace strahl {

/// Colours of corners: those of points, or where `by_triangle` those of triangles. They are sRGB-encoded unless
/// `linear`.
struct CornerColors {
    std::span<const MeshLook::Rgb> colors;
    bool by_triangle = false, linear = false;
};

/// Gives the corners of a mesh places in a picture that it makes, so that colours change linearly across triangles.
/// Triangles that are near each other in space are so in the picture as well: from afar their mean is seen. Throws
/// FileError if there are more triangles than a picture has room for.
Pigment color_corners(MeshData& mesh, const CornerColors& colors);

}  // namespace strahl

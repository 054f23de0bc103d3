// Adds faces to a mesh: splits them into triangles, and makes those flat whose normals cannot be used.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mesh/source.h"
#include "mesh/split.h"
#include "scene/kinds/mesh_data.h"

namespace strahl {

/// The corners of a face. Its normals and places are as many as its corners, or none.
struct Face {
    static constexpr std::int32_t none = -1;  // in place of the number of a normal or a place
    std::vector<std::int32_t> points, normals, places;
    void clear() { points.clear(), normals.clear(), places.clear(); }
};

class Faces {
  public:
    /// All normals and places that faces name must be in the mesh before the first is added.
    Faces(const Source& source, MeshData& mesh) : source(source), mesh(mesh) {}

    /// Adds the triangles of a face. One of fewer than three corners is skipped. One that lacks a normal or a place at
    /// some corner, or has one there that is not a direction or not a number, gets none at all. `where` says where the
    /// face stands, as in "in line 7"; it is called for warnings only. Throws FileError by `fail`, which gets the rest
    /// of a sentence about the face, if it cannot be split.
    void add(const Face& face, const Source::Where& where, const std::function<void(const std::string&)>& fail);
    /// Can all normals of the mesh be used?
    bool all_directions() const;
    /// Gives faces without normals the normal of their plane and those without places the origin, if others have some.
    void finish();

  private:
    bool has_normals(const Face& face, const Source::Where& where) const;
    bool has_places(const Face& face, const Source::Where& where) const;
    void flatten();

    const Source& source;
    MeshData& mesh;
    FaceSplitter splitter;
};

}  // namespace strahl

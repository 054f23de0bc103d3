// Reads the contents of a `mesh` block: triangles, or the name of a file; the contours of a `prism` or a
// `lathe`, and the parts of a `blob` or a `sphere_sweep`.
#pragma once
#include <array>
#include <memory>
#include <string>

#include "mesh/join.h"
#include "scene/kinds/composite.h"
#include "scene/kinds/lathe.h"
#include "scene/kinds/mesh.h"
#include "text/reading/reader.h"

namespace strahl {

/// Reads the arguments that the field table of a kind lists. Commas between them may be left out.
template <class Kind>
void read_arguments(BlockReader& reader, Kind& kind, Block& block) {
    bool first = true;
    const auto argument = [&](const auto& field) {
        if (field.given == Given::optional && !reader.lexer.at_value()) return;
        if (!first) reader.lexer.accept(',');
        first = false;
        reader.read(kind.*field.member, argument_range(field.range), field.name, block);
    };
    std::apply([&](const auto&... field) { (argument(field), ...); }, Kind::fields);
}

/// One mesh while it is read. Equal points become one.
class MeshBlock {
  public:
    explicit MeshBlock(BlockReader& reader) : reader(reader) {}
    /// Reads what follows a word of `mesh_words`; false if it is none of these.
    bool part(std::string_view word, Block& block);
    /// Returns the mesh, once its block is closed. Errors are reported at its `word`.
    Mesh take(std::string_view word, Block& block);

  private:
    void file(std::string_view word, Block& block);
    template <class Kind>
    void triangle(std::string_view word, Block& block);
    MeshData::Corners flat_normals(const DVec3& a, const DVec3& b, const DVec3& c);
    void add(const Triangle& triangle);
    void add(const SmoothTriangle& triangle);
    void add(const std::array<MeshData::Place, 3>& corners);

    BlockReader& reader;
    std::string name;
    std::string_view file_at, triangle_at;
    std::shared_ptr<const MeshData> from_file;
    MeshData inline_data;  // all but its points, normals and places
    PointJoiner points, normals, places;
};

/// Reads the block of a contour.
Contour read_contour(BlockReader& reader, std::string_view word, Block& block);
/// Reads the block of a part: a lump, or a ball of a sweep.
template <class Part>
Part read_part(BlockReader& reader, std::string_view word, Block& block) {
    Part part;
    Block own{word};
    reader.block(
        own, std::array<std::string_view, 0>{}, [&] { read_arguments(reader, part, own); },
        [](std::string_view) { return false; });
    block.absorb(own);
    return part;
}

/// Why a body of this word cannot be part of another one; empty if it can.
std::string open_mesh_fault(const Mesh& mesh);
template <class Kind>
std::string fault_as_part(const Kind& kind, std::string_view word) {
    if (!can_be_part<Kind>) return "a " + std::string(word) + " cannot be part of a body: only closed bodies can";
    if constexpr (std::is_same_v<Kind, Mesh>)
        return open_mesh_fault(kind);
    else if constexpr (std::is_same_v<Kind, Lathe>)
        return kind.open()
                   ? "this lathe cannot be part of a body: a contour neither is closed nor has both ends on the axis"
                   : "";
    else
        return "";
}

}  // namespace strahl

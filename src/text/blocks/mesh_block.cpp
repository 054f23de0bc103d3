#include "text/blocks/mesh_block.h"

#include "scene/error.h"
#include "text/blocks/blocks.h"

namespace strahl {

bool MeshBlock::part(std::string_view word, Block& block) {
    if (word == "file")
        file(word, block);
    else if (word == Triangle::name)
        triangle<Triangle>(word, block);
    else if (word == SmoothTriangle::name)
        triangle<SmoothTriangle>(word, block);
    else
        return false;
    return true;
}

void MeshBlock::file(std::string_view word, Block& block) {
    const std::string_view given = reader.lexer.quotation("the name of a file");
    if (!reader.once(file_at, word)) return;
    name = given;
    try {
        from_file = reader.files.mesh(name);
    } catch (const FileError& error) {
        reader.diagnostics.add(given, error.what());
        block.bad = true;
    }
}

template <class Kind>
void MeshBlock::triangle(std::string_view word, Block& block) {
    if (!triangle_at.data()) triangle_at = word;
    Kind triangle;
    Block own{word};
    std::string_view places_at;
    std::array<MeshData::Place, 3> corners{};
    reader.block(
        own, triangle_words, [&] { read_arguments(reader, triangle, own); },
        [&](std::string_view inner) {
            if (inner != triangle_words[0]) return false;
            own.bad |= !reader.once(places_at, inner);
            for (MeshData::Place& place : corners)
                reader.read(place, coordinates, inner, own), reader.lexer.accept(',');
            return true;
        });
    block.absorb(own);
    if (!own.good()) return;
    if (const char* const fault = triangle.fault()) {
        reader.diagnostics.add(word, "this " + std::string(word) + " is none: " + fault);
        block.bad = true;
        return;
    }
    add(triangle);
    if (places_at.data() || !inline_data.corner_places.empty()) add(corners);
}

/// Among smooth triangles a flat one has the same normal at all corners.
void MeshBlock::add(const Triangle& t) {
    inline_data.triangles.push_back({points.number_of(t.a), points.number_of(t.b), points.number_of(t.c)});
    if (inline_data.corner_normals.empty()) return;
    const std::int32_t normal = normals.number_of(normalize(cross_product(t.b - t.a, t.c - t.a)));
    inline_data.corner_normals.push_back({normal, normal, normal});
}
void MeshBlock::add(const SmoothTriangle& t) {
    if (inline_data.corner_normals.empty()) {
        const std::vector<MeshData::Corners> flat = std::exchange(inline_data.triangles, {});
        const auto corner = [&](std::int32_t i) { return points.points()[i]; };
        inline_data.corner_normals.reserve(flat.size() + 1);
        for (const auto& [a, b, c] : flat) {
            const std::int32_t n =
                normals.number_of(normalize(cross_product(corner(b) - corner(a), corner(c) - corner(a))));
            inline_data.corner_normals.push_back({n, n, n});
        }
        inline_data.triangles = flat;
    }
    inline_data.triangles.push_back({points.number_of(t.a), points.number_of(t.b), points.number_of(t.c)});
    inline_data.corner_normals.push_back(
        {normals.number_of(t.normal_a), normals.number_of(t.normal_b), normals.number_of(t.normal_c)});
}

/// The corners of triangles without places are at the origin.
void MeshBlock::add(const std::array<MeshData::Place, 3>& corners) {
    const auto number = [&](int k) { return places.number_of({corners[k][0], corners[k][1], 0}); };
    const std::int32_t none = inline_data.corner_places.empty() ? places.number_of(DVec3(0)) : 0;
    inline_data.corner_places.resize(inline_data.triangles.size() - 1, {none, none, none});
    inline_data.corner_places.push_back({number(0), number(1), number(2)});
}

Mesh MeshBlock::take(std::string_view word, Block& block) {
    const auto fault = [&](const char* message) {
        if (block.good()) reader.diagnostics.add(word, message);
        block.bad = true;
        return Mesh{};
    };
    if (file_at.data() && triangle_at.data())
        return fault("this mesh has a file and triangles of its own; two meshes may have");
    if (!block.good()) return {};
    if (file_at.data()) return {from_file, name};
    if (inline_data.triangles.empty()) return fault("this mesh is none: it has no triangles");
    inline_data.points = std::move(points.points()), inline_data.normals = std::move(normals.points());
    for (const DVec3& place : places.points()) inline_data.places.push_back({place.x, place.y});
    return {std::make_shared<const MeshData>(std::move(inline_data)), ""};
}

std::string open_mesh_fault(const Mesh& mesh) {
    const auto side = open_side(*mesh.data);
    if (!side) return "";
    return "this mesh can't be part of a body: it is open between " + text_of(side->first) + " and " +
           text_of(side->second);
}

}  // namespace strahl

#include "text/blocks/mesh_block.h"

#include "files/error.h"
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
    const bool first = reader.once(file_at, word);
    reader.file(block, "file", [&](std::string_view given) {
        if (first) from_file = reader.files.mesh(name = given);
    });
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
    if (const char* const fault = triangle.fault())
        return reader.fault(block, word, "invalid " + std::string(word) + ": " + fault);
    add(triangle);
    if (places_at.data() || !inline_data.corner_places.empty()) add(corners);
}

/// The normal of a flat triangle among smooth ones, at all corners.
MeshData::Corners MeshBlock::flat_normals(const DVec3& a, const DVec3& b, const DVec3& c) {
    const std::int32_t normal = normals.number_of(normalize(cross_product(b - a, c - a)));
    return {normal, normal, normal};
}
void MeshBlock::add(const Triangle& t) {
    inline_data.triangles.push_back({points.number_of(t.a), points.number_of(t.b), points.number_of(t.c)});
    if (!inline_data.corner_normals.empty()) inline_data.corner_normals.push_back(flat_normals(t.a, t.b, t.c));
}
void MeshBlock::add(const SmoothTriangle& t) {
    const std::vector<DVec3>& all = points.points();
    if (inline_data.corner_normals.empty())
        for (const auto& [a, b, c] : inline_data.triangles)
            inline_data.corner_normals.push_back(flat_normals(all[a], all[b], all[c]));
    inline_data.triangles.push_back({points.number_of(t.a), points.number_of(t.b), points.number_of(t.c)});
    inline_data.corner_normals.push_back(
        {normals.number_of(t.normal_a), normals.number_of(t.normal_b), normals.number_of(t.normal_c)});
}

/// Adds the places of a triangle's corners in a picture. Corners of triangles without places are at the origin.
void MeshBlock::add(const std::array<MeshData::Place, 3>& corners) {
    const auto number = [&](int k) { return places.number_of({corners[k][0], corners[k][1], 0}); };
    const std::int32_t none = inline_data.corner_places.empty() ? places.number_of(DVec3(0)) : 0;
    inline_data.corner_places.resize(inline_data.triangles.size() - 1, {none, none, none});
    inline_data.corner_places.push_back({number(0), number(1), number(2)});
}

Mesh MeshBlock::take(std::string_view word, Block& block) {
    const auto fault = [&](const char* message) {
        if (block.good()) reader.fault(block, word, message);
        return Mesh{};
    };
    if (file_at.data() && triangle_at.data())
        return fault("this mesh has both a file and triangles; make two meshes of it");
    if (!block.good()) return {};
    if (file_at.data()) return {from_file, name};
    if (inline_data.triangles.empty()) return fault("invalid mesh: it has no triangles");
    inline_data.points = std::move(points.points()), inline_data.normals = std::move(normals.points());
    for (const DVec3& place : places.points()) inline_data.places.push_back({place.x, place.y});
    return {std::make_shared<const MeshData>(std::move(inline_data)), ""};
}

Contour read_contour(BlockReader& reader, std::string_view word, Block& block) {
    Contour contour;
    Block own{word};
    reader.block(
        own, contour_words, [&] { reader.read(contour.start, coordinates, "start", own); },
        [&](std::string_view inner) {
            if (!contains(contour_words, inner)) return false;
            Contour::Stroke step;
            const bool curve = inner == contour_words[1];
            reader.read(curve ? step.control : step.end, coordinates, curve ? "control point" : "end", own);
            if (curve) {
                reader.lexer.accept(',');
                reader.read(step.end, coordinates, "end", own);
                if (reader.lexer.accept(',') || reader.lexer.at_value()) {
                    step.second = step.end;
                    reader.read(step.end, coordinates, "end", own);
                }
            } else {
                step.control = step.end;
            }
            contour.strokes.push_back(step);
            return true;
        });
    block.absorb(own);
    return contour;
}

std::string open_mesh_fault(const Mesh& mesh) {
    const auto side = open_side(*mesh.data);
    if (!side) return "";
    return "this mesh cannot be part of a body: it is open between " + text_of(side->first) + " and " +
           text_of(side->second);
}

}  // namespace strahl

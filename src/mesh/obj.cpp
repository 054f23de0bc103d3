// Reads OBJ: points, normals, places in a texture and faces, a line each. All other lines are about materials.
// tinyobjloader would read these too, but of 90,000 numbers with six decimals it reads 42,262 as not the nearest
// double, and it takes 'x' for 0, 1e400 for infinity and index 4294967299 for 3.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/source.h"

namespace strahl {
namespace {

constexpr std::int32_t none = -1;

/// Does a backslash join this line to the next?
bool continues(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line.ends_with('\\');
}

double largest(const DVec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

class ObjReader {
  public:
    explicit ObjReader(const Source& source) : source(source) {}

    MeshData read() {
        // Faces may name points that come after them.
        for_lines([&](std::string_view keyword, Words& words) {
            if (keyword == "v") read_point(words);
            if (keyword == "vn") mesh.normals.push_back(words.vector());
            if (keyword == "vt") read_place(words);
        });
        for_lines([&](std::string_view keyword, Words& words) {
            points += keyword == "v", normals += keyword == "vn", places += keyword == "vt";
            if (keyword == "f") read_face(words);
        });
        if (mesh.triangles.empty()) source.fail("there are no faces in this file; a mesh needs lines 'f'");
        if (smooth)
            give_normals();
        else
            mesh.corner_normals = std::vector<MeshData::Corners>();
        if (mesh.corner_places.empty())
            mesh.places = std::vector<MeshData::Place>();
        else
            give_places();
        return std::move(mesh);
    }

  private:
    template <class Read>
    void for_lines(Read read);
    void read_point(Words& words) {
        const DVec3 point = words.vector();
        if (const std::string fault = Source::fault(point); !fault.empty()) words.fail("this point " + fault);
        source.check_points(mesh.points.size() + 1);
        mesh.points.push_back(point);
    }
    void read_place(Words& words);
    void read_face(Words& words);
    void read_corner(std::string_view word, const Words& words);
    std::int32_t resolved(std::int64_t index, std::size_t all, std::size_t so_far, const char* noun,
                          const Words& words) const;
    void give_normals();
    void give_places();

    const Source& source;
    MeshData mesh;
    std::size_t points = 0, normals = 0, places = 0;  // so far, for negative indices
    bool smooth = false;
    std::vector<std::int32_t> corners, corner_normals, corner_places;  // of a face
    FaceSplitter splitter;
};

/// Calls `read` with the first word of each line and those that follow.
template <class Read>
void ObjReader::for_lines(Read read) {
    const std::string_view bytes = source.bytes;
    const char newline = bytes.find('\n') == bytes.npos ? '\r' : '\n';
    for (std::size_t start = 0; start < bytes.size();) {
        std::size_t end = std::min(bytes.find(newline, start), bytes.size());
        Words words(source, bytes.substr(start, end - start));
        const std::string_view keyword = words.next();
        if (keyword == "v" || keyword == "vn" || keyword == "vt" || keyword == "f") {
            while (end < bytes.size() && continues(bytes.substr(start, end - start)))
                end = std::min(bytes.find(newline, end + 1), bytes.size());
            words = Words(source, bytes.substr(start, end - start));
            read(words.next(), words);
        }
        start = end + 1;
    }
}

/// Reads one number or two; the third is for solid textures.
void ObjReader::read_place(Words& words) {
    const double u = words.number("a place in a texture");
    double v = 0;
    const std::string_view word = words.next();
    if (!word.empty() && word[0] != '#' && !read_number(word, v)) words.fail(quoted(word) + " is not a number");
    if (const std::string fault = Source::fault({u, v, 0}); !fault.empty()) words.fail("this place " + fault);
    source.check_points(mesh.places.size() + 1);
    mesh.places.push_back({u, v});
}

void ObjReader::read_face(Words& words) {
    corners.clear(), corner_normals.clear(), corner_places.clear();
    for (std::string_view word = words.next(); !word.empty() && word[0] != '#'; word = words.next())
        read_corner(word, words);
    const auto triangles = add_face(source, splitter, mesh, corners,
                                    [&](const std::string& message) { words.fail("this face" + message); });
    for (const auto& [a, b, c] : triangles)
        mesh.corner_normals.push_back({corner_normals[a], corner_normals[b], corner_normals[c]});
    if (triangles.empty() || (corner_places[0] == none && mesh.corner_places.empty())) return;
    mesh.corner_places.resize(mesh.triangles.size() - triangles.size(), {none, none, none});
    for (const auto& [a, b, c] : triangles)
        mesh.corner_places.push_back({corner_places[a], corner_places[b], corner_places[c]});
}

/// Reads a corner of a face: 1, 1/2, 1/2/3 or 1//3, numbers of a point, a place in a texture and a normal.
void ObjReader::read_corner(std::string_view word, const Words& words) {
    std::int64_t index[3]{};
    bool given_place = false;
    const char *at = word.data(), *const end = at + word.size();
    for (int i = 0; i < 3; ++i) {
        const auto [stop, fault] = std::from_chars(at, end, index[i]);
        const bool left_out = i == 1 && stop == at;
        given_place |= i == 1 && !left_out;
        if (fault != std::errc() && !left_out) break;
        at = stop;
        if (at == end || i == 2 || *at != '/') break;
        ++at;
    }
    if (at != end || word.back() == '/')
        words.fail(quoted(word) + " is not a corner of a face, which has the form 1, 1/2, 1//3 or 1/2/3");
    corners.push_back(resolved(index[0], mesh.points.size(), points, "point", words));
    const bool has_normal = std::count(word.begin(), word.end(), '/') == 2;
    if (corners.size() > 1 && has_normal != (corner_normals[0] != none))
        words.fail("this face has normals at some corners and none at others; give it all or none");
    corner_normals.push_back(has_normal ? resolved(index[2], mesh.normals.size(), normals, "normal", words) : none);
    smooth |= has_normal;
    const bool has_place = given_place && !mesh.places.empty();  // without places such numbers mean nothing
    if (corners.size() > 1 && has_place != (corner_places[0] != none))
        words.fail("this face has places in a texture at some corners and none at others; give it all or none");
    corner_places.push_back(has_place ? resolved(index[1], mesh.places.size(), places, "place", words) : none);
}

/// An index as one from 0. Indices count from 1, or back from the last that was given, which is -1.
std::int32_t ObjReader::resolved(std::int64_t index, std::size_t all, std::size_t so_far, const char* noun,
                                 const Words& words) const {
    if (index > 0 && static_cast<std::uint64_t>(index) <= all) return static_cast<std::int32_t>(index - 1);
    if (index < 0 && index >= -static_cast<std::int64_t>(so_far))
        return static_cast<std::int32_t>(static_cast<std::int64_t>(so_far) + index);
    words.fail("this face names " + std::string(noun) + " " + std::to_string(index) +
               (index < 0 ? ", and before it come " : "; the file has ") + counted(index < 0 ? so_far : all, noun) +
               (index == 0 ? ", counted from 1" : ""));
}

/// Gives faces without normals, among others that have some, the normal of their plane.
void ObjReader::give_normals() {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.corner_normals[i][0] != none) continue;
        const auto& [a, b, c] = mesh.triangles[i];
        const DVec3 u = mesh.points[b] - mesh.points[a], v = mesh.points[c] - mesh.points[a];
        const double size = largest(u) * largest(v);
        const DVec3 normal = size > 0 ? glm::cross(u / largest(u), v / largest(v)) : DVec3(0);
        // A sliver so thin that its normal is lost in rounding is only ever seen from the side.
        mesh.normals.push_back(largest(normal) > 0 ? normal : DVec3(0, 0, 1));
        const auto number = static_cast<std::int32_t>(mesh.normals.size() - 1);
        mesh.corner_normals[i] = {number, number, number};
    }
}

/// Puts corners without places, among others that have some, at the origin.
void ObjReader::give_places() {
    mesh.corner_places.resize(mesh.triangles.size(), {none, none, none});
    if (std::ranges::none_of(mesh.corner_places, [](const MeshData::Corners& corners) { return corners[0] == none; }))
        return;
    const auto origin = static_cast<std::int32_t>(mesh.places.size());
    mesh.places.push_back({0, 0});
    for (MeshData::Corners& corners : mesh.corner_places)
        if (corners[0] == none) corners = {origin, origin, origin};
}

}  // namespace

MeshData read_obj(const Source& source) { return ObjReader(source).read(); }

}  // namespace strahl

// Mesh files as strangers' programs write them: what is read of each, and the warnings about the rest.
#include <doctest/doctest.h>

#include <algorithm>

#include "mesh/read_mesh.h"
#include "tests/unit/faults.h"
#include "tests/unit/mesh/mesh_text.h"

namespace strahl::strange {
namespace {

using Corners = MeshData::Corners;
using Places = std::vector<MeshData::Place>;
using Told = std::vector<std::string>;

const std::string bom = "\xEF\xBB\xBF";

/// A mesh that was read, and the warnings, without the path in them.
struct MeshRead {
    MeshData mesh;
    Told told;
};
MeshRead reading(const std::string& name, const std::string& bytes) {
    const Scratch folder;
    const std::string path = put(folder, name, bytes);
    MeshRead result;
    result.mesh = read_mesh(path, {}, &result.told);
    for (std::string& warning : result.told) {
        REQUIRE(warning.starts_with(path + ": "));
        warning.erase(0, path.size() + 2);
    }
    return result;
}
std::string fault_in(const std::string& name, const std::string& bytes) {
    return fault_of([&] { reading(name, bytes); });
}
void refused(const std::string& name, const std::string& bytes, const std::string& message) {
    CAPTURE(bytes);
    const std::string fault = fault_in(name, bytes);
    CAPTURE(fault);
    CHECK(says(fault, message));
}

MeshData tetrahedron() {
    MeshData mesh;
    mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return mesh;
}
/// The file must be a tetrahedron, flat and without places.
void flat(const std::string& name, const std::string& bytes, const Told& told = {}) {
    CAPTURE(bytes);
    const MeshRead read = reading(name, bytes);
    CHECK(read.mesh == tetrahedron());
    CHECK(read.told == told);
}

/// Replaces all places of a piece in a text.
std::string with(std::string text, const std::string& piece, const std::string& other) {
    REQUIRE(text.find(piece) != text.npos);
    for (std::size_t at = text.find(piece); at != text.npos; at = text.find(piece, at + other.size()))
        text.replace(at, piece.size(), other);
    return text;
}
std::string wide(const std::string& text, const std::string& before, const std::string& after) {
    std::string result;
    for (const char c : text) result.append(before).append(1, c).append(after);
    return result;
}

const std::string points = "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\n", faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const std::string ply = ply_of(tetrahedron(), {});
std::string stl() {
    const MeshData mesh = tetrahedron();
    std::vector<std::array<DVec3, 3>> triangles;
    for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
    return ascii_stl(triangles);
}
std::string stl_in_bytes() {
    const MeshData mesh = tetrahedron();
    std::vector<std::array<DVec3, 3>> triangles;
    for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
    return binary_stl(triangles);
}
/// The file must be the tetrahedron in STL, where points are numbered as they come.
void flat_stl(const std::string& bytes, const Told& told = {}) {
    CAPTURE(bytes);
    static const MeshData expected = reading("a.stl", stl()).mesh;
    const MeshRead read = reading("a.stl", bytes);
    CHECK(read.mesh.points == expected.points);
    CHECK(read.mesh.triangles == expected.triangles);
    CHECK(read.told == told);
}

TEST_CASE("byte order marks are skipped, at the start and where files were joined") {
    flat("a.obj", bom + points + faces);
    flat("a.obj", bom + bom + points + bom + faces);
    flat("a.ply", bom + ply);
    flat("a", bom + ply);
    flat("a.ply", with(ply, "end_header\n", "end_header\n" + bom));
    flat("a.ply", bom + ply_of(tetrahedron(), {.format = "binary_big_endian"}));
    flat_stl(bom + stl());
    const MeshRead placed = reading("a.obj", bom + "vt .5 0\nvt 1 0\nvt 0 1\n" + points + "f 1/1 2/2 3/3\n");
    CHECK(placed.mesh.places == Places{{.5, 0}, {1, 0}, {0, 1}});
    CHECK(placed.mesh.corner_places == std::vector<Corners>{{0, 1, 2}});
}

TEST_CASE("texts in UTF-16 and UTF-32 are called so") {
    const std::string zero(1, '\0'), zeros(3, '\0');
    for (const auto& [name, text] :
         {std::pair{"a.obj", points + faces}, {"a.ply", ply}, {"a.stl", stl()}, {"a", ply}}) {
        const std::string little = wide(text, "", zero), big = wide(text, zero, "");
        for (const std::string& bytes : {"\xFF\xFE" + little, "\xFE\xFF" + big, little, big})
            refused(name, bytes, std::string(name) + ": this text is in UTF-16; save the file as UTF-8");
        refused(name, "\xFF\xFE" + std::string(2, '\0') + wide(text, "", zeros), "this text is in UTF-32");
        refused(name, std::string(2, '\0') + "\xFE\xFF" + wide(text, zeros, ""), "this text is in UTF-32");
        refused(name, wide(text, "", zeros), "this text is in UTF-32");
    }
}

TEST_CASE("OBJ: corners in all forms, with indices from either end") {
    for (const std::string ending : {"", "/", "//"})
        for (const bool negative : {false, true}) {
            std::string text = points;
            for (const auto& corners : tetrahedron().triangles) {
                text += "f";
                for (const int corner : corners)
                    text.append(" ").append(std::to_string(negative ? corner - 4 : corner + 1)).append(ending);
                text += "\n";
            }
            flat("a.obj", text);
        }
    const std::string others = points + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nvn 0 1 0\n";
    for (const char* const face : {"f 1/1/ 2/2/ 3/3/", "f -4/-3/ 2/-2 -2/3/", "f 1/1 2/2/ 3/3"}) {
        const MeshRead read = reading("a.obj", others + face + "\n");
        CHECK(read.mesh.corner_places == std::vector<Corners>{{0, 1, 2}});
        CHECK(read.mesh.corner_normals.empty());
        CHECK(read.told.empty());
    }
    const MeshRead mixed = reading("a.obj", others + "f 1/1/1 -3/-2/-1 3//2\n");
    CHECK(mixed.mesh.triangles == std::vector<Corners>{{0, 1, 2}});
    CHECK(mixed.mesh.corner_normals == std::vector<Corners>{{0, 1, 1}});
    CHECK(mixed.told == Told{"put 1 face at <0, 0> in pictures that lacked places at some corners (in line 10)"});
    for (const char* const corner :
         {"/", "//", "/1", "//1", "1///", "1/2/3/", "1/2/3/4", "1/x", "1//x", "1/1/x", "1.", "0x1"})
        refused("a.obj", others + "f 1 2 " + corner + "\n", "a.obj:10: '" + std::string(corner) + "' is not a corner");
    for (const char* const corner : {"0", "1/0", "1//0", "1/9", "1//9", "1/-4", "1//-3", "-5"})
        refused("a.obj", others + "f 1/1/1 2/1/1 " + corner + "\n", "a.obj:10: this face names ");
}

TEST_CASE("OBJ: normals and places that the file does not have") {
    flat("a.obj", points + "f 1//1 3//3 2//2\nf 1//1 2//2 4//4\nf 2//2 3//3 4//4\nf 1//1 4//4 3//3\n",
         {"left out the normals of 12 corners: the file has none (first in line 5)"});
    flat("a.obj", points + "f 1/-1/-1 3/3/3 2/2/2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n",
         {"left out the places of 3 corners in pictures: the file has none (first in line 5)",
          "left out the normals of 3 corners: the file has none (first in line 5)"});
}

TEST_CASE("OBJ and PLY: faces are flat whose normals are zero, not numbers or missing, and the others are smooth") {
    for (const char* const bad : {"0 0 0", "nan 0 1", "nan nan nan", "0 0 inf", "1e-200 0 0", "-nan(ind) 0 0"}) {
        CAPTURE(bad);
        const MeshRead read =
            reading("a.obj", points + "vn 0 0 1\nvn " + bad + "\nf 1//1 3//1 2//2\nf 1//1 2//1 4//1\n");
        CHECK(read.told == Told{"made 1 face flat with normals that are zero or not numbers (in line 7)"});
        CHECK(read.mesh.corner_normals == std::vector<Corners>{{2, 2, 2}, {0, 0, 0}});
        const DVec3 n = read.mesh.normals[2];
        CHECK((n.x == 0 && n.y == 0 && n.z < 0));
    }
    flat("a.obj", points + "vn nan 0 1\nf 1//1 3//1 2//1\nf 1//1 2//1 4//1\nf 2//1 3//1 4//1\nf 1//1 4//1 3//1\n",
         {"made 4 faces flat with normals that are zero or not numbers (first in line 6)"});
    const MeshRead some = reading("a.obj", points + "vn 0 0 1\nf 1//1 3 2\nf 1 2 4\nf 2//1 3//1 4//1\nf 1 4//1 3\n");
    CHECK(some.mesh.corner_normals == std::vector<Corners>{{1, 1, 1}, {2, 2, 2}, {0, 0, 0}, {3, 3, 3}});
    CHECK(some.told == Told{"made 2 faces flat that lacked normals at some corners (first in line 6)"});

    // A sliver whose normal is too short to be computed with.
    const MeshRead sliver =
        reading("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1e-200 0\nvn 1 0 0\nf 1//1 2//1 3\nf 1//1 2//1 3//1\n");
    CHECK(sliver.mesh.corner_normals == std::vector<Corners>{{1, 1, 1}, {0, 0, 0}});
    CHECK(sliver.mesh.normals[1] == DVec3(0, 0, 1));

    MeshData smooth = tetrahedron();
    smooth.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}};
    for (const char* const format : {"ascii", "binary_little_endian"}) {
        const MeshRead read = reading("a.ply", ply_of(smooth, {.format = format}));
        const std::string first = format[0] == 'a' ? "in line 18" : "face 1 (counted from 0)";
        CHECK(read.told == Told{"made 3 faces flat with normals that are zero or not numbers (first " + first + ")"});
        CHECK(read.mesh.corner_normals == std::vector<Corners>{{0, 2, 1}, {4, 4, 4}, {5, 5, 5}, {6, 6, 6}});
    }
}

TEST_CASE("OBJ and PLY: faces that lack places in a picture, or have some that are not numbers, are at the origin") {
    const std::string places = "vt .5 .25\nvt 1 0\nvt nan 1\n";
    const MeshRead obj = reading("a.obj", points + places + "f 1/1 3 2/2\nf 1/1 2/2 4/3\nf 2/1 3/2 4/2\nf 1 4 3\n");
    CHECK(obj.mesh.corner_places == std::vector<Corners>{{3, 3, 3}, {3, 3, 3}, {0, 1, 1}, {3, 3, 3}});
    CHECK(obj.mesh.places.back() == MeshData::Place{0, 0});
    CHECK(obj.told == Told{"put 2 faces at <0, 0> in pictures that lacked places at some corners (first in line 8)"});
    flat("a.obj", points + "vt nan 0\nf 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf 2/1 3/1 4/1\nf 1/1 4/1 3/1\n",
         {"put 4 faces at <0, 0> in pictures that lacked places at some corners (first in line 6)"});
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty float u\nproperty float v\nelement face 2\n"
        "property list uchar int vertex_index\nend_header\n";
    const MeshRead read =
        reading("a.ply", header + "0 0 0 .5 0\n2 0 0 1 0\n0 3 0 0 1\n0 0 4 nan 0\n3 0 2 1\n3 0 1 3\n");
    CHECK(read.mesh.corner_places == std::vector<Corners>{{0, 2, 1}, {4, 4, 4}});
    CHECK(read.mesh.places[1] == MeshData::Place{1, 0});
    CHECK(read.told == Told{"put 1 face at <0, 0> in pictures that lacked places at some corners (in line 17)"});
}

TEST_CASE("OBJ: lines go on after a backslash, with blanks behind it or not, but not after one in a comment") {
    for (const char* const joint : {"\\\n", "\\ \n", "\\\t \r\n", " \\ \r", "\\\r\n\\\r\n", "\\ \n \\ \n"}) {
        flat("a.obj", points + "f 1 3 " + joint + "2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
        flat("a.obj", "v 0 " + std::string(joint) + " 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\n" + faces);
    }
    flat("a.obj", points + "f 1 3 2 # a \\\nf 1 2 4 #\\ \nf 2 3 4 # C:\\\\\r\nf 1 4 3 \\");
    flat("a.obj", "# C:\\models\\\n" + points + "g C:\\parts\\\n" + faces);
    flat("a.obj", with(points + faces, "\n", "\r\n"));
    flat("a.obj", with(points + faces, "\n", "\r"));
    flat("a.obj", with(points, "\n", "\r") + faces);  // lines that end in different ways
    flat("a.obj", with(points, "\n", "\r\n") + with(faces, "\n", "\r"));
    flat("a.obj", points + faces + std::string(3, '\0'));
    flat("a.obj", points + faces + "\x1a");
    flat("a.obj", points + with(faces, "f", "fo"));
}

TEST_CASE("OBJ: what is left out is said, with the line of the first") {
    flat("a.obj", points + "f\nf 1 2\n" + faces + "f 1\n",
         {"skipped 3 faces of fewer than three corners (first in line 5)"});
    flat("a.obj", points + faces + "f 1 2 # a line\n", {"skipped 1 face of fewer than three corners (in line 9)"});
    flat("a.obj", "# x\nmtllib x.mtl\n" + points + "usemtl red\n" + faces,
         {"read no materials: the mesh has that of the scene; ignored 1 line 'mtllib' (in line 2)"});
    flat("a.obj", "v 0 0 0 1 .5 0\nv 2 0 0 1 .5 0 .25\nv 0 3 0 1\nv 0 0 4 # 1 2 3\n" + faces,
         {"ignored the colours of 2 points (first in line 1)"});
    flat("a.obj", points + faces + "l 1 2\np 1\nsurf 0 1 0 1 1 2 3 4\n", {"skipped 1 curved surface (in line 11)"});
}

TEST_CASE("PLY: elements in any order") {
    const std::string own_faces = "element face 4\nproperty list uchar int vertex_indices\n",
                      vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n",
                      more = "element edge 2\nproperty list uchar int ends\nproperty short x\n";
    const std::string face_values = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n",
                      point_values = "0 0 0\n2 0 0\n0 3 0\n0 0 4\n", more_values = "2 0 1 7\n0 -1\n";
    const std::string start = "ply\nformat ascii 1.0\n", end = "end_header\n";
    flat("a.ply", start + own_faces + vertices + end + face_values + point_values);
    flat("a.ply", start + own_faces + more + vertices + end + face_values + more_values + point_values);
    flat("a.ply", start + more + own_faces + vertices + end + more_values + face_values + point_values);
    flat("a.ply", start + vertices + more + own_faces + end + point_values + more_values + face_values);
    refused("a.ply", start + own_faces + end + face_values, "there are no vertices in this file");
    refused("a.ply", start + own_faces + vertices + end + with(face_values, "3 0 3 2", "3 0 4 2") + point_values,
            "a.ply:13: face 3 (counted from 0) names vertex 4; there are vertices 0 to 3");
    for (const std::string format : {"binary_little_endian", "binary_big_endian"}) {
        std::string bytes = with(start, "ascii", format) + own_faces + vertices + end;
        for (const auto& corners : tetrahedron().triangles) {
            put_value(bytes, 3, "uchar", format);
            for (const int corner : corners) put_value(bytes, corner, "int", format);
        }
        for (const DVec3& point : tetrahedron().points)
            for (int c = 0; c < 3; ++c) put_value(bytes, point[c], "float", format);
        flat("a.ply", bytes);
    }
}

TEST_CASE("PLY: strips of triangles, of which every second is turned, and -1 between them") {
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nelement tristrips 2\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";
    const MeshRead read = reading("a.ply", header + "11 0 1 2 3 -1 -1 1 2 0 4 -1\n3 4 3 2\n");
    CHECK(read.mesh.triangles == std::vector<Corners>{{0, 1, 2}, {2, 1, 3}, {1, 2, 0}, {0, 2, 4}, {4, 3, 2}});
    CHECK(read.told.empty());
    CHECK(reading("a.ply", header + "6 0 1 -1 2 3 4\n0\n").mesh.triangles == std::vector<Corners>{{2, 3, 4}});
    refused("a.ply", header + "4 0 1 2 -2\n0\n", "tristrips 0 (counted from 0) names vertex -2");
    refused("a.ply", header + "2 0 1\n1 -1\n", "three different corners");
}

TEST_CASE("PLY: places that belong to the corners of faces") {
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
        "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const std::string values = "3 0 1 2 6 0 0 1 0 1 .5\n4 0 2 3 1 8 0 0 1 1 0 1 .25 0\n";
    const Places places{{0, 0}, {1, 0}, {1, .5}, {0, 0}, {1, 1}, {0, 1}, {.25, 0}};
    const MeshRead read = reading("a.ply", header + values);
    CHECK(read.mesh.triangles.size() == 3);
    CHECK(read.mesh.places == places);
    CHECK(read.mesh.corner_places[0] == Corners{0, 1, 2});
    CHECK(read.mesh.corner_places[1][0] >= 3);
    CHECK(read.told.empty());
    // The list may come first, and take the place of those of the vertices.
    const std::string first = with(with(header, "property list uchar float texcoord\n", ""), "face 2\n",
                                   "face 2\nproperty list uchar float texcoord\n");
    CHECK(reading("a.ply", first + "6 0 0 1 0 1 .5 3 0 1 2\n8 0 0 1 1 0 1 .25 0 4 0 2 3 1\n").mesh == read.mesh);
    const MeshRead some = reading("a.ply", header + "3 0 1 2 0\n3 0 2 3 6 0 0 1 0 1 .5\n");
    CHECK(some.mesh.corner_places == std::vector<Corners>{{3, 3, 3}, {0, 1, 2}});
    CHECK(some.told.empty());
    const MeshRead odd = reading("a.ply", header + "3 0 1 2 7 0 0 1 0 1 .5 9\n3 0 2 3 4 0 0 1 0\n");
    CHECK(odd.mesh.corner_places == std::vector<Corners>{{0, 1, 2}, {3, 3, 3}});
    CHECK(odd.told ==
          Told{"left out the places of 1 face in pictures, which are not as many as its corners (in line 16)"});
}

TEST_CASE("PLY: first lines with blanks, lines that end in different ways, and unknown lines") {
    for (const char* const first : {"ply \n", "ply\t\r\n", "ply  \r", "ply\r\n", "ply\r"})
        flat("a", first + ply.substr(4));
    flat("a.ply", with(ply, "float z\n", "float z\r\n"));
    const std::string binary = ply_of(tetrahedron(), {.format = "binary_little_endian"});
    const std::size_t start = binary.find("end_header");
    for (const char* const ending : {"\n", "\r\n", "\r"}) {
        const std::string header = with(binary.substr(0, start), "\n", ending),
                          end = std::string("end_header") + ending;
        flat("a.ply", header + end + binary.substr(start + 11));
        if (ending[0] == '\n') flat("a.ply", header + "end_header\r\n" + binary.substr(start + 11));
        flat("a.ply",
             with(header, "ply" + std::string(ending), "ply \r\n") + "end_header\n" + binary.substr(start + 11));
    }
    flat("a.ply", with(ply, "element face", "made_by hand\nelement face"),
         {"ignored 1 line of the header that begins with no word of the PLY format (in line 7)"});
    flat("a.ply", with(ply, "end_header\n", "end_header\n\n") + "\n\n");
    refused("a.ply", with(ply, "ply\n", "ply 1\n"), "its first line is not 'ply'");
}

TEST_CASE("PLY: values that the header does not announce, and colours") {
    flat("a.ply", with(with(ply, "0 3 0 \n", "0 3 0 255 0 0\n"), "3 1 2 3 \n", "3 1 2 3 7\n"),
         {"ignored what follows the values of 2 elements in its line (first in line 12)"});
    const std::string coloured = with(ply, "property float z\n", "property float z\nproperty uchar red\n");
    flat("a.ply",
         with(with(with(with(coloured, "0 0 0 \n", "0 0 0 9\n"), "2 0 0 \n", "2 0 0 9\n"), "0 3 0 \n", "0 3 0 9\n"),
              "0 0 4 \n", "0 0 4 9\n"),
         {"ignored the colours of 4 elements (in line 7)"});
    refused("a.ply", with(ply, " \n", " "), "vertex 1 (counted from 0) end too early");
}

TEST_CASE("STL: text is recognised by its words, in capitals and after blanks") {
    flat_stl(" \t\n" + stl());
    std::string capitals = stl();
    std::transform(capitals.begin(), capitals.end(), capitals.begin(), [](char c) { return std::toupper(c); });
    flat_stl(capitals);
    flat_stl(bom + " " + capitals);
    flat_stl("# made by hand\n; and more\n// of it\n" + stl());
    flat_stl(with(stl(), "endfacet", "endfacet ; one\n# two"));
    flat_stl(with(stl(), "endsolid", "end solid"));
    flat_stl(with(with(stl(), "endloop", "end loop"), "endfacet", "End\tFacet"));
    flat_stl(with(stl(), "normal 0 0 nan", "normal"));
    flat_stl(with(stl(), "normal 0 0 nan", "normal -1.#IND 0 0"));
    flat_stl(with(stl(), "\n", "\r"));
    flat_stl(stl() + std::string(5, '\0') + "\x1a\n");
    flat_stl(with(stl(), "\n", " \\\n"));
}

TEST_CASE("STL: what is wrong with a text is said about the text") {
    refused("a.stl", with(stl(), "endsolid", ""), "the file ends where 'facet' or 'endsolid' should be");
    refused("a.stl", with(stl(), "endloop", "vertex 1 1 1 endloop"), "a.stl:7: expected 'endloop', found 'vertex'");
    refused("a.stl", "hello\n" + stl(), "a.stl:1: expected 'solid', found 'hello'");
    refused("a.stl", with(stl(), "outer", "inner"), "a.stl:3: expected 'outer', found 'inner'");
    refused("a.stl", stl().substr(0, 60), "a.stl:4: the file ends where");
    refused("a.stl", "solid a\nend", "a.stl:2: expected 'facet' or 'endsolid', found 'end'");
    refused("a.stl", " ", "the file ends where 'solid' should be");
}

TEST_CASE("STL: binary files with bytes behind them, and with other numbers of triangles") {
    const std::string bytes = stl_in_bytes();
    const auto announcing = [&](const char* number) { return std::string(bytes).replace(80, 4, number, 4); };
    flat_stl(bytes + "ab", {"ignored 2 bytes after the triangles that the header announces (from byte 284 on)"});
    const std::string solid = std::string(bytes).replace(0, 5, "solid");
    flat_stl(solid);
    flat_stl(solid + "\n", {"ignored 1 byte after the triangles that the header announces (from byte 284 on)"});
    const Told counted{"read 4 triangles, as many as fit into the file: its header announces another number (byte 80)"};
    flat_stl(announcing("\0\0\0\0"), counted);
    flat_stl(announcing("\xff\xff\xff\xff"), counted);
    refused("a.stl", announcing("\5\0\0\0"), "284 bytes, and its header announces 5 triangles");
    refused("a.stl", announcing("\0\0\0\0") + "x", "285 bytes, and its header announces 0 triangles");
    flat_stl(std::string(bytes).replace(20, 10, "COLOR=abcd"),
             {"ignored the colours of 4 triangles (by 'COLOR=' at its start)"});
}

}  // namespace
}  // namespace strahl::strange

// Meshes from PLY, OBJ and STL files that are as they should be.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <glm/geometric.hpp>
#include <vector>

#include "mesh/read_mesh.h"
#include "tests/unit/mesh/mesh_text.h"

namespace strahl {
namespace {

using Corners = MeshData::Corners;

/// A pyramid of four points.
MeshData pyramid() {
    MeshData mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {.1, .25, 3}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return mesh;
}
MeshData smooth_pyramid() {
    MeshData mesh = pyramid();
    mesh.normals = {{-1, -1, -1}, {1, 0, 0}, {0, 2, 0}, {0, 0, .5}};
    mesh.corner_normals = mesh.triangles;
    return mesh;
}

MeshData read(const std::string& name, const std::string& bytes) {
    const Scratch folder;
    return read_mesh(put(folder, name, bytes));
}

TEST_CASE("PLY: all forms are read, with normals and without") {
    for (const MeshData& mesh : {pyramid(), smooth_pyramid()})
        for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
            for (const char* index : {"uchar", "ushort", "int", "uint32", "int8", "float"}) {
                CAPTURE(format);
                CAPTURE(index);
                CHECK(read("a.ply", ply_of(mesh, {.format = format, .number = "double", .index = index})) == mesh);
            }
}

TEST_CASE("PLY: floats are the numbers that they are, and text is the nearest double") {
    MeshData mesh = pyramid();
    CHECK(read("a.ply", ply_of(mesh, {.format = "ascii", .number = "float"})) == mesh);
    mesh.points[3].x = static_cast<double>(.1f);
    CHECK(read("a.ply", ply_of(pyramid(), {.format = "binary_big_endian", .number = "float"})) == mesh);
}

TEST_CASE("PLY: what is not needed is skipped, and lines may end in any way") {
    const std::string text =
        "ply\nformat ascii 1.0\ncomment made by hand\nelement camera 1\nproperty float view\n"
        "property list uchar int numbers\nelement nothing 1000000000000\nelement vertex 4\nproperty uchar red\n"
        "property float32 z\nproperty float x\nproperty list uchar float weights\nproperty double y\n"
        "obj_info none\nelement face 2\nproperty list uchar uchar colours\nproperty list uchar int vertex_index\n"
        "property int part\nelement edge 1\nproperty int a\nproperty int b\nend_header\n"
        "7 2 5 6\n255 0 0 0 0\n9 0 1 2 .5 .5 0\n0 0 0 0 2\n1 3 .1 0 .25\n"
        "1 9 3 0 2 1 4\n0 3 0 1 3 5\n0 1\n";
    MeshData mesh = pyramid();
    mesh.triangles.resize(2);
    CHECK(read("a.ply", text) == mesh);
    for (const std::string ending : {"\r\n", "\r"}) {
        std::string changed;
        for (const char c : text) changed += c == '\n' ? ending : std::string(1, c);
        CHECK(read("a.ply", changed) == mesh);
    }
}

TEST_CASE("PLY: after a lone carriage return, values may begin with the byte of a line feed") {
    std::string bytes = ply_of(pyramid(), {.format = "binary_little_endian", .number = "float"});
    const std::size_t start = bytes.find("end_header\n") + 11;
    std::replace(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(start), '\n', '\r');
    bytes[start] = '\n';
    CHECK(read("a.ply", bytes).points[0].x == std::bit_cast<float>(std::uint32_t('\n')));
}

TEST_CASE("OBJ: indices from either end, with normals of their own") {
    const std::string points = "v 0 0 0\nv 1 0 0 1\n\tv 0 2 0\r\nv +.1 .25 3e0 0 0 0\n";
    const std::string rest = "g top\nusemtl x\nf 1 3 2\nf -4/1 2/-1 -1/7\nf 2 \\\n 3\\\r\n 4 # end\nf 3 1 4\nl 1 2\n";
    CHECK(read("a.obj", "# made \\\nmtllib x.mtl\n" + points + "s off\n" + rest) == pyramid());
    CHECK(read("A.OBJ", rest.substr(0, rest.find("-4")) + "1 2 4\nf 2 3 4\nf 3 1 4\n" + points) == pyramid());
    std::string old = points + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4";
    std::replace(old.begin(), old.end(), '\n', '\r');
    CHECK(read("a.obj", old) == pyramid());

    MeshData mesh = pyramid();
    mesh.normals = {{0, 0, -1}, {0, 3, 0}, {0, -1, 0}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
    mesh.corner_normals = {{0, 0, 0}, {1, 2, 1}};
    CHECK(read("a.obj", points + "vn 0 0 -1\nvn 0 3 0\nvn 0 -1 0\nf 1//1 3/9/1 2/9/-3\nf 1//2 2//-1 4//2\n") == mesh);
    mesh.corner_normals[0] = {3, 3, 3};
    const MeshData mixed = read("a.obj", points + "vn 0 0 -1\nvn 0 3 0\nvn 0 -1 0\nf 1 3 2\nf 1//2 2//-1 4//2\n");
    CHECK(mixed.corner_normals == mesh.corner_normals);
    CHECK(mixed.normals[3].x == 0);
    CHECK(mixed.normals[3].y == 0);
    CHECK(mixed.normals[3].z < 0);
}

TEST_CASE("places in a picture") {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv .1 .25 3\n", places = "vt .5 .25\nvt 1 # u\nvt -2 3 4\n";
    using Corners = MeshData::Corners;
    const MeshData obj = read("a.obj", points + places + "vt 7 7\nf 1/2 2/1 3/-2\nf 1/4 3/4 2/1 4/1\n");
    CHECK(obj.places == std::vector<MeshData::Place>{{.5, .25}, {1, 0}, {-2, 3}, {7, 7}});
    CHECK(obj.corner_places == std::vector<Corners>{{1, 0, 2}, {3, 3, 0}, {3, 0, 0}});
    CHECK(obj.place_numbers() == obj.corner_places.data());
    // A triangle without area is dropped, and its places with it; faces without places have those at the origin.
    const MeshData mixed =
        read("a.obj", points + places + "f 1 2 3\nf 1/1 1/1 2/2\nf 1//1 2//1 4//1\nf 2/1 3/2 4/3\nvn 0 0 1\n");
    CHECK(mixed.corner_places == std::vector<Corners>{{3, 3, 3}, {3, 3, 3}, {0, 1, 2}});
    CHECK(mixed.places[3] == MeshData::Place{0, 0});
    CHECK(read("a.obj", points + places + "f 1 2 3\n").place_numbers() == nullptr);
    const auto fault = [&](const std::string& text, const std::string& said) {
        CHECK_THROWS_WITH_AS(read("a.obj", points + text), doctest::Contains(said.c_str()), FileError);
    };
    fault(places + "f 1/1 2/2 3/4\n", "this face names place 4; the file has 3 places");
    fault("vt\nf 1 2 3\n", "a place in a texture");
    fault("vt 1 x\nf 1 2 3\n", "'x' is not a number");
    fault("vt 1e20 0\nf 1 2 3\n", "this place lies at");

    for (const char* const names : {"u v", "s t", "texture_u texture_v"}) {
        const std::string first(names, std::strchr(names, ' ')), second(std::strchr(names, ' ') + 1);
        const std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float " + second +
                                   "\nproperty float x\nproperty float y\nproperty float z\nproperty float " + first +
                                   "\nelement face 1\nproperty list uchar int vertex_index\nend_header\n";
        const MeshData ply = read("a.ply", header + ".25 0 0 0 .5\n0 1 0 0 1\n3 0 2 0 -2\n3 0 1 2\n");
        CHECK(ply.places == std::vector<MeshData::Place>{{.5, .25}, {1, 0}, {-2, 3}});
        CHECK(ply.place_numbers() == ply.triangles.data());
        CHECK_THROWS_WITH_AS(read("a.ply", header + ".25 0 0 0 .5\n0 1 0 0 1e99\n3 0 2 0 -2\n3 0 1 2\n"),
                             doctest::Contains("in a picture, vertex 1 (counted from 0) lies at"), FileError);
    }
    CHECK(read("a.ply", ply_of(pyramid(), {})).place_numbers() == nullptr);
}

TEST_CASE("STL: equal corners become one point, -0 as 0, in text and in binary") {
    std::vector<std::array<DVec3, 3>> triangles{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                                {{{0, 1, 0}, {1, 0, -0.}, {1, 1, 0}}},
                                                {{{-0., 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
    MeshData mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {2, 1, 3}, {0, 2, 4}};
    const std::string binary = binary_stl(triangles);
    CHECK(read("a.stl", binary) == mesh);
    CHECK(read("without an ending", binary) == mesh);
    std::string solid = binary;
    solid.replace(0, 5, "solid");
    CHECK(read("a.stl", solid) == mesh);
    std::string text = ascii_stl(triangles);
    CHECK(read("a.stl", text) == mesh);
    std::transform(text.begin() + 5, text.end(), text.begin() + 5, [](char c) { return std::toupper(c); });
    CHECK(read("a", text) == mesh);
    const std::size_t third = text.rfind("FACET NORMAL");  // a file of two bodies
    CHECK(read("a", text.substr(0, third) + "endsolid a b c\nsolid\n" + text.substr(third)) == mesh);
    CHECK(std::signbit(read("a.stl", binary_stl({{{{-0., 0, 0}, {0, 1, 0}, {0, 0, 1}}}})).points[0].x) == false);
}

TEST_CASE("many points are joined as few are") {
    constexpr int side = 200;
    std::vector<std::array<DVec3, 3>> triangles;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y) triangles.push_back({{{x, y, 0}, {x + 1, y, 0}, {x, y + 1, 0}}});
    const MeshData mesh = read("a.stl", binary_stl(triangles));
    CHECK(mesh.points.size() == (side + 1) * (side + 1) - 1);
    bool same = mesh.triangles.size() == triangles.size();
    for (std::size_t i = 0; same && i < triangles.size(); ++i)
        for (int c = 0; c < 3; ++c) same &= mesh.points[mesh.triangles[i][c]] == triangles[i][c];
    CHECK(same);
}

TEST_CASE("triangles without three different corners are left out, and slivers stay") {
    const MeshData mesh = read("a.obj",
                               "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 0 -0\nv 1 1e-300 0\nvn 0 0 1\nvn 0 0 2\nvn 0 0 0\n"
                               "f 1//3 2//3 4//3\nf 1//1 2//1 1//1\nf 1 2\nf\nf 1//1 2//1 3//1\nf 1//2 2//2 5//2\n");
    CHECK(mesh.triangles == std::vector<Corners>{{0, 1, 2}, {0, 1, 4}});
    CHECK(mesh.corner_normals == std::vector<Corners>{{0, 0, 0}, {1, 1, 1}});
}

/// Twice the area of all triangles, seen along z; each must be turned as the face is.
double area(const MeshData& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const DVec3 u = mesh.points[b] - mesh.points[a], v = mesh.points[c] - mesh.points[a];
        const double part = u.x * v.y - u.y * v.x;
        CHECK(part >= 0);
        sum += part;
    }
    return sum;
}

/// An OBJ file of one face.
std::string face(const std::vector<DVec3>& points) {
    std::string text, corners = "f";
    for (const DVec3& p : points) {
        text += "v " + text_of(p.x) + " " + text_of(p.y) + " " + text_of(p.z) + "\n";
        corners += " -" + std::to_string(points.size() - static_cast<std::size_t>(&p - points.data()));
    }
    return text + corners + "\n";
}

TEST_CASE("faces of many corners are split, concave ones along their ears") {
    CHECK(read("a.obj", face({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}})).triangles ==
          std::vector<Corners>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
    CHECK(area(read("a.obj", face({{0, 0, 0}, {4, 1, 0}, {0, 2, 0}, {1, 1, 0}}))) == 6);   // an arrow's head
    CHECK(area(read("a.obj", face({{1, 1, 5}, {0, 0, 2}, {4, 1, 7}, {0, 2, 1}}))) == 6);   // leaning
    const std::vector<DVec3> hole{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},   // a square hole,
                                  {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};  // cut open
    CHECK(area(read("a.obj", face(hole))) == 24);
    for (const int teeth : {3, 40, 250, 499}) {  // a comb
        std::vector<DVec3> comb{{2. * teeth, -1, 0}};
        for (int i = 2 * teeth; i-- > 0;) comb.push_back({double(i), i % 2 ? 10. : 0., 0});
        comb.push_back({0, -1, 0});
        CAPTURE(teeth);
        const MeshData mesh = read("a.obj", face(comb));
        CHECK(mesh.triangles.size() == comb.size() - 2);
        double expected = 0;  // by the shoelace formula
        for (std::size_t i = 0; i < comb.size(); ++i) {
            const DVec3 &p = comb[i], &q = comb[(i + 1) % comb.size()];
            expected += p.x * q.y - q.x * p.y;
        }
        CHECK(area(mesh) == expected);
    }
    CHECK(read("a.obj", face({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {-3, .5, 1}})).triangles.size() ==
          3);  // crosses itself
}

TEST_CASE("concave faces are split rightly whichever way they look") {
    for (const int axis : {0, 1, 2})
        for (const bool reversed : {false, true}) {
            CAPTURE(axis);
            CAPTURE(reversed);
            std::vector<DVec3> points;
            for (const auto& [x, y] : {std::pair{0, 0}, {4, 1}, {0, 2}, {1, 1}}) {
                DVec3 point{5, 5, 5};
                point[(axis + 1) % 3] = x, point[(axis + 2) % 3] = y;
                points.push_back(point);
            }
            if (reversed) std::reverse(points.begin(), points.end());
            const MeshData mesh = read("a.obj", face(points));
            double sum = 0;
            for (const auto& [a, b, c] : mesh.triangles) {
                const DVec3 normal = glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
                const double part = reversed ? -normal[axis] : normal[axis];
                CHECK(part > 0);
                sum += part;
            }
            CHECK(sum == 6);
        }
}

TEST_CASE("the time that a million triangles take" * doctest::skip()) {
    const Scratch folder;
    const MeshData torus = large_torus(500, 1000);
    std::vector<std::array<DVec3, 3>> triangles;
    for (const auto& [a, b, c] : torus.triangles)
        triangles.push_back({torus.points[a], torus.points[b], torus.points[c]});
    MeshData smooth = torus;
    smooth.normals = smooth.points, smooth.corner_normals = smooth.triangles;
    const auto time = [&](const char* name, const std::string& bytes) {
        const std::string path = put(folder, name, bytes);
        std::vector<double> seconds;
        for (int i = 0; i < 7; ++i) {
            const std::clock_t start = std::clock();
            CHECK(read_mesh(path).triangles.size() == torus.triangles.size());
            seconds.push_back(double(std::clock() - start) / CLOCKS_PER_SEC);
        }
        std::sort(seconds.begin(), seconds.end());
        std::printf("%-18s %5.1f MB: %.3f s of processor time, the median of %zu\n", name, double(bytes.size()) / 1e6,
                    seconds[seconds.size() / 2], seconds.size());
    };
    time("little_endian.ply", ply_of(torus, {.format = "binary_little_endian", .number = "float"}));
    time("big_endian.ply", ply_of(torus, {.format = "binary_big_endian", .number = "float"}));
    time("normals.ply", ply_of(smooth, {.format = "binary_little_endian", .number = "float"}));
    time("ascii.ply", ply_of(torus, {.format = "ascii", .number = "float"}));
    time("flat.obj", obj_of(torus));
    time("smooth.obj", obj_of(smooth));
    time("binary.stl", binary_stl(triangles));
    time("ascii.stl", ascii_stl(triangles));
}

}  // namespace
}  // namespace strahl

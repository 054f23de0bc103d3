// Mesh files that are broken, or made to harm programs that read them.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <ctime>

#include "files/words.h"
#include "mesh/read_mesh.h"
#include "tests/unit/faults.h"
#include "tests/unit/mesh/mesh_text.h"

namespace strahl {
namespace {

std::string fault_at(const std::string& path, const MeshLimits& limits = {}) {
    return fault_of([&] { read_mesh(path, limits); });
}
std::string fault_in(const std::string& name, const std::string& bytes, const MeshLimits& limits = {}) {
    const Scratch folder;
    return fault_at(put(folder, name, bytes), limits);
}

/// doctest shows both sides if the text does not contain the part.
struct Says {
    std::string part;
    bool operator==(const std::string& text) const { return text.find(part) != std::string::npos; }
    friend bool operator==(const std::string& text, const Says& says) { return says == text; }
    friend std::ostream& operator<<(std::ostream& out, const Says& says) { return out << says.part; }
};

MeshData triangle() {
    MeshData mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

const std::vector<std::string> formats{"ascii", "binary_little_endian", "binary_big_endian"};

/// A PLY file of one triangle in text, with a piece of it replaced.
std::string changed(const std::string& piece, const std::string& replacement) {
    std::string bytes = ply_of(triangle(), {});
    const std::size_t at = bytes.find(piece);
    REQUIRE(at != bytes.npos);
    return bytes.replace(at, piece.size(), replacement);
}

TEST_CASE("what cannot be opened, is not a file or is not a mesh") {
    const Scratch folder;
    CHECK(fault_at(folder / "none.ply") == Says{"there is no such file"});
    CHECK(fault_at(folder / "") == Says{"it is a folder"});
    CHECK(fault_at("/dev/zero") == Says{"it is not a regular file"});
    REQUIRE(::mkfifo((folder / "pipe.ply").c_str(), 0600) == 0);
    CHECK(fault_at(folder / "pipe.ply") == Says{"it is not a regular file"});
    for (const char* name : {"a.ply", "a.obj", "a.stl", "a"}) CHECK(fault_in(name, "") == Says{"it is empty"});
    for (const char* bytes : {"x", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "\x1f\x8b\x08", "plymouth"})
        CHECK(fault_in("a.txt", bytes) == Says{"a.txt: not a mesh: it is neither"});
    CHECK(fault_in("a.ply", "x") == Says{"its first line is not 'ply'"});
    CHECK(fault_in("a.ply", std::string(5000, '\0'), {.most_bytes = 4999}) == Says{"larger than 4999 bytes"});
    CHECK(fault_in("a.ply", "ply") == Says{"its first line is not 'ply'"});
}

TEST_CASE("every file that is cut off is reported as such") {
    const std::vector<std::array<DVec3, 3>> one{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    std::vector<std::pair<std::string, std::string>> files{{"a.stl", binary_stl(one)}, {"a.stl", ascii_stl(one)}};
    for (const std::string& format : formats) files.push_back({"a.ply", ply_of(triangle(), {.format = format})});
    for (const auto& [name, bytes] : files) {
        CHECK(fault_in(name, bytes) == "");
        // The last number of a text, and its last word, may be shortened without anybody's noticing.
        const std::size_t ending = bytes.back() == '\n' ? bytes.find_last_not_of(" \n") : bytes.size();
        for (std::size_t size = 4; size < ending; ++size)
            if (const std::string fault = fault_in(name, bytes.substr(0, size)); fault.empty())
                FAIL_CHECK(bytes << " cut off after " << size << " bytes is read");
    }
    const std::string ply = ply_of(triangle(), {.format = "binary_big_endian"});
    CHECK(fault_in("a.ply", ply.substr(0, ply.size() - 1)) ==
          Says{"face 0 (counted from 0) has a list of 3 entries, but the rest of the file has room for at most 2"});
    CHECK(fault_in("a.ply", ply.substr(0, 30)) == Says{"no end ('end_header')"});
    CHECK(fault_in("a.stl", ascii_stl(one).substr(0, ascii_stl(one).find("vertex") + 10)) ==
          Says{"a.stl:4: the file ends where a coordinate"});
    CHECK(fault_in("a.stl", binary_stl(one).substr(0, 100)) == Says{"100 bytes, and its header announces 1 triangle"});
    for (const std::string& format : formats)
        CHECK(fault_in("a.ply", ply_of(triangle(), {.format = format}) + "1") == Says{"goes on after all"});
    CHECK(fault_in("a.stl", ascii_stl(one) + "facet") == Says{"expected another 'solid' or the end, found"});
}

TEST_CASE("words that are not numbers, and numbers that are too large") {
    for (const char* word : {"x", "1x", "0x1", "1,5", "1e400", "--1", "+-1", "1e", "'", "\x80", "1_0"}) {
        CAPTURE(word);
        const std::string shown = quoted(word);
        CHECK(fault_in("a.ply", changed("0 1 0", std::string("0 ") + word + " 0")) == Says{":12: " + shown});
        CHECK(fault_in("a.obj", std::string("\nv 0 ") + word + " 1") == Says{"a.obj:2: " + shown});
        CHECK(fault_in("a.stl", std::string("solid\nfacet normal 0 0 0 outer loop vertex 0 ") + word) ==
              Says{"a.stl:2: " + shown});
    }
    CHECK(fault_in("a.ply", changed("0 1 0", "0 1")) ==
          Says{"a.ply:12: the values of vertex 2 (counted from 0) end too"});
    for (const char* word : {"nan", "inf", "-inf", "1.0000001e9", "-1e10", "1e308"}) {
        CAPTURE(word);
        CHECK(fault_in("a.ply", changed("0 1 0", std::string("0 ") + word + " 0")) ==
              Says{":12: vertex 2 (counted from 0) lies at <0, "});
        CHECK(fault_in("a.obj", std::string("v 0 ") + word + " 1") == Says{"a.obj:1: this point lies at <0, "});
        const double value = std::strtod(word, nullptr);
        CHECK(fault_in("a.stl", binary_stl({{{{0, 0, 0}, {1, 0, 0}, {0, 1, value}}}})) ==
              Says{"a corner of triangle 0 (counted from 0) lies at <0, 1, "});
        MeshData mesh = triangle();
        mesh.points[1].z = value;
        for (const char* number : {"float", "double"})
            CHECK(fault_in("a.ply", ply_of(mesh, {"binary_big_endian", number})) == Says{"vertex 1 (counted from 0)"});
    }
    CHECK(fault_in("a.ply", changed("0 1 0", "0 1e9 0")) == "");
    CHECK(fault_in("a.obj", "v 0 0\nv 1 0 0") == Says{"a.obj:1: this line ends where a coordinate should be"});
}

TEST_CASE("indices out of range") {
    for (const char* index : {"3", "-1", "0.5", "4294967296", "1e300", "nan", "-inf"}) {
        CAPTURE(index);
        CHECK(fault_in("a.ply", changed("3 0 1 2", std::string("3 0 ") + index + " 2")) ==
              Says{std::string(":13: face 0 (counted from 0) names vertex ") + (index[0] == '1' ? "1e" : index)});
    }
    MeshData mesh = triangle();
    mesh.triangles[0][2] = 255;
    for (const char* type : {"uchar", "int8", "int", "float"})
        CHECK(fault_in("a.ply", ply_of(mesh, {"binary_little_endian", "float", type})) ==
              Says{"there are vertices 0 to 2"});
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
    CHECK(fault_in("a.obj", points + "f 1 2 4") == Says{"a.obj:5: this face names point 4; the file has 3 points"});
    CHECK(fault_in("a.obj", points + "f 1 2 0") == Says{"names point 0; the file has 3 points, counted from 1"});
    CHECK(fault_in("a.obj", points + "f 1 2 -4\nv 1 1 1") == Says{"point -4, and before it come 3 points"});
    CHECK(fault_in("a.obj", points + "f 1//1 2//1 3//2") == Says{"names normal 2; the file has 1 normal"});
    CHECK(fault_in("a.obj", points + "f 1//1 2//1 3//-2") == Says{"normal -2, and before it come 1 normal"});
    for (const char* corner : {"3z", "/3", "3/x/1", "3/1/1/1", "x", "1.5", "99999999999999999999"}) {
        CAPTURE(corner);
        CHECK(fault_in("a.obj", points + "f 1 2 " + corner) == Says{std::string("'") + corner + "' is not a corner"});
    }
}

TEST_CASE("files without faces, or without any that has a surface") {
    CHECK(fault_in("a.obj", "v 0 0 0\nv 1 0 0\n") == Says{"there are no faces"});
    CHECK(fault_in("a.obj", "v 0 0 0\nv 0 0 -0\nv 0 1 0\nf 1 2 3\n") == Says{"three different corners"});
    CHECK(fault_in("a.stl", binary_stl({})) == Says{"three different corners"});
    CHECK(fault_in("a.stl", ascii_stl({})) == Says{"three different corners"});
    const std::string points =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\n";
    CHECK(fault_in("a.ply", points + "end_header\n0 0 0\n") == Says{"there are no faces"});
    CHECK(fault_in("a.ply", points + "element face 1\nproperty int a\nend_header\n0 0 0\n0\n") == Says{"one list"});
    CHECK(fault_in("a.ply", changed("property float x\n", "")) == Says{"lack one of x, y and z"});
    CHECK(
        fault_in("a.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_index\nend_header\n0") ==
        Says{"there are no vertices"});
}

TEST_CASE("headers of PLY files that make no sense") {
    const auto fault = [](const std::string& piece, const std::string& other) {
        return fault_in("a.ply", changed(piece, other));
    };
    CHECK(fault("format ascii 1.0\n", "") == Says{"no line 'format'"});
    CHECK(fault("ascii", "asci") == Says{"a.ply:2: the format should be"});
    CHECK(fault("element vertex 3\n", "") == Says{"a.ply:3: this property belongs to no element"});
    CHECK(fault("vertex 3", "vertex -3") == Says{"a.ply:3: an element has a name and a count"});
    CHECK(fault("vertex 3", "vertex") == Says{"an element has a name and a count"});
    CHECK(fault("float x", "half x") == Says{"a.ply:4: 'half' is not a type"});
    CHECK(fault("float x", "float") == Says{"this property has no name"});
    CHECK(fault("face", "vertex") == Says{"two elements 'vertex'"});
    CHECK(fault("uchar", "float") == Says{"an integer type"});
    CHECK(fault("float x", "list uchar float x") == Says{"lack one of x, y and z"});
    std::string elements;
    for (int i = 0; i < 99; ++i) elements.append("element e").append(std::to_string(i)).append(" 0\n");
    CHECK(fault("element face", elements + "element face") == Says{"more than 100 kinds"});
    CHECK(fault("end_header", "end") == Says{"no end ('end_header')"});
}

TEST_CASE("what a header or a list announces costs nothing before it is there") {
    const double before = memory();
    for (const char* count : {"1000000000", "18446744073709551615", "6148914691236517206"}) {
        CAPTURE(count);
        CHECK(fault_in("a.ply", changed("face 1", std::string("face ") + count)) ==
              Says{std::string("the header announces ") + count + " of element 'face', but only "});
        CHECK(fault_in("a.ply", changed("vertex 3", std::string("vertex ") + count)) == Says{"the header announces "});
    }
    CHECK(fault_in("a.ply", changed("face 1", "face 10")) == Says{"the header announces 10 of element 'face'"});
    for (const std::string& format : formats) {
        std::string bytes = ply_of(triangle(), {.format = format});
        bytes.replace(bytes.find("uchar"), 5, "double");
        CHECK(fault_in("a.ply", bytes) == Says{"an integer type"});
        bytes.replace(bytes.find("double"), 6, "uint");
        bytes.resize(bytes.find("end_header\n") + 11);
        for (int i = 0; i < 9; ++i) {
            put_value(bytes, i, "float", format);
            if (format == "ascii" && i % 3 == 2) bytes += '\n';
        }
        put_value(bytes, 1e9, "uint32", format);
        for (int i = 0; i < 3; ++i) put_value(bytes, i, "int", format);
        CHECK(fault_in("a.ply", bytes) ==
              Says{"face 0 (counted from 0) has a list of 1000000000 entries, but the rest of the file has room"});
    }
    CHECK(fault_in("a.ply", changed("3 0 1 2 \n", "3 0 1 2")) == "");  // nothing behind its last list
    CHECK(fault_in("a.ply", changed("3 0 1 2", "3.5 0 1 2")) == Says{"has a list of 3.5 entries"});
    CHECK(fault_in("a.ply", changed("3 0 1 2", "-1 0 1 2")) == Says{"has a list of -1 entries"});
    std::string stl = binary_stl({});
    stl.replace(80, 4, "\xff\xff\xff\xff");
    CHECK(fault_in("a.stl", stl) == Says{"84 bytes, and its header announces 4294967295 triangles"});
    CHECK(memory() - before < 20);
}

TEST_CASE("a mesh has at most so many triangles and points") {
    const MeshData mesh = large_torus(5, 10);
    std::vector<std::array<DVec3, 3>> triangles;
    for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
    for (const auto& [name, bytes] : {std::pair{"a.ply", ply_of(mesh, {})},
                                      {"a.obj", obj_of(mesh)},
                                      {"a.stl", ascii_stl(triangles)},
                                      {"a.stl", binary_stl(triangles)}}) {
        CHECK(fault_in(name, bytes, {.most_triangles = 100, .most_points = 50}) == "");
        CHECK(fault_in(name, bytes, {.most_triangles = 99}) == Says{"more than 99 triangles"});
        CHECK(fault_in(name, bytes, {.most_points = 49}) == Says{"more than 49 points"});
    }
    CHECK(fault_in("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4", {.most_triangles = 1}) ==
          Says{"more than 1 triangle;"});
    CHECK(fault_in("a.ply", changed("3 0 1 2", "4 0 1 2 1"), {.most_triangles = 1}) == Says{"more than 1 triangle;"});
    std::string empty_face = changed("face 1", "face 2");
    empty_face += "0\n";
    CHECK(fault_in("a.ply", empty_face) == "");
    CHECK(fault_in("a.ply", empty_face, {.most_triangles = 1}) == Says{"more than 1 triangle;"});
}

TEST_CASE("faces of very many corners take no more time than they must") {
    std::string zigzag = "f", points;
    const auto add = [&](int i, const std::string& x, const std::string& y) {
        points.append("v ").append(x).append(" ").append(y).append(" 0\n");
        zigzag.append(" ").append(std::to_string(i));
    };
    for (int i = 1; i <= 1000; ++i) add(i, std::to_string(i % 2), std::to_string(i * i % 997));
    const std::clock_t start = std::clock();
    CHECK(fault_in("a.obj", points + zigzag) == "");
    CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 1);
    add(1001, "9", "9");
    CHECK(fault_in("a.obj", points + zigzag) == Says{"1001 corners and is not convex"});
    CHECK(fault_in("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3" + std::string(200000, ' ') +
                                std::string(200000, '3')) == Says{"is not a corner"});
}

}  // namespace
}  // namespace strahl

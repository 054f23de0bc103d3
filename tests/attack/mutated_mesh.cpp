// Mutations of mesh files: bytes, words, numbers and pieces.
#include "tests/attack/mutated_mesh.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "tests/attack/mutator.h"
#include "tests/unit/mesh/mesh_text.h"

namespace strahl {
namespace {

/// Numbers at the ends of their ranges, and words that mean something to one of the readers.
const std::vector<std::string> words = [] {
    std::istringstream text(
        "0 -0 1 2 3 4 5 8 9 100 -1 -2 -5 -9 127 128 255 256 32768 65536 2147483647 -2147483648 4294967295 "
        "4294967296 4294967299 9223372036854775807 18446744073709551615 18446744073709551616 1000000000 1e9 -1e9 "
        "1.0000001e9 1e16 1e300 1e309 1e-300 1e-310 5e-324 1e-400 .5 -.5 +1 nan -nan inf -inf 0x10 1/1 1//1 1/1/1 "
        "-1//-1 1/ // f v vn vt # ply format ascii binary_little_endian binary_big_endian element vertex face "
        "property list char uchar short ushort int uint float double x y z nx ny nz vertex_index vertex_indices "
        "other end_header comment solid facet normal outer loop endloop endfacet endsolid");
    std::vector<std::string> list{"\\", "\\\n", "\n", "\r", "\r\n"};
    for (std::string word; text >> word;) list.push_back(word);
    return list;
}();

class MeshMutator : Mutator {
  public:
    using Mutator::Mutator;

    std::string mesh() {
        file = any();
        for (int i = dice.upto(dice.upto(4)); i >= 0; --i) change();
        return file;
    }

  private:
    std::size_t place() { return below(file.size()); }

    void change();
    void put_number();
    void put_word();
};

/// In a binary file, a number is four or eight bytes anywhere.
void MeshMutator::put_number() {
    constexpr std::array<double, 14> numbers{0,   1,          3,          4,    255,  -1,     65535,
                                             1e9, 2147483647, 4294967295, 1e15, 1e16, 1e-310, 1e300};
    constexpr std::array types{"float", "double", "int", "uint32", "ushort"};
    const double value = numbers[below(numbers.size())];
    const std::string type = types[below(types.size())];
    if (type[0] != 'f' && type[0] != 'd' && (value < 0 || value > 2147483647)) return;
    std::string bytes;
    put_value(bytes, value, type, dice.chance(.5) ? "binary_little_endian" : "binary_big_endian");
    if (dice.chance(.2)) std::fill(bytes.begin(), bytes.end(), dice.chance(.5) ? '\xff' : '\x7f');
    file.replace(std::min(place(), file.size()), bytes.size(), bytes);
}

/// Puts a word in place of another, or before it.
void MeshMutator::put_word() {
    constexpr const char* blanks = " \t\r\n";
    const std::size_t at = file.find_first_not_of(blanks, file.find_first_of(blanks, place()));
    if (at == file.npos) return;
    const std::size_t length = dice.chance(.8) ? std::min(file.find_first_of(blanks, at), file.size()) - at : 0;
    file.replace(at, length, words[below(words.size())] + std::string(length > 0 ? "" : " "));
}

void MeshMutator::change() {
    if (file.empty()) return;
    const std::size_t at = place(), length = below(dice.chance(.8) ? 16 : file.size());
    const int kind = dice.upto(11);
    if (kind <= overwrite)
        change_bytes(static_cast<Change>(kind), at, length, [&] { return place(); });
    else if (kind <= overwrite + 2)
        put_number();
    else
        put_word();
}

/// Points, normals and faces of every number of corners, with what no reader needs in between.
std::string rich_obj() {
    std::string text = "# all of it\nmtllib a.mtl\no one\n";
    for (int i = 0; i < 12; ++i)
        text += std::string("v ") + std::to_string(i % 4) + " " + std::to_string(i * i % 7) + "e-1 -." +
                std::to_string(i) + "\nvn 0 " + std::to_string(i) + " 1\nvt .5 .5\n";
    return text +
           "usemtl red\ns 1\nf 1 2 3\nf 1/1 2/2 3/3 4/4\nf 1//1 2//2 3//3 5//5 -1//-1\nf -1/-1/-1 -2/-2/-2 -3/-3/-3\n"
           "f 1 2 3 4 5 6 7 8 9 10 11 \\\n 12\nl 1 2\np 1\n";
}

/// A PLY file in text with other elements, other properties, and a concave face.
std::string rich_ply() {
    return "ply\nformat ascii 1.0\ncomment all of it\nelement camera 1\nproperty float view\nproperty list uchar int "
           "a\n"
           "element vertex 5\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\n"
           "property list uint8 float32 weights\nproperty float nx\nproperty float ny\nproperty float nz\n"
           "element face 3\nproperty int part\nproperty list uchar uint vertex_index\nproperty list char short b\n"
           "element edge 1\nproperty int from\nproperty int to\nend_header\n.5 2 7 8\n0 0 0 9 0 0 0 1\n4 1 0 9 1 .5 0 "
           "0 1\n"
           "0 2 0 9 2 .5 .5 0 0 1\n1 1 0 9 0 0 0 1\n1 1 1 9 0 0 0 1\n1 4 0 1 2 3 0\n2 3 0 1 4 1 5\n3 5 0 1 2 3 4 0\n0 "
           "1\n";
}

/// A PLY file whose faces, with places at their corners, and strips come before the vertices, which have normals.
std::string turned_ply() {
    return "ply \r\nformat ascii 1.0\nmade by hand\nelement face 2\nproperty list uchar float texcoord\n"
           "property list uchar int vertex_indices\nelement tristrips 1\nproperty list int int vertex_indices\n"
           "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
           "property float ny\nproperty float nz\nproperty float u\nproperty float v\nend_header\n"
           "6 0 0 1 0 1 1 3 0 1 2\n0 4 0 1 2 3\n9 0 1 2 3 -1 2 1 0 -1\n"
           "0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 0 nan 1 7\n0 1 1 nan 0 1 0 1\n";
}

std::string turned_obj() {
    return "\xEF\xBB\xBFv 0 0 0 1 0 0\nv 1 0 0\rv 0 1 0\nv 0 0 1\nvt nan 0\nvt 1 0\nvn 0 0 0\nvn 0 0 1\nmtllib a.mtl\n"
           "f 1// 2/ 3\nf -4/2/2 2/-1/-1 \\ \n3/1/1\nf 1 2\nf 1//2 2 4\nfo 2/2/ 3/1/ 4/2/ # \\\nf 1/2 2/2 3/2 4/1\n";
}

std::string turned_stl() {
    return "\xEF\xBB\xBF SOLID a\n; a comment\nFACET normal\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
           "end loop\nend facet\n# another\nend solid a\n";
}

}  // namespace

std::vector<std::string> valid_meshes() {
    std::vector<std::string> files{rich_obj(), rich_ply(), turned_ply(), turned_obj(), turned_stl()};
    for (const auto& [n, m] : {std::pair{3, 3}, {5, 8}}) {
        const MeshData flat = large_torus(n, m);
        MeshData smooth = flat;
        smooth.normals = smooth.points, smooth.corner_normals = smooth.triangles;
        for (const MeshData& mesh : {flat, smooth}) {
            files.push_back(obj_of(mesh));
            for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
                for (const char* number : {"float", "double"})
                    for (const char* index : {"uchar", "int"}) files.push_back(ply_of(mesh, {format, number, index}));
        }
        std::vector<std::array<DVec3, 3>> triangles;
        for (const auto& [a, b, c] : flat.triangles)
            triangles.push_back({flat.points[a], flat.points[b], flat.points[c]});
        for (int i = 0; i < 3; ++i) files.push_back(binary_stl(triangles)), files.push_back(ascii_stl(triangles));
        for (const std::string& file : {rich_obj(), rich_ply(), turned_ply(), turned_obj(), turned_stl()})
            files.push_back(file);
    }
    return files;
}

std::string mutated_mesh(const std::vector<std::string>& valid, std::uint64_t number) {
    return MeshMutator(valid, number).mesh();
}

}  // namespace strahl

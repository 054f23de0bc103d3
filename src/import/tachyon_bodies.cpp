#include "import/tachyon_bodies.h"

#include <array>

#include "text/reading/messages.h"

namespace strahl {
namespace {

constexpr long most_things = 1'000'000'000;  // that a file may announce

}  // namespace

bool TachyonBodies::read(std::string_view word) {
    struct Declaration {
        std::string_view word;
        void (*read)(TachyonBodies&);
    };
    static constexpr Declaration declarations[] = {
        {"SPHERE", [](TachyonBodies& b) { b.read_sphere(); }},
        {"PLANE", [](TachyonBodies& b) { b.read_plane(); }},
        {"BOX", [](TachyonBodies& b) { b.read_box(); }},
        {"RING", [](TachyonBodies& b) { b.read_ring(); }},
        {"FCYLINDER", [](TachyonBodies& b) { b.read_tube(); }},
        {"CYLINDER", [](TachyonBodies& b) { b.read_endless_cylinder(); }},
        {"POLYCYLINDER", [](TachyonBodies& b) { b.read_chain(); }},
        {"TRI", [](TachyonBodies& b) { b.read_triangle(false, false); }},
        {"STRI", [](TachyonBodies& b) { b.read_triangle(true, false); }},
        {"VCSTRI", [](TachyonBodies& b) { b.read_triangle(true, true); }},
        {"VERTEXARRAY", [](TachyonBodies& b) { b.read_vertex_array(); }},
        {"SCAPE", [](TachyonBodies& b) { b.skip_landscape(); }},
        {"SCALARVOL", [](TachyonBodies& b) { b.skip_volume(); }},
        {"TPOLYFILE", [](TachyonBodies& b) { b.skip_triangle_file(); }},
        {"TEXDEF", [](TachyonBodies& b) { b.textures.define(); }},
        {"TEXALIAS", [](TachyonBodies& b) { b.textures.define_alias(); }},
        {"IMAGEDEF", [](TachyonBodies& b) { b.textures.skip_image(); }},
    };
    for (const Declaration& declaration : declarations)
        if (same_word(word, declaration.word)) return declaration.read(*this), true;
    return false;
}

void TachyonBodies::read_sphere() {
    const DVec3 centre = vector_after("CENTER");
    const double radius = words.number_after("RAD");
    textures.use();
    scene.add(Sphere{centre, radius});
}

void TachyonBodies::read_plane() {
    const DVec3 point = vector_after("CENTER"), normal = vector_after("NORMAL");
    textures.use();
    scene.add_plane(point, normal);
}

void TachyonBodies::read_box() {
    const DVec3 low = vector_after("MIN"), high = vector_after("MAX");
    textures.use();
    scene.add(Cuboid{low, high});
}

void TachyonBodies::read_ring() {
    const DVec3 centre = vector_after("CENTER"), normal = vector_after("NORMAL");
    const double inner = words.number_after("INNER"), outer = words.number_after("OUTER");
    textures.use();
    scene.add(Disc{centre, normal, outer, inner});
}

void TachyonBodies::read_tube() {
    const DVec3 base = vector_after("BASE"), apex = vector_after("APEX");
    const double radius = words.number_after("RAD");
    textures.use();
    scene.warn("FCYLINDER is an open tube in Tachyon; here it is closed");
    scene.add(Cylinder{base, apex, radius});
}

void TachyonBodies::read_endless_cylinder() {
    const DVec3 centre = vector_after("CENTER"), axis = vector_after("AXIS");
    const double radius = words.number_after("RAD");
    textures.use();
    scene.add_endless_cylinder(centre, axis, radius);
}

/// Reads tubes from point to point, and adds a ball at each.
void TachyonBodies::read_chain() {
    words.expect("POINTS");
    const long count = words.whole("POINTS", 0, most_things);
    points.clear();
    for (long i = 0; i < count; ++i) points.push_back(vector("a point"));
    const double radius = words.number_after("RAD");
    textures.use();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0) scene.add(Cylinder{points[i - 1], points[i], radius});
        scene.add(Sphere{points[i], radius});
    }
}

void TachyonBodies::read_triangle(bool smooth, bool colored) {
    std::array<DVec3, 3> corners, bent;
    Color color(0);
    constexpr const char* names[3][3] = {{"V0", "V1", "V2"}, {"N0", "N1", "N2"}, {"C0", "C1", "C2"}};
    for (int i = 0; i < 3; ++i) corners[i] = vector_after(names[0][i]);
    for (int i = 0; smooth && i < 3; ++i) bent[i] = vector_after(names[1][i]);
    for (int i = 0; colored && i < 3; ++i) color += words.vector_after(names[2][i]);
    if (colored) {
        Material m = textures.read_without_color();
        m.rgb = color / 3.;
        scene.warn("the corners' colours: each triangle has their mean");
        scene.set_material(m);
    } else {
        textures.use();
    }
    scene.add_polygon(corners, smooth ? std::span<const DVec3>(bent) : std::span<const DVec3>());
}

void TachyonBodies::read_vertex_array() {
    words.expect("NUMVERTS");
    const long count = words.whole("NUMVERTS", 0, most_things);
    const auto read_all = [&](std::vector<DVec3>& list, const char* what, bool mirrored) {
        list.clear();
        for (long i = 0; i < count; ++i) list.push_back(mirrored ? vector(what) : words.vector(what));
    };
    words.expect("COORDS");
    read_all(points, "a vertex", true);
    words.expect("NORMALS");
    read_all(normals, "a normal", true);
    colors.clear();
    array_material = TachyonTextures::usual();
    for (;;) {
        const std::string_view part = words.choose({"COLORS", "TEXTURE", "TRIMESH", "TRISTRIP", "END_VERTEXARRAY"});
        if (part == "END_VERTEXARRAY") return;
        if (part == "COLORS") {
            read_all(colors, "a colour", false);
            scene.warn("COLORS: each triangle has the mean of its corners' colours");
        } else if (part == "TEXTURE") {
            array_material = textures.read();
        } else {
            read_strip(part == "TRISTRIP");
        }
    }
}

/// Reads the triangles of a vertex array: three numbers each, or in a strip one more for each after the first.
void TachyonBodies::read_strip(bool strip) {
    const long count = words.whole(strip ? "TRISTRIP" : "TRIMESH", 0, most_things);
    const auto corner = [&] {
        if (points.empty()) words.fail("there are triangles, but no vertices");
        return words.whole("a vertex's number", 0, static_cast<long>(points.size()) - 1);
    };
    if (!strip) {
        for (long i = 0; i < count; ++i) {
            const long a = corner(), b = corner(), c = corner();
            add_facet(a, b, c);
        }
        return;
    }
    long before = 0, last = 0;
    for (long i = 0; i < count; ++i) {
        const long next = corner();
        if (i > 1) i % 2 == 0 ? add_facet(before, last, next) : add_facet(last, before, next);
        before = last, last = next;
    }
}

void TachyonBodies::add_facet(long a, long b, long c) {
    Material m = array_material;
    if (!colors.empty()) m.rgb = (colors[a] + colors[b] + colors[c]) / 3.;
    scene.set_material(m);
    scene.add_polygon(std::array{points[a], points[b], points[c]}, std::array{normals[a], normals[b], normals[c]});
}

void TachyonBodies::skip_landscape() {
    words.expect("RES");
    for (int i = 0; i < 2; ++i) words.number("RES");
    words.expect("SCALE");
    for (int i = 0; i < 2; ++i) words.number("SCALE");
    vector_after("CENTER");
    textures.use();
    scene.warn("SCAPE, a random landscape, is left out");
}

void TachyonBodies::skip_volume() {
    vector_after("MIN"), vector_after("MAX");
    words.vector_after("DIM");
    words.expect("FILE");
    const std::string file = quoted(words.take("a file"));
    textures.use();
    scene.warn("SCALARVOL " + file + ", a volume, is left out");
}

void TachyonBodies::skip_triangle_file() {
    vector_after("SCALE"), vector_after("ROT"), vector_after("CENTER");
    words.expect("FILE");
    const std::string file = quoted(words.take("a file"));
    textures.use();
    scene.warn("TPOLYFILE " + file + ", triangles in another file, is left out");
}

}  // namespace strahl

// OBJ files with materials: the words of .mtl files, and which triangles have which.
#include "import/models/mtl.h"
#include "num/vec_math.h"
#include "tests/unit/import/models.h"

using namespace strahl;
using namespace strahl::importing;

namespace {

std::vector<MtlMaterial> parsed(const std::string& text, std::vector<std::string> told = {}) {
    std::vector<std::string> warnings;
    std::vector<MtlMaterial> list = parse_mtl(text, "a.mtl", warnings);
    CHECK(warnings == told);
    return list;
}
std::string mtl_fault(const std::string& text) {
    return fault_of([&] { parsed(text); }, "no error");
}

/// The material of a triangle that has this .mtl.
Material material_by(const std::string& values, const std::string& picture = "") {
    Models models;
    if (!picture.empty()) models.put(picture, "");
    models.put("a.mtl", "newmtl m\n" + values)
        .put("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    const Model model = models.read("a.obj");
    return model.materials.at(std::size_t(model.parts.at(0).material));
}

}  // namespace

TEST_CASE("mtl: the words of a material") {
    const auto list = parsed(
        "# a comment\nKd 1 1 1\n\nnewmtl first one\r\n  Kd .1 .2 .3 \nKs .5\nKe 1 0 0\nTf 0 1 0\nNs 96.1\nd .25\nNi "
        "1.5\nillum 7\nKa 1 1 1\nnewmtl b\nTr .25\nmap_Kd -s 2 3 -o .5 -clamp on dir\\wood grain.png\n"
        "bump -bm 2 -imfchan r b.png\nnorm -new_option 1 n.png\nmap_d d.png\nKd xyz 1 1 1\n");
    REQUIRE(list.size() == 2);
    CHECK(list[0].name == "first one");
    CHECK(list[0].diffuse == Color(.1, .2, .3));
    CHECK(list[0].specular == Color(.5));
    CHECK(list[0].emission == Color(1, 0, 0));
    CHECK(list[0].filter == Color(0, 1, 0));
    CHECK(list[0].shininess == 96.1);
    CHECK(list[0].opacity == .25);
    CHECK(list[0].ior == 1.5);
    CHECK(list[0].illum == 7);
    CHECK(list[1].opacity == .75);
    CHECK(list[1].diffuse == Color(.8));
    REQUIRE(list[1].color_picture);
    CHECK(list[1].color_picture->file == "dir/wood grain.png");
    CHECK(list[1].color_picture->place.scale == DVec3(2, 3, 1));
    CHECK(list[1].color_picture->place.offset == DVec3(.5, 0, 0));
    CHECK(list[1].color_picture->place.clamped);
    CHECK(list[1].bump->strength == 2);
    CHECK(list[1].bump->file == "b.png");
    CHECK(list[1].normal->file == "n.png");
    CHECK(list[1].opacity_picture->line == 19);
}

TEST_CASE("mtl: what is wrong is told with its line, what is unknown is a warning") {
    CHECK(mtl_fault("newmtl a\nNs\n") == "a.mtl:2: the line ends where a number for 'Ns' should be");
    CHECK(mtl_fault("newmtl a\r\nd much\r\n") == "a.mtl:2: 'much' should be a number from -1e9 to 1e9, for 'd'");
    CHECK(mtl_fault("newmtl a\nNs 1e300") == "a.mtl:2: '1e300' should be a number from -1e9 to 1e9, for 'Ns'");
    CHECK(mtl_fault("newmtl a\nmap_Kd -s 2") == "a.mtl:2: 'map_Kd' names no file");
    CHECK(mtl_fault("newmtl a\nmap_Kd -s 0 a.png") == "a.mtl:2: a picture cannot be scaled by 0");
    parsed("newmtl a\nKt 1\nPr .5\nKt 2\n", {"a.mtl:2: left out: 'Kt'", "a.mtl:3: left out: 'Pr'"});
}

TEST_CASE("mtl: materials as Whitted's model has them") {
    const Material dull = material_by("Kd 1 0 0\nKs 1 1 1\nNs 50\nillum 1\n");
    CHECK(dull.rgb == Pigment(1, 0, 0));
    CHECK(dull.specular == 0);
    CHECK(dull.reflection == 0);
    CHECK(material_by("Kd 5e8 0 0\n").rgb.color == Color(1e9, 0, 0));
    const Material glossy = material_by("Kd 0 0 0\nKs .5 .25 0\nNs 50\nillum 2\n");
    CHECK(glossy.specular == .5);
    CHECK(glossy.pow == 50);
    const Material mirror = material_by("Kd 0 0 0\nKs .5 .25 0\nillum 3\n");
    CHECK(mirror.reflection == .5);
    CHECK(mirror.mirror == Color(1, .5, 0));
    CHECK(material_by("Kd 1 1 1\nd .25\n").rgb.transmit == .75);
    const Material glass = material_by("Kd 0 0 0\nd .1\nTf .5 1 .5\nNi 1.5\nillum 6\n");
    CHECK(glass.refraction == doctest::Approx(.9));
    CHECK(glass.ior == 1.5);
    CHECK(glass.rgb == Pigment(.5, 1, .5));
    CHECK(glass.fresnel == 0);
    const Material better = material_by("d .1\nNi 1.5\nillum 7\n");
    CHECK(better.fresnel == 1);
    CHECK(better.reflection == 1);
    CHECK(better.facing == 0);
    CHECK(better.conserve == 1);
    const Material lamp = material_by("Kd 0 0 0\nKe 1 1 0\n");
    CHECK(lamp.ambient == 1);
    CHECK(lamp.rgb == Pigment(1, 1, 0));
    CHECK(material_by("Kd 1 0 0\nillum 0\n").diffuse == 0);
    // Values are as they are to be seen: .5 is sRGB-encoded.
    CHECK(material_by("Kd .5 0 0\n").rgb.color.x == doctest::Approx(.2140411));
}

TEST_CASE("mtl: pictures") {
    const Material wood = material_by("Kd .8 .8 .8\nmap_Kd -s 2 4 -o .5 0 w.png\n", "w.png");
    const Pattern& pattern = *wood.rgb.pattern;
    const auto& image = std::get<ImagePattern>(pattern.kind);
    CHECK(image.file == "w.png");
    CHECK(pattern.by_uv);
    CHECK(!image.once);
    // The place (u, v) = (.25, .5) is at (2 u + .5, 4 v) in the picture.
    const DVec3 place = transform_point(matrix(pattern.transformations), DVec3(1, 2, 0));
    CHECK(place == DVec3(.25, .5, 0));
    CHECK(std::get<ImagePattern>(material_by("map_Kd -clamp on w.png\nKd 1 0 0", "w.png").rgb.pattern->kind).once ==
          Color(1, 0, 0));
    // A colour of its own multiplies the picture's, in linear light.
    const Material red = material_by("Kd 1 0 0\nmap_Kd w.png\n", "w.png");
    const auto& changed = *std::get<ImagePattern>(red.rgb.pattern->kind).pixels;
    CHECK(changed.values == std::vector<float>{1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0});
    CHECK(changed.linear);
    const Material rough = material_by("map_bump -bm 2 b.png\nnorm b.png\n", "b.png");
    CHECK(rough.bump.height == doctest::Approx(.02));
    CHECK(rough.normal.pattern != nullptr);
}

TEST_CASE("mtl: where a picture is not opaque light comes through") {
    const auto opacity = [](const Material& own, double u, double v) {
        const auto& values = std::get<SolidPattern>(own.rgb.pattern->kind);
        return values.function->value_at({u, v, 0});
    };
    const Material leaf = material_by("map_Kd clear.png\n", "clear.png");
    CHECK(leaf.rgb.clear());
    CHECK(opacity(leaf, .25, .25) == 1);
    CHECK(opacity(leaf, .75, .25) == 0);
    CHECK(opacity(leaf, .5, .75) == .5);
    // The picture repeats itself beyond its edges.
    CHECK(opacity(leaf, 1.25, -.75) == 1);
    CHECK(opacity(leaf, 1, .5) == .5);
    REQUIRE(leaf.rgb.pattern->colors.size() == 2);
    CHECK(leaf.rgb.pattern->colors[0].transmit == 1);
    CHECK(leaf.rgb.pattern->colors[1].pattern != nullptr);
    const Material mask = material_by("Kd 1 0 0\nmap_d m.png\nd .5", "m.png");
    CHECK(opacity(mask, .25, .75) == .5);
    CHECK(opacity(mask, .25, .25) == 0);
    CHECK(mask.rgb.pattern->colors[1].color == Color(1, 0, 0));
}

TEST_CASE("obj: triangles of one name and one material are a body") {
    Models models;
    models.put("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    models.put("a.obj",
               "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no house\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4\n"
               "g roof\nf 2 3 4\ng house\nusemtl red\nf 3 2 1\nf 1 1 2\n");
    const Model model = models.read("a.obj");
    REQUIRE(model.parts.size() == 3);
    const auto is = [&](std::size_t i, const std::string& name, const Color& color, std::size_t triangles) {
        CHECK(model.parts[i].name == name);
        CHECK(model.materials[std::size_t(model.parts[i].material)].rgb.color == color);
        CHECK(model.parts[i].mesh->triangles.size() == triangles);
        CHECK(model.parts[i].mesh->points.size() == 3);
    };
    is(0, "house", {1, 0, 0}, 2), is(1, "house", {0, 0, 1}, 1), is(2, "roof", {0, 0, 1}, 1);
    CHECK(model.parts[2].mesh->points == std::vector<DVec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    CHECK(model.files == std::vector<std::string>{models.folder / "a.obj", models.folder / "a.mtl"});
}

TEST_CASE("obj: materials and pictures that are missing are told") {
    Models models;
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    models.put("none.obj", "mtllib none.mtl\nusemtl a\n" + triangle);
    CHECK(models.without_folder(models.read("none.obj").warnings.at(0)) ==
          "none.obj: materials are left out: cannot read 'none.mtl': there is no such file");
    models.put("a b.mtl", "newmtl a\nmap_Kd no.png\n").put("a.obj", "mtllib a b.mtl\nusemtl a\nusemtl b\n" + triangle);
    CHECK(models.without_folder(models.read("a.obj").warnings.at(1)) == "a.obj: there is no material 'b'");
    models.put("p.obj", "mtllib a b.mtl\nusemtl a\n" + triangle);
    CHECK(models.without_folder(models.read("p.obj").warnings.at(0)) ==
          "a b.mtl:2: a picture is left out: cannot read 'no.png'");
    models.put("bad.mtl", "newmtl a\nNs x\n").put("bad.obj", "mtllib bad.mtl\nusemtl a\n" + triangle);
    CHECK(models.fault("bad.obj") == "bad.mtl:2: 'x' should be a number from -1e9 to 1e9, for 'Ns'");
}

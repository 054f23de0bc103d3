// Imported scenes: what NFF and Tachyon's format say, and what is told of the rest.
#include "import/import.h"

#include <doctest/doctest.h>

#include <cmath>

#include "import/polygon.h"
#include "text/parse.h"
#include "text/write.h"

using namespace strahl;

namespace {

const std::string view = "v\nfrom 2 1 3\nat 0 0 0\nup 0 0 1\nangle 45\nhither 0\nresolution 512 256\n";
const std::string eye =
    "BEGIN_SCENE RESOLUTION 400 200\nCAMERA ZOOM 2 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 7\n"
    "CENTER 1 2 -9 VIEWDIR 0 0 1 UPDIR 0 1 0 END_CAMERA\n";
const std::string white = "TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0\n";

/// What is imported can always be written, and is the same when read again.
Imported imported(const std::string& text, const ImportLimits& limits = {}) {
    const Imported result = import_scene(text, "x", limits);
    CHECK(parse_scene(write_scene(result.scene), "x.rt") == result.scene);
    return result;
}

std::string message(const std::string& text, const ImportLimits& limits = {}) {
    try {
        import_scene(text, "x", limits);
    } catch (const FileError& error) {
        return error.what();
    }
    return "no error";
}
/// The first line of the message.
std::string fault(const std::string& text, const ImportLimits& limits = {}) {
    const std::string all = message(text, limits);
    return all.substr(0, all.find('\n'));
}

using Told = std::vector<std::string>;

template <class Kind>
Kind body(const Imported& scene, std::size_t i = 0) {
    REQUIRE(scene.scene.primitives.size() > i);
    REQUIRE(std::holds_alternative<Kind>(scene.scene.primitives[i].shape));
    return std::get<Kind>(scene.scene.primitives[i].shape);
}
Material material(const Imported& scene, std::size_t i = 0) {
    return scene.scene.materials.at(scene.scene.primitives.at(i).material);
}

}  // namespace

TEST_CASE("NFF: camera, background and lights") {
    const Imported x =
        imported(view + "b .1 .2 .3\nl 4 3 2\nl 1 -4 4 .5 .6 .7\n# l 9 9 9\nl 0 0 9 # a comment\nl 1 1 1");
    CHECK(x.scene.camera == Camera{.position = {2, 1, 3}, .look_at = DVec3(0), .up = {0, 0, -1}, .fov = 22.5});
    CHECK(x.size->width == 512);
    CHECK(x.size->height == 256);
    CHECK(x.scene.background == Color(.1, .2, .3));
    CHECK(x.scene.lights ==
          std::vector<Light>{
              {{4, 3, 2}, Color(.5)}, {{1, -4, 4}, {.5, .6, .7}}, {{0, 0, 9}, Color(.5)}, {{1, 1, 1}, Color(.5)}});
    CHECK(x.warnings.empty());
}

TEST_CASE("NFF: bodies and materials") {
    const Imported x =
        imported(view + "f 1 .9 .7 .5 .4 30 .2 1.5\ns 1 2 3 .5\nc 0 0 0 1\n0 0 2 1\nf 0 0 1 1 0 0 0 0\n" +
                 "c 0 0 0 1 0 0 2 0\ns 0 0 0 -2\n");
    CHECK(material(x, 0) == Material{.rgb = {1, .9, .7},
                                     .reflection = .4,
                                     .refraction = .2,
                                     .diffuse = .5,
                                     .ambient = 0,
                                     .specular = .4,
                                     .pow = 30,
                                     .ior = 1.5});
    CHECK(body<Sphere>(x) == Sphere{{1, 2, 3}, .5});
    CHECK(body<Cylinder>(x, 1) == Cylinder{DVec3(0), {0, 0, 2}, 1});
    CHECK(material(x, 1) == material(x, 0));
    CHECK(material(x, 2).rgb == Color(0, 0, 1));
    CHECK(material(x, 2).ior == 1);
    CHECK(body<Cone>(x, 2) == Cone{DVec3(0), 1, {0, 0, 2}, 0});
    CHECK(body<Sphere>(x, 3).radius == 2);
    CHECK(x.warnings == Told{"x:11: cones and cylinders are open tubes in NFF; here they are closed (and in line 13)",
                             "x:14: a negative radius: bodies are seen from both sides"});
}

TEST_CASE("NFF: what is told") {
    CHECK(imported("v from 1 0 0 at 0 0 0 up 0 0 1 angle 45 hither .5").warnings ==
          Told{"x:1: 'hither': bodies that are nearer are shown too"});
    CHECK(imported(view + "f 1 1 1 1 0 0 0 0\ns 0 0 0 0\ns 1 1 1 1\ns 1e99 0 0 1\n").warnings ==
          Told{"x:9: a sphere is left out: its radius must be greater than 0 (at least 2.3e-308) and at most 1e15",
               "x:11: a sphere is left out: its centre must be from -1e15 to 1e15"});
    CHECK(imported(view + "f -1 1 1 1 1.5 0 0 0\ns 0 0 0 1").warnings ==
          Told{"x:8: the material's rgb is -1; 0 instead", "x:8: the material's reflection is 1.5; 1 instead"});
    CHECK(imported(view + "s 0 0 0 1\ns 0 0 1 1\n").warnings ==
          Told{"x:8: no material: an 'f' is missing before this body; it gets that of a scene without materials"});
    const Imported many = imported([] {
        std::string text = view + "f 1 1 1 1 0 0 0 0\n";
        for (int i = 0; i < 20; ++i) text += "s 0 0 0 -1\n";
        return text;
    }());
    CHECK(many.warnings == Told{"x:9: a negative radius: bodies are seen from both sides (and in lines 10, 11, 12, 13, "
                                "14, 15, 16, 17, 18 and 10 more, the last in line 28)"});
}

TEST_CASE("NFF: errors have a place") {
    CHECK(message(view + "f 1 1 1 1 0 0 0 0\ns 1 2 nan 4\n") ==
          "x:9:7: a number expected for the centre, but here comes 'nan'\n    s 1 2 nan 4\n          ^~~");
    for (const char* const number : {"inf", "-inf", "1e999", "0x10", "1.2.3", "+-1", "--1", "1,", "."})
        CHECK(fault(view + "s 1 2 3 " + number).starts_with("x:8:9: a number expected for the radius"));
    for (const char* const number : {"1", "+1", "1.", ".5", "1e3", "-0"})
        CHECK(fault(view + "s 1 2 " + number + " 3") == "no error");
    CHECK(fault("") == "x:1:1: this scene has no camera: an entity 'v' expected, but the file ends");
    CHECK(fault("s 0 0 0 1\n\n") == "x:1:10: this scene has no camera: an entity 'v' expected, but the file ends");
    CHECK(fault(view + view) == "x:8:1: a second 'v': a scene has one camera");
    CHECK(fault(view + "q 1") ==
          "x:8:1: NFF has no entity 'q'; it knows v, b, l, f, s, c, p and pp. (A scene of Tachyon starts with "
          "BEGIN_SCENE.)");
    CHECK(fault("nff\nversion 2.0\n") ==
          "x:1:1: this is the NFF of the WorldToolKit, another format; E. Haines' NFF "
          "expected, but here comes 'nff'");
    CHECK(fault("v\nfrom 0 0 0\nat 0 0 0\nup 0 0 1\nangle 45\n").starts_with("x:5:7: the camera sees nothing"));
    CHECK(fault("v\nangle 180\n") == "x:2:7: 'angle' must be greater than 0 and less than 180 degrees");
    CHECK(fault("v\nfrom 0 0 1\nb 1 1 1").starts_with("x:3:1: 'from', 'at', 'up' and 'angle' expected"));
    CHECK(fault(view + "b 1 -1 0") == "x:8:6: the background must be three numbers from 0 to 1e9");
    CHECK(fault(view + "p 1000000000\n0 0 0\n1 0 0\n") == "x:10:6: a number expected for a corner, but the file ends");
    for (const char* const count : {"2", "-3", "3.5", "1e10"})
        CHECK(fault(view + "p " + count) == "x:8:3: the number of corners must be a whole number from 3 to 1000000000");
    ImportLimits limits;
    limits.primitives = 2, limits.lights = 1;
    const std::string ball = "s 0 0 0 1\n";
    CHECK(fault(view + ball + ball, limits) == "no error");
    CHECK(fault(view + ball + ball + ball, limits) == "x:10:9: more than 2 bodies");
    CHECK(fault(view + "l 1 1 1\nl 1 1 1", limits) == "x:9:7: more than 1 lights");
}

TEST_CASE("a file that is cut off anywhere is an error or a scene") {
    const std::string nff =
        view + "l 1 2 3\nf 1 1 1 1 0 0 0 0\np 3 0 0 0 1 0 0 0 1 0\npp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n";
    const std::string tachyon = eye + "TEXDEF a " + white.substr(8) + "SPHERE CENTER 1 2 3 RAD 4 a\n" +
                                "VERTEXARRAY NUMVERTS 3 COORDS 0 0 0 1 0 0 0 1 0 NORMALS 0 0 1 0 0 1 0 0 1\n" + white +
                                "TRISTRIP 3 0 1 2 END_VERTEXARRAY\n";
    for (const std::string& text : {nff, tachyon})
        for (std::size_t i = 0; i < text.size(); ++i) {
            const std::string all = message(text.substr(0, i));
            CHECK((all == "no error" || all.starts_with("x:")));
        }
    CHECK(message(nff) == "no error");
    CHECK(message(tachyon) == "no error");
}

TEST_CASE("Tachyon: camera and lights, mirrored in z") {
    const Imported x = imported(eye + "LIGHT CENTER 1 2 3 RAD 0 COLOR 1 .5 0\nBACKGROUND .1 .2 .3\nEND_SCENE nonsense");
    CHECK(x.scene.camera.position == DVec3(1, 2, 9));
    CHECK(x.scene.camera.look_at == DVec3(1, 2, 8));
    CHECK(x.scene.camera.up == DVec3(0, -1, 0));
    CHECK(x.scene.camera.fov == doctest::Approx(std::atan(.5) * 180 / std::acos(-1.)));
    CHECK(!x.scene.camera.aspectratio);
    CHECK(x.scene.settings.max_trace_level == 7);
    CHECK(x.scene.lights == std::vector<Light>{{{1, 2, -3}, {1, .5, 0}}});
    CHECK(x.scene.background == Color(.1, .2, .3));
    CHECK(x.size->width == 400);
    CHECK(x.warnings.empty());

    const std::string start =
        "begin_scene resolution 100 100\ncamera projection perspective zoom 1 aspectratio 2 "
        "antialiasing 0 raydepth 1 center 0 0 0 viewdir 0 0 1 updir 0 1 0 ";
    CHECK(imported(start + "end_camera").scene.camera.aspectratio == .5);
    CHECK(imported(start + "frustum -2 2 -1 1 end_camera").scene.camera.aspectratio == 2);
    CHECK(imported(start + "frustum -2 2 -2 2 end_camera").scene.camera.fov == doctest::Approx(63.434949));
    CHECK(imported(start + "frustum -1 2 -1 1 end_camera").warnings.size() == 1);
}

TEST_CASE("Tachyon: bodies and textures") {
    const Imported x =
        imported(eye +
                 "TEXDEF a AMBIENT .1 DIFFUSE .8 SPECULAR .2 OPACITY .7 PHONG PLASTIC .5 PHONG_SIZE 40 COLOR 1 .5 .2 "
                 "TEXFUNC 0\nTEXALIAS b a\n"
                 "SPHERE CENTER 1 2 3 RAD 4 a\nBOX MIN 0 0 0 MAX 1 2 3 b\nPLANE CENTER 0 -1 0 NORMAL 0 2 0 " +
                 white + "FCYLINDER BASE 0 0 0 APEX 0 0 5 RAD 1 a\nPOLYCYLINDER POINTS 2 0 0 0 1 0 0 RAD .1 a\n");
    CHECK(material(x) == Material{.rgb = {1, .5, .2},
                                  .reflection = .2,
                                  .refraction = .3,
                                  .diffuse = .8,
                                  .ambient = .1,
                                  .specular = .5,
                                  .pow = 10,
                                  .ior = 1});
    CHECK(body<Sphere>(x) == Sphere{{1, 2, -3}, 4});
    CHECK(body<Cuboid>(x, 1) == Cuboid{{0, 0, 0}, {1, 2, -3}});
    CHECK(material(x, 1) == material(x, 0));
    CHECK(body<Plane>(x, 2).normal() == DVec3(0, 1, 0));
    CHECK(body<Plane>(x, 2).a == DVec3(0, -1, 0));
    CHECK(body<Cylinder>(x, 3) == Cylinder{DVec3(0), {0, 0, -5}, 1});
    CHECK(body<Sphere>(x, 4) == Sphere{DVec3(0), .1});
    CHECK(body<Cylinder>(x, 5) == Cylinder{DVec3(0), {1, 0, 0}, .1});
    CHECK(body<Sphere>(x, 6) == Sphere{{1, 0, 0}, .1});
    CHECK(x.warnings == Told{"x:9: FCYLINDER is an open tube in Tachyon; here it is closed"});

    for (const DVec3& normal : {DVec3(1, 0, 0), DVec3(0, 0, -1), DVec3(1, 2, -3), DVec3(-.1, 1e-9, 5)}) {
        const Imported y = imported(eye + "PLANE CENTER 1e6 7 3 NORMAL " + std::to_string(normal.x) + " " +
                                    std::to_string(normal.y) + " " + std::to_string(normal.z) + " " + white);
        const DVec3 n = body<Plane>(y).normal();
        const double length = std::hypot(normal.x, normal.y, normal.z);
        for (int i = 0; i < 3; ++i) CHECK(std::fabs(n[i] - (i == 2 ? -1 : 1) * normal[i] / length) < 1e-6);
    }
}

TEST_CASE("Tachyon: what has no counterpart is told, and something near is done") {
    const Imported x = imported(eye + "DIRECTIONAL_LIGHT DIRECTION 0 -1 2 COLOR 1 1 1\nSPHERE CENTER 0 0 40 RAD 2 " +
                                white + "CYLINDER CENTER 0 0 0 AXIS 0 2 0 RAD 1 " + white);
    CHECK(x.scene.lights.at(0).position == DVec3(0, 5e5, 1e6));
    CHECK(body<Cylinder>(x, 1) == Cylinder{{0, -1e6, 0}, {0, 1e6, 0}, 1});
    CHECK(x.warnings == Told{"x:4: lights have a place: this directional light becomes one far away",
                             "x:6: cylinders have ends: this endless one gets them far away"});

    const Imported faded = imported(eye + "SHADER_MODE FULL TRANS_VMD END_SHADER_MODE\nSPHERE CENTER 0 0 0 RAD 1 " +
                                    "TEXTURE AMBIENT .1 DIFFUSE .8 SPECULAR .2 OPACITY .5 COLOR 1 1 1 TEXFUNC 0\n");
    CHECK(material(faded).ambient == .05);
    CHECK(material(faded).diffuse == .4);
    CHECK(material(faded).reflection == .1);
    CHECK(faded.warnings.empty());

    const Imported open = imported(
        eye + "SHADER_MODE FULL AMBIENT_OCCLUSION AMBIENT_COLOR .5 .5 .5 RESCALE_DIRECT .6 " +
        "SAMPLES 9 END_SHADER_MODE\nLIGHT CENTER 0 0 0 RAD 0 COLOR 1 1 1\n" + "SPHERE CENTER 0 0 0 RAD 1 " + white);
    CHECK(material(open).ambient == .5);
    CHECK(open.scene.lights.at(0).color == Color(.6));

    for (const char* const text :
         {"FOG START 0 END 1 DENSITY 1 COLOR 1 1 1", "FOG LINEAR START 0 END 1 DENSITY 1 COLOR 1 1 1",
          "LIGHT CENTER 0 0 0 RAD 1 COLOR 1 1 1", "INCLUDE other.dat",
          "LIGHT CENTER 0 0 0 RAD 0 ATTENUATION CONSTANT 1 LINEAR 0 QUADRATIC 0 COLOR 1 1 1",
          "SPOTLIGHT CENTER 0 0 0 RAD 0 DIRECTION 0 0 1 FALLOFF_START .1 FALLOFF_END .2 COLOR 1 1 1",
          "START_CLIPGROUP NUMPLANES 1 0 0 1 5 END_CLIPGROUP", "SPHERE CENTER 0 0 0 RAD 1 nowhere",
          "SKY_LIGHT NUMSAMPLES 9 COLOR 1 1 1", "SCAPE RES 9 9 SCALE 1 1 CENTER 0 0 0 nowhere",
          "SPHERE CENTER 0 0 0 RAD 0 TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0",
          "TEXDEF a AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 7 b.ppm CENTER 0 0 0 ROTATE 0 0 0 "
          "SCALE 1 1 1",
          "TEXDEF a AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 OUTLINE 1 OUTLINE_WIDTH .5 COLOR 1 1 1 TEXFUNC 0",
          "TEXDEF a AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 PHONG METAL 1 PHONG_SIZE 9 COLOR 1 1 1 TEXFUNC 0",
          "IMAGEDEF ::a FORMAT RGB24 RESOLUTION 2 1 1 ENCODING HEX fff 000", "SHADER_MODE LOW END_SHADER_MODE",
          "BACKGROUND_GRADIENT SKY_SPHERE UPDIR 0 1 0 TOPVAL 1 BOTTOMVAL 0 TOPCOLOR 1 1 1 BOTTOMCOLOR 0 0 0"}) {
        INFO(text);
        const Told told =
            imported(eye + text + "\n" + (text == std::string("") ? "" : "LIGHT CENTER 0 0 0 RAD 0 COLOR 1 1 1"))
                .warnings;
        CHECK(!told.empty());
        for (const std::string& warning : told) CHECK(warning.starts_with("x:4: "));
    }
    const std::string a = "TEXDEF a " + white.substr(8), b = "TEXDEF a AMBIENT 1" + white.substr(17);
    CHECK(material(imported(eye + a + b + "SPHERE CENTER 0 0 0 RAD 1 a")).ambient == 0);
    CHECK(imported(eye + a + b).warnings.size() == 1);
    CHECK(imported(eye + a + a).warnings.empty());
}

TEST_CASE("Tachyon: errors have a place") {
    CHECK(fault("BEGIN_SCENE RESOLUTION 0 5") == "x:1:24: RESOLUTION must be a whole number from 1 to 1048576");
    CHECK(fault("BEGIN_SCENE RESOLUTION 5 5\nEND_SCENE").starts_with("x:2:10: this scene has no camera"));
    CHECK(fault(eye + "SPHERE CENTRE 0 0 0") == "x:4:8: 'CENTER' expected, but here comes 'CENTRE'");
    CHECK(fault(eye + "BALL") == "x:4:1: Tachyon has no declaration 'BALL'");
    CHECK(fault(eye + "POLYCYLINDER POINTS 1000000000 1 2 3").starts_with("x:4:37: a number expected for a point"));
    CHECK(
        fault(eye + "VERTEXARRAY NUMVERTS 1000000000 COORDS 1").starts_with("x:4:41: a number expected for a vertex"));
    CHECK(fault(eye + "VERTEXARRAY NUMVERTS 1 COORDS 1 1 1 NORMALS 1 1 1 TRIMESH 1 0 0 1") ==
          "x:4:65: a vertex's number must be a whole number from 0 to 0");
    CHECK(fault(eye + "VERTEXARRAY NUMVERTS 0 COORDS NORMALS TRIMESH 1 0 0 1") ==
          "x:4:47: there are triangles, but no vertices");
    CHECK(fault(eye + "IMAGEDEF a FORMAT RGB24 RESOLUTION 1000000 1000000 1000000 ENCODING HEX fff")
              .ends_with("the file ends"));
    CHECK(fault("BEGIN_SCENE RESOLUTION 5 5\nCAMERA ZOOM 0 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 1 CENTER 0 0 0 "
                "VIEWDIR 0 0 1 UPDIR 0 1 0 END_CAMERA")
              .find("the camera sees nothing") != std::string::npos);
}

TEST_CASE("polygons are cut into triangles that cover them") {
    const auto area = [](const std::vector<DVec3>& corners, const Triangles& cut) {
        double sum = 0;
        for (const auto& [a, b, c] : cut.list)
            sum += (corners[b].x - corners[a].x) * (corners[c].y - corners[a].y) -
                   (corners[b].y - corners[a].y) * (corners[c].x - corners[a].x);
        return sum / 2;
    };
    const std::vector<DVec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    CHECK(triangles_of(square, 0).list.size() == 2);
    CHECK(area(square, triangles_of(square, 0)) == 1);
    // A comb with teeth; either way round, and with each corner as the first.
    std::vector<DVec3> comb{{9, 0, 0}, {9, -1, 0}, {0, -1, 0}};
    for (int i = 0; i < 9; ++i) comb.push_back({double(i), 0, 0}), comb.push_back({i + .5, 5, 0});
    for (std::size_t i = 0; i < comb.size(); ++i) {
        std::rotate(comb.begin(), comb.begin() + 1, comb.end());
        const Triangles cut = triangles_of(comb, 100);
        CHECK(cut.list.size() == comb.size() - 2 - (cut.list.size() < comb.size() - 2));
        CHECK(area(comb, cut) == doctest::Approx(9 + 9 * 2.5));
        CHECK(!cut.crossing);
        const std::vector<DVec3> back(comb.rbegin(), comb.rend());
        CHECK(area(back, triangles_of(back, 100)) == doctest::Approx(-31.5));
        CHECK(triangles_of(comb, 20).too_long);
    }
    // A square with a square hole, reached by a seam.
    const std::vector<DVec3> frame{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                   {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    CHECK(area(frame, triangles_of(frame, 100)) == 12);
    CHECK(!triangles_of(frame, 100).crossing);
    CHECK(triangles_of(std::vector<DVec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, 9).list.empty());
    CHECK(triangles_of(std::vector<DVec3>{{0, 0, 0}, {4, 1, 0}, {4, 0, 0}, {0, 1, 0}, {2, 5, 0}}, 9).list.size() == 3);
}

// NFF: its entities as bodies, warnings, and the places of errors.
#include "tests/unit/import/import.h"

using namespace strahl;
using namespace strahl::importing;

TEST_CASE("NFF: camera, background and lights") {
    const Imported x =
        imported(view + "b .1 .2 .3\nl 4 3 2\nl 1 -4 4 .5 .6 .7\n# l 9 9 9\nl 0 0 9 # a comment\nl 1 1 1");
    CHECK(x.scene.camera ==
          Camera{.position = {2, 1, 3}, .look_at = DVec3(0), .up = {0, 0, -1}, .fov = 22.5, .aspectratio = {}});
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
    CHECK(material(x, 2).rgb == Pigment(0, 0, 1));
    CHECK(material(x, 2).ior == 1);
    CHECK(body<Cone>(x, 2) == Cone{DVec3(0), 1, {0, 0, 2}, 0});
    CHECK(body<Sphere>(x, 3).radius == 2);
    CHECK(x.warnings == Told{"x:11: cones and cylinders are open tubes in NFF; here they are closed (and in line 13)",
                             "x:14: a negative radius: bodies are seen from both sides"});
}

TEST_CASE("NFF: polygons") {
    const std::string grey = "f 1 1 1 1 0 0 0 0\n", triangle = "p 3\n0 0 0\n1 0 0\n0 1 0\n";
    const Imported one =
        imported(view + grey + triangle + "s 1 2 3 1\n" + "pp 3 0 0 0 0 0 2 1 0 0 0 1 1 0 1 0 1 0 1\n");
    CHECK(body<Triangle>(one) == Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(body<Sphere>(one, 1) == Sphere{{1, 2, 3}, 1});
    CHECK(body<SmoothTriangle>(one, 2) ==
          SmoothTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {0, 1, 1}, {1, 0, 1}});
    CHECK(one.warnings.empty());

    // Polygons that follow one another share their corners; another material, another body or normals end the run.
    const std::string square = "p 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const Imported mesh = imported(view + grey + square + "p 3 1 0 0 2 0 0 1 1 0\n" + "f 1 0 0 1 0 0 0 0\n" + square +
                                   "pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n");
    REQUIRE(mesh.scene.primitives.size() == 3);
    const MeshData& data = *body<Mesh>(mesh).data;
    CHECK(data.points == std::vector<DVec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}});
    CHECK(data.triangles == std::vector<MeshData::Corners>{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}});
    CHECK(data.normals.empty());
    CHECK(data.corner_normals.empty());
    CHECK(body<Mesh>(mesh, 1).data->triangles.size() == 2);
    CHECK(material(mesh, 1).rgb == Pigment(1, 0, 0));
    CHECK(std::holds_alternative<SmoothTriangle>(mesh.scene.primitives[2].shape));

    const Imported bent = imported(view + grey + "pp 4 0 0 0 0 0 1 1 0 0 0 1 1 1 1 0 0 0 1 0 1 0 1 0 1\n");
    CHECK(body<Mesh>(bent).data->corner_normals == std::vector<MeshData::Corners>{{0, 1, 0}, {0, 0, 2}});
    CHECK(body<Mesh>(bent).data->normals == std::vector<DVec3>{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}});

    CHECK(imported(view + grey + "pp 3 0 0 0 0 0 0 1 0 0 0 1 1 0 1 0 1 0 1\n" +
                   "p 3 0 0 0 1 1 1 2 2 2\np 3 0 0 0 1 1 1 1e10 0 0")
              .warnings == Told{"x:9: a normal without a direction: this polygon is flat here",
                                "x:10: a polygon is left out: it has no area",
                                "x:11: a polygon is left out: its corners must be from -1e9 to 1e9"});
    // A comb of 1001 corners or more is not cut up.
    const auto comb = [&](int teeth) {
        std::string text = view + grey + "p " + std::to_string(2 * teeth + 2) + "\n0 -1 0\n";
        for (int i = 0; i < teeth; ++i) text += std::to_string(i) + " 5 0\n" + std::to_string(i) + ".5 0 0\n";
        return text + std::to_string(teeth) + " -1 0\n";
    };
    CHECK(body<Mesh>(imported(comb(9))).data->triangles.size() == 18);
    CHECK(imported(comb(500)).warnings ==
          Told{"x:1011: a polygon is left out: it is not convex and has more than 1000 corners"});
    ImportLimits limits;
    limits.primitives = 2;
    CHECK(fault(view + grey + square, limits) == "no error");
    CHECK(fault(view + grey + square + triangle, limits) == "x:17:5: more than 2 bodies");
}

TEST_CASE("NFF and Tachyon: a byte order mark is skipped, and UTF-16 is called so") {
    const std::string bom = "\xEF\xBB\xBF";
    for (const std::string& text : {view + "s 0 0 0 1\n", eye + "END_SCENE\n"}) {
        CHECK(imported(bom + text).scene == imported(text).scene);
        CHECK(imported(bom + text).warnings == imported(text).warnings);
        std::string wide = "\xFF\xFE";
        for (const char c : text) wide.append(1, c).append(1, '\0');
        CHECK(message(wide) == "x: this text is in UTF-16; save the file as UTF-8");
        CHECK(message(wide.substr(2)) == "x: this text is in UTF-16; save the file as UTF-8");
    }
}

TEST_CASE("NFF: warnings") {
    CHECK(imported("v from 1 0 0 at 0 0 0 up 0 0 1 angle 45 hither .5").warnings ==
          Told{"x:1: 'hither': bodies that are nearer are shown too"});
    CHECK(imported(view + "f 1 1 1 1 0 0 0 0\ns 0 0 0 0\ns 1 1 1 1\ns 1e99 0 0 1\n").warnings ==
          Told{"x:9: a sphere is left out: its radius must be greater than 0 and at most 1e9",
               "x:11: a sphere is left out: its centre must be from -1e9 to 1e9"});
    CHECK(imported(view + "f -1 1 1 1 1.5 0 0 0\ns 0 0 0 1").warnings ==
          Told{"x:8: the material's rgb is -1; 0 instead", "x:8: the material's reflection is 1.5; 1 instead"});
    CHECK(imported(view + "s 0 0 0 1\ns 0 0 1 1\n").warnings ==
          Told{"x:8: no material: there is no 'f' before this body; it gets the default material"});
    const std::string grey = view + "f 1 1 1 1 0 0 0 0\n";
    CHECK(imported(grey + "c 1 2 3 1 1 2 3 1").warnings.at(1) ==
          "x:9: a cylinder is left out: base and cap are the same point");
    CHECK(imported(grey + "s 0 0 0 -1 s 0 0 0 -1").warnings ==
          Told{"x:9: a negative radius: bodies are seen from both sides"});
    for (const std::string end : {"\n", "\r", "\r\n"})
        CHECK(imported(grey + end + "# a comment" + end + end + "s 0 0 0 -1").warnings.at(0).starts_with("x:12: "));
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
          "x:9:7: a number expected for the centre, but found 'nan'\n    s 1 2 nan 4\n          ^~~");
    for (const char* const number : {"inf", "-inf", "1e999", "0x10", "1.2.3", "+-1", "--1", "1,", "."})
        CHECK(fault(view + "s 1 2 3 " + number).starts_with("x:8:9: a number expected for the radius"));
    for (const char* const number : {"1", "+1", "1.", ".5", "1e3", "-0"})
        CHECK(fault(view + "s 1 2 " + number + " 3") == "no error");
    CHECK(fault("") == "x:1:1: this scene has no camera: an entity 'v' expected, but the file ends");
    CHECK(fault("s 0 0 0 1\n\n") == "x:1:10: this scene has no camera: an entity 'v' expected, but the file ends");
    CHECK(fault(view + view) == "x:8:1: a second 'v': a scene has one camera");
    CHECK(fault(view + "q 1") ==
          "x:8:1: unknown entity 'q'; NFF has v, b, l, f, s, c, p and pp. (A scene of Tachyon starts with "
          "BEGIN_SCENE.)");
    CHECK(fault("nff\nversion 2.0\n") ==
          "x:1:1: this is the NFF of the WorldToolKit, another format; E. Haines' NFF "
          "expected, but found 'nff'");
    CHECK(fault("v\nfrom 0 0 0\nat 0 0 0\nup 0 0 1\nangle 45\n").starts_with("x:5:7: invalid camera"));
    CHECK(fault("v\nangle 180\n") == "x:2:7: 'angle' must be greater than 0 and less than 180 degrees");
    CHECK(fault("v\nfrom 0 0 1\nb 1 1 1").starts_with("x:3:1: 'from', 'at', 'up' and 'angle' expected"));
    CHECK(fault(view + "b 1 -1 0") == "x:8:5: the background must be three numbers from 0 to 1e9");
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

// Tachyon's scenes: their bodies, warnings, and the places of errors.
#include <cmath>

#include "tests/unit/import/import.h"

using namespace strahl;
using namespace strahl::importing;

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

TEST_CASE("Tachyon: parallel light, spotlights, fog and skies") {
    const Imported lit = imported(eye +
                                  "DIRECTIONAL_LIGHT DIRECTION 0 -1 2 COLOR 1 .5 1\nSPOTLIGHT CENTER 1 2 3 RAD 0 "
                                  "DIRECTION 0 0 2 FALLOFF_START 20 FALLOFF_END 45 COLOR 1 1 0\n");
    CHECK(lit.scene.lights.at(0) == Light{.color = {1, .5, 1}, .direction = DVec3(0, -1, -2)});
    CHECK(lit.scene.lights.at(1) ==
          Light{.position = {1, 2, -3}, .color = {1, 1, 0}, .spot = Spot{{1, 2, -5}, 20, 45}});
    CHECK(lit.warnings.empty());

    const Imported foggy = imported(eye + "FOG EXP START 0 END 9 DENSITY .1 COLOR 1 .5 .2");
    CHECK(foggy.scene.fog == Fog{10, {1, .5, .2}});
    CHECK(foggy.warnings.empty());
    CHECK(imported(eye + "FOG START 0 END 9 DENSITY .1 COLOR 1 .5 .2").scene.fog == std::nullopt);

    const std::string gradient = eye + "BACKGROUND_GRADIENT SKY_SPHERE UPDIR 0 0 2 TOPVAL .9 BOTTOMVAL -.3 ";
    const Imported sky = imported(gradient + "TOPCOLOR 1 0 0 BOTTOMCOLOR 0 0 1");
    REQUIRE(sky.scene.background.pattern);
    const Pattern& pattern = *sky.scene.background.pattern;
    CHECK(std::get<Gradient>(pattern.kind).axis == DVec3(0, 0, -1));
    CHECK(pattern.colors == std::vector<ColorStop>{{.4, {0, 0, 1}}, {.8, {1, 0, 0}}});
    const auto at = glm::inverse(matrix(pattern.transformations)) * glm::dvec4(0, 0, .9, 1);  // .9 down
    CHECK(-at.z == doctest::Approx(.2));                                                      // (-.9 + 1.5) / 3
    CHECK(sky.warnings.empty());
}

TEST_CASE("Tachyon: bodies and textures") {
    const Imported x = imported(
        eye +
        "TEXDEF a AMBIENT .1 DIFFUSE .8 SPECULAR .2 OPACITY .7 PHONG PLASTIC .5 PHONG_SIZE 40 COLOR 1 .5 .2 "
        "TEXFUNC 0\nTEXALIAS b a\n"
        "SPHERE CENTER 1 2 3 RAD 4 a\nBOX MIN 0 0 0 MAX 1 2 3 b\nPLANE CENTER 0 -1 0 NORMAL 0 2 0 " +
        white + "FCYLINDER BASE 0 0 0 APEX 0 0 5 RAD 1 a\nPOLYCYLINDER POINTS 2 0 0 0 1 0 0 RAD .1 a\n" +
        "RING CENTER 1 2 3 NORMAL 0 1 1 INNER .5 OUTER 2 a\nRING CENTER 1 2 3 NORMAL 0 1 1 INNER 2 OUTER 2 a\n");
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
    CHECK(body<Disc>(x, 7) == Disc{{1, 2, -3}, {0, 1, -1}, 2, .5});
    CHECK(x.warnings == Told{"x:9: FCYLINDER is an open tube in Tachyon; here it is closed",
                             "x:12: a disc is left out: the hole is as large as the disc"});

    for (const DVec3& normal : {DVec3(1, 0, 0), DVec3(0, 0, -1), DVec3(1, 2, -3), DVec3(-.1, 1e-9, 5)}) {
        const Imported y = imported(eye + "PLANE CENTER 1e6 7 3 NORMAL " + std::to_string(normal.x) + " " +
                                    std::to_string(normal.y) + " " + std::to_string(normal.z) + " " + white);
        const DVec3 n = body<Plane>(y).normal();
        const double length = std::hypot(normal.x, normal.y, normal.z);
        for (int i = 0; i < 3; ++i) CHECK(std::fabs(n[i] - (i == 2 ? -1 : 1) * normal[i] / length) < 1e-6);
    }
}

TEST_CASE("Tachyon: triangles and vertex arrays") {
    const std::string corners = "V0 0 0 1 V1 1 0 1 V2 0 1 1 ", normals = "N0 0 0 1 N1 0 1 1 N2 1 0 1 ";
    const Imported x =
        imported(eye + "TRI " + corners + white + "STRI " + corners + normals + white + "VCSTRI " + corners + normals +
                 "C0 1 0 0 C1 0 .5 0 C2 .5 1 0 AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 VCST\n");
    CHECK(body<Triangle>(x) == Triangle{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}});
    CHECK(body<SmoothTriangle>(x, 1) ==
          SmoothTriangle{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, -1}, {0, 1, -1}, {1, 0, -1}});
    CHECK(material(x, 2).rgb == Pigment(.5, .5, 0));
    CHECK(x.warnings == Told{"x:6: the corners' colours: each triangle has their mean"});

    const std::string vertices =
        "VERTEXARRAY NUMVERTS 4 COORDS 0 0 0 1 0 0 0 1 0 1 1 0 "
        "NORMALS 0 0 1 0 0 1 0 0 1 0 0 1\n";
    const Imported strip = imported(eye + vertices + white + "TRISTRIP 4 0 1 2 3 TRIMESH 1 3 2 1 END_VERTEXARRAY");
    CHECK(body<Mesh>(strip).data->triangles == std::vector<MeshData::Corners>{{0, 1, 2}, {2, 1, 3}, {3, 2, 1}});
    CHECK(body<Mesh>(strip).data->points.size() == 4);
    CHECK(strip.warnings.empty());
    const Imported colored =
        imported(eye + vertices + "COLORS 1 0 0 1 0 0 1 0 0 1 0 .6\n" + white + "TRISTRIP 4 0 1 2 3 END_VERTEXARRAY");
    REQUIRE(colored.scene.primitives.size() == 2);
    CHECK(material(colored, 0).rgb == Pigment(1, 0, 0));
    CHECK(material(colored, 1).rgb.color.z == doctest::Approx(.2));
    CHECK(colored.warnings == Told{"x:5: COLORS: each triangle has the mean of its corners' colours"});
}

TEST_CASE("Tachyon: features without a counterpart are reported and replaced by something near") {
    const Imported x =
        imported(eye + "SPHERE CENTER 0 0 40 RAD 2 " + white + "CYLINDER CENTER 0 0 0 AXIS 0 2 0 RAD 1 " + white);
    CHECK(body<Cylinder>(x, 1) == Cylinder{{0, -1e6, 0}, {0, 1e6, 0}, 1});
    CHECK(x.warnings == Told{"x:5: an endless cylinder: it ends far away here"});

    CHECK(imported(eye + "CYLINDER CENTER 9e14 0 0 AXIS 1 0 0 RAD 1 " + white).scene.primitives.empty());

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
         {"FOG EXP START 2 END 1 DENSITY 1 COLOR 1 1 1", "FOG LINEAR START 0 END 1 DENSITY 1 COLOR 1 1 1",
          "LIGHT CENTER 0 0 0 RAD 1 COLOR 1 1 1", "INCLUDE other.dat",
          "LIGHT CENTER 0 0 0 RAD 0 ATTENUATION CONSTANT 1 LINEAR 0 QUADRATIC 0 COLOR 1 1 1",
          "SPOTLIGHT CENTER 0 0 0 RAD 0 DIRECTION 0 0 0 FALLOFF_START 1 FALLOFF_END 2 COLOR 1 1 1",
          "SPOTLIGHT CENTER 0 0 0 RAD 0 DIRECTION 0 0 1 FALLOFF_START 5 FALLOFF_END 2 COLOR 1 1 1",
          "DIRECTIONAL_LIGHT DIRECTION 0 0 0 COLOR 1 1 1", "START_CLIPGROUP NUMPLANES 1 0 0 1 5 END_CLIPGROUP",
          "SPHERE CENTER 0 0 0 RAD 1 nowhere", "SKY_LIGHT NUMSAMPLES 9 COLOR 1 1 1",
          "SCAPE RES 9 9 SCALE 1 1 CENTER 0 0 0 nowhere",
          "SPHERE CENTER 0 0 0 RAD 0 TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0",
          "TEXDEF a AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 7 b.ppm CENTER 0 0 0 ROTATE 0 0 0 "
          "SCALE 1 1 1",
          "TEXDEF a AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 OUTLINE 1 OUTLINE_WIDTH .5 COLOR 1 1 1 TEXFUNC 0",
          "TEXDEF a AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 PHONG METAL 1 PHONG_SIZE 9 COLOR 1 1 1 TEXFUNC 0",
          "IMAGEDEF ::a FORMAT RGB24 RESOLUTION 2 1 1 ENCODING HEX fff 000", "SHADER_MODE LOW END_SHADER_MODE",
          "BACKGROUND_GRADIENT SKY_ORTHO_PLANE UPDIR 0 1 0 TOPVAL 1 BOTTOMVAL 0 TOPCOLOR 1 1 1 BOTTOMCOLOR 0 0 0"}) {
        INFO(text);
        const Told told = imported(eye + text + "\nLIGHT CENTER 0 0 0 RAD 0 COLOR 1 1 1").warnings;
        CHECK(!told.empty());
        for (const std::string& warning : told) CHECK(warning.starts_with("x:4: "));
    }
    const std::string a = "TEXDEF a " + white.substr(8), b = "TEXDEF a AMBIENT 1" + white.substr(17);
    CHECK(material(imported(eye + a + b + "SPHERE CENTER 0 0 0 RAD 1 a")).ambient == 0);
    CHECK(imported(eye + a + b).warnings.size() == 1);
    CHECK(imported(eye + a + a).warnings.empty());
}

TEST_CASE("Tachyon: what comes out stays in the range of the language") {
    const std::string camera = "BEGIN_SCENE RESOLUTION 9 9 CAMERA PROJECTION ";
    const std::string rest = " ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 999 CENTER 0 0 0 VIEWDIR 0 0 1 UPDIR 0 1 0 ";
    CHECK(imported(camera + "PERSPECTIVE ZOOM 1e-10" + rest + "END_CAMERA").scene.camera.fov < 90);
    CHECK(imported(camera + "PERSPECTIVE ZOOM 1e10" + rest + "END_CAMERA").scene.camera.fov > 0);
    CHECK(imported(camera + "ORTHOGRAPHIC ZOOM 1" + rest + "FRUSTUM -1e-305 1e-305 -1e-305 1e-305 END_CAMERA")
              .scene.camera.fov > 0);
    const Camera parallel = imported(camera + "ORTHOGRAPHIC ZOOM .25" + rest + "END_CAMERA").scene.camera;
    CHECK(parallel.projection == Projection::orthographic);
    CHECK(frame_of(parallel, 1).tan_x == doctest::Approx(2));
    CHECK(imported(camera + "FISHEYE ZOOM 1" + rest + "FRUSTUM -3 3 -1 1 END_CAMERA").scene.camera.fov ==
          doctest::Approx(60));
    CHECK(imported(eye +
                   "SKY_LIGHT NUMSAMPLES 1 COLOR 1e9 1e9 1e9 SPHERE CENTER 0 0 0 RAD 1 TEXTURE AMBIENT 1 DIFFUSE 9 " +
                   "SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0\n")
              .scene.materials.at(0)
              .ambient == 1e9);
    CHECK(imported(eye + "SHADER_MODE FULL AMBIENT_OCCLUSION AMBIENT_COLOR 0 0 0 RESCALE_DIRECT 1e9 SAMPLES 1 " +
                   "END_SHADER_MODE LIGHT CENTER 0 0 0 RAD 0 COLOR 1e9 1 0")
              .scene.lights.at(0)
              .color == Color(1e9, 1e9, 0));
}

TEST_CASE("Tachyon: errors have a place") {
    CHECK(fault("BEGIN_SCENE RESOLUTION 0 5") == "x:1:24: RESOLUTION must be a whole number from 1 to 1048576");
    CHECK(fault("BEGIN_SCENE RESOLUTION 5 5\nEND_SCENE").starts_with("x:2:10: this scene has no camera"));
    CHECK(fault(eye + "SPHERE CENTRE 0 0 0") == "x:4:8: 'CENTER' expected, but found 'CENTRE'");
    CHECK(fault(eye + "BALL") == "x:4:1: unknown declaration 'BALL'");
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
              .find("invalid camera") != std::string::npos);
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

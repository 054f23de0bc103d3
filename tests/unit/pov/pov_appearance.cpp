// Textures, lights, cameras and settings of POV-Ray's scenes, and what is told about those that scenes cannot hold.
#include <cmath>

#include "files/output_file.h"
#include "num/vec_math.h"
#include "scene/camera.h"
#include "tests/unit/pov/opened.h"
#include "tests/unit/scratch.h"

using namespace strahl;

TEST_CASE("POV-Ray: cameras have POV-Ray's axes") {
    struct Row {
        const char* text;
        DVec3 forward, right;  // in POV-Ray's coordinates
        double tan_x, tan_y;
    };
    const double t = std::tan(20 * 3.14159265358979323846 / 180);
    for (const Row& row : {Row{"", {0, 0, 1}, {1, 0, 0}, .665, .5}, Row{"angle 90", {0, 0, 1}, {1, 0, 0}, 1, 1 / 1.33},
                           Row{"right -2*x", {0, 0, 1}, {-1, 0, 0}, 1, .5},
                           Row{"location y look_at <0, 1, 5> angle 40", {0, 0, 1}, {1, 0, 0}, t, t / 1.33},
                           Row{"look_at x right x", {1, 0, 0}, {0, 0, -1}, .5, .5},
                           Row{"look_at x right -x", {1, 0, 0}, {0, 0, 1}, .5, .5},
                           Row{"sky z look_at y right -x", {0, 1, 0}, {1, 0, 0}, .5, .5},
                           Row{"direction 2*z", {0, 0, 1}, {1, 0, 0}, .3325, .25},
                           Row{"sky z direction -x right -x location z look_at 0", {0, 0, -1}, {1, 0, 0}, .5, .5},
                           Row{"look_at z rotate 90*y", {1, 0, 0}, {0, 0, -1}, .665, .5}}) {
        CAPTURE(row.text);
        const Scene scene = whole("camera { " + std::string(row.text) + " }", false);
        const CameraFrame frame = frame_of(scene.camera, 4. / 3);
        // The mirrored scene shows what the file means.
        const bool same = length(frame.forward - row.forward) < 1e-12 && length(frame.right - row.right) < 1e-12;
        const DVec3 z(1, 1, -1);
        const bool mirrored =
            length(frame.forward - z * row.forward) < 1e-12 && length(frame.right - z * row.right) < 1e-12;
        CHECK((same || mirrored));
        CHECK(frame.tan_x == doctest::Approx(row.tan_x).epsilon(1e-12));
        CHECK(frame.tan_y == doctest::Approx(row.tan_y).epsilon(1e-11));
    }
    CHECK(whole("camera { location -3*z angle 40 look_at 0 }", false).camera.fov == 20);
}

TEST_CASE("POV-Ray: cameras of other projections") {
    struct Row {
        const char* text;
        Projection projection;
        double x, y;  // half the picture
    };
    const double t = std::tan(20 * 3.14159265358979323846 / 180), degree = 3.14159265358979323846 / 180;
    for (const Row& row :
         {Row{"orthographic", Projection::orthographic, .665, .5},
          Row{"orthographic location -9*z look_at 0", Projection::orthographic, 9 * .665, 4.5},
          Row{"orthographic location -9*z right 3*x look_at 0", Projection::orthographic, 1.5, .5},
          Row{"orthographic location -9*z right 3*x look_at 0 angle 40", Projection::orthographic, 9 * t, 3 * t},
          Row{"orthographic location -9*z right 3*x look_at 0 angle 0", Projection::orthographic, 9 * 1.5, 4.5},
          Row{"orthographic location -9*z up 2*y rotate 20*y", Projection::orthographic, .665, 1},
          Row{"fisheye angle 160", Projection::fisheye, 1.33 * 80 * degree, 80 * degree},
          Row{"ultra_wide_angle angle 160", Projection::ultra_wide_angle, 80 * degree, 80 / 1.33 * degree},
          Row{"spherical", Projection::spherical, 180 * degree, 90 * degree},
          Row{"spherical angle 90 30", Projection::spherical, 45 * degree, 15 * degree},
          Row{"panoramic angle 60", Projection::panoramic, .665, .5},
          Row{"cylinder 1 angle 60 up 2*y", Projection::cylinder, 30 * degree, 1},
          Row{"cylinder 2 angle 60 right 3*x", Projection::cylinder2, 1.5, 30 * degree},
          Row{"cylinder 3 angle 60 up 2*y", Projection::cylinder3, 30 * degree, 1},
          Row{"cylinder 4 angle 60 right 3*x", Projection::cylinder4, 1.5, 30 * degree}}) {
        CAPTURE(row.text);
        const Camera camera = whole("camera { " + std::string(row.text) + " }", false).camera;
        const CameraFrame frame = frame_of(camera, 4. / 3);
        CHECK(camera.projection == row.projection);
        CHECK(frame.tan_x == doctest::Approx(row.x).epsilon(1e-12));
        CHECK(frame.tan_y == doctest::Approx(row.y).epsilon(1e-11));
    }
    CHECK(whole("camera { orthographic location -3*z angle 40 look_at 0 }", false).camera.fov == 20);
    // A lens is a quarter of the aperture, sharp at the distance of focal_point, or else as far as `direction` is long.
    const auto lens = [](const std::string& words) {
        const Camera own = opened("camera { location -3*z " + words + " }", false).scene.camera;
        return std::pair(own.aperture, own.focus.value_or(-1));
    };
    CHECK(lens("aperture 2 focal_point <3, 0, 1> blur_samples 4, 9") == std::pair(.5, 5.));
    CHECK(lens("focal_point <4, 4, 4> aperture 2 blur_samples 9 direction 2*z") == std::pair(.5, 9.));
    CHECK(lens("aperture -.4 blur_samples 4 direction 2*z") == std::pair(.1, 2.));
    CHECK(lens("aperture 2 focal_point 1") == std::pair(0., -1.));  // POV-Ray takes no samples
}

TEST_CASE("POV-Ray: finishes and pigments") {
    const auto of = [](const std::string& text) { return material(whole("sphere { 0, 1 " + text + " }")); };
    CHECK(of("") ==
          Material{.rgb = {0, 0, 0}, .reflection = 0, .diffuse = .6, .ambient = .1, .specular = 0, .pow = 40});
    const Material shiny =
        of("pigment { rgb .2 } finish { phong .7 phong_size 25 reflection .3 ambient 0 diffuse .9 }");
    CHECK(shiny ==
          Material{.rgb = {.2, .2, .2}, .reflection = .3, .diffuse = .9, .ambient = 0, .specular = .7, .pow = 25});
    CHECK(material(whole("#declare P = pigment { rgb x } sphere { 0, 1 pigment { uv_mapping P } }")).rgb ==
          Color(1, 0, 0));
    const Material clear = of("pigment { rgb 1 transmit .75 } finish { reflection .25 } interior { ior 1.5 }");
    CHECK(clear.refraction == .75);
    CHECK(clear.ior == 1.5);
    CHECK(clear.diffuse == .15);
    CHECK(clear.ambient == .025);
    // Layers: what the upper one lets through falls on the lower one.
    CHECK(of("texture { pigment { rgb x } } texture { pigment { rgb 0 transmit .5 } finish { ambient 0 diffuse 0 } }")
              .diffuse == .3);
}

TEST_CASE("POV-Ray: what only its finishes have") {
    const auto of = [](const std::string& text) { return material(whole("sphere { 0, 1 " + text + " }")); };
    const Material brass =
        of("pigment { rgb <.8, .6, .2> } finish { ambient rgb <.1, .05, 0> diffuse .4 brilliance 3 specular .8 "
           "roughness .02 metallic reflection { .1, .5 falloff 2 metallic .7 } }");
    CHECK(brass.ambient == .1);
    CHECK(brass.glow == Color(1, .5, 0));
    CHECK(brass.brilliance == 3);
    CHECK(brass.blinn == .8);
    CHECK(brass.roughness == .02);
    CHECK(brass.metallic == 1);
    CHECK(brass.reflection == .5);
    CHECK(brass.facing == .2);
    CHECK(brass.falloff == 2);
    CHECK(brass.gilding == .7);
    const Material stained = of("pigment { rgbft <1, .5, 0, .5, .25> } no_shadow");
    CHECK(stained.rgb.filter == .5);
    CHECK(stained.rgb.transmit == .25);
    CHECK(stained.diffuse == .6);
    CHECK(stained.shadow == 0);
    // Colours that filter light differ from place to place.
    const Material pane =
        of("pigment { gradient x color_map { [0 rgbf <1, .5, 0, 1>] [1 rgbf 1] } } finish { ambient 0 diffuse 0 }");
    CHECK((pane.rgb.pattern && pane.rgb.filter == 1));
    // Rays go by what POV-Ray keeps in single precision.
    const Material bent =
        of("pigment { granite color_map { [.3 rgbt 1] [.7 rgbt .5] } } normal { granite .035 } "
           "interior { ior 1.1 }");
    CHECK((bent.ior == 1.1f && bent.bump.height == .035f));
    REQUIRE(bent.rgb.pattern);
    CHECK(bent.rgb.pattern->colors.at(0).at == .3f);
    const Material frugal = of("pigment { rgbt <1, 1, 1, .5> } finish { reflection { .1, .9 } conserve_energy }");
    CHECK((frugal.conserve == 1 && frugal.reflection == .9));
    const Material deep =
        of("pigment { rgbt 1 } interior { ior 1.5 fade_distance 2 fade_power 1001 fade_color <.5, 1, 0> } no_image "
           "no_reflection");
    CHECK((deep.fade_distance == 2 && deep.fade_power == 1001 && deep.fade_color == Color(.5, 1, 0)));
    CHECK((deep.seen == 0 && deep.mirrored == 0 && deep.shadow == 1));
    // Rays meet only the first of two bodies in one place.
    const pov::OpenedPov twins = opened("sphere { 0, 1 no_image } sphere { 0, 1 }");
    CHECK((twins.scene.primitives.size() == 1 && material(twins.scene).seen == 1));
    const Material layered = of("texture { pigment { rgb <1, .5, .5> } } texture { pigment { rgbf <0, 0, 1, .5> } }");
    REQUIRE(layered.coats.size() == 1);
    CHECK(layered.rgb.color == Color(1, .5, .5));
    CHECK(layered.coats[0].rgb.filter == .5);
    // A layer that is opaque hides those below it.
    const Material hidden = of("texture { pigment { rgb x } finish { specular 1 } } texture { pigment { rgb z } }");
    CHECK(hidden == of("pigment { rgb z }"));
    const Material bright = of("finish { reflection rgb <2, 1, .5> }"), gray = of("finish { reflection 1.5 }");
    CHECK((bright.reflection == 1 && bright.mirror == Color(2, 1, .5)));
    CHECK((gray.reflection == 1 && gray.mirror == Color(1.5)));
    // Rays that would bring less than POV-Ray follows are black.
    CHECK(whole("sphere { 0, 1 finish { specular 1 } }").settings.adc_bailout == 1. / 255);
    CHECK(whole("sphere { 0, 1 finish { phong 1 } }").settings.adc_bailout == 0);
    const Light fill = whole("light_source { 0 rgb 1 shadowless fade_distance 2 fade_power 3 }").lights.at(0);
    CHECK((fill.shadowless && fill.fade_distance == 2 && fill.fade_power == 3));
}

TEST_CASE("POV-Ray: textures that differ in their finishes are mixed by their shares") {
    const std::string a = "#declare A = texture { pigment { rgb x } finish { phong 1 } } ";
    const std::string b = "#declare B = texture { pigment { rgb y } finish { reflection .5 } } ";
    const auto of = [&](const std::string& texture) {
        return material(whole(a + b + "sphere { 0, 1 texture { " + texture + " } }"));
    };
    const Material mixed = of("gradient y texture_map { [.2 A] [.6 B] [.6 A] [1 B] }");
    REQUIRE(mixed.coats.size() == 1);
    CHECK((mixed.rgb == Pigment(Color(1, 0, 0)) && mixed.specular == 1 && mixed.reflection == 0));
    CHECK((mixed.coats[0].rgb == Pigment(Color(0, 1, 0)) && mixed.coats[0].reflection == .5));
    REQUIRE((mixed.share.pattern && mixed.coats[0].share.pattern));
    CHECK(mixed.share.pattern->colors ==
          std::vector<ColorStop>{{.2f, Color(1)}, {.6f, Color(0)}, {.6f, Color(1)}, {1, Color(0)}});
    CHECK(mixed.coats[0].share.pattern->colors ==
          std::vector<ColorStop>{{.2f, Color(0)}, {.6f, Color(1)}, {.6f, Color(0)}, {1, Color(1)}});
    // Tiles begin with the second texture; textures with one finish become one pattern of pigments.
    CHECK(of("tiles { texture { A } tile2 texture { B } }").rgb == Pigment(Color(0, 1, 0)));
    CHECK(of("checker texture { A } texture { A pigment { rgb z } }").coats.empty());
    CHECK(of("checker texture { A } texture { A pigment { rgbt <0, 0, 1, .5> } }").coats.size() == 1);
    CHECK(of("average texture_map { [1 A] [1 A] }").coats.empty());
    // A texture that stands in several places of maps counts once, also where turbulence moves it.
    const std::string inner =
        "#declare C = texture { pigment { granite } normal { bumps } } #declare N = texture { bozo "
        "texture_map { [0 C] [.3 B] [.6 C] [.9 B] } turbulence 1 scale 1.5 } ";
    const Scene turned = whole(
        a + b + inner + "sphere { 0, 1 texture { gradient y texture_map { [0 A] [.2 N] [.5 N] [.8 N] [1 A] } } }");
    CHECK(material(turned).coats.size() == 2);
    const Scene corners = whole(a + b +
                                "mesh2 { vertex_vectors { 4, 0, x, y, x + y } texture_list { 3, texture { A } texture "
                                "{ B } texture { B } } face_indices { 2, <0, 1, 2>, 0, 1, 2, <1, 2, 3>, 1, 2, 1 } }");
    REQUIRE(corners.primitives.size() == 2);
    CHECK(corners.materials[0].coats.empty());
    CHECK((corners.materials[1].coats.size() == 1 && corners.materials[1].share.pattern->by_uv));
    // Many textures, and textures that hold each other many times, are told.
    std::string many = a + b + "#declare T0 = texture { checker texture { A } texture { B } } ";
    for (int i = 0; i < 30; ++i) {
        const std::string inner = "texture { T" + std::to_string(i) + " } ";
        many += "#declare T" + std::to_string(i + 1) + " = texture { checker " + inner + inner + "} ";
    }
    const auto told = opened(many + "sphere { 0, 1 texture { T30 } }");
    CHECK(!told.notes.empty());
}

TEST_CASE("POV-Ray: an interior_texture is the inner side of a material, in the space of the body") {
    const std::string a = "#declare A = texture { pigment { rgb x } finish { phong 1 } } ";
    const std::string b = "#declare B = texture { pigment { gradient y } finish { reflection .5 } } ";
    const auto of = [&](const std::string& body) { return whole(a + b + body); };
    const auto check = [&](const Material& own, const std::vector<Transformation>& steps) {
        CHECK((own.rgb == Pigment(Color(1, 0, 0)) && own.specular == 1 && own.reflection == 0));
        CHECK((own.inside == 0 && own.outside == 1));
        REQUIRE(own.coats.size() == 1);
        CHECK((own.coats[0].inside == 1 && own.coats[0].outside == 0 && own.coats[0].reflection == .5));
        REQUIRE(own.coats[0].rgb.pattern);
        CHECK_MESSAGE(own.coats[0].rgb.pattern->transformations == steps,
                      own.coats[0].rgb.pattern->transformations.size());
    };
    const std::vector<Transformation> twice{Scale{{2, 2, 2}}};
    check(material(of("sphere { 0, 1 texture { A } interior_texture { B scale 2 } }")), twice);
    check(material(of("sphere { 0, 1 interior_texture { B scale 2 } texture { A } }")), twice);
    check(material(of("sphere { 0, 1 material { texture { A } interior_texture { B scale 2 } scale 3 } }")), twice);
    check(material(of("sphere { 0, 1 texture { A } interior_texture { B scale 2 } translate y }")), twice);
    check(material(of("object { sphere { 0, 1 texture { A } } interior_texture { B scale 2 } translate y }")), twice);
    // Parts with a texture of their own keep the inner side of the whole.
    const Scene parts =
        of("union { sphere { 0, 1 } sphere { x, 1 texture { A } translate y } texture { B } "
           "interior_texture { B scale 2 } }");
    REQUIRE(parts.materials.size() == 2);
    check(parts.materials[1], {Scale{{2, 2, 2}}, Translate{{0, -1, 0}}});
    CHECK((parts.materials[0].coats.size() == 1 && parts.materials[0].reflection == .5));
    // Turned inside out, a body shows its other side.
    CHECK(material(of("sphere { 0, 1 texture { A } interior_texture { B } inverse }")).outside == 0);
}

TEST_CASE("POV-Ray: a light_group lights its bodies alone, and no others do unless it says so") {
    const std::string lights = "light_source { 2*y rgb 1 } light_source { 2*z rgb -.5 } ";
    const Scene groups =
        whole(lights +
              "light_group { light_source { 5*x rgb 1 } sphere { 0, 1 } } light_group { union { sphere { 3*x, 1 } "
              "light_source { 6*x rgb 1 } } global_lights on } sphere { 9*x, 1 }");
    REQUIRE(groups.lights.size() == 4);
    CHECK(groups.lights[1].color == Color(-.5));
    CHECK((groups.lights[0].group == 0 && groups.lights[2].group == 1 && groups.lights[3].group == 2));
    const auto of = [&](std::size_t i) { return groups.materials[std::size_t(groups.primitives.at(i).material)]; };
    CHECK((of(0).group == 1 && of(0).common == 0));
    CHECK((of(1).group == 2 && of(1).common == 1));
    CHECK((of(2).group == 0 && of(2).common == 1));
}

TEST_CASE("POV-Ray: media are left out of hollow bodies, and fog of clipped ones through which light goes") {
    const std::string ball = "sphere { 0, 1 pigment { rgbt .5 } ", media = "interior { media { emission 1 } } ";
    CHECK(notes_of(ball + media + "}") == "");
    CHECK(notes_of(ball + media + "hollow }") == "x.pov:1: left out: media");
    CHECK(notes_of("union { " + ball + "translate 3 } " + ball + media + "} hollow }") == "x.pov:1: left out: media");
    const std::string fog = "fog { distance 5 rgb 1 } ", clips = "clipped_by { plane { y, 0 } } ";
    CHECK(notes_of(fog + "sphere { 0, 1 " + clips + "}") == "");
    CHECK(notes_of(ball + clips + "}") == "");
    CHECK(says(notes_of(fog + ball + clips + "}"), "no fog inside a clipped body"));
    CHECK(notes_of(fog + ball + clips + "hollow }") == "");
    CHECK(says(notes_of(fog + "union { sphere { 3, 1 } " + ball + "} " + clips + "}"), "no fog inside"));
}

TEST_CASE("POV-Ray: photons are left out where they are aimed at a body") {
    const std::string shot = "global_settings { photons { count 100 } } ", aimed = "photons { target 1 reflection on }";
    CHECK(notes_of(shot + "sphere { 0, 1 photons { collect off } }") == "");
    CHECK(notes_of("sphere { 0, 1 " + aimed + " }") == "");
    CHECK(notes_of("union { sphere { 0, 1 " + aimed + " } sphere { x, 1 } } " + shot) == "x.pov:1: left out: photons");
}

TEST_CASE("POV-Ray: lights on surfaces that cast shadows are told of") {
    const auto told = [](const std::string& text) {
        return says(notes_of("camera { right -4/3*x location <50, 30, 20> look_at <70, 1, 1> } " + text),
                    "a light on a surface");
    };
    const std::string box = "box { <0, 0, 0>, <1, 2, 3> translate 70*x ", light = "light_source { <70.5, 1, 3> rgb 1 ";
    const std::string floor = "plane { y, -1 } ";
    CHECK(told(light + "} " + floor + box + "}"));
    CHECK(
        !told(light + "} " + floor + "sphere { <70.5, 1, 3>, 1 } " + box + "}"));  // it shines on nothing that is seen
    CHECK(told("light_source { <70, 9, 0> rgb 1 } difference { sphere { <70, 9, 0>, 2 } sphere { <70, 7, 0>, 2 } } " +
               floor));
    const std::string still = "box { <70, 0, 0>, <71, 2, 3> }";  // the light is on its face, or a hair inside of it
    CHECK(!told(light + "} " + floor + still));
    CHECK(told(light + "translate -1e-14*z } " + floor + still));
    CHECK(!told(light + "translate 1e-14*z } " + floor + still));
    CHECK(!told(light + "} " + floor + box + "no_shadow }"));
    CHECK(!told(light + "shadowless } " + floor + box + "}"));
    CHECK(!told(light + "parallel point_at 0 } " + floor + box + "}"));
    CHECK(!told(light + "translate 1e-5*z } " + floor + box + "}"));
    CHECK(!told("light_source { 9*y rgb 1 } difference { sphere { 9*y, 2 } sphere { 9*y, 1 } } " + floor));
    CHECK(!told("light_source { <50, 31, 20> rgb 1 } box { <49, 29, 19>, <51, 31, 21> }"));  // around the eye
}

TEST_CASE("POV-Ray: opaque meshes with patterns have its planes of single precision") {
    const std::string mesh =
        "mesh { triangle { <9.1, 0, 0>, <9.3, 1, .7>, <9, .2, 1> } "
        "triangle { <9.3, 1, .7>, <9, .2, 1>, <9.2, 2, 2> } ";
    const auto data = [&](const std::string& look) { return *shape<Mesh>(whole(mesh + look)).data; };
    const MeshData plain = data("}"), planes = data("pigment { granite } }");
    CHECK((plain.points.size() == 4 && planes.points.size() == 6));
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto corner = [&](const MeshData& of) { return of.points[std::size_t(of.triangles[i][k])]; };
            CHECK(length(corner(planes) - corner(plain)) < 2e-6);
            CHECK(corner(planes) != corner(plain));
        }
    // Light would go through clear meshes with sides that no two triangles share.
    CHECK(data("pigment { granite color_map { [0 rgbt .5] [1 rgb 1] } } }") == data("pigment { rgbt .5 } }"));
}

TEST_CASE("POV-Ray: lights of cylinders and lights behind surfaces") {
    const Light beam =
        whole("light_source { <1, 2, 3> rgb 1 cylinder point_at <1, 0, 3> radius 2 falloff 3 }").lights[0];
    CHECK((beam.beam == 3 && beam.core == 2 && beam.tightness == 0));
    CHECK((beam.from == DVec3(1, 2, 3) && normalize(*beam.direction) == DVec3(0, -1, 0)));
    CHECK(whole("light_source { y rgb 1 cylinder }").lights[0].beam == 1);
    CHECK(whole("light_source { y rgb 1 cylinder falloff 0 }").lights.empty());
    CHECK(whole("light_source { y rgb 1 spotlight parallel }").lights[0].beam == 1e9);
    // Old words of a finish belong to the interior.
    const Material glass =
        material(whole("sphere { 0, 1 texture { pigment { rgbf <1, 0, 0, 1> } finish { refraction "
                       "1.25 ior 1.5 irid { .25 thickness .5 } } } }"));
    CHECK((glass.clarity == 1.25 && glass.ior == 1.5 && glass.irid == .25 && glass.film == .5));
    CHECK(says(notes_of("sphere { 0, 1 finish { irid { .25 turbulence .5 } } }"), "the film of 'irid' is even"));
    const Material both = material(whole("disc { 0, y, 1 finish { diffuse .5, .25 } double_illuminate }"));
    CHECK((both.both_sides == 1 && both.behind == .25 && both.diffuse == .5));
}

TEST_CASE("POV-Ray: patterns that scenes have are exact") {
    const auto pattern = [](const std::string& text) {
        const Material own = material(whole("sphere { 0, 1 pigment { " + text + " } }"));
        REQUIRE(own.rgb.pattern);
        return *own.rgb.pattern;
    };
    CHECK(std::get<Brick>(pattern("brick rgb 0, rgb 1 brick_size <2, 1, 1> mortar .1").kind) == Brick{{2, 1, 1}, .1});
    CHECK(pattern("checker").colors == std::vector<ColorStop>{{0, {0, 0, 1}}, {1, {0, 1, 0}}});
    CHECK(pattern("checker rgb x").colors == std::vector<ColorStop>{{0, {1, 0, 0}}, {1, {0, 1, 0}}});
    CHECK(pattern("checker pigment { rgb x }").colors == std::vector<ColorStop>{{0, {1, 0, 0}}, {1, Color(0)}});
    const Pattern ramp = pattern("gradient y color_map { [0 rgb 0] [.25 rgb x] [1 rgb 1] } scale 3");
    CHECK(std::get<SolidPattern>(ramp.kind) == SolidPattern{.solid = Solid::gradient, .axis = {0, 1, 0}});
    CHECK(ramp.colors == std::vector<ColorStop>{{0, Color(0)}, {.25, {1, 0, 0}}, {1, Color(1)}});
    const Pattern beyond = pattern("gradient y color_map { [-.5 rgb 0] [.5 rgb x] [1.5 rgb 1] [2 rgb y] }");
    CHECK(beyond.colors == std::vector<ColorStop>{{0, {.5, 0, 0}}, {.5, {1, 0, 0}}, {1, {1, .5, .5}}});
    // The old form of a map, and a wave.
    const Pattern old = pattern(
        "gradient x triangle_wave color_map { [0, .5 color rgb 0 color rgb 1] [.5 1 color rgb 1 color rgb 1] }");
    CHECK(old.colors == std::vector<ColorStop>{{0, Color(0)}, {.5, Color(1)}, {.5, Color(1)}, {1, Color(1)}});
    CHECK(std::get<SolidPattern>(old.kind).wave == 1);
    CHECK(std::get<SolidPattern>(pattern("bozo noise_generator 1").kind).generator == 1);
    CHECK(std::get<SolidPattern>(pattern("bumps turbulence .2").kind) ==
          SolidPattern{.solid = Solid::bozo, .turbulence = DVec3(.2)});
    const Scene clear = whole(
        "#version 3.7; sphere { 0, 1 pigment { granite color_map { [0 rgbt <1, 0, 0, .5>] "
        "[1 rgbft <0, 1, 0, .25, .5>] } } }");
    REQUIRE(material(clear).rgb.pattern);
    CHECK(material(clear).rgb.pattern->colors ==
          std::vector<ColorStop>{{0, {1, 0, 0}, 0, .5}, {1, {0, 1, 0}, .25, .5}});
    // A pattern in a map has its own transformations, in the space of the one around it, which is POV-Ray's.
    const Pattern around = pattern("gradient y pigment_map { [0 rgb x] [1 granite scale 2] } scale 3");
    CHECK(std::get<SolidPattern>(around.kind).solid == Solid::gradient);
    REQUIRE(around.nests());
    CHECK(around.colors[0] == ColorStop{0, {1, 0, 0}});
    CHECK(std::get<SolidPattern>(around.colors[1].pattern->kind).solid == Solid::granite);
    CHECK(around.colors[1].pattern->transformations == std::vector<Transformation>{Scale{DVec3(2)}});
    const Scene turned =
        whole("sphere { 0, 1 pigment { checker pigment { granite scale 2 }, pigment { rgb x } } }", false);
    CHECK(material(turned).rgb.pattern->colors[0].pattern->transformations ==
          std::vector<Transformation>{Scale{{1, 1, -1}}, Scale{DVec3(2)}, Scale{{1, 1, -1}}});
    CHECK(pattern("checker pigment { bozo } pigment { rgb y }").colors[0].pattern);
    const Scene sky = whole("#version 3.7; sky_sphere { pigment { gradient y } pigment { rgb x transmit .5 } }");
    CHECK(sky.background.pattern);
    CHECK(sky.background_coats == std::vector<Pigment>{[] {
              Pigment red(1, 0, 0);
              return red.transmit = .5, red;
          }()});
    const Scene dawn = whole(
        "sky_sphere { pigment { gradient y color_map { [0 rgb x] [1 rgb 1] } } pigment { rgbt .5 } emission <.5, 1, 2> "
        "}");
    CHECK(dawn.background.pattern->colors == std::vector<ColorStop>{{0, {.5, 0, 0}}, {1, {.5, 1, 2}}});
    CHECK(dawn.background_coats.at(0).color == Color(.25, .5, 1));
    CHECK(whole("sky_sphere { pigment { rgb y } } background { rgb x }").background == Pigment(0, 1, 0));
    const SolidPattern quilted = std::get<SolidPattern>(pattern("quilted control0 0 control1 .5").kind);
    REQUIRE(quilted.function);
    CHECK(quilted.function->value_at({.75, .5, .5}) == doctest::Approx((.015625 + .0703125) * 1.154700538 / 12));
    CHECK(!std::get<SolidPattern>(pattern("quilted control0 1").kind).function);
    CHECK(std::get<SolidPattern>(pattern("marble").kind) == SolidPattern{.solid = Solid::marble, .wave = 1});
    CHECK(std::get<SolidPattern>(pattern("wood").kind) == SolidPattern{.solid = Solid::wood, .wave = 1});
}

TEST_CASE("POV-Ray: lights") {
    const auto light = [](const std::string& text) {
        const Scene scene = whole("light_source { " + text + " }");
        REQUIRE(scene.lights.size() == 1);
        return scene.lights[0];
    };
    CHECK(light("<1, 2, 3> rgb <1, .5, .25>") == Light{.position = {1, 2, 3}, .color = {1, .5, .25}});
    CHECK(light("0 rgb 1 spotlight point_at y falloff 30 radius 20 tightness 2").spot == Spot{{0, 1, 0}, 20, 30, 2});
    CHECK(light("0 rgb 1 spotlight point_at y falloff 30 radius 40").spot == Spot{{0, 1, 0}, 40, 40, 0});
    CHECK(light("0 rgb 1 spotlight").spot == Spot{{0, 0, 1}, 30, 45, 0});
    CHECK(light("0 rgb 1 spotlight radius -330 falloff 400").spot == Spot{{0, 0, 1}, 30, 40, 0});
    CHECK(light("0 rgb 1 spotlight radius 200 falloff 1").spot == Spot{{0, 0, 1}, 90, 90, 0});
    CHECK(light("0 rgb 1 spotlight radius 91 falloff 130").spot == Spot{{0, 0, 1}, 90, 90, 0});
    CHECK(notes_of("light_source { 0 rgb 1 spotlight radius 30 falloff 91 }") != "");
    CHECK(light("2*y rgb 1 parallel point_at x").direction == DVec3(1, -2, 0));
    CHECK(!light("2*y rgb 1 parallel point_at x").from);
    const auto from = [](const std::string& bodies) {
        return whole("light_source { 2*y rgb 1 parallel point_at 0 } " + bodies).lights.at(0).from;
    };
    CHECK(from("plane { y, -1 }") == DVec3(0, 2, 0));
    CHECK(from("sphere { 2*y, 1 }") == DVec3(0, 2, 0));
    CHECK(!from("sphere { 0, 1 }"));
    CHECK(light("x rgb 1 translate y").position == DVec3(1, 1, 0));
    const auto soft = [](const std::string& more) {
        return opened("light_source { 2*y rgb 1 spotlight point_at 0 area_light x, z, " + more + " }")
            .scene.lights.at(0);
    };
    CHECK((soft("2, 3").soft && soft("2, 3").spot->look_at == DVec3(0)));
    CHECK(soft("2, 3").area == Area{{1, 0, 0}, {0, 0, 1}, 2, 3});
    CHECK(soft("9, 9 adaptive 2 circular").adaptive == 2);
    CHECK((soft("9, 9 circular").circular && !soft("9, 1 circular").circular));
    CHECK((soft("2, 3 orient jitter").circular && soft("2, 3 orient jitter").orient));
    CHECK((soft("3, 3 adaptive 1 jitter").jitter && soft("3, 3 jitter").area == Area{{1, 0, 0}, {0, 0, 1}, 3, 3}));
    const auto notes = [](const std::string& more) {
        return notes_of("light_source { 2*y rgb 1 area_light x, z, " + more + " }");
    };
    CHECK(
        (notes("3, 3 adaptive 1 jitter") == "" && notes("4, 4 adaptive 1 jitter") == "" && notes("9, 9 jitter") == ""));
    CHECK((notes("5, 5 adaptive 1 jitter") == "" && soft("5, 5 adaptive 1 jitter").adaptive == 1));
    CHECK(notes("3, 3 circular orient") == "");
    const std::string turning = "light_source { 2*y rgb 1 area_light x, z, 3, 3 circular orient } ";
    const auto left_handed = opened("camera { } " + turning, false);
    CHECK((left_handed.notes.empty() && left_handed.scene.lights.at(0).mirrored && !soft("3, 3 orient").mirrored));
    CHECK(length(soft("5, 1").area->v) < 1e-5);
    CHECK((soft("1, 5").area->u == DVec3(0, 0, 1) && soft("1, 5").area->columns == 5));
    CHECK(!soft("1, 1").area);
    CHECK(length(light("x rgb 1 spotlight point_at y rotate 90*z").spot->look_at - DVec3(-1, 0, 0)) < 1e-15);
    const Scene body = opened("light_source { x rgb 1 looks_like { sphere { 0, .1 } } translate y }").scene;
    CHECK(body.primitives.at(0).transformations ==
          std::vector<Transformation>{Translate{{1, 0, 0}}, Translate{{0, 1, 0}}});
}

TEST_CASE("POV-Ray: gamma and defaults depend on the version") {
    const auto gamma = [](const char* text) { return whole(text).settings.assumed_gamma; };
    CHECK(gamma("") == 0);
    CHECK(gamma("#version 3.6;") == 0);
    CHECK(gamma("#version 3.7;") == 1);
    CHECK(gamma("#version 3.6; #version 3.7;") == 1);
    CHECK(gamma("global_settings { assumed_gamma 1 }") == 1);
    CHECK(gamma("global_settings { assumed_gamma 1.8 } global_settings { assumed_gamma 1 }") == 1.8);
    CHECK(gamma("#version 3.7; global_settings { assumed_gamma srgb }") == 0);
    const Settings settings = whole("global_settings { ambient_light rgb .5 max_trace_level 7 }").settings;
    CHECK(settings.ambient_light == Color(.5));
    CHECK(settings.max_trace_level == 7);
    CHECK(whole("").settings.max_trace_level == 5);
}

TEST_CASE("POV-Ray: fog") {
    const Fog fog = *whole(
                         "fog { fog_type 2 distance 5 color rgbft <.5, .25, 1, .5, .125> fog_alt 2 fog_offset -1 "
                         "up <0, 2, 1> turbulence .5 octaves 3 omega .25 lambda 3 turb_depth .75 }")
                         .fog;
    CHECK(fog == Fog{5, {.5, .25, 1}, 2, -1, {0, 2, 1}, .5, .125, DVec3(.5), 3, .25, 3, .75});
    CHECK(*whole("fog { distance 5 rgb x }").fog == Fog{5, {1, 0, 0}});
}

TEST_CASE("POV-Ray: what scenes cannot hold is told with its line, once") {
    const auto told = [](const std::string& text, const char* note) {
        const std::string all = notes_of("\n" + text);
        CHECK_MESSAGE(says(all, std::string("x.pov:2: ") + note), text, " tells: ", all);
    };
    told("sphere { 0, 1 finish { reflection { .5 exponent 2 } } }", "approximated: 'exponent' of a reflection");
    told("sphere { 0, 1 pigment { rgbt <1, 1, 1, -1> } }", "approximated: filter and transmit below 0");
    told("sphere { 0, 1 pigment { pavement } }", "approximated: the pattern 'pavement' is its mean colour");
    const auto thick = [](const std::string& fog, const std::string& body) {
        return says(notes_of("fog { distance 9 rgb" + fog + " } " + body), "fog that lets light through is thicker");
    };
    const std::string tube = "cylinder { -y, y, 1 open }", unseen = "sphere { 0, 1 no_reflection }";
    CHECK((thick("t <1,1,1,.2>", tube) && thick("f <1,1,1,.2>", tube) && !thick(" 1", tube)));
    CHECK(
        (thick("t <1,1,1,.2>", unseen) && !thick("f <1,1,1,.2>", unseen) && !thick("t <1,1,1,.2>", "sphere { 0, 1 }")));
    const std::string fog = "fog { distance 9 rgb 1 } ";
    CHECK(says(notes_of(fog + tube), "fog is seen from an open body"));
    CHECK((notes_of(fog + "cylinder { -y, y, 1 open hollow }") == "" &&
           notes_of(fog + "cylinder { 3*y, 5*y, 1 open }") == ""));
    const auto fails = [](const std::string& plane, const std::string& fade) {
        return says(notes_of("camera { location -9*z } plane { y, " + plane +
                             " } light_source { 0 rgb 1 parallel "
                             "point_at y fade_distance 2 fade_power " +
                             fade + " }"),
                    "parallel light does not fade behind the plane");
    };
    CHECK((fails("-1", "1.5") && fails("-1", "1") && !fails("-1", "2") && !fails("1", "1")));
    const auto ends = [](const std::string& body) {
        return says(notes_of("difference { " + body + " julia_fractal { <-.1,.8,-.5,.1> } }"), "at the fractal's box");
    };
    CHECK((ends("box { -5, 5 }") && ends("plane { y, 0 }") && !ends("box { -1, 1 }")));
    told("fog { distance 9 } light_source { 9 rgb 1 media_attenuation on }", "approximated: fog does not dim a light");
    CHECK(notes_of("sphere { 0, 1 pigment { crackle metric 2 form <-1, 1, 0> agate_turb 1 } }") == "");
    told("text { ttf \"no.ttf\" \"A\" 1, 0 }", "left out: a text: cannot find its font 'no.ttf'");
    told("sphere_sweep { cubic_spline 4, -x, .2, 0, .2, x, .3, 2*x+y, .2 texture { } interior_texture { } }",
         "approximated: which sides of its faces are inside");
    told(
        "light_group { sphere { 0, 1 } light_group { light_source { x rgb 1 } sphere { 0, 1 } } light_source { 0 rgb 1 "
        "} }",
        "approximated: lights of the outer light_group do not shine on the inner one");
    told("media { emission 1 }", "left out: media");
    told("global_settings { assumed_gamma .5 }", "approximated: assumed_gamma 0.5 is 1");
    told("rainbow { distance 1 }", "left out: a rainbow");
    told("sphere { 0, 1 texture { material_map { png \"no.png\" texture { pigment { rgb x } } texture { } } } }",
         "left out: all textures of a material_map but the first");
    told("fog { fog_type 2 distance 1 }", "left out: fog without a direction");
    told("fog { distance 1 } fog { distance 2 }", "left out: a second fog");
    told("global_settings { radiosity { count 9 } }", "approximated: radiosity");
    told("camera { omnimax }", "approximated: a camera of another projection");
    told("camera { omnimax angle 90 }", "approximated: a camera of another projection");
    told("camera { fisheye up 2*y }", "approximated: the circle of a fisheye");
    const std::string loop =
        "#declare B = sphere { 0, 1 pigment { pavement } } #for (I, 1, 50) object { B translate I*x } #end";
    CHECK(opened(loop).notes.size() == 1);
    CHECK(opened("sphere { 0, 1 }").summary() == "opens whole");
    CHECK(opened("julia_fractal { 0 sin } sphere { 0, 1 pigment { pavement } }").summary() ==
          "approximated in 1 place, left out in 1 place");
    // Tells what a function stands in for where a body shows it, and only there.
    const std::string stand_in = "#declare F = function { pattern { pavement } }";
    CHECK(opened(stand_in).notes.empty());
    CHECK(notes_of(stand_in + "sphere { 0, 1 pigment { function { F(x, y, z) } } }").find(".5 everywhere") !=
          std::string::npos);
}

TEST_CASE("POV-Ray: pictures are sharp unless they are interpolated") {
    const Scratch folder;
    write_file(folder / "a.png", "");
    pov::InterpreterOptions options;
    options.file = folder / "x.pov";
    const auto read = [](const std::string&) { return Pixels{1, 1, false, {0, 0, 0}, Color(1)}; };
    const auto sharp = [&](const std::string& more) {
        const std::string text = "sphere { 0, 1 pigment { image_map { png \"a.png\"" + more + " } } }";
        return std::get<ImagePattern>(material(open_pov(text, options, read).scene).rgb.pattern->kind).sharp;
    };
    CHECK(sharp(""));
    CHECK(sharp(" interpolate 0"));
    CHECK(!sharp(" interpolate 2"));
}

TEST_CASE("POV-Ray: a scene of too many bodies ends") {
    pov::InterpreterOptions options;
    options.file = "x.pov", options.limits.bytes = 10 << 20;
    const auto read = [](const std::string&) { return Pixels(); };
    const auto fault = [&](const std::string& text) { return fault_of([&] { open_pov(text, options, read); }); };
    CHECK(says(fault("#macro A(N) #if (N>0) A(N-1) A(N-1) #end sphere { 0, 1 } #end A(60)"), "too much memory"));
    CHECK(fault("#for (I, 1, 1000) sphere { 0, 1 } #end") == "");
    CHECK(
        says(fault("#declare A = sphere { 0, 1 } #for (I, 1, 40) #declare A = union { object { A } object { A } } #end "
                   "object { A }"),
             "bodies need too much memory; more than 10 MiB in all"));
    CHECK(
        says(fault("#declare A = sphere { 0, 1 } #for (I, 1, 3000) #declare A = union { object { A } sphere { I, 1 } } "
                   "#end object { A }"),
             "nested more than 2000 levels deep"));
    // A loop's bodies share a texture that is the same; others count.
    const std::string ball = "sphere { 0, 1 pigment { rgb ";
    CHECK(fault("#for (I, 1, 3500) " + ball + "1 } finish { phong .5 } } #end") == "");
    CHECK(says(fault("#for (I, 1, 3500) " + ball + "I } finish { phong .5 } } #end"), "10 MiB"));
    CHECK(says(fault("#for (I, 0, 1e8) union { sphere { I, 1 } union { sphere { I, 2 } } } #end"), "10 MiB"));
    CHECK(says(fault("mesh { #for (I, 0, 1e8) triangle { I*x, <I, 1, 0>, <I, 0, 1> } #end }"), "10 MiB"));
    const std::string own = "texture { pigment { rgb I } }";
    CHECK(says(fault("mesh { #for (I, 0, 1e8) triangle { I*x, <I, 1, 0>, <I, 0, 1> " + own + " } #end }"), "10 MiB"));
}

TEST_CASE("POV-Ray: errors have their place") {
    CHECK(says(fault_of([] { opened("\nsphere { 0, 1 colour_blue }"); }), "x.pov:2:"));
    CHECK(says(fault_of([] { opened("\ncamera { location 0 right 0 }"); }), "x.pov:2"));
    CHECK(fault_of([] { opened("mesh2 { vertex_vectors { 1, 0 } face_indices { 1, <0, 1, 2> } }"); }) != "");
}

TEST_CASE("POV-Ray: with alpha the background is opaque from version 3.7 on, by what it does not transmit") {
    // As POV-Ray 3.7 with +UA writes it.
    const auto opacity = [](const std::string& text, Color* color = nullptr) {
        pov::InterpreterOptions options;
        options.alpha = true;
        const pov::OpenedPov opened = pov::open_pov(text, options, {});
        if (color) *color = opened.scene.background.color;
        return opened.background_opacity;
    };
    Color color;
    CHECK(opacity("#version 3.7; background { rgbt <.2, .4, .8, .5> }", &color) == .5);
    CHECK(std::abs(color.z - .8) < 1e-6);  // mirrors show it as it is
    CHECK(opacity("#version 3.7; background { rgb <.2, .4, .8> }") == 1);
    CHECK(opacity("#version 3.7;") == 0);
    CHECK(opacity("#version 3.6; background { rgb <.2, .4, .8> }") == 0);
    CHECK(opacity("#version 3.7; sky_sphere { pigment { rgb x } }") == 1);
    CHECK(opacity("#version 3.6; sky_sphere { pigment { rgb x } }") == 0);
}

TEST_CASE("POV-Ray: from version 3.7 on a background that lets light through is before black") {
    const auto background = [](const char* version, const char* color) {
        return whole(std::string(version) + " background { " + color + " }").background.color;
    };
    for (const char* const color : {"rgbt <.5, 1, .25, .5>", "rgbft <.5, 1, .25, .75, .5>"}) {
        CHECK(background("#version 3.7;", color) == Color(.25, .5, .125));
        CHECK(background("#version 3.6;", color) == Color(.5, 1, .25));
        CHECK(background("", color) == Color(.5, 1, .25));
    }
    CHECK(background("#version 3.7;", "rgbf <.5, 1, .25, .5>") == Color(.5, 1, .25));
}

TEST_CASE("POV-Ray: numbers below 0 of finishes and lights take light away, or light more; scene text has none") {
    const auto finish = [](const std::string& words) {
        const Material own = material(whole("sphere { 0, 1 pigment { rgb 1 } finish { " + words + " } }"));
        return own;
    };
    CHECK(finish("ambient -.05").ambient * finish("ambient -.05").glow == Color(-.05));
    const Material mixed = finish("ambient <.1, -.2, 0>");
    CHECK(length(mixed.ambient * mixed.glow - Color(.1, -.2, 0)) < 1e-12);
    CHECK(finish("brilliance -2").brilliance == -2);
    CHECK(finish("phong 1 phong_size -3").pow == -3);
    CHECK(finish("specular 1 roughness -.1").roughness == -.1);
    CHECK(finish("reflection -.2").reflection == 0);
    CHECK(whole("light_source { y, 1 spotlight tightness -10 point_at 0 }").lights[0].spot->tightness == -10);
    CHECK(whole("light_source { y, 1 parallel cylinder tightness -1 point_at 0 }").lights[0].tightness == -1);
    const auto told = [](const std::string& text, const char* note) {
        CAPTURE(text);
        pov::InterpreterOptions options;
        options.file = "x.pov", options.as_text = true;
        std::string all;
        for (const pov::PovNote& each : open_pov("camera { right -4/3*x } " + text, options, {}).notes)
            all += each.message.told();
        CHECK(says(all, std::string("approximated: ") + note));
    };
    told("sphere { 0, 1 finish { ambient -.05 } }", "ambient light");
    told("sphere { 0, 1 finish { brilliance -2 } }", "brilliance");
    told("light_source { y, 1 spotlight tightness -10 point_at 0 }", "a light that is brighter off its axis");
    for (const char* const as_nothing : {"diffuse -1", "phong -1", "specular -1", "diffuse 0 brilliance -1"})
        CHECK(notes_of(std::string("sphere { 0, 1 finish { ") + as_nothing + " } }") == "");
}

TEST_CASE("POV-Ray: colours that are left out are black, sizes may follow names of normals") {
    CHECK(whole("light_source { y }").lights.empty());
    CHECK(material(whole("sphere { 0, 1 pigment { color } }")).rgb.color == Color(0));
    const auto amount = [](const std::string& normal) {
        const std::string declared = "#declare N = normal { bumps .5 } sphere { 0, 1 normal { " + normal + " } }";
        return material(whole(declared)).bump.height;
    };
    CHECK(amount("N") == .5);
    CHECK(amount("N .75") == .75);
    CHECK(amount("N, .25 scale 2") == .25);
    whole("#declare N = normal { bumps } sphere { 0, 1 normal { gradient x normal_map { [0 N .2] [1, N, 1] } } }");
}

TEST_CASE("POV-Ray: textures before version 3 need no blocks, and noise is older before version 3.5") {
    const Scene scene = whole(
        "#version 2.0; sphere { <0, 0, 0> 1 texture { color red .5 green 1 ambient .25 phong .5 bumps .75 scale 2 } }");
    CHECK(material(scene).rgb.color == Color(.5, 1, 0));
    CHECK(material(scene).ambient == .25);
    CHECK(material(scene).specular == .5);
    CHECK(material(scene).bump.height == .75);
    CHECK(says(notes_of("#version 2.0; sphere { 0 1 texture { marble turbulence .4 .1 } }"), "crand"));
    const auto generator = [](const std::string& before) {
        const Scene own = whole(before + " sphere { 0, 1 pigment { bozo } }");
        return std::get<SolidPattern>(material(own).rgb.pattern->kind).generator;
    };
    CHECK(generator("#version 3.1;") == 1);
    CHECK(generator("#version 3.5;") == 2);
    CHECK(generator("") == 2);
    CHECK(generator("global_settings { noise_generator 3 } #version 3.1;") == 3);
}

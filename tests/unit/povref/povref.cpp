// The scenes as converted for POV-Ray.
#include <doctest/doctest.h>

#include "files/output_file.h"
#include "povref/convert/material_names.h"
#include "povref/convert/pov_scene.h"
#include "povref/convert/scale.h"
#include "tests/unit/povref/agreement.h"
#include "tests/unit/scratch.h"

using namespace strahl;

namespace {

PovRequest request_for(const std::string& name, const Scene& scene) {
    return {.title = std::filesystem::path(name).filename().string() + ".rt",
            .pov_path = "s.pov",
            .picture_path = "s.png",
            .cameras = {scene.camera},
            .width = picture_width,
            .height = picture_height,
            .depth = scene.settings.max_trace_level};
}
PovFiles convert(const std::string& text) {
    const Scene scene = parse_scene(text, "test");
    return write_pov(scene, request_for("test", scene));
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
    return n;
}

std::string sha256(const std::string& path) {
    std::FILE* pipe = popen(("sha256sum '" + path + "'").c_str(), "r");
    REQUIRE(pipe);
    char sum[65] = {};
    REQUIRE(std::fread(sum, 1, 64, pipe) == 64);
    REQUIRE(pclose(pipe) == 0);
    return sum;
}

const std::string camera = "camera { position <0, -9, 3> look_at <0, 0, 1> sky <0, 0, 1> fov 20 aspectratio 1.25 }\n";
const std::string light = "light { position <-4, -6, 8> color <1, 1, 1> }\n";

}  // namespace

TEST_CASE("the camera's vectors span Strahl's picture") {
    const PovFiles files = convert(
        "camera { position <1, 2, 3> look_at <1, 5, 3> sky <0, 0, 1> angle 90 aspectratio 2 }\n"
        "sphere { <1, 5, 3>, 1 }");
    CHECK(has(files.pov, "location  <1, 2, 3>"));
    CHECK(has(files.pov, "direction <0, 1, 0>"));
    // The exact width is 2, and 1 the height; tan 45 degrees is not.
    double right = 0, up = 0;
    CHECK(std::sscanf(files.pov.c_str() + files.pov.find("right     "), "right <%lf, 0, 0>", &right) == 1);
    CHECK(std::sscanf(files.pov.c_str() + files.pov.find("up        "), "up <0, 0, %lf>", &up) == 1);
    CHECK(right == doctest::Approx(2).epsilon(1e-15));
    CHECK(up == doctest::Approx(1).epsilon(1e-15));
    CHECK_FALSE(has(files.pov, "look_at"));
}

TEST_CASE("values are written as they are, or as linear light") {
    const std::string body = "sphere { <0, 0, 1>, 1 }";
    CHECK(has(convert(camera + body).pov, "assumed_gamma srgb"));
    CHECK(has(convert(camera + "global_settings { assumed_gamma 1 }" + body).pov, "assumed_gamma 1.0"));
    CHECK(has(convert(camera + body).ini, "File_Gamma=srgb\n"));
}

TEST_CASE("transformations are kept, or become a matrix where POV-Ray would change them") {
    const std::string text =
        convert(camera + "sphere { <0, 0, 1>, 1 rotate <10, 20, 30> translate <1, 2, 3> scale <1, 2, -3> }").pov;
    CHECK(has(text, "rotate <10, 20, 30>"));
    CHECK(text.find("rotate <10, 20, 30>") < text.find("translate <1, 2, 3>"));
    CHECK(text.find("translate <1, 2, 3>") < text.find("scale <1, 2, -3>"));
    const std::string tiny = convert(camera + "sphere { <0, 0, 1e9>, 1e9 scale 1e-12 }").pov;
    CHECK(has(tiny, "matrix <1e-12, 0, 0, 0, 1e-12, 0, 0, 0, 1e-12, 0, 0, 0>"));
}

TEST_CASE("coloured shadows need a copy of the body, white ones and lightless scenes none") {
    const auto glass = [](const char* rgb) {
        return std::string("sphere { <0, 0, 1>, 1 material { refraction 0.8 reflection 0.2 ior 1.5 rgb ") + rgb +
               " } }";
    };
    const std::string red = convert(camera + light + glass("<1, 0.5, 0.5>")).pov;
    CHECK(count(red, "no_image no_reflection") == 1);
    CHECK(count(red, "no_shadow") == 1);
    CHECK(red.find("no_image") < red.find("no_shadow"));
    CHECK(count(convert(camera + light + glass("<1, 1, 1>")).pov, "no_image") == 0);
    CHECK(count(convert(camera + glass("<1, 0.5, 0.5>")).pov, "no_image") == 0);
}

TEST_CASE("the old keyword `refraction` is used only where total reflection needs it") {
    const auto glass = [](const char* how) {
        return camera + light + "sphere { <0, 0, 1>, 1 material { " + how + " } }";
    };
    CHECK_FALSE(has(convert(glass("reflection 0.2 refraction 0.8 ior 1.5")).pov, " refraction 1"));
    CHECK_FALSE(has(convert(glass("reflection 0.2 refraction 0.5 ior 1")).pov, " refraction 0"));
    const PovFiles files = convert(glass("reflection 0.1 refraction 0.2 ior 1.5"));
    CHECK(has(files.pov, "refraction 0.3"));
    CHECK(has(files.pov, "transmit 0.2/0.3"));
    CHECK(has(files.ini, "Warning_Console=Off"));
    CHECK_FALSE(has(convert(glass("refraction 0 reflection 0.5")).ini, "Warning_Console"));
}

TEST_CASE("an ior of 1 is written as another number only where the depth limit could show the difference") {
    const auto panes = [](const char* weight) {
        return convert(camera + light + "sphere { <0, 0, 1>, 1 material { reflection 0 ior 1 refraction " + weight +
                       " } }");
    };
    CHECK(has(panes("0.3").pov, "ior 1 }"));
    CHECK(panes("0.3").warnings.empty());
    CHECK(has(panes("0.9").pov, "ior 1.00000012"));
    REQUIRE(panes("0.9").warnings.size() == 1);
    CHECK(has(panes("0.9").pov, "// Not exact: POV-Ray does not count"));
}

TEST_CASE("pictures that do not repeat cause a warning, and mirrored ones are mirrored") {
    const auto image = [&](const std::string& wrap) {
        const auto red = [](const std::string&) { return Pixels{1, 1, false, {1, 0, 0}, Color(1, 0, 0)}; };
        const Scene scene =
            parse_scene(camera + light + "sphere { <0, 0, 1>, 1  material { rgb image { \"a\" " + wrap + " } } }\n",
                        "wrap", {}, red);
        return write_pov(scene, request_for("wrap", scene));
    };
    CHECK(image("").warnings.empty());
    REQUIRE(image("wrap clamp").warnings.size() == 1);
    CHECK(has(image("wrap clamp").warnings[0], "pictures repeat"));
    CHECK(has(image("wrap repeat mirror").pov, "} warp { repeat y flip y }"));
}

TEST_CASE("transparent bodies that may overlap cause a warning") {
    const std::string glass = "material { reflection 0 refraction 0.9 ior 1.5 } }\n";
    const auto two = [&](const char* x) {
        return convert(camera + light + "sphere { <0, 0, 1>, 1 " + glass + "sphere { <" + x + ", 0, 1>, 1 " + glass);
    };
    CHECK(two("3").warnings.empty());
    CHECK(two("1").warnings.size() == 1);
}

TEST_CASE("materials that are mixed by several patterns cause a warning, those by one do not") {
    const auto mixed = [&](const char* scale) {
        return convert(camera + light + "sphere { <0, 0, 1>, 1  material { share checker { <1, 1, 1>, <0, 0, 0> }\n" +
                       "coat { rgb <0, 1, 0>  share checker { <0, 0, 0>, <1, 1, 1> " + scale + " } } } }\n");
    };
    CHECK(mixed("").warnings.empty());
    REQUIRE(mixed("scale 2").warnings.size() == 1);
    CHECK(has(mixed("scale 2").warnings[0], "the first is shown"));
}

TEST_CASE("bodies made of bodies: a material for each part, or one for all of a clear one") {
    const auto lens = [](const std::string& first, const std::string& own) {
        return camera + light + "intersection {\n  sphere { <0, 0, 1>, 1 " + first +
               " }\n  sphere { <0, 0.5, 1>, 1 translate <0, 0, 0.5> }\n  scale 2 " + own + " }";
    };
    const std::string dull = convert(lens("material { reflection 0 }", "")).pov;
    CHECK(has(dull,
              "\nintersection {\n  sphere { <0, 0, 1>, 1 texture { Grey_Gloss } }\n"
              "  sphere { <0, 0.5, 1>, 1 translate <0, 0, 0.5> }\n  texture { Grey_Mirror }\n  scale 2\n"
              "  scale Unit\n}\n"));
    const std::string glass = "material { rgb <1, 0, 0> reflection 0 refraction 1 diffuse 0 ior 1.5 }";
    const PovFiles clear = convert(lens("", glass));
    CHECK(has(clear.pov,
              "\n#declare Intersection_1 = intersection {\n  sphere { <0, 0, 1>, 1 }\n"
              "  sphere { <0, 0.5, 1>, 1 translate <0, 0, 0.5> }\n  scale 2\n  scale Unit\n}\n"));
    CHECK(count(clear.pov, "object { Intersection_1 ") == 2);
    // Parts with materials of their own have textures, and the whole has the one interior that POV-Ray follows.
    const auto bodies = [](const PovFiles& files) { return files.pov.substr(files.pov.find("---- Transparent")); };
    const PovFiles mixed = convert(lens("material { rgb <0, 1, 0> ior 1.2 }", glass));
    CHECK_FALSE(has(bodies(mixed), "material {"));
    CHECK(count(bodies(mixed), "interior {") == 1);
    CHECK(has(bodies(mixed), "interior { ior 1.5 }"));
    CHECK(count(bodies(mixed), "pigment { rgb <0, 1, 0> transmit 1 }") == 1);
    CHECK(count(bodies(mixed), "pigment { rgb <0, 1, 0> filter 1 }") == 1);
    const auto says = [](const PovFiles& files) {
        return std::ranges::any_of(files.warnings, [](const auto& w) { return has(w, "reflected totally"); });
    };
    CHECK_FALSE(says(mixed));
    CHECK_FALSE(says(convert(lens("material { reflection 0 refraction 0 }", glass))));
    CHECK(says(convert(lens("material { refraction .4 }", glass))));
    CHECK(has(bodies(convert(lens("material { refraction .5 ior 2 }", "material { reflection 0 }"))), "{ ior 2 }"));
    CHECK(has(bodies(convert(lens("material { refraction .5 ior 2 }", "material { rgb <0, 0, 1> reflection 0 }"))),
              "  sphere { <0, 0.5, 1>, 1\n    texture {\n      pigment { rgb <0, 0, 1> }"));
    // That interior is the whole's also where all parts share another material.
    const std::string part = "sphere { <0, 0, 1>, 1 material { ior 1.2 } } ";
    CHECK(has(bodies(convert(camera + light + "union { " + part + part + glass + " }")), "{ ior 1.5 }"));
    CHECK(has(convert(camera + "union { sphere { <0, 0, 1>, 1 } sphere { <0, 1, 1>, 1 } }").pov, "\nmerge {\n"));
}

TEST_CASE("copies that cast shadows keep no fog out") {
    const std::string glass = "sphere { <0, 0, 1>, 1 material { refraction .8 reflection .2 rgb <1, .5, .5> } }";
    CHECK(has(convert(camera + light + "fog { distance 5 color <1, 1, 1> } " + glass).pov, "no_reflection hollow }"));
    CHECK_FALSE(has(convert(camera + light + glass).pov, "hollow"));
}

TEST_CASE("what POV-Ray keeps in single precision, or interpolates after it was transformed") {
    const std::string far = convert(camera + "mesh { triangle { <1000, 0, 0>, <1001, 0, 0>, <1000, 1, 0> } }").pov;
    CHECK(has(far, "triangle { <-0.5, -0.5, 0>, <0.5, -0.5, 0>, <-0.5, 0.5, 0> }\n  translate <1000.5, 0.5, 0>"));
    CHECK_FALSE(has(convert(camera + "mesh { triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> } }").pov, "translate"));
    const std::string bent = "smooth_triangle { <0,0,0>, <1,0,0>, <0,1,0>, <0,0,1>, <1,0,1>, <0,1,1> ";
    CHECK(has(convert(camera + bent + "scale <1, 2, 1> }").pov, "mesh {\n  smooth_triangle {"));
    CHECK_FALSE(has(convert(camera + bent + "scale 2 }").pov, "mesh {"));
    const std::string both = "smooth_triangle { <0,0,0>, <1,0,0>, <0,1,0>, <0,0,1>, <1,0,1>, <0,1,-1> }";
    CHECK(has(convert(camera + both).pov, "mesh {\n  smooth_triangle {"));
}

TEST_CASE("a torus without a hole is solid") {
    const auto torus = [](const char* radii) {
        return convert(camera + "torus { <1, 2, 3>, <0, 1, 0>, " + radii + " }").pov;
    };
    CHECK(has(torus("3, 5"), "merge { torus { 3, 5 sturm matrix <"));
    CHECK(has(torus("3, 5"), " } sphere { <1, 2, 3>, 4 }"));
    CHECK_FALSE(has(torus("5, 3"), "merge"));
}

TEST_CASE("patterns move with their bodies, and go through the parts that share them") {
    const std::string chequered = "material { reflection 0 rgb checker { <1, 1, 1>, <0, 0, 0> scale 2 } }";
    const std::string ball = "sphere { <0, 0, 1>, 1 translate <0, 0, 1> ";
    const std::string pov = convert(camera + light + ball + chequered + " }").pov;
    CHECK(has(pov, "pigment { checker rgb <1, 1, 1>, rgb <0, 0, 0> scale 2 }"));
    CHECK(has(pov, "sphere { <0, 0, 1>, 1 texture { Checker_Gloss } translate <0, 0, 1>"));
    CHECK_FALSE(has(pov, "#declare Noise"));
    const std::string glass = "material { refraction .9 rgb noise { colors { 0 <1, 1, 1> 1 <0, 0, 1> } } }";
    const std::string clear = convert(camera + light + "sphere { <0, 0, 1>, 1 scale 3 " + glass + " }").pov;
    CHECK(has(clear, "#declare Noise = function(x, y, z)"));
    CHECK(has(clear, "color_map { [0 rgb <1, 1, 1> filter 0.9] [1 rgb <0, 0, 1> filter 0.9] }"));
    CHECK(has(clear, "{ Noise_Glass_Shadow scale 3"));
    CHECK(has(clear, "{ Noise_Glass scale 3"));
    // The parts have their composite's pattern, but not that of their own one beside it.
    const std::string parts = "sphere { <0, 0, 1>, 1 rotate <0, 0, 9> } sphere { <0, 1, 1>, 1 rotate <0, 0, 8> ";
    const std::string whole = convert(camera + "union { " + parts + "} " + chequered + " }").pov;
    CHECK(count(whole, "texture { Checker_Gloss }") == 1);
    const std::string first = "union { sphere { <0, 0, 1>, 1 " + chequered + " } ";
    const std::string apart = convert(camera + first + parts + chequered + " } }").pov;
    CHECK(count(apart, "texture { Checker_Gloss }") == 2);
}

TEST_CASE("with the camera in glass, bodies are listed in the file's order") {
    const std::string ball = "sphere { <0, -9, 3>, 1 material { refraction 0.5 } }";
    CHECK(has(convert(camera + light + ball).ini, "Bounding=Off"));
    CHECK_FALSE(has(convert(camera + light + "sphere { <0, 0, 1>, 1 material { refraction 0.5 } }").ini, "Bounding"));
}

TEST_CASE("small and large scenes are scaled") {
    const auto scale = [](double size) {
        Scene scene;
        scene.camera.position = {0, -9 * size, 3 * size};
        scene.materials.emplace_back();
        scene.primitives.push_back({Sphere{{0, 0, size}, size}, 0, {}});
        scene.primitives.push_back({Plane{}, 0, {}});
        return scale_for(scene, {scene.camera});
    };
    // Farthest point and POV-Ray's tolerances and horizon: see povref/convert/scale.h.
    for (const double size : {1e-12, 1e-3, 1., 1e4, 1e9}) {
        CAPTURE(size);
        const PovScale own = scale(size);
        CHECK(own.fault.empty());
        CHECK(own.factor * 11 * size > 100);
        CHECK(own.factor * 11 * size < 1e4);
    }
    CHECK(scale(100).factor == 1);
    CHECK_FALSE(has(convert("camera { position <0, -900, 300> look_at <0, 0, 1> sky <0, 0, 1> fov 20 }\n"
                            "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> } sphere { <0, 0, 100>, 100 }")
                        .pov,
                    "Unit"));
    Scene wide;
    wide.camera.position = {0, -1e6, 0};
    wide.materials.emplace_back();
    wide.primitives.push_back({Sphere{{0, 0, 0}, 1e-6}, 0, {}});
    CHECK(scale_for(wide, {wide.camera}).fault != "");
    wide.primitives[0].shape = Disc{{0, 0, 0}, {0, 0, 1}, 100};  // it is flat, not small
    CHECK(scale_for(wide, {wide.camera}).fault == "");
}

TEST_CASE("materials get different, descriptive names") {
    Material red{.rgb = {0.9, 0.1, 0.1}, .reflection = 0, .specular = 0};
    Material glass{.rgb = {1, 1, 1}, .refraction = 0.8};
    Material mirror{.rgb = {0.1, 0.2, 0.8}, .reflection = 0.8, .ambient = 0.1};
    const auto names = material_names({red, glass, mirror, red});
    CHECK(names == std::vector<std::string>{"Red_Matt", "Clear_Glass", "Blue_Mirror", "Red_Matt_2"});
}

TEST_CASE("an animation holds every frame's camera") {
    const Scene scene = read_scene("crosscheck/flight");
    PovRequest request = request_for("flight", scene);
    request.fps = 5;
    request.cameras.clear();
    for (int n = 0; n < 10; ++n) request.cameras.push_back(camera_at(*scene.flythrough, scene.camera, n / 5.));
    const PovFiles files = write_pov(scene, request);
    CHECK(has(files.pov, "#declare Eye = array[10] {"));
    CHECK(has(files.pov, "location  Eye[frame_number]"));
    CHECK(has(files.ini, "Initial_Frame=0\nFinal_Frame=9\n"));
    CHECK_FALSE(has(files.ini, "Clock"));
    // Bodies move by the clock; equal motions are declared once.
    const std::string motion = "motion { key { time 1 } key { time 3 translate <0, 0, 8> } }";
    const std::string two = "sphere { <0, 0, 0>, 1 " + motion + " } sphere { <3, 0, 0>, 1 " + motion + " }";
    const Scene moving = parse_scene(camera + light + two, "test");
    const PovFiles moved = write_pov(moving, request);
    CHECK(has(moved.ini, "Initial_Clock=0\nFinal_Clock=1.8\n"));
    CHECK(has(moved.pov, "#if (clock > 1 & clock < 3)"));
    CHECK(count(moved.pov, "#declare Motion_") == 1);
    CHECK(count(moved.pov, " transform { Motion_1 }") == 2);
    CHECK(has(moved.pov, "#declare Over = (clock - 1)/2;\n    #declare Share ="));
    const Scene eased = parse_scene(
        camera + "sphere { <0, 0, 0>, 1 motion { key { time 1 } key { time 3 translate <0, 0, 8> ease .75 } } }",
        "test");
    CHECK(has(write_pov(eased, request).pov,
              "#declare Over = (clock - 1)/2;\n    #declare Over = Cubic(0, 1, 1, 0.25, Over);\n"));
    request.fps = 0, request.time = 3;
    CHECK(count(write_pov(moving, request).pov, " translate <0, 0, 8>") == 2);
}

TEST_CASE("every scene has a current reference picture") {
    std::map<std::string, std::string> sums;
    std::ifstream list(STRAHL_SOURCE "/povref/reference/emitted.sha256");
    for (std::string sum, file; list >> sum >> file;) sums[file] = sum;
    const Scratch scratch;
    const std::string path = scratch / "scene.pov";
    std::string stale;
    for (const std::string& name : scene_names()) {
        const Scene scene = read_scene(name);
        write_file(path, write_pov(scene, request_for(name, scene)).pov);
        if (sums[name + ".pov"] != sha256(path)) stale += " " + name;
        sums.erase(name + ".pov");
    }
    CHECK_MESSAGE(stale.empty(), "stale, run povref/make_references:", stale);
    CHECK_MESSAGE(sums.empty(), "references without a scene, run povref/make_references");
}

TEST_CASE("a scene's file name cannot put lines into the files, nor can a path") {
    const Scene scene = parse_scene(camera + light, "test");
    PovRequest request = request_for("test", scene);
    const PovFiles plain = write_pov(scene, request);
    for (const std::string name :
         {"evil\nCreate_Ini=precious.txt\n;.rt", "evil\rCreate_Ini=precious.txt", "\n#include \"precious.txt\""}) {
        request.title = name;
        const PovFiles files = write_pov(scene, request);
        CHECK(count(files.ini, "\n") == count(plain.ini, "\n"));
        CHECK(count(files.pov, "\n") == count(plain.pov, "\n"));
        CHECK(count(files.ini + files.pov, "\r") == 0);
    }
    for (const std::string name :
         {"a\nCreate_Ini=b.pov", "a\rb.pov", "a\tb.pov", "a\x1b[2Jb.pov", "\"'.pov", "a\\\" b.pov"}) {
        request.pov_path = name;
        CHECK_THROWS_AS(write_pov(scene, request), UsageError);
    }
    for (const auto& [name, held] : {std::pair{"a b.pov", "\"a b.pov\""},
                                     {"a\"b.pov", "'a\"b.pov'"},
                                     {"a'b.pov", "\"a'b.pov\""},
                                     {"a.pov", "a.pov"}}) {
        request.pov_path = name;
        CHECK(has(write_pov(scene, request).ini, std::string("\nInput_File_Name=") + held + "\n"));
    }
}

// A scene written as text and parsed again is the same scene.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "files/read_file.h"
#include "image/pixels.h"
#include "tests/unit/text/random_texts.h"
#include "text/parse.h"
#include "text/write.h"

// The picture library is loaded while this runs. The leak check of g++ 12 takes a wrong address for that library's
// thread-local memory then, and ends in a segmentation fault.
extern "C" const char* __asan_default_options() { return "intercept_tls_get_addr=0"; }

using namespace strahl;

TEST_CASE("random scenes") {
    int whole = 0;
    for (unsigned seed = 0; seed < 1300; ++seed) {
        const Scene scene = RandomScenes(seed).scene();
        const std::string text = write_scene(scene);
        CAPTURE(text);
        try {
            const Scene again = parse_scene(text, "written", {}, made_up_pixels);
            CHECK(again == scene);
            CHECK(write_scene(again) == text);
            ++whole;
        } catch (const FileError& error) {
            // A body transformed out of range; the text must have no other error.
            const std::string message = error.what();
            CHECK_MESSAGE(message.find("the transformations up to here") != message.npos, message);
        }
    }
    CHECK(whole > 700);
}

TEST_CASE("scenes of this project") {
    const std::filesystem::path folder = std::filesystem::path(STRAHL_SOURCE) / "scenes";
    if (!std::filesystem::exists(folder)) return;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".rt") continue;
        const std::string path = entry.path().string();
        CAPTURE(path);
        const Scene scene = parse_scene(read_text(path), path, {}, read_pixels);
        CHECK(parse_scene(write_scene(scene), path, {}, read_pixels) == scene);  // files of meshes are beside it
    }
}

TEST_CASE("written text looks hand-written") {
    Scene scene;
    scene.camera = {{0, -9, .1}, {0, 0, 0}, {0, 0, -1}, 25, {}};
    scene.settings.assumed_gamma = 1;
    scene.lights = {{{1, 2, 3}, {1, 1, 1}}};
    Material red, glass;
    red.rgb = {1, 0, 0};
    glass.refraction = .9, glass.ior = 1.5;
    scene.materials = {Material{}, red, glass};
    scene.primitives = {{Plane{}, 0, {}},
                        {Sphere{{0, 0, 1}, .5}, 1, {Rotate{{0, 0, 90}}}},
                        {Sphere{{2, 0, 1}, .5}, 2, {}},
                        {Sphere{{4, 0, 1}, 1e-7}, 2, {Scale{{2, 2, 2}}, Scale{{1, 2, 3}}}}};
    CHECK(write_scene(scene) == R"(camera {
  position <0, -9, 0.1>
  look_at <0, 0, 0>
  up <0, 0, -1>
  fov 25
}
global_settings {
  assumed_gamma 1
}

light { position <1, 2, 3>  color <1, 1, 1> }

plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }
sphere { <0, 0, 1>, 0.5  rotate <0, 0, 90>  material { rgb <1, 0, 0> } }

defaultmaterial { refraction 0.9  ior 1.5 }
sphere { <2, 0, 1>, 0.5 }
sphere { <4, 0, 1>, 1e-07  scale 2  scale <1, 2, 3> }
)");
    scene.primitives = {
        {Union{std::make_shared<const std::vector<Primitive>>(std::vector<Primitive>{
             {Sphere{{0, 0, 1}, .5}, 1, {}},
             {Difference{std::make_shared<const std::vector<Primitive>>(std::vector<Primitive>{
                  {Cuboid{{0, 0, 0}, {1, 1, 1}}, 0, {Rotate{{0, 0, 9}}}}, {Sphere{{0, 0, 1}, .5}, 2, {}}})},
              0,
              {Scale{{2, 2, 2}}}}})},
         1,
         {Translate{{1, 2, 3}}}}};
    CHECK(write_scene(scene).ends_with(R"(
union {
  sphere { <0, 0, 1>, 0.5 }
  difference {
    box { <0, 0, 0>, <1, 1, 1>  rotate <0, 0, 9> }
    sphere { <0, 0, 1>, 0.5  material { refraction 0.9  ior 1.5 } }
    scale 2
    material { rgb <0.5, 0.5, 0.5> }
  }
  translate <1, 2, 3>
  material { rgb <1, 0, 0> }
}
)"));
    CHECK(write_flythrough(
              {3, true, {{0, {1, 2, 3}, {0, 0, 0}, 45., {}}, {2, {1, 2, 4}, {0, 0, 0}, {}, DVec3(0, 1, 0)}}}) ==
          R"(flythrough {
  duration 3
  loop
  key { time 0  position <1, 2, 3>  look_at <0, 0, 0>  fov 45 }
  key { time 2  position <1, 2, 4>  look_at <0, 0, 0>  up <0, 1, 0> }
}
)");
}

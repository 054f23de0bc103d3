// The scene language: valid scenes.
#include "tests/unit/text/language.h"

#include "text/write.h"

using namespace strahl;
using namespace strahl::language;

TEST_CASE("the article's own listings") {
    const Scene scene = parse(R"(
camera
{
  position <5.0,-20.0,18.0>
  look_at < 0.0,0.0,0.0> //K.ziel
  up < 0,0,-1> //Kamera oben?
  fov 25.0 //Öffnungswinkel
  aspectratio 1.333333
  //Breite/Höhe des Bildschirms
}
light
{
  position <-5.0,0.0,10.0> //Ort
  color < 0.5,0.5,0.5> //L.Farbe
}
defaultmaterial
{
  rgb < 0.5, 0.5, 0.5> //RGB-Farbe
  reflection 0.5 // Reflexkoeff.
  refraction 0.0 // Transparenz
  diffuse 0.5 // Reflex.Koeffiz.
  ambient 0.0 // Reflex.Koeffiz.
  specular 1.0 // Koeffiz.für
  // spiegelnde Reflexion
  pow 50.0 // Potenz dafür
  ior 1.0 // Brechzahl-Material
}
sphere
{ < 1,2,3>, 4
  material
  { rgb <1,0,0> }
}
plane
{< 0.0, 0.0, 0.0 >,
 < 1.0, 0.0, 0.0 >,
 < 0.0, 1.0, 0.0 > }
)");
    CHECK(scene.camera == Camera{{5, -20, 18}, {0, 0, 0}, {0, 0, -1}, 25, 1.333333});
    CHECK(scene.lights == std::vector<Light>{{{-5, 0, 10}, {.5, .5, .5}}});
    Material red;
    red.rgb = {1, 0, 0};
    CHECK(scene.materials == std::vector<Material>{red, Material{}});
    REQUIRE(scene.primitives.size() == 2);
    CHECK(scene.primitives[0] == Primitive{Sphere{{1, 2, 3}, 4}, 0, {}});
    CHECK(scene.primitives[1] == Primitive{Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 1, {}});
    CHECK(scene.settings == Settings{});
    CHECK(scene.background == Color(0));
    CHECK(!scene.flythrough);
}

TEST_CASE("everything that the article does not have") {
    const Scene scene = parse(R"(
        background { color <.1, .2, .3> }
        global_settings { ambient_light <1, 2, 3> max_trace_level 256 assumed_gamma 1 }
        cylinder { <0,0,0>, <0,0,2>, .5 }
        camera { angle 50 sky <0,0,1> look_at <0,0,0> position <0,-9,0> }
        flythrough { loop duration 12
            key { time 0 position <0,-9,0> look_at <0,0,0> }
            key { look_at <0,0,1> position <1,-9,0> time 4 angle 90 sky <1,0,1> } })");
    CHECK(scene.background == Color(.1, .2, .3));
    CHECK(scene.settings == Settings{{1, 2, 3}, 256, true});
    CHECK(scene.primitives == std::vector<Primitive>{{Cylinder{{0, 0, 0}, {0, 0, 2}, .5}, 0, {}}});
    CHECK(scene.camera == Camera{{0, -9, 0}, {0, 0, 0}, {0, 0, -1}, 25, {}});
    CHECK(
        scene.flythrough ==
        Flythrough{12, true, {{0, {0, -9, 0}, {0, 0, 0}, {}, {}}, {4, {1, -9, 0}, {0, 0, 1}, 45., DVec3(-1, 0, -1)}}});
}

TEST_CASE("materials start from the default in force; no duplicates, in the order of use") {
    const Scene scene = with_eye(R"(
        sphere { <0,0,0>, 1 }
        defaultmaterial { diffuse .1 ior 2 }
        sphere { <0,0,0>, 2 material { diffuse .2 } }
        sphere { <0,0,0>, 3 }
        defaultmaterial { ambient 1 }
        sphere { <0,0,0>, 4 material { } }
        defaultmaterial { rgb <.5,.5,.5> reflection .5 refraction 0 diffuse .5 ambient -0 specular 1 pow 50 ior 1 }
        sphere { <0,0,0>, 5 }
        defaultmaterial { pow 3 })");
    const auto of = [&](int i) { return scene.materials[scene.primitives[i].material]; };
    CHECK(of(0) == Material{});
    CHECK((of(1).diffuse == .2 && of(1).ior == 2 && of(1).ambient == 0));
    CHECK((of(2).diffuse == .1 && of(2).ior == 2 && of(2).ambient == 0));
    CHECK((of(3).diffuse == .1 && of(3).ior == 2 && of(3).ambient == 1));  // the second default starts from the first
    CHECK(scene.primitives[4].material == 0);
    CHECK(scene.materials.size() == 4);
}

TEST_CASE("transformations keep their order, even with a material between them") {
    const Scene scene =
        with_eye("sphere { <0,0,0>, 1 scale 2 rotate <1,2,3> material { } translate <4,5,6> scale <1,2,-3> }");
    CHECK(scene.primitives[0].transformations ==
          std::vector<Transformation>{Scale{{2, 2, 2}}, Rotate{{1, 2, 3}}, Translate{{4, 5, 6}}, Scale{{1, 2, -3}}});
}

TEST_CASE("numbers as in C, commas, comments and white space") {
    const auto radius = [](const std::string& text) {
        return std::get<Sphere>(with_eye("sphere { <0,0,0>, " + text + " }").primitives.at(0).shape).radius;
    };
    CHECK(radius("1") == 1);
    CHECK(radius("+2.50") == 2.5);
    CHECK(radius(".5") == .5);
    CHECK(radius("1.") == 1);
    CHECK(radius("1e-3") == 1e-3);
    CHECK(radius("1E+3") == 1e3);
    CHECK(radius("0.1") == .1);
    CHECK(radius("1.7976931348623157e-300") == 1.7976931348623157e-300);
    const std::vector<Primitive> ball{{Sphere{{1, -2, 3}, 4}, 0, {}}};
    for (const char* const text :
         {"sphere{<1,-2,3>,4}", "sphere{<1,-2,3>4}", "sphere { <1 , -2 , 3> 4 }", "sphere\r\n{\t<1,\v-2,\f3>\r,4\r\n}",
          "sphere/**/{/* a * / */<1,-2,// }\n3>/**/4/*}*/}//", "// ä\nsphere{<1,-2,3>,4}\n/* /* */",
          "sphere{<1,-2,3>/***/4}"})
        CHECK(with_eye(text).primitives == ball);
    CHECK(parse("\xEF\xBB\xBF" + eye).lights.empty());  // a byte order mark
}

TEST_CASE("lines may end in a carriage return, in a line feed, or in both") {
    for (const std::string end : {"\r", "\n", "\r\n"}) {
        CAPTURE(end.size());
        std::string text = eye;
        for (const char* line : {"// a ball", "sphere { <1,2,3>, 4 } // and another one", "sphere { <1,2,3>, 5 }"})
            text += line + end;
        CHECK(parse(text).primitives.size() == 2);
        const Faults told = faults(text + "// below it" + end + "sphere { <1,2,3>, -6 }" + end);
        REQUIRE(told.size() == 1);
        CHECK(told[0].starts_with("x.rt:6:19: "));
    }
}

TEST_CASE("many materials are fast, and numbered in the order of use") {
    std::string text = "camera { position <0,-9,0> look_at <0,0,0> up <0,0,-1> fov 25 }\n";
    constexpr int count = 20000;
    for (int i = 0; i < 2 * count; ++i)
        text += "sphere { <0,0,0>, 1 material { pow " + std::to_string(i % count) + " } }\n";
    const Scene scene = parse_scene(text, "many");
    REQUIRE(scene.materials.size() == count);
    for (int i = 0; i < 2 * count; ++i) REQUIRE(scene.primitives[i].material == i % count);
    CHECK(scene.materials[count - 1].pow == count - 1);
    CHECK(parse_scene(write_scene(scene), "written") == scene);
}

// The scene language: bodies made of bodies.
#include "tests/unit/text/language.h"

using namespace strahl;
using namespace strahl::language;

namespace {

template <class Kind>
const std::vector<Primitive>& parts(const Primitive& primitive) {
    return *std::get<Kind>(primitive.shape).parts;
}

const std::string ball = "sphere { <0,0,0>, 1 } ";

std::string nested(int levels) {
    std::string text;
    for (int i = 1; i < levels; ++i) text += "union { ";
    text += ball;
    for (int i = 1; i < levels; ++i) text += "} ";
    return text;
}

}  // namespace

TEST_CASE("bodies made of bodies, in any depth and with words in any order") {
    const Scene scene = with_eye(R"(
        sphere { <0,0,0>, 9 }
        difference {
          scale 2
          box { <-1,-1,-1>, <1,1,1> translate <1,2,3> }
          rotate <1,2,3>
          union { sphere { <0,0,0>, 1 } intersection { plane { <0,0,0>, <1,0,0>, <0,1,0> } } }
        })");
    REQUIRE(scene.primitives.size() == 2);
    const Primitive& whole = scene.primitives[1];
    CHECK(whole.transformations == std::vector<Transformation>{Scale{{2, 2, 2}}, Rotate{{1, 2, 3}}});
    REQUIRE(parts<Difference>(whole).size() == 2);
    CHECK(parts<Difference>(whole)[0] == Primitive{Cuboid{{-1, -1, -1}, {1, 1, 1}}, 0, {Translate{{1, 2, 3}}}});
    const std::vector<Primitive>& inner = parts<Union>(parts<Difference>(whole)[1]);
    REQUIRE(inner.size() == 2);
    CHECK(inner[0] == Primitive{Sphere{{0, 0, 0}, 1}, 0, {}});
    CHECK(parts<Intersection>(inner[1]) == std::vector<Primitive>{{Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0, {}}});
}

TEST_CASE("parts start from the material of the composite around them, wherever it stands") {
    const Scene scene = with_eye(R"(
        defaultmaterial { pow 7 }
        union {
          sphere { <0,0,0>, 1 }
          material { diffuse .1  ambient .1 }
          sphere { <0,0,0>, 2 material { ambient .2 } }
          difference {
            sphere { <0,0,0>, 3 material { ambient .3 } }
            sphere { <0,0,0>, 4 }
            material { ior 2 }
          }
        }
        sphere { <0,0,0>, 5 })");
    const auto named = [](double diffuse, double ambient, double ior) {
        return Material{.diffuse = diffuse, .ambient = ambient, .pow = 7, .ior = ior};
    };
    // In the order of first use: of a composite its own, then those of its parts.
    CHECK(scene.materials == std::vector<Material>{named(.1, .1, 1), named(.1, .2, 1), named(.1, .1, 2),
                                                   named(.1, .3, 2), named(.5, 0, 1)});
    CHECK(scene.primitives[0].material == 0);
    const std::vector<Primitive>& outer = parts<Union>(scene.primitives[0]);
    CHECK(outer[0].material == 0);
    CHECK(outer[1].material == 1);
    CHECK(outer[2].material == 2);
    CHECK(parts<Difference>(outer[2])[0].material == 3);
    CHECK(parts<Difference>(outer[2])[1].material == 2);
    CHECK(scene.primitives[1].material == 4);
}

TEST_CASE("composites that are not allowed") {
    check_fault("union { }", "2:1: invalid union: it has no parts");
    check_fault("union { " + ball + "\ndifference { } }", "3:1: invalid difference: it has no parts");
    check_fault("intersection { " + ball + "\ndisc { <0,0,0>, <0,0,1>, 1 } }",
                "3:1: a disc cannot be part of a body: only closed bodies can");
    const std::string three =
        "triangle { <0,0,0>, <0,1,0>, <1,0,0> } triangle { <0,0,0>, <1,0,0>, <0,0,1> } "
        "triangle { <0,0,0>, <0,0,1>, <0,1,0> } ";
    check_fault("union { mesh { " + three + "} }",
                "2:9: this mesh cannot be part of a body: it is open between <0, 1, 0> and <1, 0, 0>");
    CHECK(with_eye("union { mesh { " + three + "triangle { <1,0,0>, <0,1,0>, <0,0,1> } } }").primitives.size() == 1);
    check_fault("union { " + ball + "\ncylinder { <0,0,0>, <0,0,0>, 1 } }",
                "3:1: invalid cylinder: base and cap are the same point");
    std::string many;
    for (int i = 0; i < 1023; ++i) many += ball;
    CHECK(with_eye("union { " + many + ball + ball + "}").primitives.size() == 1);
    CHECK(with_eye("difference { " + many + ball + "}").primitives.size() == 1);
    check_fault("union { difference { " + many + ball + ball + "} }",
                "2:1: invalid union: 1025 of its bodies are connected, and at most 1024 may be");
    check_fault("union { " + many + ball + ball + "material { refraction .5 } }",
                "2:1: invalid union: 1025 of its bodies are connected, and at most 1024 may be");
    check_fault(
        "union { " + ball + "camera_ }",
        "2:31: unknown word 'camera_' in 'union'; known here: material, motion, rotate, translate, scale, sphere, "
        "plane, cylinder, cone, box, disc, torus, prism, lathe, superellipsoid, blob, sphere_sweep, julia_fractal, "
        "triangle, smooth_triangle, mesh, union, intersection, difference");
    check_fault("union { material { }\nmaterial { } " + ball + "}", "3:1: a second 'material'; the first is in line 2");
    check_fault("union { " + ball + "\nlight { position <0,0,0> color <1,1,1> }",
                "3:1: '}' missing: the 'union' of line 2 is still open");
    check_fault("union {\nunion { " + ball, "3:1: '}' missing: this 'union' is never closed");
    check_fault("union { sphere { <0,0,zero>, 1 } }",
                "2:23: a number expected for 'centre' of 'sphere', but found 'zero'");
    check_fault("union <1>", "2:7: '{' expected after 'union', but found '<'");
}

TEST_CASE("parts are checked where all transformations have taken them") {
    check_fault("union { sphere { <1e8,0,0>, 1 scale 1e8 } }",
                "2:31: invalid sphere: the transformations up to here make it too large, too small or too far away "
                "(coordinates go up to 1e9)");
    check_fault("union { union { sphere { <1e5,0,0>, 1 scale 1e3 } } scale 1e3 }",
                "2:53: invalid union: the transformations up to here make it too large, too small or too far away "
                "(coordinates go up to 1e9)");
    check_fault("union { sphere { <0,0,0>, 1 scale <1,1,1e-8> } scale <1,1,1e-8> }",
                "2:48: invalid union: the transformations up to here flatten it: one side shrinks more than 1e12 times "
                "as much as another");
    check_fault("union { sphere { <0,0,0>, 1 scale 1e-200 } scale 1e-200 }",
                "2:44: invalid union: the transformations up to here scale it out of the range of numbers");
    CHECK(with_eye("union { sphere { <0,0,0>, 1 scale <1,1,1e-8> } scale <1,1,1e8> }").primitives.size() == 1);
    CHECK(with_eye("intersection { plane { <0,0,0>, <1,0,0>, <0,1,0> } scale 1e8 }").primitives.size() == 1);
}

TEST_CASE("bodies in bodies have a limit, and parts count as primitives") {
    CHECK(with_eye(nested(32)).primitives.size() == 1);
    CHECK(faults(eye + nested(33)) == Faults{"x.rt:2:257: more than 32 levels of bodies in bodies"});
    for (const std::string piece : {"union {", "difference { sphere { <0,0,0>, 1 ", "intersection { material {"}) {
        std::string text;
        for (int i = 0; i < 100000; ++i) text += piece;
        CHECK(message(eye + text).starts_with("x.rt:2:"));
        CHECK(message(eye + text).size() < 5000);
    }
    TextLimits limits;
    limits.primitives = 3;
    CHECK(message(eye + "union { " + ball + ball + "}", limits) == "no error");
    CHECK(
        message(eye + "union { " + ball + ball + "}\n" + ball, limits).starts_with("x.rt:3:1: more than 3 primitives"));
}

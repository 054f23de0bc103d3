// Bodies of POV-Ray's scenes: shapes, composites, transformations, and which texture each has.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "num/decimal.h"
#include "num/vec_math.h"
#include "pov/language/interpreter_options.h"
#include "pov/things/letters.h"
#include "pov/things/steps.h"
#include "pov/things/surfaces.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "tests/referee/pattern.h"
#include "tests/unit/pov/opened.h"

using namespace strahl;

TEST_CASE("POV-Ray: a composite has no more connected bodies than rays can meet together") {
    const std::string spheres = "union { #for (I, 0, 39) #for (J, 0, 39) sphere { <I, J, 0>, .4 } #end #end } ";
    const Scene whole_box = whole("difference { box { -1, <20, 20, 1> } " + spheres + "}");
    CHECK(leaves_of(whole_box.primitives[0].shape) == 1 + 21 * 21);
    const std::string all = "difference { box { -1, <50, 50, 1> } " + spheres + "}";
    CHECK(says(notes_of(all), "left out: bodies of a composite beyond 1024 that are connected"));
    CHECK(leaves_of(opened(all).scene.primitives[0].shape) == 1024);
    CHECK(says(notes_of("intersection { " + spheres + spheres + " }"), "beyond 1024"));
}

TEST_CASE("POV-Ray: a difference keeps the faces that its parts share") {
    const auto first = [](const std::string& parts) {
        const Scene scene = whole("difference { " + parts + " }");
        return (*shape<Difference>(scene).parts)[0].shape;
    };
    const Cuboid grown = std::get<Cuboid>(first("box { 0, 4 } box { 1, <2, 4, 2> }"));
    CHECK(grown.opposite.y > 4);
    CHECK(grown.opposite.y < 4 + 1e-7);
    CHECK(grown.corner == DVec3(0));
    CHECK(grown.opposite.x == 4);
    CHECK(std::get<Cuboid>(first("box { 0, 4 } cylinder { <1, 1, 1>, <1, 5, 1>, .5 translate -y }")).opposite.y > 4);
    CHECK(std::get<Cylinder>(first("cylinder { 0, 3*y, 2 } cylinder { y, 3*y, 1 }")).cap.y > 3);
    CHECK(std::get<Cone>(first("cone { 0, 1, 3*y, 2 } cone { y, .5, 3*y, 1 }")).cap.y > 3);
    CHECK(std::get<Plane>(first("plane { y, 3 } cylinder { y, 3*y, 1 }")).a.y > 3);
    const Shape open = first("cylinder { 0, 3*y, 2 open } cone { y, .5, 3*y, 1 }");
    CHECK(std::ranges::any_of(*std::get<Intersection>(open).parts, [](const Primitive& part) {
        const auto* const plane = std::get_if<Plane>(&part.shape);
        return plane && plane->a.y > 3 && plane->a.y < 3 + 1e-7;
    }));
    // Faces beside each other, or that face each other, stay.
    CHECK(first("box { 0, 4 } box { <6, 1, 1>, <7, 4, 2> }") == Shape(Cuboid{DVec3(0), DVec3(4)}));
    CHECK(first("box { 0, 4 } box { <1, 4, 1>, <2, 5, 2> }") == Shape(Cuboid{DVec3(0), DVec3(4)}));
}

TEST_CASE("POV-Ray: faces of parts in one place are told where POV-Ray's rounding decides what is seen") {
    const auto told = [](const std::string& text) {
        return says(notes_of("camera { right -4/3*x location <1, 9, -2> look_at 0 } " + text),
                    "faces of parts in one place");
    };
    const std::string flush = "box { -1, 1 } box { <.5, -1, -.5>, <3, 1, .5> } ";
    CHECK(told("merge { " + flush + "}"));
    CHECK(told("merge { " + flush + "rotate <-10, 20, 3> }"));
    CHECK(told("intersection { box { -1, 1 } box { <-2, -2, -1>, <2, 2, 3> } }"));
    CHECK(!told("intersection { box { -1, 1 } box { <-2, -2, 1>, <2, 2, 3> } }"));
    CHECK(!told("union { " + flush + "}"));
    CHECK(!told("merge { box { -1, 1 } box { <.5, -1, -.5>, <3, .9, .5> } }"));  // not seen from above
    CHECK(told("merge { box { -1, 1 } box { <.5, -1, -.5>, <3, .9, .5> } pigment { rgbt .5 } }"));
    CHECK(!told("merge { box { -1, 1 } box { <.5, -.9, -.5>, <3, .9, .5> } }"));
    CHECK(!told("merge { " + flush + "box { -1.5, 4 } }"));  // inside another part
    // Parts of a merge that touch have a face there in POV-Ray, which shows if light goes through.
    const std::string touching = "merge { box { -1, 1 } box { <1, -2, -1>, <3, .5, .5> } pigment { rgb 1 ";
    CHECK(told(touching + "transmit .5 } }"));
    CHECK(!told(touching + "} }"));
    CHECK(!told("merge { box { -1, 1 } box { <1.001, -2, -1>, <3, .5, .5> } pigment { rgbt .5 } }"));
    const std::string prism = "prism { 0, 5, 5, <.2,-2.4>, <-.2,-2.4>, <-.8,-1.4>, <.8,-1.4>, <.2,-2.4> } ";
    const std::string beside = "prism { 0, 4, 5, <-.8,-1.4>, <-.5,-1.9>, <-1,-1.9>, <-1.3,-1.4>, <-.8,-1.4> } ";
    CHECK(told("merge { " + prism + beside + "pigment { rgbt .5 } }"));
    // Looks at faces of what two parts take away, inside the first part of a difference.
    const std::string open = "box { <-1, -1, -1>, <1, 3, 1> } box { <.5, -1, -.5>, <3, 3, .5> } ";
    CHECK(told("difference { sphere { 0, 2 } " + open + "}"));
    CHECK(!told("difference { sphere { 0, 2 } " + flush + "}"));  // hidden inside
    CHECK(!told("difference { sphere { <-1, -1, -1>, .4 } box { -.7, 1 } box { <.5, -.7, -.5>, <3, 1, .5> } }"));
    CHECK(!told("difference { box { -1, 1 } box { <-.5, -.5, -.5>, <.5, 1, .5> } }"));
    CHECK(told("difference { sphere { 0, 2 } union { " + open + "} union { " + open + "} rotate 9 }"));
    const std::string ball = "sphere { <.3, 1.5, -.3>, 1.2 } ";
    CHECK(told("difference { sphere { 0, 2 } " + ball + ball + "}"));
    CHECK(!told("difference { sphere { 0, 2 } " + ball + "torus { 1, .1 } }"));
    // No point of the surface of a cylinder or a cone is inside, so that their faces stay in differences and merges.
    const std::string red = " pigment { rgb x } } ";
    for (const std::string body : {"cylinder { -3*y, 3*y, .5 ", "cone { -y, 1, 3*y, .2 "}) {
        CHECK(!told("difference { sphere { 0, 2 } " + body + "} " + body + "} }"));
        CHECK(told("intersection { sphere { 0, 2 } " + body + "} " + body + "} }"));
        CHECK(!told("merge { " + body + "} " + body + "} }"));
        CHECK(told("merge { " + body + red + body + "} }"));
    }
    // What is less than a four-hundredth of the picture does not count.
    CHECK(!told("merge { " + flush + "scale .02 }"));
}

TEST_CASE("POV-Ray: differences keep the curved faces of cylinders and cones that they share with what they lose") {
    const auto first = [](const std::string& parts) {
        return (*std::get<Difference>(whole("difference { " + parts + " }").primitives[0].shape).parts)[0].shape;
    };
    CHECK(std::get<Cylinder>(first("cylinder { -2*y, 2*y, 1 } cylinder { y, 3*y, 1 }")).radius > 1);
    CHECK(std::get<Cylinder>(first("cylinder { -2*y, 2*y, 1 } cylinder { y, 3*y, .9 }")).radius == 1);
    CHECK(std::get<Cylinder>(first("cylinder { -2*y, 2*y, 1 } cylinder { y, <1, 3, 0>, 1 }")).radius == 1);
    const auto cone = std::get<Cone>(first("cone { -y, 1, y, .2 } cone { 0, .6, 1.5*y, 0 }"));
    CHECK((cone.base_radius > 1 && cone.cap_radius > .2));
    CHECK(std::get<Cone>(first("cone { -y, 1, y, .2 } cone { 0, .5, 1.5*y, 0 }")).base_radius == 1);
}

TEST_CASE("POV-Ray: faces of bodies in one place are told where they are seen, by the camera or in mirrors") {
    const auto told = [](const std::string& text) {
        return says(notes_of("camera { right -4/3*x location <1, 5, -9> look_at 0 } " + text),
                    "a face in the place of another body's");
    };
    const std::string red = " pigment { rgb x } } ", clear = " pigment { rgbt .8 } } ";
    const std::string box = "box { -1, 1 } ", higher = "box { <-.5, -1, -.5>, <2, 1, .5>" + red;
    CHECK(told(box + higher));
    CHECK(told("union { " + box + higher + "rotate 20*z }") != told("union { " + box + higher + "rotate 0 }"));
    CHECK(!told(box + "box { <-.5, -1, -.5>, <2, 1, .5> } "));  // looks the same
    CHECK(!told(box + "box { <-.5, -1, -.5>, <2, .99, .5>" + red));
    CHECK(!told(box + higher + "box { <-5, 2, -9>, <5, 2.1, 9> } "));                    // hidden
    CHECK(!told("box { -1, 1 scale .1 } box { <-.05, -1, -.05>, <.2, .1, .05>" + red));  // small
    CHECK(!told(box + higher + "sphere { 0, 4 clipped_by { plane { -y, 3.9 } } }"));     // by what is there of a body
    CHECK(told(box + higher + "sphere { 0, 4 clipped_by { plane { y, -3.9 } } }"));
    CHECK(says(notes_of("camera { orthographic right -8*x up 6*y location <1, 5, -9> look_at 0 } " + box + higher),
               "a face in the place of another body's"));
    CHECK(told("disc { y, y, 2" + red + box));
    CHECK(told("polygon { 4, <-2, 1, -2>, <2, 1, -2>, <0, 1, 2>, <-2, 1, -2>" + red + box));
    CHECK(told("cylinder { y, 2*y, .8" + clear + box));
    CHECK(!told("cylinder { y, 2*y, .8 } " + box));
    CHECK(told("sphere { 0, 2 } sphere { 0, 2" + red));
    CHECK(told("sphere { 0, 2 pigment { rgb .5 } } sphere { 0, 2 pigment { rgb <.503, .5, .5> } }"));
    CHECK(!told("sphere { 0, 2 pigment { rgb .5 } } sphere { 0, 2 pigment { rgb <.501, .5, .5> } }"));
    CHECK(told("cylinder { -y, y, 2 } cylinder { 0, 2*y, 2" + red));
    CHECK(told("union { cylinder { -y, y, 2 } cylinder { 0, 2*y, 2" + red + "scale .8 rotate <30, 20, 10> }"));
    CHECK(!told("cylinder { -y, y, 2 } cylinder { 0, <.01, 2, 0>, 2" + red));
    CHECK(told("cone { -y, 2, y, 1 } cone { 0, 1.5, 3*y, 0" + red));
    // The face that both boxes have is behind them.
    const std::string turned = "box { <-2, -1, -1>, <2, 1, 2> } box { <-1, -.8, 1>, <1, .8, 2>" + red;
    CHECK(!told(turned + "plane { z, 6 } "));
    CHECK(told(turned + "plane { z, 6 finish { reflection .5 } } "));
}

TEST_CASE("POV-Ray: faces of clear bodies in planes are told, and the plane is seen in their place") {
    const auto told = [](const std::string& text) {
        return says(notes_of("camera { right -4/3*x location <1, 5, -9> look_at 0 } " + text),
                    "a clear body's face in a plane");
    };
    const std::string clear = " pigment { rgbt .8 } } ", floor = "plane { y, 0 } ";
    CHECK(told("cylinder { 0, y, 1" + clear + floor));
    CHECK(told("merge { cylinder { 0, y, 1 } sphere { y, 1.1 }" + clear + floor));
    CHECK(told("prism { 0, 1, 4, <0, 0>, <3, 0>, <3, 3>, <0, 0>" + clear + floor));
    CHECK(!told("box { <-1, 0, -1>, 1" + clear + floor));
    CHECK(!told("cylinder { .001*y, y, 1" + clear + floor));
    CHECK(!told("cylinder { 0, y, 1 } " + floor));
    CHECK(!told("cylinder { 0, y, 1" + clear + floor + "box { <-5, 2, -9>, <5, 2.1, 9> }"));  // hidden
    const auto lowest = [](const std::string& text) {
        return world_bounds(opened("camera { right -4/3*x location <1, 5, -9> look_at 0 } " + text).scene.primitives[0])
            .low.y;
    };
    const std::string box = "box { <-1, 0, -1>, 1 rotate 20*y translate 3*x scale 2";
    CHECK(lowest(box + clear + floor) < 0);
    CHECK(lowest(box + clear + floor) > -1e-5);
    CHECK(lowest(box + " } " + floor) == 0);
    CHECK(lowest("difference { cylinder { 0, y, 1 } cylinder { .1*y, 2*y, .9 }" + clear + floor) < 0);
}

TEST_CASE("POV-Ray: a box that a division by zero makes endless reaches as far as coordinates do") {
    const Box box = world_bounds(opened("box { <0, 0, 1>, <1, 1/0, 2> }").scene.primitives.at(0));
    CHECK((box.low.y == 0 && box.high.y == 1e9));
}

TEST_CASE("POV-Ray: boxes and planes of an intersection that only touch have a face there") {
    const std::string teeth = "intersection { box { <1, .2, -.4>, <1.1, .4, .4> translate 2*y } ";
    const Scene scene = whole(teeth + "difference { box { <0, 2, -1>, <1, 3, 1> } box { <0, 2, -1>, <2, 2.3, 1> } } }");
    CHECK(contains(scene.primitives[0], {1.000001, 2.35, 0}));
    CHECK_FALSE(contains(scene.primitives[0], {1.000001, 2.25, 0}));
    CHECK_FALSE(contains(scene.primitives[0], {1.0001, 2.35, 0}));
    // Leaves boxes as they are that lie beside each other.
    const Scene apart = whole(teeth + "box { <.5, 4, -1>, <1, 5, 1> } }");
    CHECK(shape<Intersection>(apart).parts->at(1).shape == Shape(Cuboid{{.5, 4, -1}, {1, 5, 1}}));
}

TEST_CASE("POV-Ray: two sides of one slanting plane are a sheet") {
    for (const char* const move : {"", "rotate <10, 20, 30> translate <1, 2, 3>", "scale <1, 2, 3>"}) {
        const std::string sheet = "#declare N = vnormalize(<3, 5, -3>); intersection { plane { N, .5 } ";
        const std::string rest = std::string(" sphere { 0, 3 } ") + move + "}";
        const Scene scene = whole(sheet + "plane { -N, -.5 }" + rest);
        const auto& parts = *shape<Intersection>(scene).parts;
        const DVec3 n = normalize(DVec3(3, 5, -3)), in = .5 * n;
        const auto moved = [&](const DVec3& p) {
            return transform_point(matrix(scene.primitives[0].transformations), p);
        };
        CHECK(parts.size() == 3);
        CHECK(contains(scene.primitives[0], moved(in - 1e-7 * n)));
        CHECK_FALSE(contains(scene.primitives[0], moved(in - 1e-3 * n)));
        const Scene thick = whole(sheet + "plane { -N, -.4 }" + rest);
        CHECK_FALSE(contains(thick.primitives[0], moved(.4 * n - 1e-7 * n)));
    }
}

TEST_CASE("POV-Ray: a body is left out of which a part is missing that would hide some of it") {
    const std::string open = "triangle { x, y, z } ", ball = "sphere { 0, 1 } ";
    const auto bodies = [](const std::string& text) { return opened(text).scene.primitives.size(); };
    for (const std::string& text :
         {"intersection { " + ball + open + "}", "difference { " + ball + open + "}",
          "difference { " + open + ball + "}", "intersection { " + ball + "difference { box { -1, 1 } " + open + "} }",
          "object { " + ball + "clipped_by { " + open + "} }"}) {
        CAPTURE(text);
        CHECK(bodies(text) == 0);
        CHECK(says(notes_of(text), "left out"));
    }
    CHECK(bodies("merge { " + ball + open + "}") == 1);
    // A ball without a size shows nothing, and takes nothing away.
    CHECK(whole("difference { " + ball + "sphere { 0, 0 } }").primitives.size() == 1);
    CHECK(whole("intersection { " + ball + "sphere { 0, 0 } }").primitives.empty());
}

TEST_CASE("POV-Ray: open meshes that are parts have the inside that their inside_vector says") {
    const std::string roof = "mesh { triangle { -x, x+z, x-z } triangle { -x, x+z, y } triangle { x+z, x-z, y } ";
    const std::string open = "mesh { triangle { -x, x+z, y } triangle { x+z, x-z, y } triangle { x-z, -x, y } ";
    const auto inside = [&](const std::string& text, const std::string& move, const DVec3& p) {
        const Scene scene = opened(text).scene, lone = whole("sphere { 0, 1" + move + " }");
        REQUIRE(scene.primitives.size() == 1);
        return contains(scene.primitives[0], transform_point(matrix(lone.primitives[0].transformations), p));
    };
    for (const std::string move : {"", " rotate 20*y translate <3, 1, 2>", " scale <1, 2, .5>"}) {
        CAPTURE(move);
        const std::string own = open + "inside_vector y" + move + " } box { -9, 9 } }", met = "intersection { " + own;
        CHECK(inside(met, move, {.2, .1, 0}));
        CHECK_FALSE(inside(met, move, {.2, .9, 0}));
        CHECK_FALSE(inside(met, move, {1.2, .1, 0}));
        const std::string left = "difference { box { -9, 9 } " + open + "inside_vector y" + move + " } }";
        CHECK_FALSE(inside(left, move, {.2, .1, 0}));
        CHECK_FALSE(inside(left, move, {.2, -2, 0}));
        CHECK(inside(left, move, {.2, .9, 0}));
        CHECK(inside(left, move, {1.2, -2, 0}));
    }
    CHECK(inside("intersection { " + open + "inside_vector -y } box { -9, 9 } }", "", {.2, .9, 0}));
    CHECK(says(notes_of("intersection { " + open + "inside_vector y } box { -9, 9 } }"), "ends at the box around it"));
    whole("difference { box { -9, 9 } " + open + "inside_vector y } }");
    CHECK(says(notes_of("intersection { " + roof + "inside_vector y } triangle { x, y, z } }"), "left out"));
}

TEST_CASE("POV-Ray: unions that are parts keep the surfaces inside them, where there are some") {
    const std::string clear = " pigment { rgbt .5 } }";
    const auto both = [](const std::string& place) { return "{ sphere { 0, 1 } sphere { " + place + ", 1 } } "; };
    const std::string box = "box { -3, <3, .5, 3> } ";
    const auto keeps = [](const Scene& scene) {
        int count = 0;
        const auto look = [&](const auto& self, const Primitive& body) -> void {
            if (const auto* const own = std::get_if<Union>(&body.shape)) count += own->keeps;
            each_part(body, [&](const Primitive& part) { self(self, part); });
        };
        for (const Primitive& body : scene.primitives) look(look, body);
        return count;
    };
    for (const std::string& text :
         {"intersection { union " + both("x") + box, "difference { union " + both("y") + "sphere { 9, 1 } ",
          "merge { union " + both("x") + box,
          "difference { difference { union " + both("z") + box + "} sphere { 9, 1 } "}) {
        CAPTURE(text);
        CHECK(keeps(whole("object { " + text + clear + "}")) == 1);
    }
    // Unions of bodies that are apart, merges, and what a difference takes away have no such surfaces.
    for (const std::string& text :
         {"intersection { union " + both("8*x") + box, "intersection { merge " + both("x") + box,
          "difference { " + box + "union " + both("x"),
          "difference { " + box + "difference { " + box + "union " + both("x") + "} ",
          "union { union " + both("x") + box})
        CHECK(keeps(whole(text + clear)) == 0);
}

TEST_CASE("POV-Ray: parts have interiors of their own, bodies of a union share theirs where they overlap") {
    const std::string glass = "pigment { rgbf 1 } ", own = "interior { ior 1.1 } ", all = "interior { ior 1.5 } ";
    const auto balls = [](const std::string& more, const std::string& at) {
        return "{ sphere { 0, 1 } sphere { " + at + ", .8 " + more + "} ";
    };
    const auto interiors = [](const std::string& text) {
        const Scene scene = whole(text);
        std::vector<int> list;
        for (const Primitive& body : scene.primitives)
            for_each_leaf(body, [&](const Primitive& leaf, const glm::dmat4&) {
                list.push_back(scene.materials[static_cast<std::size_t>(leaf.material)].interior);
            });
        return list;
    };
    for (const std::string word : {"intersection ", "difference ", "merge "}) {
        CAPTURE(word);
        const std::vector<int> two = interiors(word + balls(own + glass, "x") + glass + all + "}");
        CHECK((two[0] > 0 && two[1] > 0 && two[0] != two[1]));
        CHECK(interiors(word + balls(own, "x") + "pigment { rgb 1 } " + all + "}") == std::vector{0, 0});
        CHECK(interiors(word + balls("", "x") + glass + all + "}") == std::vector{0, 0});
    }
    const std::vector<int> shared = interiors("union " + balls("", "x") + glass + all + "}");
    CHECK((shared[0] > 0 && shared[0] == shared[1]));
    CHECK(interiors("union " + balls("", "x") + glass + "} fog { distance 9 rgb 1 }")[0] > 0);
    CHECK(interiors("union " + balls("", "3*x") + glass + all + "}") == std::vector{0, 0});
    CHECK(interiors("union " + balls("", "x") + glass + "}") == std::vector{0, 0});
    CHECK(interiors("union " + balls("", "x") + "pigment { rgb 1 } " + all + "}") == std::vector{0, 0});
}

TEST_CASE("POV-Ray: of slanting faces in one plane that is seen whose box a ray enters first") {
    const std::string turn = " rotate <-10, 0, 25> translate <.3, .1, .7> ", view = "camera { right -4/3*x location ";
    const auto lifted = [&](const std::string& bodies, std::size_t number) {
        const Scene scene = whole(view + "<0, 3, -9> look_at 0 } light_source { 9, 1 } " + bodies, false);
        return shape<Disc>(scene, number).centre.y > 0;
    };
    const std::string small = "disc { 0, y, 2, 1" + turn + "} ", large = "disc { 0, y, 2.5, 1.5" + turn + "} ";
    CHECK(lifted(large + small, 0));
    CHECK(lifted(small + large, 1));
    CHECK_FALSE(lifted(small + large, 0));
    CHECK_FALSE(lifted(small + "disc { -.1*y, y, 2.5, 1.5" + turn + "} ", 0));
}

TEST_CASE("POV-Ray: a slanting face is before all that it hides, and told where rays are of two minds") {
    const std::string turn = " rotate <20, 0, 30> } ", view = "camera { right -4/3*x location <0, 8, -5> look_at 0 } ";
    const std::string a = "box { <-3, -1, -1>, <-1, 0, 1>" + turn, b = "box { <-2, -1, -1>, <2, 0, 1>" + turn,
                      c = "box { <1, -1, -1>, <3, 0, 1>" + turn;
    const Scene scene = whole(view + a + b + c + "light_source { 9, 1 }", false);
    const auto top = [&](std::size_t i) { return shape<Cuboid>(scene, i).opposite.y; };
    CHECK((top(0) > top(1) || top(1) > top(0)));
    CHECK((top(1) > top(2) || top(2) > top(1)));
    const auto told = [&](const std::string& bodies) {
        return says(notes_of(view + "light_source { 9, 1 } " + bodies), "a face in the place of another body's");
    };
    CHECK(!told(b + "box { <-1, -.5, -2>, <1, 0, 2> pigment { rgb x }" + turn));
    CHECK(told("box { <-2, -1, -1.8>, <2, 0, 1.8>" + turn +
               "box { <-1.7, -.1, -2.2>, <1.7, 0, 2.2> pigment { rgb x } rotate 20*y" + turn));
}

TEST_CASE("POV-Ray: a plane is seen where a body has a face in its place") {
    const auto box_of = [](const std::string& camera) {
        return shape<Cuboid>(
            whole("camera { right -4/3*x " + camera + " } plane { y, 0 } box { -2, <2, 0, 2> }", false), 1);
    };
    CHECK(box_of("location 5*y look_at 0").opposite.y < 0);
    CHECK(box_of("location -y look_at -2*y").opposite.y > 0);
    CHECK(box_of("location -5*y look_at 0").opposite.y == 0);  // that side is not seen
}

TEST_CASE("POV-Ray: a prism without an area is nothing, and takes nothing away") {
    const std::string prism = "prism { 0, 4, 4, <0, 0>, <2, 0>, <2, -0>, <0, 0> } ";
    CHECK(whole(prism).primitives.empty());
    CHECK(opened("difference { sphere { 0, 2 } " + prism + "}").scene.primitives.size() == 1);
}

TEST_CASE("POV-Ray: a camera is beside the surface that it lies on, where it looks; lights stay") {
    const std::string text =
        "camera { right -4/3*x location <0, 1, -3> look_at <0, 1, 0> } "
        "box { <-3, 0, -3>, <3, 4, 3> } light_source { <0, 4, 0> rgb 1 }";
    const Scene scene = whole(text, false);
    CHECK(scene.camera.position.z > -3);
    CHECK(scene.camera.position.z < -3 + 1e-5);
    CHECK(scene.lights.at(0).position == DVec3(0, 4, 0));
}

TEST_CASE("POV-Ray: a polygon of several outlines is where an odd number of them is") {
    const auto inside = [](const std::string& points, const DVec3& p) {
        const Scene scene = whole("polygon { " + points + " }");
        const MeshData& mesh = *shape<Mesh>(scene).data;
        int count = 0;
        for (const MeshData::Corners& own : mesh.triangles) {
            const auto at = [&](std::size_t k) { return mesh.points[std::size_t(own[k])] - p; };
            const DVec3 a = cross_product(at(0), at(1)), b = cross_product(at(1), at(2));
            count += dot_product(a, b) > 0 && dot_product(b, cross_product(at(2), at(0))) > 0;
        }
        CHECK(count < 2);
        return count == 1;
    };
    // A hole that touches the edge, and a second outline.
    const std::string holed =
        "15, <0, 0>, <4, 0>, <4, 4>, <0, 4>, <0, 0>, <0, 1>, <2, 1>, <2, 3>, <0, 3>, <0, 1>, <5, 0>, <6, 0>, <6, 1>, "
        "<5, 1>, <5, 0>";
    CHECK(inside(holed, {3.1, 2.3, 0}));
    CHECK(!inside(holed, {1.1, 2.3, 0}));
    CHECK(inside(holed, {1.1, .4, 0}));
    CHECK(inside(holed, {5.3, .4, 0}));
    CHECK(!inside(holed, {4.6, .4, 0}));
    // An outline that crosses itself, in a plane of its own.
    const std::string crossed = "5, <0, 0, 0>, <2, 2, 2>, <2, 0, 2>, <0, 2, 0>, <0, 0, 0>";
    CHECK(inside(crossed, {.2, 1.3, .2}));
    CHECK(inside(crossed, {1.8, 1.3, 1.8}));
    CHECK(!inside(crossed, {1, 1.8, 1}));
    // POV-Ray ignores those whose points are in no plane, or in more than one.
    for (const std::string points : {"4, 0, x, 2*x, 0", "3, 0, x, 0", "5, 0, x, x + y, y + 2e-10*z, 0"})
        CHECK(whole("polygon { " + points + " }", false).primitives.empty());
    CHECK(whole("polygon { 5, 0, x, x + y, y + 5e-11*z, 0 }").primitives.size() == 1);
}

TEST_CASE("POV-Ray: a left-handed scene is turned over in z, a right-handed one stays") {
    const std::string ball = "sphere { <1, 2, 3>, .5 translate <0, 0, 2> rotate <10, 20, 30> }";
    const Scene left = whole("camera { look_at z } " + ball, false), right = whole(ball);
    CHECK(shape<Sphere>(right) == Sphere{{1, 2, 3}, .5});
    CHECK(shape<Sphere>(left) == Sphere{{1, 2, -3}, .5});
    CHECK(right.primitives[0].transformations ==
          std::vector<Transformation>{Translate{{0, 0, 2}}, Rotate{{10, 20, 30}}});
    CHECK(left.primitives[0].transformations ==
          std::vector<Transformation>{Translate{{0, 0, -2}}, Rotate{{-10, -20, 30}}});
    const Box a = world_bounds(right.primitives[0]), b = world_bounds(left.primitives[0]);
    CHECK(a.low.x == b.low.x);
    CHECK(a.low.z == -b.high.z);
}

TEST_CASE("POV-Ray: matrices become rotations and scalings") {
    for (const bool mirrored : {false, true})
        for (const std::string words : {"rotate <20, 30, 40> scale <1, 2, 3> rotate <50, 60, 70> translate <1, 2, 3>",
                                        "scale <-1, 2, 2> rotate <5, 90, 3>", "scale 2 rotate <10, 20, 30>"}) {
            pov::Steps steps{pov::MatrixStep{glm::dmat4(.5, 2, .25, 0, -1, .5, 3, 0, .125, 1, 1, 0, 4, 5, 6, 1)}};
            if (words.size() < 40) steps = {Rotate{{20, 30, 40}}, Scale{{1, -2, 3}}, pov::MatrixStep(glm::dmat4(1))};
            glm::dmat4 wanted = pov::matrix_of(steps);
            const glm::dmat4 made = matrix(pov::transformations_of(steps, mirrored));
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 3; ++j)
                    CHECK(made[i][j] ==
                          doctest::Approx(wanted[i][j] * (mirrored && (i == 2) != (j == 2) ? -1 : 1)).epsilon(1e-12));
            pov::Steps back = steps;
            pov::append(back, pov::inverse(steps));
            const glm::dmat4 nothing = pov::matrix_of(back);
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j) CHECK(nothing[i][j] == doctest::Approx(i == j).epsilon(1e-12));
        }
}

TEST_CASE("POV-Ray: unions keep the surfaces inside them, merges do not") {
    const std::string balls = " { sphere { 0, 1 } sphere { x, 1 } translate y }";
    const Scene two = whole("union" + balls), one = whole("merge" + balls);
    CHECK(two.primitives.size() == 2);
    CHECK(two.primitives[1].transformations == std::vector<Transformation>{Translate{{0, 1, 0}}});
    REQUIRE(one.primitives.size() == 1);
    CHECK(shape<Union>(one).parts->size() == 2);
    // A body may stand alone by its name, right after it was declared.
    CHECK(whole("#declare B = sphere { 0, 1 } B").primitives.size() == 1);
    CHECK(whole("#declare A = array[2]; #declare A[1] = sphere { 0, 1 } A[1]").primitives.size() == 1);
    CHECK(whole("sphere_sweep { linear_spline, 2, 0, 1, x, 1 }").primitives.size() == 3);
}

TEST_CASE("POV-Ray: composites with bodies turned inside out contain the same points") {
    const auto inside = [](const std::string& text, const DVec3& p) {
        return contains(whole(text).primitives.at(0), p);
    };
    const std::string ball = "sphere { 0, 1 ", box = "box { <0, -2, -2>, <2, 2, 2> ";
    const DVec3 left(-.5, 0, 0), right(.5, 0, 0), far(1.5, 0, 0);
    for (const std::string& text :
         {"intersection { " + ball + "} " + box + "inverse } }", "difference { " + ball + "} " + box + "} }",
          "difference { " + box + "inverse } " + ball + "inverse } }"}) {
        CHECK(inside(text, left));
        CHECK_FALSE(inside(text, right));
        CHECK_FALSE(inside(text, far));
    }
    // The outside of a union with the outside of a body is a body.
    const std::string text = "merge { " + ball + "} " + box + "inverse } inverse }";
    CHECK(inside(text, far));
    CHECK_FALSE(inside(text, left));
    CHECK_FALSE(inside(text, right));
    // A clear one that bends light fills the space around it, in which rays start.
    const std::string around = "difference { " + ball + "inverse } " + box + "} translate 9*y ";
    const std::string bends = around + "pigment { rgbt 1 } interior { ior 1.5 } }", opaque = around + "}";
    for (const DVec3& p : {left, right, far}) {
        const DVec3 moved = p + DVec3(0, 9, 0);
        CHECK((!inside(bends, moved) && inside(bends, p) && inside(opaque, moved) && !inside(opaque, p)));
    }
    CHECK(whole("union { " + ball + "} " + box + "} inverse }").primitives.size() == 1);  // no surfaces inside it
    CHECK(inside("intersection { plane { x, 0 } plane { -x, 1 } box { -9, 9 } }", left));
    CHECK_FALSE(inside("intersection { plane { x, 0 } plane { -x, 1 } box { -9, 9 } }", DVec3(-1.5, 0, 0)));
}

TEST_CASE("POV-Ray: clipped bodies are cut off by what lets all light through") {
    const Scene scene = whole("sphere { 0, 1 clipped_by { plane { x, .5 } } pigment { rgb x } }");
    const auto& parts = *shape<Intersection>(scene).parts;
    REQUIRE(parts.size() == 2);
    CHECK(scene.materials[parts[0].material].rgb == Pigment(1, 0, 0));
    const Material& nothing = scene.materials[parts[1].material];
    CHECK((nothing.rgb.transmit == 1 && nothing.shadow == 1 && nothing.reflection == 0 && nothing.specular == 0));
    // The pieces of a union are clipped each by itself, so that surfaces inside it stay.
    CHECK(whole("union { sphere { 0, 1 } sphere { x, 1 } clipped_by { plane { y, 0 } } }").primitives.size() == 2);
    // An open cylinder is a longer one that is clipped; a cone does not grow beyond its tip.
    const Scene tube = whole("cylinder { 0, y, 1 open translate x }");
    const auto& ends = *shape<Intersection>(tube).parts;
    REQUIRE(ends.size() == 3);
    CHECK(std::get<Cylinder>(ends[0].shape) == Cylinder{{0, -1, 0}, {0, 2, 0}, 1});
    CHECK(contains(tube.primitives[0], {1, .9, 0}));
    CHECK_FALSE(contains(tube.primitives[0], {1, 1.1, 0}));
    const Scene cone = whole("cone { 0, 0, y, 1 open }");
    CHECK(std::get<Cone>(shape<Intersection>(cone).parts->at(0).shape) == Cone{DVec3(0), 0, {0, 2, 0}, 2});
}

TEST_CASE("POV-Ray: parts without a texture have that of the composite, others their own") {
    const Scene scene = whole(
        "difference { box { -1, 1 } sphere { x, 1 pigment { rgb x } } cylinder { -y*2, y*2, .2 } pigment { rgb z } }");
    REQUIRE(scene.primitives.size() == 1);
    const auto& parts = *shape<Difference>(scene).parts;
    CHECK(parts[0].material == scene.primitives[0].material);
    CHECK(parts[2].material == scene.primitives[0].material);
    CHECK(scene.materials[std::size_t(parts[1].material)].rgb == Pigment(1, 0, 0));
    CHECK(material(scene).rgb == Pigment(0, 0, 1));
}

TEST_CASE("POV-Ray: textures move with what is written after them") {
    const auto pattern = [](const std::string& text) {
        const Scene scene = whole(text);
        const Material& own = material(scene);
        REQUIRE(own.rgb.pattern);
        return matrix(scene.primitives[0].transformations) * matrix(own.rgb.pattern->transformations);
    };
    const auto close = [](const glm::dmat4& a, const glm::dmat4& b) {
        double most = 0;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) most = std::max(most, std::fabs(a[i][j] - b[i][j]));
        return most < 1e-12;
    };
    const std::string checker = "pigment { checker rgb 1 rgb 0 scale 2 } ";
    const std::vector<Transformation> inner{Scale{DVec3(2)}};
    const auto moved = [&](std::vector<Transformation> more) {
        more.insert(more.begin(), inner.begin(), inner.end());
        return matrix(more);
    };
    CHECK(close(pattern("sphere { 0, 1 " + checker + "rotate 30*y translate x }"),
                moved({Rotate{{0, 30, 0}}, Translate{{1, 0, 0}}})));
    CHECK(close(pattern("sphere { 0, 1 rotate 30*y " + checker + "translate x }"), moved({Translate{{1, 0, 0}}})));
    CHECK(close(pattern("sphere { 0, 1 scale 3 translate <1, 2, 3> " + checker + "}"), moved({})));
    // In unions the texture of the whole moves with the whole, not with the part.
    CHECK(close(pattern("union { sphere { 0, 1 translate 5*y } rotate 20*x " + checker + "scale 4 }"),
                moved({Scale{DVec3(4)}})));
    CHECK(close(pattern("union { sphere { 0, 1 translate 5*y " + checker + "scale 3 } rotate 20*x }"),
                moved({Scale{DVec3(3)}, Rotate{{20, 0, 0}}})));
    // A declared body takes along what it has.
    CHECK(close(pattern("#declare B = sphere { 0, 1 " + checker + "translate x } object { B translate y }"),
                moved({Translate{{1, 0, 0}}, Translate{{0, 1, 0}}})));
    // A normal that is given later does not move with what moved the pigment before.
    const Scene bent = whole("sphere { 0, 1 pigment { rgb 1 } scale 3 normal { bumps .5 scale 2 } }");
    CHECK(close(matrix(bent.primitives[0].transformations) * matrix(material(bent).bump.pattern->transformations),
                moved({})));
}

TEST_CASE("POV-Ray: defaults are those of a body's use") {
    const Scene scene = whole(
        "#declare Ball = sphere { 0, 1 } #default { pigment { rgb x } finish { ambient .5 } } object { Ball } "
        "#default { finish { diffuse .9 } } object { Ball translate y } sphere { 3*x, 1 pigment { rgb z } }");
    CHECK(material(scene, 0).rgb == Pigment(1, 0, 0));
    CHECK(material(scene, 0).ambient == .5);
    CHECK(material(scene, 0).diffuse == .6);
    CHECK(material(scene, 1).diffuse == .9);
    CHECK(material(scene, 1).ambient == .5);
    CHECK(material(scene, 2).rgb == Pigment(0, 0, 1));
    CHECK(material(scene, 2).diffuse == .9);
}

TEST_CASE("POV-Ray: scenes can ask about their bodies") {
    const std::string text =
        "#declare B = difference { sphere { 0, 1 } box { <0, -2, -2>, <2, 2, 2> } translate 3*y } "
        "#declare N = <0, 0, 0>; #declare P = trace(B, <-5, 3, 0>, x, N); "
        "#declare Q = trace(B, <5, 3, 0>, -x); #declare Miss = trace(B, <-5, 9, 0>, x); "
        "sphere { P, 1 } sphere { P + N, 1 } sphere { Q, 1 } sphere { Miss, 1 } "
        "sphere { <inside(B, <-.5, 3, 0>), inside(B, <.5, 3, 0>), 0>, 1 } "
        "#declare S = sphere { <1, 2, 3>, 1 } sphere { min_extent(S), 1 } sphere { max_extent(S), 1 }";
    const Scene scene = whole(text);
    const auto at = [&](std::size_t i, const DVec3& p) { return length(shape<Sphere>(scene, i).centre - p) < 1e-6; };
    CHECK(at(0, {-1, 3, 0}));
    CHECK(at(1, {-2, 3, 0}));
    CHECK(at(2, {0, 3, 0}));
    CHECK(at(3, DVec3(0)));
    CHECK(at(4, {1, 0, 0}));
    CHECK(at(5, {0, 1, 2}));
    CHECK(at(6, {2, 3, 4}));
}

TEST_CASE("POV-Ray: triangles without an area are read over") {
    CHECK(whole("union { triangle { 0, x, 2*x } smooth_triangle { 0, y, x, y, 3*x, y } sphere { 0, 1 } }")
              .primitives.size() == 1);
}

TEST_CASE("POV-Ray: a box that is flat is a rectangle") {
    const Primitive flat = whole("box { <0, 1, 5>, <3, 1, 2> }").primitives.at(0);
    const Box box = world_bounds(flat);
    CHECK((box.low == DVec3(0, 1, 2) && box.high == DVec3(3, 1, 5)));
    CHECK(std::get<Mesh>(flat.shape).data->triangles.size() == 2);
}

TEST_CASE("POV-Ray: curved bodies become closed meshes") {
    for (const std::string text : {"superellipsoid { <2.5, .5> }", "isosurface { function { x*x + y*y + z*z - .9 } }",
                                   "prism { conic_sweep 0, 1, 4, <0, 0>, <1, 0>, <0, 1>, <0, 0> }"}) {
        const Scene scene = opened("difference { " + text + " sphere { 9, .1 } }").scene;
        CAPTURE(text);
        REQUIRE(scene.primitives.size() == 1);
        CHECK(std::holds_alternative<Mesh>(shape<Difference>(scene).parts->at(0).shape));
    }
}

TEST_CASE("POV-Ray: superellipsoids are exact, but those with dents") {
    CHECK(shape<Superellipsoid>(whole("superellipsoid { <.25, 2> scale 2 }")) == Superellipsoid{.25, 2});
    CHECK(contains(whole("superellipsoid { <1, 1> }").primitives[0], {.577, .577, .577}));
    CHECK_FALSE(contains(whole("superellipsoid { <1, 1> }").primitives[0], {.578, .5775, .5775}));
    CHECK(says(notes_of("\nsuperellipsoid { <3, 1> }"), "approximated: 'superellipsoid' is a mesh of flat pieces"));
}

TEST_CASE("POV-Ray: triangles of a mesh with an inside run in any direction") {
    const std::string corners =
        "vertex_vectors { 4, 0, x, y, z } face_indices { 4, <0,2,1>, <0,1,3>, <0,2,3>, <3,2,1> }";
    const Scene scene = whole("difference { mesh2 { " + corners + " inside_vector z } sphere { 9, .1 } }");
    const Primitive& solid = shape<Difference>(scene).parts->at(0);
    CHECK(contains(solid, {.2, .2, .2}));
    CHECK_FALSE(contains(solid, {.4, .4, .4}));
    CHECK(says(notes_of("\ndifference { mesh2 { " + corners + " } sphere { 9, .1 } }"), "left out: an open body"));
}

TEST_CASE("POV-Ray: corners of a mesh2 are in single precision, those of a mesh are not") {
    const auto first = [](const std::string& text) { return shape<Mesh>(whole(text)).data->points.at(0); };
    CHECK(first("mesh2 { vertex_vectors { 3, <.1, 0, 0>, y, z } face_indices { 1, <0, 1, 2> } }").x == double(.1F));
    CHECK(first("mesh { triangle { <.1, 0, 0>, y, z } }").x == .1);
}

/// Checks that a mesh is closed and has this volume.
static void check_solid(const MeshData& mesh, double volume) {
    CHECK(!open_side(mesh));
    double sum = 0;
    for (const MeshData::Corners& own : mesh.triangles) {
        const auto at = [&](int k) { return mesh.points[static_cast<std::size_t>(own[static_cast<std::size_t>(k)])]; };
        sum += dot_product(at(0), cross_product(at(1), at(2))) / 6;
    }
    CHECK(std::fabs(sum) == doctest::Approx(std::fabs(volume)).epsilon(1e-9));
}

TEST_CASE("POV-Ray: prisms have holes, and what is within these") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    // Stars around a middle: the outermost, four holes in it, and an island in each hole.
    const auto star = [&](const pov::Point2& middle, double radius, double& area) {
        pov::Outline all;
        for (int i = 0, count = 3 + int(9 * unit(random)); i < count; ++i) {
            const double angle = 2 * 3.14159265358979323846 * i / count, r = radius * (.6 + .4 * unit(random));
            all.push_back({middle[0] + r * std::cos(angle), middle[1] + r * std::sin(angle)});
        }
        double twice = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const pov::Point2 &p = all[i], &q = all[(i + 1) % all.size()];
            twice += p[0] * q[1] - p[1] * q[0];
        }
        area = twice / 2;
        if (unit(random) < .5) std::ranges::reverse(all);
        return all;
    };
    for (int trial = 0; trial < 30; ++trial) {
        std::vector<pov::Outline> outlines{{{-1, -1}, {0, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0}}};
        double area = 4, own = 0;
        for (const double x : {-.5, .5})
            for (const double y : {-.5, .5}) {
                outlines.push_back(star({x, y}, .45, own)), area -= own;
                outlines.push_back(star({x, y}, .12, own)), area += own;
            }
        std::ranges::shuffle(outlines, random);
        check_solid(pov::swept(outlines, {.low = -1, .high = 2}), 3 * area);
    }
    const Scene frame =
        whole("prism { 0, 1, 8, <0, 0>, <3, 0>, <0, 3>, <0, 0>, <.5, .5>, <.5, 1>, <1, .5>, <.5, .5> }");
    CHECK(contains(frame.primitives.at(0), {.2, .5, .2}));
    CHECK_FALSE(contains(frame.primitives[0], {.6, .5, .6}));
    // Straight lines and parabolas stay what they are.
    const auto prism = [](const std::string& words) { return shape<Prism>(whole("prism { " + words + " }")); };
    CHECK(prism("bezier_spline 0, 1, 8, <0, 0>, <1, 0>, <2, 0>, <3, 0>, <3, 0>, <2, 2>, <1, 2>, <0, 0>") ==
          Prism{0, 1,
                std::make_shared<const ContourData>(
                    std::vector<Contour>{{{0, -0.}, {{{3, -0.}, {3, -0.}}, {{1.5, -3}, {0, -0.}}}}})});
    const Prism rounded = prism(
        "quadratic_spline 0, 1, 10, <0, -1>, <1, 0>, <0, 1>, <-1, 0>, <1, 0>, "
        "<9, 9>, <3, 0>, <4, 1>, <5, 0>, <3, 0>");
    CHECK(rounded.data->contours.size() == 2);
    CHECK(rounded.contains({.1, -.1, .5}));
    CHECK(rounded.contains({4, -.4, .5}));
    CHECK_FALSE(rounded.contains({2, -.2, .5}));
    const Prism cubic = prism("cubic_spline 0, 1, 6, <0, -1>, <1, 0>, <0, 1>, <-1, 0>, <1, 0>, <0, 3>");
    CHECK(cubic.data->contours.at(0).strokes.size() == 3);
    CHECK(cubic.contains({0, -.9, .5}));
    CHECK(says(notes_of("\nprism { cubic_spline conic_sweep 0, 1, 6, <0, -1>, <1, 0>, <0, 1>, <-1, 0>, <1, 0>, "
                        "<0, 3> }"),
               "approximated: 'prism' is a mesh of flat pieces"));
}

TEST_CASE("POV-Ray: lathes are contours that turn, and have inside what POV-Ray has") {
    const auto lathe = [](const std::string& words) { return shape<Lathe>(whole("lathe { " + words + " }")); };
    using Points = std::vector<Contour>;
    CHECK(lathe("3, <0, 0>, <1, .5>, <0, 1>").data->contours ==
          Points{{{0, 0}, {{{1, .5}, {1, .5}}, {{0, 1}, {0, 1}}}}});
    // Closed lines go on.
    CHECK(lathe("linear_spline 5, <1, 0>, <2, 0>, <2, 1>, <1, 0>, <0, 0>").data->contours.at(0).strokes.size() == 4);
    const Lathe quadratic = lathe("quadratic_spline 4, <0, -1>, <0, 0>, <1, .5>, <0, 1>");
    CHECK(quadratic.data->contours == Points{{{0, 0}, {{{.25, .375}, {1, .5}}, {{1, .75}, {0, 1}}}}});
    CHECK(quadratic.contains({0, .6, .7}));
    const Lathe cubic = lathe("cubic_spline 5, <0, -1>, <0, 0>, <1, .5>, <0, 1>, <0, 2>");
    CHECK(cubic.data->contours.at(0).strokes.size() == 2);
    CHECK_FALSE(cubic.open());
    const Lathe two = lathe("bezier_spline 8, <0, 0>, <1, 0>, <2, 0>, <3, 0>, <0, 2>, <1, 2>, <2, 2>, <3, 1>");
    CHECK(two.data->contours.size() == 2);
    CHECK(two.data->contours[0] == Contour{{0, 0}, {{{3, 0}, {3, 0}}}});
    // An open one as a part is solid up to its least radius and its ends, where nothing is seen.
    const Scene cut = opened("difference { lathe { 4, <1.2, 1>, <1, 2>, <2, 2>, <2, 0> } sphere { 9, .1 } }").scene;
    const std::vector<Primitive>& parts = *std::get<Difference>(shape<Difference>(cut).parts->at(0).shape).parts;
    REQUIRE(parts.size() == 4);
    CHECK_FALSE(std::get<Lathe>(parts[0].shape).open());
    for (std::size_t i = 1; i < parts.size(); ++i) CHECK(cut.materials[parts[i].material].rgb.transmit == 1);
    for (const double y : {-.0001, .0001, .9999, 1.0001, 1.4, 1.6, 1.9999, 2.0001}) {
        CHECK(contains(cut.primitives[0], {1.1, y, 0}) == (y > 0 && y < 2 && !(y > 1 && y < 1.5)));
        CHECK_FALSE(contains(cut.primitives[0], {.9, y, 0}));
    }
    const auto inner = [&](const std::string& words) { return lathe(words).data->inner; };
    CHECK(inner("bezier_spline 4, <.6, 0>, <.3, .4>, <.35, .8>, <.8, 1.3>") == .3);
    CHECK(inner("quadratic_spline 4, <1, -1>, <1, 0>, <.5, 1>, <1, 2>") == .5);
    CHECK(shape<Lathe>(whole("sor { 4, <.3, 0>, <.3, .2>, <.4, .6>, <.3, 1> open }")).data->inner == 0);
    CHECK(whole("lathe { 2, <0, 0>, <0, 1> }").primitives.empty());
}

TEST_CASE("POV-Ray: a sor is a lathe whose squared radius is a cubic of the height") {
    const auto sor = [](const std::string& words) { return shape<Lathe>(whole("sor { " + words + " }")); };
    const Lathe vase = sor("6, <.5, -.5>, <.5, 0>, <.8, .5>, <.3, 1>, <0, 1.3>, <0, 1.5>");
    CHECK_FALSE(vase.open());
    // POV-Ray's cubic over the heights from .5 to 1, and from 1 to the axis.
    const auto square = [](double t, double from, double to, double m, double n) {
        return from + t * (m + t * (3 * (to - from) - 2 * m - n + t * (m + n - 2 * (to - from))));
    };
    for (double t = .003; t < 1; t += .007) {
        const double lower = std::sqrt(square(t, .64, .09, .5 * 1.6 * -.2, .5 * .6 * -1));
        const double upper = std::sqrt(square(t, .09, 0, .3 * .6 * -1, 0));
        for (const auto& [radius, y] : {std::pair(lower, .5 + .5 * t), std::pair(upper, 1 + .3 * t)}) {
            CHECK(vase.contains({radius - 1e-8, y, 0}));
            CHECK_FALSE(vase.contains({0, y, radius + 1e-8}));
        }
    }
    CHECK(sor("5, <.5, -.5>, <.5, 0>, <.8, .5>, <.3, 1>, <.2, 1.5> open").open());
    CHECK(says(notes_of("\nsor { 4, <.5, 0>, <.5, 0>, <.8, 0>, <.3, 1> }"),
               "left out: a body without extent: it has no surface"));
}

TEST_CASE("POV-Ray: an ovus is two balls and the arc that touches both") {
    const auto ovus = [](const std::string& words) { return shape<Lathe>(whole("ovus { " + words + " }")); };
    // Checks the middle of the arc and a point of each ball, with the thin end above and below.
    for (const auto& [bottom, top] : {std::pair(1., .5), std::pair(.6, 1.)}) {
        const Lathe egg = ovus(std::to_string(bottom) + ", " + std::to_string(top));
        CHECK_FALSE(egg.open());
        const double large = 2 * std::max(bottom, top), from_bottom = large - bottom, from_top = large - top;
        const double y = (bottom * bottom + from_bottom * from_bottom - from_top * from_top) / (2 * bottom);
        const double x = -std::sqrt(from_bottom * from_bottom - y * y);
        const double angle = (std::atan2(-y, -x) + std::atan2(bottom - y, -x)) / 2;
        const auto is_edge = [&](double radius, double height, double dx, double dy) {
            CHECK(egg.contains({radius - 1e-8 * dx, height - 1e-8 * dy, 0}));
            CHECK_FALSE(egg.contains({radius + 1e-8 * dx, height + 1e-8 * dy, 0}));
        };
        is_edge(x + large * std::cos(angle), y + large * std::sin(angle), std::cos(angle), std::sin(angle));
        is_edge(bottom * .6, bottom * -.8, .6, -.8);
        is_edge(top * .28, bottom + top * .96, .28, .96);
    }
    // A ball if one is within the other.
    CHECK(ovus(".5, 1").contains({0, -.4999, 0}));
    CHECK_FALSE(ovus(".5, 1").contains({0, -.5001, 0}));
    CHECK_FALSE(ovus("1, 0").contains({.01, 1, 0}));
    CHECK(says(notes_of("\novus { 0, 0 }"), "left out: a body without extent"));
    CHECK_THROWS_AS(opened("ovus { 1, -1 }"), FileError);
}

TEST_CASE("POV-Ray: height fields of functions") {
    const Scene scene = whole("height_field { function 3, 2 { x*.5 + y*2 } }");
    // POV-Ray's own heights at these corners, where y = 1 stands at z = 0, and 2 and 2.25 become 1 and .25.
    struct Row {
        double x, z, height;
    };
    for (const Row& row : {Row{0, 1, 0}, Row{.5, 1, 16383. / 65536}, Row{1, 1, 32767. / 65536},
                           Row{0, 0, 65535. / 65536}, Row{.5, 0, 16383. / 65536}, Row{1, 0, 32767. / 65536}}) {
        bool found = false;
        for (const DVec3& p : shape<Mesh>(scene).data->points)
            found |= length(p - DVec3(row.x, row.height, row.z)) < 1e-12;
        CHECK_MESSAGE(found, row.x, " ", row.z);
    }
    CHECK(says(notes_of("\nheight_field { function 1, 2 { x } }"), "left out: a height_field: it has too few pixels"));
    // Normals are means of those of the triangles around, in cells of 1 by 65536 by 1, as whole 32767ths.
    const Scene smooth = opened("height_field { function 3, 3 { x*x*.001 } smooth }").scene;
    const MeshData& data = *shape<Mesh>(smooth).data;
    const double first = 16, second = 65 - 16;  // the heights of 16, and 65 less 16, at x = .5 and 1
    const DVec3 left = normalize(DVec3(-first, 1, 0)), right = normalize(DVec3(-second, 1, 0));
    const DVec3 mean = 32767. * normalize(left + right);
    const DVec3 wanted(2 * std::trunc(mean.x), 65536 * std::trunc(mean.y), 0);
    CHECK(length(data.normals[4] - wanted) < 1e-9);
}

TEST_CASE("POV-Ray: scenes find the surfaces of meshes") {
    std::string text =
        "#declare S = isosurface { function { x*x + y*y + z*z - .81 } rotate <10, 20, 30> scale 2/.9 "
        "translate <3, 4, 5> } ";
    for (const char* const way : {"x", "-x", "y", "-y", "z", "-z", "<1, 1, 1>", "<-1, 2, .5>"})
        text += "sphere { trace(S, <3, 4, 5> + 9*vnormalize(" + std::string(way) + "), -" + way + "), 1 } ";
    for (const Primitive& own : opened(text).scene.primitives)
        CHECK(length(std::get<Sphere>(own.shape).centre - DVec3(3, 4, 5)) == doctest::Approx(2).epsilon(.002));
}

TEST_CASE("POV-Ray: functions of patterns and pigments") {
    // Values of POV-Ray's own functions at <.3, .4, .7>.
    const Scene scene = whole(
        "#declare F = function { pattern { granite scale 2 } } #declare G = function { pigment { bozo color_map { "
        "[0 rgb <1, 0, .5>] [1 rgbt <0, 1, .5, .25>] } } } sphere { F(.3, .4, .7), 1 } "
        "#declare C = G(.3, .4, .7); sphere { <C.red, C.green, C.transmit>, 1 }");
    CHECK(shape<Sphere>(scene).centre.x == doctest::Approx(0.328662381280).epsilon(1e-9));
    CHECK(length(shape<Sphere>(scene, 1).centre - DVec3(0.489435613, 0.510564387, 0.127641097)) < 1e-6);
}

TEST_CASE("POV-Ray: letters are solid, and follow each other as in POV-Ray") {
    const std::vector<std::string> folders = pov::standard_library();
    REQUIRE_MESSAGE(!folders.empty(), "Debian's package povray-includes is not installed");
    const auto font = folders[0] + "/timrom.ttf";
    std::string all;
    for (char c = '!'; c <= '~'; ++c) all += c;
    for (const pov::Letter& letter : pov::letters_of(font, all)) {
        CHECK(letter.contours->half[0] > 0);
        const auto& pieces = letter.contours->pieces;
        double x = 0, y = 0;  // all around a closed contour
        for (const auto& piece : pieces) x += piece.cx - piece.ax, y += piece.cy - piece.ay;
        CHECK(std::fabs(x) + std::fabs(y) < 1e-12);
    }
    // Contours meet in the middle between two controls, also where that is not a whole number of the font's units.
    const auto round = pov::letters_of(font, "o").at(0).contours;
    CHECK(std::ranges::any_of(round->contours.at(0).strokes, [](const auto& stroke) {
        return stroke.end == Contour::Point{.3415, .4515};
    }));
    const auto begin = [&](const std::string& line) {  // of the last letter
        const pov::Letter last = pov::letters_of(font, line).back();
        return last.x + last.contours->centre[0] - last.contours->half[0];
    };
    CHECK(begin("A") == doctest::Approx(0));
    CHECK(begin("AV") < begin("AH") - .05);  // they are moved together
    const std::vector<pov::Letter> three = pov::letters_of(font, "A A");
    CHECK(three.at(1).contours->pieces.empty());
    CHECK(three.at(2).contours == three.at(0).contours);  // equal letters share them
    const Prism ring{0, .5, pov::letters_of(font, "O").at(0).contours};
    const Box box = ring.bounds();
    CHECK(ring.contains({box.low.x + .05, box.centre().y, .25}));
    CHECK_FALSE(ring.contains(box.centre()));
    CHECK(pov::letters_of(font, "\xC3\x84\xE2\x82\xAC", true).size() == 2);
    CHECK(pov::letters_of(font, "\xC3\x84").at(1).contours->pieces.empty());
    // The font's map for the Macintosh has another hyphen, kerned by 49 thousandths, as POV-Ray's max_extent tells.
    const auto second = folders[0] + "/cyrvetic.ttf";
    const double plain = pov::letters_of(second, "V-", true).at(1).x;
    CHECK(pov::letters_of(second, "V-").at(1).x == doctest::Approx(plain - .049));
    CHECK(says(fault_of([&] { pov::letters_of(__FILE__, "A"); }), "is not a font with outlines"));
}

TEST_CASE("POV-Ray: quartics that are toruses or superellipsoids are these") {
    const std::string zeros = "0, 0, 0, 0, 0, 0, 0, 0, 0, 0, ";
    // The torus of radii 3 and 1: (x^2 + y^2 + z^2 + 8)^2 = 36 (x^2 + z^2), and twice that.
    const std::string ring =
        "quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -20, " + zeros + "1, 0, 0, 2, 0, 16, 0, 0, 0, 0, 1, 0, -20, 0, 64> }";
    CHECK(shape<Torus>(whole(ring)) == Torus{{0, 0, 0}, {0, 1, 0}, 3, 1});
    const std::string upright =
        "poly { 4, <2, 0, 0, 0, 4, 0, 0, 4, 0, -40, " + zeros + "2, 0, 0, 4, 0, -40, 0, 0, 0, 0, 2, 0, 32, 0, 128> }";
    CHECK(shape<Torus>(whole(upright)) == Torus{{0, 0, 0}, {0, 0, 1}, 3, 1});
    const Scene cushion =
        whole("quartic { <1, " + zeros + zeros.substr(3) + "1, " + zeros.substr(3) + "16, 0, 0, 0, -16> }");
    CHECK(shape<Superellipsoid>(cushion) == Superellipsoid{.5, .5});
    CHECK(cushion.primitives[0].transformations == std::vector<Transformation>{Scale{{2, 2, 1}}});
    for (const std::string other : {"-20, 0, 63", "-21, 0, 64", "-20, 1, 64"}) {
        CAPTURE(other);
        CHECK(says(notes_of("\n" + ring.substr(0, ring.size() - 14) + other + "> }"),
                   "approximated: 'polynomial' is a mesh of flat pieces"));
    }
}

TEST_CASE("POV-Ray: paraboloids and hyperboloids are lathes") {
    struct Quadric {
        DVec3 squares, linear;
        double number;
    };
    std::mt19937 numbers(1);
    std::uniform_real_distribution<double> place(-6, 6);
    for (const auto& [squares, linear, number] : {Quadric{{1, 4, -2}, {1, -2, .5}, -3},
                                                  {{1, 4, -2}, {1, -2, .5}, 9},
                                                  {{-.5, 1, 1}, {2, 0, 0}, 1},
                                                  {{0, 1, 3}, {2, 1, 0}, -1},
                                                  {{2, 0, 3}, {2, -1, 0}, -1},
                                                  {{2, 1, 0}, {0, 0, 3}, 4}}) {
        const std::string words =
            "quadric { " + text_of(squares) + ", 0, " + text_of(linear) + ", " + text_of(number) + " }";
        CAPTURE(words);
        for (const bool right_handed : {false, true}) {
            const std::string camera = right_handed ? "" : "camera { look_at z } ";
            const Scene scene = whole(camera + "difference { " + words + " sphere { 99, 1 } }", right_handed);
            const Primitive body = scene.primitives.at(0);
            const Primitive& own = std::get<Difference>(body.shape).parts->at(0);
            CHECK(std::holds_alternative<Lathe>(own.shape));
            for (int i = 0; i < 300; ++i) {
                const DVec3 p{place(numbers), place(numbers), place(numbers)};
                const double value = dot_product(p, squares * p) + dot_product(linear, p) + number;
                if (std::fabs(value) < 1e-5) continue;
                CHECK(contains(own, {p.x, p.y, right_handed ? p.z : -p.z}) == (value < 0));
            }
        }
    }
    CHECK(says(notes_of("\nquadric { <-1, -1, 1>, 0, 0, 1 }"), "approximated: 'quadric' is a mesh of flat pieces"));
}

TEST_CASE("POV-Ray: sweeps along curves are exact") {
    const Scene scene =
        whole("sphere_sweep { b_spline, 5, <0, 0, 2>, .1, <1, 0, 2> .2 <2, 1, 2>, .3, 3*x, 0, 4*x, .1 }");
    const std::vector<SweptBall>& balls = shape<SphereSweep>(scene).data->balls;
    REQUIRE(balls.size() == 5);
    CHECK(balls[2] == SweptBall{{2, 1, 2}, .3, false});
    // Half way between two balls: the ends count 1 and the middle ones 23 of 48; or else -1 and 9 of 16.
    const std::string line = "4, -x, 0, 0, .6, 2*x, .6, 3*x, 0 }";
    const auto radius = [&](const std::string& kind) {
        const Scene own = whole("sphere_sweep { " + kind + "_spline " + line);
        double low = 0;
        for (double step = .5; step > 1e-9; step /= 2)
            if (contains(own.primitives[0], {1, low + step, 0})) low += step;
        return low;
    };
    CHECK(radius("b") == doctest::Approx(.575).epsilon(1e-6));
    CHECK(radius("cubic") == doctest::Approx(.675).epsilon(1e-6));
    CHECK(says(notes_of("\nsphere_sweep { b_spline 4, 0, -1, x, 1, y, 1, z, 1 }"),
               "left out: a sphere_sweep: one of its radii is below 0"));
}

TEST_CASE("POV-Ray: Julia sets are exact") {
    const JuliaFractal plain = shape<JuliaFractal>(whole("julia_fractal { <.2, .1, -.3, .4> }"));
    CHECK(plain == JuliaFractal{{.2, .1, -.3}, .4, 20, 20});
    const Scene scene = opened(
                            "julia_fractal { <.2, .1, -.3, .4> pwr(2, .5) hypercomplex max_iteration 7.9 precision 60"
                            " slice <0, .1, 0, .5>, .2 }")
                            .scene;
    const JuliaFractal& full = shape<JuliaFractal>(scene);
    CHECK(full.step == JuliaStep::power);
    CHECK(std::array{full.exponent, full.imaginary, full.iterations, full.precision, full.slice_fourth,
                     full.distance} == std::array{2., .5, 7., 60., .5, .2});
    CHECK(full.hypercomplex);
    // The set is not symmetric: what is at z is at -z in a right-handed scene.
    const std::string text = "julia_fractal { <-.083, 0, -.83, -.025> max_iteration 8 ";
    const Scene left = whole("camera { location 0 } " + text + "rotate 30*y }", false),
                right = whole(text + "rotate 30*y }");
    int inside = 0, same = 0;
    for (int i = 0; i < 1000; ++i) {
        const DVec3 p(i % 10 * .2 - .9, i / 10 % 10 * .2 - .9, i / 100 * .2 - .9);
        const bool here = contains(left.primitives.at(0), {p.x, p.y, -p.z});
        CHECK(here == contains(right.primitives.at(0), p));
        inside += here, same += here == contains(left.primitives.at(0), p);
    }
    CHECK((inside > 20 && same < 990));
    CHECK(says(notes_of("\njulia_fractal { 0 sin }"),
               "left out: a julia_fractal: quaternions are only squared or cubed"));
}

TEST_CASE("POV-Ray: blobs are exact") {
    const Scene scene = whole(
        "blob { threshold .5 sphere { x, 1, 2 translate -x } cylinder { 0, <0, 2, 3>, .25, strength -1 }"
        " component 1.5, .75, <0, 1, 5> scale 2 }");
    const Blob& blob = shape<Blob>(scene);
    CHECK(blob.threshold == .5);
    REQUIRE(blob.data->lumps.size() == 3);
    CHECK(blob.data->lumps[0] == Lump{DVec3(0), DVec3(0), 1, 2});
    CHECK(blob.data->lumps[1] == Lump{DVec3(0), {0, 2, 3}, .25, -1});
    CHECK(blob.data->lumps[2] == Lump{{0, 1, 5}, {0, 1, 5}, .75, 1.5});
    // Stretched along x, then turned about z by 90 degrees: x goes to y.
    const Lump turned =
        shape<Blob>(whole("blob { sphere { <1, 0, 3>, 1, 2 scale <2, 1, 1> rotate 90*z } }")).data->lumps[0];
    CHECK(length(turned.x - DVec3(0, 2, 0)) < 1e-15);
    CHECK(length(turned.z - DVec3(0, 0, 1)) < 1e-15);
    CHECK(length(turned.from - DVec3(1, 0, 3)) < 1e-15);
    // 2 (1 - r^2)^2 is 1/2 where r^2 is 1/2.
    const Scene ball = whole("blob { threshold .5 sphere { x, 1, 2 translate -x } }");
    CHECK(contains(ball.primitives[0], {0, .7071, 0}));
    CHECK_FALSE(contains(ball.primitives[0], {0, .7072, 0}));
    CHECK(whole("blob { threshold .5 sphere { 0, 1, -1 } }").primitives.empty());
    CHECK(
        says(notes_of("\nblob { threshold 0 sphere { 0, 1, 1 } }"), "left out: a blob: its threshold is not above 0"));
    const std::string layers = "texture { pigment { rgb 1 } } texture { pigment { rgbt .5 } }";
    CHECK(says(notes_of("\nblob { sphere { 0, 1, 2 " + layers + " } }"), "approximated: the parts of a blob have"));
    // Parts with one finish become one layer of a blob, and those with others layers with shares.
    const Scene layered = whole(
        "blob { sphere { 0, 1, 2 pigment { rgb x } } sphere { x, 1, 1 finish { phong 1 } } sphere { y, 1, 1 } "
        "sphere { z, 1, 1 pigment { rgbt <1, 1, 1, .5> } } pigment { rgb z } }");
    CHECK(material(layered).coats.size() == 2);
    CHECK(material(layered).share.pattern);
    // Parts blend by their fields, of which one may take away.
    const Scene blended = whole(
        "blob { threshold .1 sphere { 0, 1, 2 pigment { rgb 2*x } translate .5*x } sphere { 0, 1, 1 pigment { rgb z } "
        "} "
        "cylinder { <-1, 0, 0>, <0, 0, 0>, 2, -.1 } pigment { rgb y } }");
    REQUIRE(material(blended).rgb.pattern);
    for (const double at : {-.2, .1, .3, .45}) {
        const auto q = [](double square) { return square < 1 ? (1 - square) * (1 - square) : 0; };
        const double red = 2 * q((at - .5) * (at - .5)), blue = q(at * at), green = .1 * q(at > 0 ? at * at / 4 : 0);
        const double sum = red + blue + green;
        const auto seen = referee::Paint<double>(material(blended).rgb, glm::dmat4(1)).at({at, 0, 0});
        CAPTURE(at);
        CHECK(double(seen.x) == doctest::Approx(2 * red / sum));
        CHECK(double(seen.y) == doctest::Approx(green / sum));
        CHECK(double(seen.z) == doctest::Approx(blue / sum));
    }
}

TEST_CASE("POV-Ray: polynomials and isosurfaces become meshes near their surfaces") {
    // Returns the least and the largest distance of the mesh's points from the origin, or from a circle around y.
    const auto distances = [](const std::string& text, double circle = 0) {
        const Scene scene = opened(text).scene;
        const MeshData& mesh = *shape<Mesh>(scene).data;
        CHECK(mesh.corner_normals.size() == mesh.triangles.size());
        std::pair<double, double> range{1e9, 0};
        for (const DVec3& p : mesh.points) {
            const double away = std::hypot(std::hypot(p.x, p.z) - circle, p.y);
            range = {std::min(range.first, away), std::max(range.second, away)};
        }
        return range;
    };
    const auto is = [](std::pair<double, double> range, double radius) {
        CHECK(range.first == doctest::Approx(radius).epsilon(.002));
        CHECK(range.second == doctest::Approx(radius).epsilon(.002));
    };
    is(distances("quadric { <1, 1, 1>, <0, 0, .0001>, 0, -1 }"), 1);
    // The torus of radii 3 and 1: (x^2 + y^2 + z^2 + 8)^2 = 36 (x^2 + z^2).
    is(distances(
           "quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 16, 0, 0, 0, 0,"
           "1, 0, -20, .00001, 64> }",
           3),
       1);
    is(distances("isosurface { function { x*x + y*y + z*z } threshold 4 contained_by { box { -3, 3 } } }"), 2);
    CHECK(opened("isosurface { function { 1 } }").scene.primitives.empty());
    is(distances("parametric { function { 2*sin(u)*cos(v) } function { 2*cos(u) }, function(a, b) { 2*sin(a)*sin(b) }"
                 "<0, 0>, <pi, 2*pi> contained_by { sphere { 0, 2 } } precompute 4 x, y, z accuracy .1 }"),
       2);
    const Scene strip =
        opened("parametric { function { u } function { .01/v } function { 0 } <-3, -1>, <3, 1> }").scene;
    CHECK(shape<Mesh>(strip).bounds().high.x < 1.0001);  // its container is the usual box, and 1/0 is left out
    CHECK(opened("parametric { function { u } function { v } function { 5 } <0, 0>, <1, 1> }").notes.size() == 2);
    // Noise as fine as the grid cuts its cells in all ways; the surface is closed, and keeps to its container.
    const Scene noise = opened(
                            "#declare N = function { internal(76) }"
                            "isosurface { function { N(19 * x, 23 * y, 21 * z) } threshold .5 }")
                            .scene;
    const Mesh& mesh = shape<Mesh>(noise);
    CHECK_FALSE(mesh.open());
    CHECK(mesh.data->triangles.size() > 10'000);
    CHECK(std::ranges::all_of(mesh.data->points, [](const DVec3& p) { return length(p) < 1.75; }));
    // Operators, calls and loops, at eight points at once: planes at x = 2/3 and 1/3.
    const Scene planes = opened(
                             "#declare F = function(a) { select(a - 1, 3 * a, 0) + prod(i, 1, 3, a) * 0 }"
                             "isosurface { function { -min(F(x) - sum(i, 0, 1, i) * 1, 2 - F(x)) } }")
                             .scene;
    const Box slab = shape<Mesh>(planes).bounds();
    CHECK(slab.low.x == doctest::Approx(1. / 3).epsilon(.001));
    CHECK(slab.high.x == doctest::Approx(2. / 3).epsilon(.001));
    CHECK(slab.high.y == doctest::Approx(1).epsilon(.001));
    // Expects many triangles where one of 70 uses is near the camera, and few where another is far away.
    const Scene many = opened(
                           "#declare S = isosurface { function { x*x + y*y + z*z - .5 } }"
                           "#for (i, 1, 70) object { S translate i * i * z } #end")
                           .scene;
    REQUIRE(many.primitives.size() == 70);
    CHECK(shape<Mesh>(many, 0).data->triangles.size() > 10'000);
    CHECK(shape<Mesh>(many, 69).data->triangles.size() < 2'000);
    CHECK(shape<Mesh>(many, 69).data == shape<Mesh>(many, 60).data);
    // A body that is declared and not shown is not made.
    CHECK(opened("#declare S = isosurface { function { x } }").notes.empty());
}

TEST_CASE("POV-Ray: a clipped body's pattern moves with the body") {
    const std::string look = "pigment { checker } translate <-3, 1, 0>";
    const Scene plain = whole("box { -1, 1 " + look + " }");
    const Scene clipped = whole("box { -1, 1 clipped_by { sphere { 0, 1.2 } } " + look + " }");
    CHECK(clipped.primitives.at(0).transformations == plain.primitives.at(0).transformations);
    CHECK(material(clipped).rgb == material(plain).rgb);
    const auto& parts = *std::get<Intersection>(clipped.primitives.at(0).shape).parts;
    CHECK(matrix(parts.at(1).transformations) == glm::dmat4(1));
}

TEST_CASE("POV-Ray: bodies that no ray meets are not missing") {
    for (const char* const text :
         {"sphere { x, 0 }", "box { 1, 1 }", "box { <-1, 0, 2>, <1, 0, 2> }", "cylinder { -2*x, 2*x, 0 }",
          "cylinder { -y, x, 0 open }", "cone { -x, 0, x, 0 }", "disc { 0, z, 0 }", "disc { 0, z, .5, .8 }",
          "disc { x, 0, 1 }", "torus { 1, 0 }", "torus { 0, 0 }", "triangle { 0, x, 2*x }",
          "smooth_triangle { 0, z, x, 0, y, z }", "blob { sphere { 0, 1, 0 } }", "blob { sphere { 0, 0, 1 } }",
          "sphere_sweep { linear_spline 2, -x, 0, x, 0 }", "polygon { 3, 0, x, 2*x }",
          "intersection { sphere { 0, 1 } cylinder { -2*z, 2*z, 0 } }"}) {
        CAPTURE(text);
        CHECK(whole(text).primitives.empty());
    }
    CHECK(whole("difference { sphere { 0, 1 } sphere { 0, 0 } }").primitives.size() == 1);
    const std::string bent = "polygon { 4, 0, x, <1, 1, .1>, y }";
    const std::vector<Message> warnings = opened(bent).warnings;
    REQUIRE(warnings.size() == 1);
    CHECK(says(warnings[0].told(), "not in one plane"));
    CHECK(whole(bent).primitives.empty());
    CHECK(shape<Disc>(whole("disc { 0, z, -1, -.5 }")) == shape<Disc>(whole("disc { 0, z, 1, .5 }")));
    // Takes a body without extent away, which could be seen inside a clear one.
    const std::string thin = "difference { sphere { 0, 1 } cylinder { -y, y, 0 } ";
    CHECK(notes_of(thin + "}") == "");
    CHECK(says(notes_of(thin + "pigment { rgbt .5 } }"), "left out: a body without extent"));
    // POV-Ray looks for spheres of a negative radius in a box that is turned inside out, unless they are taken away.
    const std::string negative = "sphere { y, -.5 }";
    CHECK(says(notes_of(negative), "a sphere of a negative radius"));
    CHECK(says(notes_of("difference { " + negative + " box { 0, 1 } }"), "a sphere of a negative radius"));
    CHECK(notes_of("difference { sphere { 0, 1 } " + negative + " }") == "");
}

TEST_CASE("POV-Ray: normals of meshes without a length are x, and triangles with one normal are flat") {
    const auto normals = [](const std::string& a, const std::string& b, const std::string& c) {
        const std::string text = "mesh { smooth_triangle { 0, " + a + ", y, " + b + ", x, " + c + " } }";
        const std::string second = "mesh2 { vertex_vectors { 3, 0, y, x } normal_vectors { 3, " + a + ", " + b + ", " +
                                   c + " } face_indices { 1, <0, 1, 2> } }";
        const auto own = shape<Mesh>(whole(text)).data, other = shape<Mesh>(whole(second)).data;
        CHECK(own->normals == other->normals);
        return own->normals;
    };
    CHECK(normals("0", "-z", "<0, .5, -1>")[0] == DVec3(1, 0, 0));
    CHECK(normals("-z", "<1e-11, 0, 0>", "<0, .5, -1>")[1] == DVec3(1, 0, 0));
    for (const char* const all : {"0", "<.3, .4, -.5>", "z"})
        for (const DVec3& normal : normals(all, all, all)) CHECK(normalize(normal) == DVec3(0, 0, -1));
}

// Bodies that lie between the samples.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "files/read_file.h"
#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "scene/capsules.h"
#include "scene/kinds/capsule.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/scenes.h"
#include "trace/cells/cell_sample.h"
#include "trace/cells/thin_bodies.h"
#include "trace/cells/tube.h"
#include "trace/tracer.h"

using namespace strahl;

namespace {

double distance_to(const Capsule& capsule, const DVec3& p) {
    const DVec3 way = capsule.to - capsule.from, since = p - capsule.from;
    const double squared = dot_product(way, way);
    const double t = squared > 0 ? std::clamp(dot_product(since, way) / squared, 0., 1.) : 0.;
    return length(since - t * way) - capsule.radius;
}

/// Is the point in the body, in the scene's coordinates?
bool inside(const Primitive& primitive, const DVec3& p) {
    const DVec3 own = transform_point(glm::inverse(matrix(primitive.transformations)), p);
    return std::visit([&](const auto& kind) { return kind.contains(own); }, primitive.shape);
}

/// A picture's size, 4:3 unless its height is given.
struct PictureSize {
    int width, height;
    PictureSize(int w) : PictureSize(w, w * 3 / 4) {}
    PictureSize(int w, int h) : width(w), height(h) {}
};

std::vector<double> picture(const Scene& scene, PictureSize size, const Sampling& sampling) {
    const View view{.camera = scene.camera, .width = size.width, .height = size.height, .error = 1. / 510};
    ThreadPool pool(2);
    Tracer tracer(scene, Precision::float64);
    return values_of(tracer, view, {.columns = view.width, .rows = view.height}, pool, sampling);
}

Scene wires() {
    const std::string path = STRAHL_SOURCE "/tests/bench/sampling/wires.rt";
    return parse_scene(read_text(path), path, {}, read_pixels);
}

/// 400 balls, so far away that they are .05 to .3 pixels wide at 320x240.
Scene dust() {
    Scene scene = wires();
    scene.primitives.resize(1);
    const Primitive first = scene.primitives[0];
    scene.primitives.clear();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> across(-3, 3), up(-2.2, 2.2), radius(.0006, .0035);
    for (int i = 0; i < 400; ++i) {
        scene.primitives.push_back(first);
        scene.primitives.back().shape = Sphere{{across(random), 0, up(random)}, radius(random)};
    }
    return scene;
}

/// A floor, on which falls the shadow of a wire that is not in the picture: .2 pixels wide.
const char* const shadow_of_wire = R"(
camera { position <0, -1, 10>  look_at <0, 0, 0>  sky <0, 1, 0>  angle 20 }
light { position <30, 5, 40>  color <1, 1, 1> }
background { color <0, 0, 0> }
defaultmaterial { rgb <1, 1, 1>  diffuse .8  ambient .1  specular 0  reflection 0 }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }
cylinder { <3.65, -.28, 5>, <3.9, 1.43, 5>, .0019 }
)";

/// A wire behind the camera, .2 pixels wide in a flat mirror.
const char* const wire_in_mirror = R"(
camera { position <0, -1, 10>  look_at <0, 0, 0>  sky <0, 1, 0>  angle 20 }
light { position <30, 5, 40>  color <1, 1, 1> }
background { color <0, 0, 0> }
defaultmaterial { rgb <1, 1, 1>  diffuse 0  ambient .1  specular 0  reflection .5 }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }
defaultmaterial { rgb <1, 1, 1>  diffuse 0  ambient 1  specular 0  reflection 0 }
cylinder { <-2.5, .7, 12>, <2.7, 1.7, 12>, .0048 }
)";

/// A ceiling behind the camera in a flat mirror, and on it the shadow of a wire, .2 pixels wide.
const char* const shadow_in_mirror = R"(
camera { position <0, -1, 10>  look_at <0, 0, 0>  sky <0, 1, 0>  angle 20 }
light { position <30, 5, 4>  color <2, 2, 2> }
background { color <0, 0, 0> }
defaultmaterial { rgb <1, 1, 1>  diffuse 0  ambient .1  specular 0  reflection .8 }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }
defaultmaterial { rgb <1, 1, 1>  diffuse .8  ambient .1  specular 0  reflection 0 }
plane { <0, 0, 16>, <1, 0, 16>, <0, 1, 16> }
cylinder { <14.6, .3, 10>, <15.4, 4.3, 10>, .0012 }
)";

/// A wire .2 pixels wide, as large as at look_at.
const char* const wire_in_sight = R"(
camera { position <0, -1, 10>  look_at <0, 0, 0>  sky <0, 1, 0>  angle 20 }
light { position <30, 5, 40>  color <1, 1, 1> }
background { color <0, 0, 0> }
defaultmaterial { rgb <1, 1, 1>  diffuse 0  ambient 1  specular 0  reflection 0 }
cylinder { <-1.1, -.9, 5>, <1.2, -.3, 5>, .0022 }
)";

/// Checks how much light of a scene's thin last body our samples find, against a fine grid: all but a share of `lost`.
/// Pixels that keep less than a quarter of it may be up to this share of those that show the body.
void check_last_body(Scene scene, PictureSize size = 160, double lost = .01, double missing = 0) {
    const std::vector<double> exact = picture(scene, size, {.grid = 20}), ours = picture(scene, size, {});
    scene.primitives.pop_back();
    const std::vector<double> without = picture(scene, size, {});
    double sum = 0, exact_sum = 0;
    int missed = 0, concerned = 0;
    for (std::size_t i = 0; i < exact.size(); i += 3) {
        const double own = std::abs(without[i] - ours[i]), right = std::abs(without[i] - exact[i]);
        sum += own, exact_sum += right;
        concerned += right > .02, missed += right > .02 && own < right / 4;
    }
    CAPTURE(concerned);
    CHECK(concerned > size.width / 2);
    CHECK(missed <= missing * concerned);
    CHECK(sum == doctest::Approx(exact_sum).epsilon(lost));
}

}  // namespace

TEST_CASE("capsules contain their bodies") {
    std::mt19937 random(1);
    int tried = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed)
        for (const Primitive& primitive : random_scene(seed).primitives) {
            const std::vector<Capsule> capsules = capsules_of(primitive);
            if (capsules.empty()) continue;
            std::uniform_real_distribution<double> anywhere(-6, 6);
            for (int i = 0; i < 300; ++i) {
                const DVec3 p(anywhere(random), anywhere(random), anywhere(random));
                if (!inside(primitive, p)) continue;
                ++tried;
                double least = 1e9;
                for (const Capsule& capsule : capsules) least = std::min(least, distance_to(capsule, p));
                CHECK(least < 1e-9);
            }
        }
    CHECK(tried > 300);
}

TEST_CASE("tubes meet what points of them lie in") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(-1, 1), positive(0, 1);
    const auto point = [&] { return DVec3(anywhere(random), anywhere(random), anywhere(random)); };
    int met = 0, missed = 0;
    for (int i = 0; i < 20000; ++i) {
        const double length_of_tube = 2 * positive(random), end = .3 * positive(random);
        const DVec3 middle = point();
        const Capsule capsule{middle, i % 3 == 0 ? middle : middle + point(), .01 + .2 * positive(random)};
        Tube tube{.from = point(),
                  .direction = normalize(point()),
                  .length = length_of_tube,
                  .radius = 0,
                  .growth = 0,
                  .area = 2};
        tube.radius = i % 2 == 0 ? .3 * positive(random) : 0, tube.growth = (end - tube.radius) / length_of_tube;
        const double radius = radius_at(tube, capsule);
        double found = -1;  // of points of the tube in the capsule, those where it is widest
        for (int k = 0; k < 40; ++k) {
            const double along = k / 39. * tube.length, own = tube.radius + tube.growth * along;
            const DVec3 at = tube.from + along * tube.direction, aside = cross_product(tube.direction, point());
            if (distance_to(capsule, at + own * positive(random) * normalize(aside)) < 0) found = std::max(found, own);
        }
        CHECK(radius >= found - 1e-12);
        met += found >= 0, missed += radius < 0;
    }
    CHECK(met > 300);
    CHECK(missed > 5000);  // the bound is of use
}

TEST_CASE("thin bodies in a tube are found, and no others") {
    Scene scene = wires();
    const Tube tube{.from = {0, -10, 0}, .direction = {0, 1, 0}, .length = 11, .radius = 0, .growth = .1, .area = 2};
    const auto meets = [&](const Shape& shape, const Tube& where, double least, std::span<const DVec3> own = {}) {
        scene.primitives.resize(1);
        scene.primitives[0].shape = shape;
        return CapsuleTree(scene).meets(where, RayBundle{}, least, FacetsSeen::any, own);
    };
    const Sphere small{{0, 0, 0}, .1}, large{{0, 0, 0}, 1.5}, beside{{1.2, 0, 0}, .1};
    CHECK(meets(small, tube, .01));
    CHECK(!meets(small, tube, .05));  // it covers .04 of 2.04
    CHECK(!meets(large, tube, .01));
    CHECK(!meets(beside, tube, .001));
    Tube shorter = tube;
    shorter.length = 9;
    CHECK(!meets(small, shorter, .001));
    const std::vector<DVec3> own{{0, -.1, 0}, {0, 0, .1}};
    CHECK(!meets(small, tube, .01, own));
    scene.primitives.clear();
    CHECK(!CapsuleTree(scene).meets(tube, RayBundle{}, 0, FacetsSeen::any));
}

TEST_CASE("wires and dust keep their light") {
    for (const auto& [scene, width] : {std::pair(wires(), 640), std::pair(dust(), 320)}) {
        const std::vector<double> exact = picture(scene, width, {.grid = 20}), ours = picture(scene, width, {});
        double sum = 0, exact_sum = 0;
        int missed = 0, concerned = 0;
        for (std::size_t i = 0; i < exact.size(); i += 3) {
            sum += ours[i], exact_sum += exact[i];
            concerned += exact[i] > .02, missed += exact[i] > .02 && ours[i] < exact[i] / 4;
        }
        CAPTURE(concerned);
        CHECK(concerned > 100);
        CHECK(missed == 0);
        CHECK(sum == doctest::Approx(exact_sum).epsilon(.01));
    }
}

TEST_CASE("a wire that is the only body keeps its light, whatever end is nearer") {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> within(-2, 2);
    const auto end = [&](double x) { return DVec3(x, within(random), within(random)); };
    for (int i = 0; i < 6; ++i) {
        CAPTURE(i);
        Scene scene = wires();
        scene.primitives.resize(1);
        const PictureSize size = i % 2 ? PictureSize(120) : PictureSize(96, 170);
        scene.primitives[0].shape = Cylinder{end(-2.7), end(2.7), .48 / size.width};
        check_last_body(std::move(scene), size, .03);
    }
}

TEST_CASE("shadows of wires keep their darkness") { check_last_body(parse_scene(shadow_of_wire, "shadow_of_wire")); }

TEST_CASE("wires, their shadows and reflections keep their light in parallel views") {
    for (std::string text : {std::string(shadow_of_wire), std::string(wire_in_mirror), std::string(wire_in_sight)}) {
        text.replace(text.find("angle 20"), 8, "orthographic angle 15");
        check_last_body(parse_scene(text, "parallel"), 120, .05, .02);
    }
}

TEST_CASE("wires in a mirror keep their light") { check_last_body(parse_scene(wire_in_mirror, "wire_in_mirror")); }
TEST_CASE("shadows of wires in a mirror keep their darkness") {
    check_last_body(parse_scene(shadow_in_mirror, "shadow_in_mirror"));
}

TEST_CASE("the share of rays that a polygon takes is that of many rays") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> within(-1, 1);
    const auto vector = [&] { return DVec3(within(random), within(random), within(random)); };
    int between = 0;
    for (int i = 0; i < 400; ++i) {
        const bool parallel = i % 2 == 1;
        const RayBundle bundle{.from = vector(),
                               .corner = DVec3(0, 0, 2) + .3 * vector(),
                               .across = DVec3(1, 0, 0) + .3 * vector(),
                               .down = DVec3(0, 1, 0) + .3 * vector(),
                               .parallel = parallel,
                               .nearest = .2,
                               .furthest = 2};
        const DVec3 middle = bundle.from + (parallel ? DVec3(.5, .5, 2) : DVec3(.5, .5, 2.5)) + vector();
        const DVec3 polygon[3]{middle + .8 * vector(), middle + .8 * vector(), middle + .8 * vector()};
        // Where rays meet the triangle, from the sides that a point of its plane is on.
        const DVec3 normal = cross_product(polygon[1] - polygon[0], polygon[2] - polygon[0]);
        const auto meets = [&](double u, double v) {
            const DVec3 beside = u * bundle.across + v * bundle.down;
            const DVec3 from = parallel ? bundle.from + beside : bundle.from;
            const DVec3 way = parallel ? bundle.corner : bundle.corner + beside;
            const double w = dot_product(polygon[0] - from, normal) / dot_product(way, normal);
            const DVec3 point = from + w * way;
            for (int k = 0; k < 3; ++k) {
                const DVec3 side = polygon[(k + 1) % 3] - polygon[k];
                if (dot_product(cross_product(side, point - polygon[k]), normal) < 0) return false;
            }
            return w > bundle.nearest && w < bundle.furthest;
        };
        constexpr int rays = 60;
        int met = 0;
        for (int k = 0; k < rays * rays; ++k) met += meets((k % rays + .5) / rays, (k / rays + .5) / rays);
        unsigned corners = 0;
        for (const auto& [u, v, bit] : {std::tuple(0, 0, 1), {1, 0, 2}, {1, 1, 4}, {0, 1, 8}})
            if (meets(u, v)) corners |= unsigned(bit);
        const RayBundle::Met own = bundle.met(polygon, bundle.coordinates());
        CHECK(own.corners == corners);
        CHECK(std::abs(own.share - met / double(rays * rays)) < .02);
        between += corners == 0 && met > 0;
    }
    CHECK(between > 50);
}

TEST_CASE("of many long triangles those are found that a bundle meets, and no others") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> within(-1, 1);
    const auto vector = [&] { return DVec3(within(random), within(random), within(random)); };
    MeshData data;
    std::vector<std::array<DVec3, 3>> triangles;
    for (int i = 0; i < 40; ++i) {
        const DVec3 middle = 5. * vector(), half = 10. * within(random) * normalize(vector());
        triangles.push_back({middle - half, middle + half, middle + .05 * vector()});
        data.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        data.points.insert(data.points.end(), triangles.back().begin(), triangles.back().end());
    }
    Scene scene = wires();
    scene.primitives.resize(1);
    scene.primitives[0] = {Mesh{std::make_shared<const MeshData>(data), ""}, 0, {}};
    const CapsuleTree tree(scene);
    constexpr double least = .01;
    int found = 0, missed = 0;
    for (int i = 0; i < 2000; ++i) {
        const std::array<DVec3, 3>& aimed = triangles[std::size_t(i) % triangles.size()];
        const double t = .5 + .5 * within(random);
        const DVec3 from = 30. * normalize(vector()), target = (1 - t) * aimed[0] + t * aimed[1] + .3 * vector();
        const DVec3 across = .3 * normalize(cross_product(target - from, vector()));
        const DVec3 down = .3 * normalize(cross_product(target - from, across));
        const RayBundle bundle{.from = from,
                               .corner = target - from - .5 * (across + down),
                               .across = across,
                               .down = down,
                               .parallel = false,
                               .nearest = .1,
                               .furthest = 2};
        const double distance = length(target - from);
        const Tube tube{.from = from,
                        .direction = (target - from) / distance,
                        .length = 3 * distance,
                        .radius = 0,
                        .growth = .22 / distance,
                        .area = 2};
        bool any = false;
        for (const auto& triangle : triangles) {
            const RayBundle::Met met = bundle.met(triangle, bundle.coordinates());
            any |= met.corners == 0 && met.share >= least;
        }
        CHECK(tree.meets(tube, bundle, least, FacetsSeen::any) == any);
        ++(any ? found : missed);
    }
    CHECK(found > 300);
    CHECK(missed > 300);
}

TEST_CASE("flat bodies seen edge-on, rings, slivers and what differences leave keep their light") {
    const std::string seen =
        "camera { position <0, 0, 1000>  look_at <0, 0, 0>  sky <0, 1, 0>  fov .5 }  background { color <1, 1, 1> }\n"
        "light { position <0, 0, 500>  color <0, 0, 0> }\n"
        "defaultmaterial { ambient 0  diffuse 0  specular 0  reflection 0 }\n";
    const std::string floor =
        "camera { position <0, -1, 10>  look_at <0, 0, 0>  sky <0, 1, 0>  angle 20 }\n"
        "light { position <3, 5, 40>  color <1, 1, 1> }\n"
        "defaultmaterial { rgb <1, 1, 1>  diffuse .8  ambient .1  specular 0  reflection 0 }\n"
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }\n";
    const std::string mirror =
        "camera { position <0, -1, 10>  look_at <0, 0, 0>  sky <0, 1, 0>  angle 20 }\n"
        "light { position <30, 5, 40>  color <1, 1, 1> }\n"
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { diffuse 0  ambient .1  specular 0  reflection .5 } }\n"
        "defaultmaterial { rgb <1, 1, 1>  diffuse 0  ambient 1  specular 0  reflection 0 }\n";
    for (const std::string& text : {
             seen + "disc { <.03, .02, 0>, <0, 1, 1>, 5, 4.96 }",
             seen + "disc { <0, .03, 0>, <0, 1, .008>, 5 }",
             seen + "triangle { <-6, .033, 0>, <6, .75, 0>, <6, .8, 0> }",
             seen + "box { <-6, .033, -3>, <6, .073, 0>  rotate <0, 0, 7> }",
             seen + "cylinder { <0, .033, 0>, <0, .073, 0>, 5  rotate <0, 0, 7> }",
             seen + "mesh { triangle { <-6, .033, 0>, <6, .75, 0>, <6, .79, 0> } "
                    "triangle { <-6, .033, 0>, <6, .79, 0>, <-6, .073, 0> } }",
             seen + "difference { cylinder { <.03, .02, -1>, <.03, .02, 1>, 5 } "
                    "cylinder { <.03, .02, -2>, <.03, .02, 2>, 4.96 } }",
             floor + "disc { <.1, .3, 1>, <0, 0, 1>, .8, .78 }",
             mirror + "triangle { <-2.5, .7, 12>, <2.7, 1.7, 12>, <2.7, 1.73, 12> }",
         }) {
        CAPTURE(text);
        // Bodies of a sixth of a pixel lose up to 7 % of their light in this small picture, of a fifth up to 3 %.
        check_last_body(parse_scene(text, "flat"), 80, .08, .02);
    }
}

TEST_CASE("rings, slivers, plates, coins and strips of meshes, of .06 to .5 pixels, take their area") {
    std::mt19937 random(21);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
    for (int i = 0; i < 24; ++i) {
        CAPTURE(i);
        const PictureSize sizes[]{{120, 90}, {128, 72}, {72, 128}}, &size = sizes[i / 6 % 3];
        Scene scene = wires();
        scene.primitives.resize(1);
        const double width = 7.2 / size.width * std::pow(10., between(-1.2, -.3));  // a pixel has 7.2 / size.width
        const DVec3 across(between(-1, 1), between(-1, 1), between(-1, 1));
        Shape& shape = scene.primitives[0].shape;
        if (i % 6 == 0) shape = Disc{{}, {across.x, 1, across.z}, 2.5, 2.5 - width};
        if (i % 6 == 1)
            shape = Triangle{{-2.5, across.x, across.y}, {-2.5, across.x, across.y + width}, {2.5, 0, across.z}};
        if (i % 6 == 2) shape = Disc{{0, 0, .2}, {across.x, width / 8, 1}, 2};
        if (i % 6 == 3) shape = Cuboid{{-2.3, 0, 0}, {2.4, 1.5, width}};
        if (i % 6 == 4) shape = Cylinder{{0, 0, 0}, {0, 0, width}, 2};
        if (i % 6 == 5) {
            const DVec3 low(-2.5, across.x, across.y), high(2.5, across.y, across.z), up(0, 0, width);
            MeshData data;
            data.points = {low, low + up, high, high + up}, data.triangles = {{0, 2, 3}, {0, 3, 1}};
            shape = Mesh{std::make_shared<const MeshData>(data), ""};
        }
        if (i % 6 == 3 || i % 6 == 4) scene.primitives[0].transformations = {Rotate{{0, 30 * across.x, 0}}};
        check_last_body(std::move(scene), size, .02, .02);
    }
}

TEST_CASE("tori and sphere sweeps of .05 to .4 pixels take their area") {
    // Black bodies before white, seen in parallel. How much of the picture they hide is known in closed form: all of a
    // curve's length, as it is seen, times their thickness, and at its ends a half circle each.
    const std::string black =
        "camera { position <0, 0, 1000>  look_at <0, 0, 0>  sky <0, 1, 0>  orthographic fov .45 }\n"
        "background { color <1, 1, 1> }  light { position <0, 0, 500>  color <0, 0, 0> }\n"
        "defaultmaterial { ambient 0  diffuse 0  specular 0  reflection 0 }\n";
    std::mt19937 random(31);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
    const auto text_of = [](const DVec3& v) {
        return "<" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ">";
    };
    const auto length_seen = [](const auto& place, int steps) {
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const DVec3 step = place((i + 1.) / steps) - place(double(i) / steps);
            sum += std::hypot(step.x, step.y);
        }
        return sum;
    };
    for (int i = 0; i < 12; ++i) {
        const PictureSize sizes[]{{480, 360}, {480, 270}, {360, 640}}, &size = sizes[i % 3];
        const double pixel = 2000 * std::tan(.45 * std::numbers::pi / 180) / size.width;
        const double thick = pixel * std::pow(10., between(-1.3, -.4));
        const double radius = between(2, 4), x = between(-1, 1), y = between(-1, 1);
        std::string body;
        double area = 0;
        if (i % 2 == 0) {
            const double tilt = between(0, 1.2), turn = between(0, 6);
            const DVec3 axis(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
            body = "torus { " + text_of({x, y, 0}) + ", " + text_of(axis) + ", " + std::to_string(radius) + ", " +
                   std::to_string(thick / 2) + " }";
            area = thick * length_seen(
                               [&](double t) {
                                   const double at = 2 * std::numbers::pi * t;
                                   return DVec3(radius * std::cos(at), radius * std::cos(tilt) * std::sin(at), 0);
                               },
                               10000);
        } else {
            DVec3 balls[5];
            body = "sphere_sweep { ";
            for (int k = 0; k < 5; ++k) {
                balls[k] = DVec3(2.2 * k - 4.4 + between(-.6, .6), between(-1.5, 1.5), between(-2, 2));
                body += "through { " + text_of(balls[k]) + ", " + std::to_string(thick / 2) + " } ";
            }
            body += "}";
            area = thick * thick * std::numbers::pi / 4;
            for (int k = 0; k < 2; ++k)  // the spline of Catmull and Rom
                area += thick * length_seen(
                                    [&](double t) {
                                        const DVec3 &a = balls[k], &b = balls[k + 1], &c = balls[k + 2],
                                                    &d = balls[k + 3];
                                        return .5 * (2. * b + t * (c - a) + t * t * (2. * a - 5. * b + 4. * c - d) +
                                                     t * t * t * (3. * b - a - 3. * c + d));
                                    },
                                    2000);
        }
        CAPTURE(body);
        double hidden = 0;
        const std::vector<double> values = picture(parse_scene(black + body, "thin"), size, {});
        for (std::size_t k = 0; k < values.size(); k += 3) hidden += 1 - values[k];
        CHECK(hidden == doctest::Approx(area / (pixel * pixel)).epsilon(.03));
    }
}

TEST_CASE("a gap between two bodies is seen") {
    Scene scene = parse_scene(
        "camera { position <0, 0, 1000>  look_at <0, 0, 0>  sky <0, 1, 0>  fov .5 }  background { color <1, 1, 1> }\n"
        "light { position <0, 0, 500>  color <0, 0, 0> }\n"
        "defaultmaterial { ambient 0  diffuse 0  specular 0  reflection 0 }\n"
        "box { <-6, -4, -.001>, <.033, 4, 0>  rotate <0, 0, 7> }\n"
        "box { <.073, -4, -.001>, <6, 4, 0>  rotate <0, 0, 7> }\n",
        "gap");
    const std::vector<double> exact = picture(scene, 80, {.grid = 20}), ours = picture(scene, 80, {});
    double sum = 0, exact_sum = 0;
    for (int y = 20; y < 40; ++y)
        for (int x = 20; x < 60; ++x) sum += ours[3 * (80 * y + x)], exact_sum += exact[3 * (80 * y + x)];
    CHECK(sum == doctest::Approx(exact_sum).epsilon(.08));  // a sixth of a pixel, as above
}

TEST_CASE("what a flat mirror shows of a large body takes no rays for what may be hidden") {
    const Scene scene = parse_scene(
        "camera { position <0, -10, 4>  look_at <0, 0, 0>  sky <0, 0, 1>  angle 10 }\n"
        "light { position <-6, -8, 40>  color <1, 1, 1> }\n"
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { diffuse 0  specular 0  reflection .8 } }\n"
        "difference { box { <-30, 6, -1>, <30, 6.7, 50> }  box { <-1, 5, 48>, <1, 9, 60> }\n"
        "             material { diffuse .8  ambient .1  specular 0  reflection 0 } }\n",
        "wall");
    const View view{.camera = scene.camera, .width = 64, .height = 48, .error = 1. / 510};
    ThreadPool pool(1);
    Tracer tracer(scene, Precision::float64);
    tracer.prepare(view, pool);
    const Job job{view, pool, [](const Tile&) {}};
    CHECK(tracer.trace(job, SampledRegion{{.columns = 64, .rows = 48}, {}}).camera < 64 * 48);
}

TEST_CASE("shadows are not looked for in cells that reach to the horizon") {
    const Scene scene = parse_scene(
        "camera { position <0, -10, 4>  look_at <0, 0, 4>  sky <0, 0, 1>  angle 10 }\n"
        "light { position <-6, -8, 10>  color <1, 1, 1> }\n"
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }  sphere { <10, 20, 1>, .005 }\n",
        "horizon");
    const ThinBodies thin(scene, {.camera = scene.camera, .width = 64, .height = 48});
    const auto hides = [&](double low, double high) {  // in pixels below the horizon
        const double pixel = 2 * std::tan(std::numbers::pi / 36) / 64;
        const auto sample = [&](double below) {
            CellSample own{};
            own.rgb[0] = 1, own.lit = 1, own.distance = static_cast<float>(4 / (pixel * below));
            return own;
        };
        const CellSample upper = sample(low), lower = sample(high);
        const double left = 32, right = left + high - low;
        return thin.hides_in({{{left, 24 + low, &upper},
                               {right, 24 + low, &upper},
                               {right, 24 + high, &lower},
                               {left, 24 + high, &lower}}},
                             1e-3);
    };
    CHECK(!hides(.002, .0645));
}

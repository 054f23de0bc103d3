// Pictures through a shutter: against a closed form, against means of many pictures of single moments, which share no
// code with it, and the same bits however they are cut.
#include "trace/shutter.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "scene/moving_scene.h"
#include "tests/referee/dice.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/sanitized.h"
#include "tests/unit/text/language.h"
#include "tests/unit/trace/cut_out.h"
#include "text/parse.h"
#include "trace/cells/cell_picture.h"
#include "trace/hierarchy/moving_hierarchy.h"
#include "trace/tracer.h"
#include "trace/world/build_world.h"

namespace strahl::shutter {

/// A view of the scene while its shutter is open around a time.
View view_of(const Scene& scene, double time, int width, int height) {
    const Camera camera = camera_at(scene, time);
    return {.camera = camera,
            .width = width,
            .height = height,
            .depth = 6,
            .time = time,
            .moments = shutter_moments(scene, time, camera.shutter, [&](double t) { return camera_at(scene, t); })};
}

std::vector<double> picture(const Scene& scene, const View& view, const Lattice& part, int threads, double error,
                            Sampled* sampled = nullptr, Simd simd = Simd::automatic) {
    ThreadPool pool(threads);
    Tracer tracer(scene, Precision::float64, simd);
    tracer.prepare(view, pool);
    CellPicture cells(tracer.scene(), view, part, error);
    if (sampled) cells.check(1000);
    std::vector<double> values(std::size_t(3) * part.columns * part.rows);
    const auto keep = [&](const Tile& tile) { place(tile, part, values); };
    for (const int finest : {1, 0}) tracer.trace({view, pool, keep}, CellPass{cells, finest});
    CHECK(cells.finished());
    if (sampled) *sampled = cells.sampled();
    return values;
}

/// Averages pictures of n moments of the time that the shutter is open, each with m x m rays in a pixel, which are at
/// other places of it at each moment; through a lens, each from another place of it (the sequence R4 of M. Roberts,
/// 2018).
std::vector<double> by_pictures(const Scene& scene, const View& view, int n, int m) {
    ThreadPool pool;
    std::vector<double> sum(std::size_t(3) * view.width * view.height);
    for (int i = 0; i < n; ++i) {
        const auto part = [&](double step) { return std::fmod((i + .5) * step, 1); };
        View own = view;
        own.moments = nullptr;
        own.time = view.time + view.camera.shutter * ((i + .5) / n - .5);
        own.camera = camera_at(scene, own.time);
        own.shift_x = (part(.8566748838545029) - .5) / m, own.shift_y = (part(.7338918566271260) - .5) / m;
        if (has_lens(own.camera)) {
            const CameraFrame frame = frame_of(own.camera, double(view.width) / view.height);
            const double angle = 2 * std::numbers::pi * part(.5385972572236101), sharp = focal_distance(own.camera);
            const double radius = own.camera.aperture * std::sqrt(part(.6287067210378087));
            const double x = radius * std::cos(angle), y = radius * std::sin(angle);
            own.camera.aperture = 0;
            own.camera.position = own.camera.position + x * frame.right + y * frame.down;
            own.camera.look_at = own.camera.position + frame.forward;
            own.shift_x -= x / sharp / frame.tan_x * view.width / 2;
            own.shift_y -= y / sharp / frame.tan_y * view.height / 2;
        }
        Tracer tracer(at(scene, own.time), Precision::float64);
        const std::vector<double> one = values_of(tracer, own, whole(own), pool, {.grid = m});
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += one[k] / n;
    }
    return sum;
}

/// A random world in which half of the bodies and lights move and, every other time, the camera flies.
Scene world(int seed) {
    Dice dice(seed);
    Scene scene = random_scene(seed, {.lights = seed % 2 == 1, .patterns = seed % 3 == 0, .any_kind = .5});
    const auto motion = [&](double far, double turn) {
        Motion all;
        for (int i = 0; i < 3; ++i) all.keys.push_back({double(i), dice.vector(-far, far), dice.vector(-turn, turn)});
        return all;
    };
    for (Primitive& body : scene.primitives)
        if (dice.chance(.5)) body.transformations.emplace_back(motion(1, 60));
    for (Light& light : scene.lights)
        if (dice.chance(.5)) light.motion = motion(2, 10);
    if (seed % 2 == 0) {
        const Camera& own = scene.camera;
        const DVec3 by = .05 * length(own.look_at - own.position) * dice.direction();
        scene.flythrough = {
            .duration = 2,
            .keys = {{0, own.position, own.look_at, {}, {}}, {2, own.position + by, own.look_at, {}, {}}}};
    }
    scene.camera.shutter = dice.in(.1, 1);
    return scene;
}

TEST_CASE("a moving edge is as bright as the share of the time for which it covers a place") {
    // The edge of a glowing wall goes from -1 to 1 in a second, at the distance 10.
    Scene scene = language::parse(R"(
camera { position <0, 0, 0>  look_at <0, 1, 0>  sky <0, 0, 1>  fov 20  shutter .5 }
background { color <0, 0, 0> }
box { <0, 10, -100>, <100, 10.000001, 100>  material { rgb <1, 1, 1>  ambient 1  diffuse 0  specular 0  reflection 0 }
      motion { key { time 0  translate <-1, 0, 0> }  key { time 1  translate <1, 0, 0> } } })");
    const View view = view_of(scene, .5, 64, 8);
    const std::vector<double> values = picture(scene, view, whole(view), 2, 1. / 510);
    const double tan_x = frame_of(scene.camera, 8).tan_x;
    double squares = 0;
    for (int x = 0; x < view.width; ++x) {
        double exact = 0;
        constexpr int parts = 1000;
        for (int i = 0; i < parts; ++i) {
            const double place = 10 * ((x + (i + .5) / parts) / view.width * 2 - 1) * tan_x;
            exact += std::clamp(place + .5, 0., 1.) / parts;
        }
        for (int y = 0; y < view.height; ++y) {
            const double wrong = values[std::size_t(3) * (y * view.width + x)] - exact;
            squares += wrong * wrong / (view.width * view.height);
        }
    }
    CHECK(std::sqrt(squares) * 510 < 1.5);
}

TEST_CASE("a small bright ball that passes by leaves all its light") {
    for (const bool flies : {false, true}) {  // the camera instead of the ball
        CAPTURE(flies);
        const std::string motion = "{ key { time 0  translate <-1, 0, .1> }  key { time 1  translate <1, 0, -.1> } }";
        Scene scene = language::parse(
            "camera { position <0, 0, 0>  look_at <0, 1, 0>  sky <0, 0, 1>  fov 20  shutter .5 }\n"
            "background { color <0, 0, 0> }\nglobal_settings { ambient_light <20, 20, 20> }\n"
            "sphere { <0, 10, 0>, .03  material { rgb <1, 1, 1>  ambient 1  diffuse 0  specular 0  reflection 0 }" +
            (flies ? std::string() : "motion " + motion) + "}");
        if (flies)
            scene.flythrough = {.duration = 1,
                                .keys = {{0, {1, 0, -.1}, {1, 1, -.1}, {}, {}}, {1, {-1, 0, .1}, {-1, 1, .1}, {}, {}}}};
        const View view = view_of(scene, .5, 48, 24);
        const double pixel = 2 * 10 * frame_of(scene.camera, 2).tan_x / view.width;
        double sum = 0;
        const std::vector<double> values = picture(scene, view, whole(view), 2, 1. / 510);
        for (std::size_t i = 0; i < values.size(); i += 3) sum += values[i];
        CHECK(sum * pixel * pixel == doctest::Approx(20 * std::numbers::pi * .03 * .03).epsilon(.01));
    }
}

TEST_CASE("mirrors, shadows, turning patterns and flashes of light are means over the time") {
    const Scene scene = language::parse(R"(
camera { position <0, -10, 3>  look_at <0, 0, 1>  sky <0, 0, 1>  fov 20  shutter .4 }
background { color <.1, .2, .4> }
music { bpm 60  rows 8 }
light { position <-4, -8, 8>  color <1, .8, .6>
        motion { key { time 0 }  key { time 1  translate <8, 0, 0> } } }
light { position <4, -3, 5>  color <track "flash", track "flash", 0> }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb <.8, .8, .8>  reflection .2 } }
sphere { <1, 2, 1>, 1  material { rgb <.1, .1, .1>  reflection .8  diffuse .1 } }
sphere { <-1, -1, .6>, .5  material { rgb <.9, .3, .2> }
         motion { key { time 0  translate <-1, 0, 0> }  key { time 1  translate <4, 0, 1> } } }
box { <-.5, -.5, -.5>, <.5, .5, .5>  material { rgb checker { <1, 1, 1>, <.1, .1, .1>  scale .3 } }
      motion { key { time 0 }  key { time 1  rotate <0, 0, 170> } }  translate <-2, 2, .6> })");
    Scene flashing = scene;
    flashing.tracks = {{"flash", {{0, 0}, {4, 1}, {5, 0}}}};  // from .5 s to .625 s
    const View view = view_of(flashing, .55, 40, 30);
    Sampled sampled;
    const std::vector<double> values = picture(flashing, view, whole(view), 2, 1. / 200, &sampled);
    const std::vector<double> exact = by_pictures(flashing, view, 200, 2);
    CHECK(rms(values, exact) < 1.4 / 200);
    CHECK(sampled.error() < 2 * rms(values, exact));
    CHECK(rms(values, exact) < 2 * sampled.error());
    View sharp = view;
    sharp.moments = nullptr;
    CHECK(rms(picture(flashing, sharp, whole(view), 2, 1. / 200), exact) > 10. / 200);
}

TEST_CASE("random worlds are the mean of many moments, and the error is what is said") {
    if (sanitized()) return;  // only figures count: the case of threads, crops and lanes runs the same code
    double all = 0, said = 0;
    for (const int seed : {2, 7, 12, 23}) {
        const Scene scene = world(seed);
        const View view = view_of(scene, .8, 27, 19);
        Sampled sampled;
        const std::vector<double> values = picture(scene, view, whole(view), 2, 1. / 100, &sampled);
        const double off = rms(values, by_pictures(scene, view, 150, 2));
        CAPTURE(seed);
        CHECK(off < 1.6 / 100);
        all += off * off, said += sampled.error() * sampled.error();
    }
    CHECK(std::sqrt(all) < 2 * std::sqrt(said));
    CHECK(std::sqrt(said) < 2 * std::sqrt(all));
}

TEST_CASE("a lens and a shutter together are the mean of lenses at many moments") {
    if (sanitized()) return;  // only figures count: the case of threads, crops and lanes runs the same code
    Scene scene = world(31);
    const double distance = length(scene.camera.look_at - scene.camera.position);
    scene.camera.projection = Projection::perspective;
    scene.camera.aperture = .02 * distance, scene.camera.focus = .7 * distance;
    const View view = view_of(scene, .8, 27, 19);
    const std::vector<double> values = picture(scene, view, whole(view), 2, 1. / 100);
    CHECK(rms(values, by_pictures(scene, view, 600, 1)) < 1.6 / 100);
}

TEST_CASE("pictures through a shutter do not depend on threads, crops, lanes and passes") {
    for (const int seed : {5, 14}) {
        const Scene scene = world(seed);
        const View view = view_of(scene, .8, 75, 21);
        const std::vector<double> values = picture(scene, view, whole(view), 1, 1. / 50);
        CHECK(picture(scene, view, whole(view), 3, 1. / 50) == values);
        CHECK(picture(scene, view, whole(view), 1, 1. / 50, nullptr, Simd::scalar) == values);
        ThreadPool pool(2);
        Tracer tracer(scene, Precision::float64);
        CHECK(values_of(tracer, view, whole(view), pool, {.error = 1. / 50}) == values);
        const Lattice part{.x = 61, .y = 5, .columns = 9, .rows = 11};
        const std::vector<double> crop = picture(scene, view, part, 2, 1. / 50);
        for (int y = 0; y < part.rows; ++y)
            for (int i = 0; i < 3 * part.columns; ++i)
                CHECK(crop[std::size_t(3) * part.columns * y + i] ==
                      values[std::size_t(3) * ((part.y + y) * view.width + part.x) + i]);
    }
}

TEST_CASE("what stands still is as it is without a shutter, and takes few rays more") {
    Scene scene = language::parse(R"(
camera { position <0, -10, 3>  look_at <0, 0, 1>  sky <0, 0, 1>  fov 20  shutter .4 }
background { color <.1, .2, .4> }
light { position <-4, -8, 8>  color <1, .8, .6> }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb checker { <1, 1, 1>, <.1, .1, .1> }  reflection .2 } }
sphere { <1, 2, 1>, 1  material { rgb <.1, .5, .1>  reflection .4 } }
sphere { <1, 2, 1>, .5  motion { key { time 0 }  key { time 1  translate <.2, 0, 0> } } })");  // in the other one
    const int width = sanitized() ? 32 : 64, height = 3 * width / 4;
    const View view = view_of(scene, .5, width, height);
    REQUIRE(view.moments);
    View sharp = view;
    sharp.moments = nullptr;
    Sampled with, without;
    CHECK(picture(scene, view, whole(view), 2, 1. / 510, &with) ==
          picture(scene, sharp, whole(view), 2, 1. / 510, &without));
    CHECK(with.pixels == without.pixels);
    ThreadPool pool(2);
    Tracer tracer(scene, Precision::float64);
    const auto rays = [&](const View& own) {
        return tracer.trace({own, pool, [](const Tile&) {}}, SampledRegion{whole(own), {}}).camera;
    };
    CHECK(rays(view) <= rays(sharp) + 4 * width * height);

    // Without anything that moves there is no shutter, nor one with a ray in each pixel.
    const std::vector<double> one = values_of(tracer, sharp, whole(view), pool);
    CHECK(values_of(tracer, view, whole(view), pool) == one);
    scene.primitives.pop_back();
    CHECK(!view_of(scene, .5, width, height).moments);
    scene.flythrough = {.duration = 1,
                        .keys = {{0, {0, -10, 3}, DVec3(0), {}, {}}, {1, {1, -10, 3}, DVec3(0), {}, {}}}};
    CHECK(view_of(scene, .5, width, height).moments);
}

TEST_CASE("worlds of moments at which lights alone are elsewhere are those of their bodies with other lights") {
    for (const bool many : {false, true}) {
        CAPTURE(many);
        std::string text =
            "camera { position <0,-9,4> look_at <0,0,0> up <0,0,-1> fov 20 shutter 1 }\n"
            "light { position <-4,-4,6> color <1,1,1> motion { key { time 0 translate <-2,0,0> } "
            "key { time 1 translate <3,0,0> } } }\n"
            "light { position <4,-4,6> color <.2,.2,.4> }\nplane { <0,0,-1>, <1,0,0>, <0,1,0> }\n";
        for (int i = 0; i < (many ? 80 : 3); ++i)
            text += "sphere { <" + std::to_string(i % 9 - 4) + ", " + std::to_string(i / 9 - 4) + ", 0>, .4 }\n";
        const Scene scene = parse_scene(text, "shutter.cpp");
        const View view = view_of(scene, .5, 32, 24);
        const std::vector<double> values = picture(scene, view, whole(view), 2, 1. / 510);
        const std::vector<double> wanted = by_pictures(scene, view, 128, 2);
        double squares = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
            squares += (values[i] - wanted[i]) * (values[i] - wanted[i]) / double(values.size());
        CHECK(std::sqrt(squares) * 510 < 2);
    }
}

/// A bumpy ball of 2 * n * m triangles around `centre`: smooth or not, with places or without.
MeshData bumpy_ball(Dice& dice, int n, int m, bool smooth, bool places) {
    MeshData mesh;
    const double waves = dice.upto(5) + 1, high = dice.in(0, .3);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j < m; ++j) {
            const double down = std::numbers::pi * i / n, around = 2 * std::numbers::pi * j / m;
            const double radius = 1 + high * std::sin(waves * around) * std::sin(3 * down) + dice.in(0, .01);
            mesh.points.push_back(
                radius * DVec3(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)));
            if (smooth) mesh.normals.push_back(dice.in(.5, 2) * (mesh.points.back() + dice.arrow(0, .2)));
            if (places) mesh.places.push_back({6. * j / m, 4. * i / n});
        }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const int a = i * m + j, b = i * m + (j + 1) % m;
            mesh.triangles.push_back({a, a + m, b}), mesh.triangles.push_back({b, a + m, b + m});
        }
    if (smooth) mesh.corner_normals = mesh.triangles;
    return mesh;
}
/// The triangles of a mesh from `first` to before `last`.
Mesh stretch_of(const MeshData& whole, int first, int last) {
    MeshData part = whole;
    for (auto* const all : {&part.triangles, &part.corner_normals})
        if (!all->empty()) *all = {all->begin() + first, all->begin() + last};
    Mesh mesh;
    mesh.data = std::make_shared<const MeshData>(std::move(part));
    return mesh;
}
/// A random world with bumpy balls of 5,000 triangles that fly, turn and are mirrored and stretched, whole or in
/// halves, and some of the camera's time. Halves are small enough for each moment to have triangles of its own.
Scene flying_mesh(int seed, bool whole) {
    Dice dice(seed);
    Scene scene = random_scene(seed, {.lights = seed % 2 == 1, .patterns = seed % 3 == 0, .any_kind = .5});
    if (seed % 4 == 1) scene.settings.passed_over = 1e-4;
    for (int i = 0; i < (seed % 3 == 2 ? 70 : 0); ++i)  // so many that there is a hierarchy
        scene.primitives.push_back({Sphere{dice.vector(-4, 4), dice.in(.05, .2)}, 0, {}});
    const std::string plain =
        "mesh { triangle { <0,0,0>, <1,0,0>, <0,1,0>  uv_vectors <0,0>, <1,0>, <0,1> }  material { rgb ";
    const Scene looks = language::parse(language::eye + plain + "<.9, .5, .2>  specular .7  pow 30 } }" +  //
                                        plain + "checker { <1, 1, 1>, <.1, .3, .1>  map uv  scale .5 } } }" + plain +
                                        "<.2, .3, .4>  reflection .5  bump noise { height .05  map uv  scale .2 } } }" +
                                        plain + "checker { <1, 1, 1>, <.1, .3, .1>  scale .3 }  reflection .1 } }");
    for (int body = 0; body < 1 + seed % 2; ++body) {
        const MeshData mesh = bumpy_ball(dice, 50, 50, dice.chance(.5), dice.chance(.7));
        std::vector<Transformation> steps;
        steps.emplace_back(Scale{{dice.in(.5, 1.5), dice.in(.5, 1.5), dice.chance(.5) ? -1. : 1.}});
        Motion motion;
        for (int i = 0; i < 3; ++i) motion.keys.push_back({double(i), dice.vector(-1.5, 1.5), dice.vector(-180, 180)});
        if (body == 0) steps.emplace_back(motion);  // the other one stands still
        const int material = static_cast<int>(scene.materials.size());
        scene.materials.push_back(looks.materials[dice.upto(3)]);
        if (dice.chance(.4)) scene.materials.back().inside = .2;  // another look from inside
        const int size = static_cast<int>(mesh.triangles.size()), half = size / 2;
        if (whole) scene.primitives.push_back({stretch_of(mesh, 0, size), material, steps});
        if (!whole) scene.primitives.push_back({stretch_of(mesh, 0, half), material, steps});
        if (!whole) scene.primitives.push_back({stretch_of(mesh, half, size), material, steps});
    }
    scene.camera.shutter = dice.in(.2, 1);
    return scene;
}

/// Returns so many of the moments, all over the time. Their worlds take longer to make than their rays to trace.
std::shared_ptr<const std::vector<Shot>> few_of(const std::vector<Shot>& moments, std::size_t count) {
    std::vector<Shot> few;
    for (std::size_t i = 0; i < count; ++i) few.push_back(moments[i * moments.size() / count]);
    return std::make_shared<const std::vector<Shot>>(std::move(few));
}

TEST_CASE("a mesh that moments share looks as if each moment had made it anew") {
    std::size_t shown = 0, all = 0;
    for (int seed = 1; seed <= (sanitized() ? 2 : 12); ++seed) {
        CAPTURE(seed);
        const Scene scene = flying_mesh(seed, true), halves = flying_mesh(seed, false);
        Scene without = scene;
        std::erase_if(without.primitives,
                      [](const Primitive& body) { return std::holds_alternative<Mesh>(body.shape); });
        View view = view_of(scene, .8, sanitized() ? 16 : 48, sanitized() ? 12 : 36);
        view.moments = few_of(*view.moments, sanitized() ? 4 : 16);
        const auto seen = [&](const Scene& own, Precision precision) {
            ThreadPool pool(2);
            Tracer tracer(own, precision);
            return values_of(tracer, view, whole(view), pool, {.grid = 3});
        };
        for (const Precision precision : {Precision::float64, Precision::float32}) {
            CAPTURE(int(precision));
            const bool fine = precision == Precision::float64;
            const std::vector<double> own = seen(scene, precision), wanted = seen(halves, precision);
            // Rounding lets single rays pass edges, bumps and borders of patterns on another side.
            std::size_t off = 0;
            double sum = 0;
            for (std::size_t i = 0; i < own.size(); ++i) {
                const double wrong = std::abs(own[i] - wanted[i]);
                off += wrong > (fine ? 1e-9 : 1e-3), sum += wrong;
            }
            CHECK(double(off) / own.size() < (fine ? .001 : .01));
            CHECK(sum / own.size() < (fine ? 1e-6 : 1e-4));
            if (fine) continue;
            const std::vector<double> empty = seen(without, precision);
            for (std::size_t i = 0; i < own.size(); ++i) shown += std::abs(own[i] - empty[i]) > .01, ++all;
        }
    }
    CHECK(double(shown) > .2 * double(all));
}

TEST_CASE("worlds of moments hold large opaque meshes once") {
    const Scene scene = flying_mesh(3, true);  // with two of them
    ThreadPool pool(2);
    SharedMeshes<double> meshes;
    meshes.add(scene, pool, 1);
    const Placement place = placement(extent_of(scene), scene.camera.position);
    const auto meshes_of = [&](const Scene& own) {
        const BuiltWorld<double> built(own, place, pool, nullptr, nullptr, false, 1, &meshes);
        const World<double>& world = built.world();
        int count = 0;
        world.groups.each([&](const auto& group) {
            using Form = typename std::remove_cvref_t<decltype(group)>::Form;
            if (Form::compact && !Form::hot) count += group.count;
        });
        return std::pair(count / 5000, world.groups.get<SharedMeshForm>().count);
    };
    CHECK((meshes_of(at(scene, .3)) == std::pair(0, 2)));
    Scene clear = scene, flat = scene;
    clear.materials[clear.primitives.back().material].refraction = .5;
    CHECK((meshes_of(clear) == std::pair(1, 1)));
    flat.primitives.back().transformations.emplace_back(Scale{{1, 1, 1e-3}});
    CHECK((meshes_of(flat) == std::pair(1, 1)));
}

TEST_CASE("moments share the arrays of what stands still") {
    std::string text =
        "camera { position <0,-9,4> look_at <0,0,0> up <0,0,-1> fov 20 }\n"
        "box { <3,3,0>, <4,4,1> motion { key { time 0 } key { time 1 translate <-3,0,0> } } }\n";
    for (int i = 0; i < 90; ++i)
        text += "sphere { <" + std::to_string(i % 9 - 4) + ", " + std::to_string(i / 9 - 4) + ", 0>, .4 }\n";
    const Scene scene = parse_scene(text, "shutter.cpp");
    ThreadPool pool(1);
    MovingHierarchy moving;
    const Placement place = placement(extent_of(scene), scene.camera.position);
    const BuiltWorld<double> first(at(scene, 0), place, pool, &moving);
    BuiltWorld<double> second(at(scene, 1), place, pool, &moving);
    const auto arrays_of = [](const BuiltWorld<double>& world) {
        std::vector<const void*> all{world.world().references};
        world.world().groups.each([&](const auto& group) {
            if (group.count > 0) all.push_back(group.items), all.push_back(group.columns);
        });
        return all;
    };
    const auto before = arrays_of(first), apart = arrays_of(second);
    REQUIRE((before.size() == 5 && apart.size() == 5));
    second.share(first);
    const auto together = arrays_of(second);
    int shared = 0, own = 0;
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(before[i] != apart[i]);
        CHECK((together[i] == before[i] || together[i] == apart[i]));
        shared += together[i] == before[i], own += together[i] == apart[i];
    }
    CHECK((shared == 3 && own == 2));  // spheres and references; boxes
}

}  // namespace strahl::shutter

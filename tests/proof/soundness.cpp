// Does a proof ever lie? Random worlds, traced with bounds, against exact arithmetic.
//
//     test_proof                                       a few worlds
//     PROOF_FIRST=1000 PROOF_WORLDS=2000 test_proof    the table of tests/proof/README.md
//     PROOF_SCALAR=1 test_proof                        by the scalar kernel
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/proof/exact.h"
#include "tests/proof/worlds.h"
#include "tests/unit/sanitized.h"
#include "tests/unit/scenes.h"
#include "trace/thread_pool.h"

using namespace strahl;

namespace {

/// A picture with a bound for each pixel.
struct Proved {
    std::vector<double> rgb, bounds;
};
Proved prove(const Scene& scene, View view, Precision precision = Precision::float64) {
    view.prove = true;
    Proved proved{std::vector<double>(3 * std::size_t(view.width) * view.height),
                  std::vector<double>(std::size_t(view.width) * view.height)};
    ThreadPool pool(2);
    Tracer tracer(scene, precision, std::getenv("PROOF_SCALAR") ? Simd::scalar : Simd::automatic);
    const Lattice whole{.columns = view.width, .rows = view.height};
    tracer.trace(view, whole, pool, [&](const Tile& tile) {
        place(tile, whole, proved.rgb);
        const Lattice& own = tile.lattice;
        for (int i = 0; i < own.columns * own.rows; ++i)
            proved.bounds[std::size_t(own.y + i / own.columns) * view.width + own.x + i % own.columns] = tile.bounds[i];
    });
    return proved;
}
View view_of(const Scene& scene, int width, int height) {
    return {.camera = scene.camera, .width = width, .height = height, .depth = scene.settings.max_trace_level};
}

struct Tally {
    std::int64_t values = 0, certain[2] = {}, lies[2] = {}, violated = 0;
    std::vector<double> slack;  // bounds over errors, where the bound is small
    Tally& operator+=(const Tally& more) {
        values += more.values, violated += more.violated;
        for (const int i : {0, 1}) certain[i] += more.certain[i], lies[i] += more.lies[i];
        slack.insert(slack.end(), more.slack.begin(), more.slack.end());
        return *this;
    }
    void print(const std::string& name) {
        const auto middle = slack.begin() + std::ssize(slack) / 2;
        std::nth_element(slack.begin(), middle, slack.end());
        std::printf(
            "%s: %lld values, proved %.2f %% at 8 bits, %.2f %% at 16; %lld and %lld wrong, %lld bounds violated; "
            "bound over error %.0f in the median\n",
            name.c_str(), static_cast<long long>(values), 100. * certain[0] / values, 100. * certain[1] / values,
            static_cast<long long>(lies[0]), static_cast<long long>(lies[1]), static_cast<long long>(violated),
            slack.empty() ? 0 : *middle);
    }
    void add(double value, double bound, Quadruple truth) {
        ++values;
        const Quadruple error = truth > value ? truth - value : value - truth;
        violated += !(error <= bound);
        if (bound < 1e-3 && error > 0) slack.push_back(bound / static_cast<double>(error));
        for (const int i : {0, 1}) {
            const int steps = i ? 65535 : 255;
            const auto code = [&](Quadruple v) {
                return static_cast<int>((v < 0 ? Quadruple(0) : v > 1 ? Quadruple(1) : v) * steps + Quadruple(.5));
            };
            const bool sure = std::isfinite(bound) && code(Quadruple(value) - bound) == code(Quadruple(value) + bound);
            certain[i] += sure, lies[i] += sure && code(truth) != code(value);
        }
    }
};

/// Values of one world that are judged by exact arithmetic: as it is, with rays that are off by more than rounding, and
/// in extended precision.
struct Judged {
    Tally plain, shifted, extended;
    Judged& operator+=(const Judged& more) {
        return plain += more.plain, shifted += more.shifted, extended += more.extended, *this;
    }
    void print(const std::string& name) {
        plain.print(name), shifted.print(name + ", shifted"), extended.print(name + ", extended");
    }
};
void judge(const Scene& scene, const View& view, Judged& judged) {
    const Proved proved = prove(scene, view);
    View off = view;
    off.shift_x = 1e-7, off.shift_y = -1e-7;
    const Proved shifted = prove(scene, off), extended = prove(scene, view, Precision::extended);
    const exact::Tracer judge(scene, view);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const exact::Vector truth = judge.at(x, y);
            const std::size_t i = std::size_t(y) * view.width + x;
            const Quadruple rgb[]{truth.x, truth.y, truth.z};
            for (int c = 0; c < 3; ++c) {
                judged.plain.add(proved.rgb[3 * i + c], proved.bounds[i], rgb[c]);
                judged.shifted.add(shifted.rgb[3 * i + c], shifted.bounds[i], rgb[c]);
                judged.extended.add(extended.rgb[3 * i + c], extended.bounds[i], rgb[c]);
            }
        }
}

void check_honest(const Judged& judged) {
    for (const Tally& tally : {judged.plain, judged.shifted, judged.extended}) {
        CHECK(tally.violated == 0);
        CHECK(tally.lies[0] == 0);
        CHECK(tally.lies[1] == 0);
    }
}

int number(const char* variable, int otherwise) {
    const char* const text = std::getenv(variable);
    return text ? std::atoi(text) : otherwise;
}

}  // namespace

TEST_CASE("proofs do not lie") {
    const int worlds = number("PROOF_WORLDS", sanitized() ? 15 : 60), first = number("PROOF_FIRST", 0);
    Judged all, edges;
    for (int seed = first; seed < first + worlds; ++seed) {
        const Scene scene = proof::random_world(seed);
        Judged own, near_edges;
        judge(scene, view_of(scene, 16, 12), own);
        for (int i = 0; i < 4; ++i) {
            const Scene world = proof::world_of_edges(4 * seed + i);
            judge(world, view_of(world, proof::edge_columns, proof::edge_rows), near_edges);
        }
        CAPTURE(seed);
        check_honest(own), check_honest(near_edges);
        all += own, edges += near_edges;
    }
    all.print("worlds"), edges.print("edges");
    CHECK(all.plain.certain[1] > .85 * all.plain.values);
    CHECK(edges.plain.certain[1] < .5 * edges.plain.values);
}

TEST_CASE("worlds to look at are proved") {
    for (const char* const name : {"article", "flythrough"}) {
        const Scene scene = read_scene(name);
        Judged judged;
        judge(scene, view_of(scene, 40, 30), judged);
        judged.print(name);
        CAPTURE(name);
        check_honest(judged);
        CHECK(judged.plain.certain[1] > .99 * judged.plain.values);
    }
}

namespace {

/// A dull ball before a floor, seen from 6 away.
Scene ball_on_floor() {
    Scene scene;
    scene.camera.position = {0, -6, 1}, scene.camera.look_at = {0, 0, 0}, scene.camera.up = {0, 0, -1};
    scene.camera.fov = 20;
    scene.background.color = {.2, .3, .4};
    scene.lights.push_back({.position = {3, -8, 9}, .color = Color(.71)});
    Material dull;
    dull.reflection = 0;
    scene.materials.push_back(dull);
    scene.primitives.push_back({Sphere{{0, 0, 0}, .7}, 0, {}});
    scene.primitives.push_back({Plane{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, 0, {}});
    return scene;
}
/// How many of its pixels have a bound below 1e-9.
double share_bounded(const Scene& scene) {
    const Proved proved = prove(scene, view_of(scene, 64, 48));
    return static_cast<double>(std::ranges::count_if(proved.bounds, [](double b) { return b < 1e-9; })) /
           static_cast<double>(proved.bounds.size());
}

}  // namespace

TEST_CASE("what proofs do not know is undecided") {
    const Scene plain = ball_on_floor();
    CHECK(share_bounded(plain) > .97);
    Scene scene = plain;
    scene.primitives.push_back({Torus{}, 0, {}});
    CHECK(share_bounded(scene) < .9);  // the torus and its shadow
    CHECK(share_bounded(scene) > .3);
    scene = plain;
    scene.primitives[0].transformations.push_back(Scale{{1, 2, 1}});
    CHECK(share_bounded(scene) < .9);
    scene = plain;
    scene.materials[0].rgb.pattern =
        std::make_shared<const Pattern>(Pattern{Checker{}, {{0, Color(.2)}, {1, Color(.8)}}, {}});
    CHECK(share_bounded(scene) < .3);  // the background
    scene = plain;
    scene.fog = Fog{10, Color(.5)};
    CHECK(share_bounded(scene) == 0);
    scene = plain;
    scene.lights[0].area = Area{{1, 0, 0}, {0, 1, 0}};
    CHECK(share_bounded(scene) < .3);
    scene = plain;
    scene.lights[0].spot = Spot{};
    CHECK(share_bounded(scene) < .3);
    scene = plain;  // twice in the same place, by its numbers in double
    scene.primitives.push_back(scene.primitives[0]);
    CHECK(share_bounded(scene) < .9);
}

TEST_CASE("a picture with bounds is that of double") {
    for (int seed = 0; seed < 20; ++seed) {
        const Scene scene = proof::random_world(seed);
        const View view = view_of(scene, 48, 36);
        CAPTURE(seed);
        const std::vector<double> proved = prove(scene, view).rgb, plain = render(scene, view).rgb;
        double most = 0;
        for (std::size_t i = 0; i < plain.size(); ++i) most = std::max(most, std::abs(proved[i] - plain[i]));
        CHECK(most < 1e-15);  // glass is multiplied in another order
    }
}

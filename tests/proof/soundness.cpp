// Does a proof ever lie? Random worlds, traced with bounds, against exact arithmetic.
//
//     test_proof                                       a few worlds
//     PROOF_FIRST=1000 PROOF_WORLDS=2000 test_proof    the table of tests/proof/README.md
//     PROOF_EXTENDED=16 test_proof                     one world of 16 in extended precision as well (else one of two)
//     PROOF_SIZE=4 test_proof                          pictures four times as large each way
//     PROOF_SCALAR=1 test_proof                        by the scalar kernel
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <numeric>
#include <string>

#include "num/thread_pool.h"
#include "tests/proof/exact.h"
#include "tests/proof/proved.h"
#include "tests/proof/worlds.h"
#include "tests/unit/sanitized.h"
#include "tests/unit/scenes.h"

using namespace strahl;
using proof::prove, proof::Proved, proof::view_of;

namespace {

/// Counts of one set of pictures.
struct Tally {
    std::int64_t values = 0, certain[2] = {}, lies[2] = {}, violated = 0, judged_twice = 0;
    std::array<std::int64_t, 4096> slack{};  // histogram of 32 log2(bound / error), of small bounds
    Tally& operator+=(const Tally& more) {
        values += more.values, violated += more.violated, judged_twice += more.judged_twice;
        for (const int i : {0, 1}) certain[i] += more.certain[i], lies[i] += more.lies[i];
        std::ranges::transform(slack, more.slack, slack.begin(), std::plus());
        return *this;
    }
    double median_slack() const {
        std::int64_t left = std::accumulate(slack.begin(), slack.end(), std::int64_t(0)) / 2;
        const auto middle = std::ranges::find_if(slack, [&](std::int64_t n) { return (left -= n) < 0; });
        return middle == slack.end() ? 0 : std::exp2(static_cast<double>(middle - slack.begin()) / 32 - 32);
    }
    void print(const std::string& name) const {
        std::printf(
            "%s: %lld values, proved %.2f %% at 8 bits, %.2f %% at 16; %lld and %lld wrong, %lld bounds violated; "
            "bound over error %.0f in the median; %lld judged twice\n",
            name.c_str(), static_cast<long long>(values), 100. * certain[0] / values, 100. * certain[1] / values,
            static_cast<long long>(lies[0]), static_cast<long long>(lies[1]), static_cast<long long>(violated),
            median_slack(), static_cast<long long>(judged_twice));
    }
    template <class R>
    void add(double value, double bound, R truth) {
        ++values;
        const R error = truth > value ? truth - value : value - truth;
        violated += !(error <= bound);
        if (bound < 1e-3 && error > 0) {
            const double place = 32 * (std::log2(bound / static_cast<double>(error)) + 32);
            ++slack[static_cast<std::size_t>(std::clamp(place, 0., 4095.))];
        }
        for (const int i : {0, 1}) {
            const int steps = i ? 65535 : 255;
            const auto code = [&](R v) { return static_cast<int>((v < 0 ? R(0) : v > 1 ? R(1) : v) * steps + R(.5)); };
            const bool sure = std::isfinite(bound) && code(R(value) - bound) == code(R(value) + bound);
            certain[i] += sure, lies[i] += sure && code(truth) != code(value);
        }
    }
};

/// A picture and what exact arithmetic says of it.
struct Judgement {
    const Proved& proved;
    Tally& tally;
    /// Long double decides where it finds all errors of a pixel well within the bound: it knows them to about a
    /// thousandth, but where a ray passes an edge within its own rounding. What is left needs 113 bits.
    bool decide(std::size_t pixel, const referee::Vector<long double>& nearly) const {
        const double bound = proved.bounds[pixel], *const rgb = &proved.rgb[3 * pixel];
        const auto within = [&](double value, long double truth) { return std::abs(truth - value) <= .9L * bound; };
        if (!within(rgb[0], nearly.x) || !within(rgb[1], nearly.y) || !within(rgb[2], nearly.z)) return false;
        return add(pixel, nearly), true;
    }
    template <class R>
    void add(std::size_t pixel, const referee::Vector<R>& truth) const {
        const double bound = proved.bounds[pixel], *const rgb = &proved.rgb[3 * pixel];
        tally.add(rgb[0], bound, truth.x), tally.add(rgb[1], bound, truth.y), tally.add(rgb[2], bound, truth.z);
    }
};

/// Values of one world that are judged by exact arithmetic: as it is, with rays that are off by more than rounding, and
/// in extended precision.
struct Judged {
    Tally plain, shifted, extended;
    int pruned = 0;  // pictures of which light is left out
    Judged& operator+=(const Judged& more) {
        pruned += more.pruned;
        return plain += more.plain, shifted += more.shifted, extended += more.extended, *this;
    }
    void print(const std::string& name) {
        plain.print(name), shifted.print(name + ", shifted"), extended.print(name + ", extended");
    }
};
/// In extended precision as well: then 113 bits judge all of it.
void judge(const Scene& scene, const View& view, bool in_extended, Judged& judged) {
    View off = view;
    off.shift_x = 1e-7, off.shift_y = -1e-7;
    const Proved plain = prove(scene, view), shifted = prove(scene, off),
                 extended = in_extended ? prove(scene, view, Precision::extended) : Proved{};
    judged.pruned += plain.pruned > 0;
    const Judgement first{plain, judged.plain}, second{shifted, judged.shifted}, third{extended, judged.extended};
    const exact::Tracer<Quadruple> judge(scene, view);
    const exact::Tracer<long double> fast(scene, view);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const std::size_t i = std::size_t(y) * view.width + x;
            bool sees_first = true, sees_second = true;
            if (!in_extended) {
                const auto nearly = fast.at(x, y);
                sees_first = !first.decide(i, nearly), sees_second = !second.decide(i, nearly);
                if (!sees_first && !sees_second) continue;
                judged.plain.judged_twice += 3 * sees_first, judged.shifted.judged_twice += 3 * sees_second;
            }
            const auto truth = judge.at(x, y);
            if (sees_first) first.add(i, truth);
            if (sees_second) second.add(i, truth);
            if (in_extended) third.add(i, truth);
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
    const int extended = number("PROOF_EXTENDED", 2), size = number("PROOF_SIZE", 1);
    Judged all, edges, finished;
    std::mutex mutex;
    ThreadPool pool;
    share_out(pool, worlds, 1, [&](int i, int) {
        const int seed = first + i;
        const bool in_extended = seed % extended == 0;
        const Scene scene = proof::random_world(seed);
        Judged own, near_edges;
        View view = view_of(scene, 16 * size, 12 * size);
        if (seed % 3 == 0) view.error = 1e-3;
        judge(scene, view, in_extended, own);
        for (int j = 0; j < 4; ++j) {
            const Scene world = proof::world_of_edges(4 * seed + j);
            judge(world, view_of(world, proof::edge_columns, proof::edge_rows), in_extended, near_edges);
        }
        const std::lock_guard lock(mutex);
        CAPTURE(seed);
        check_honest(own), check_honest(near_edges);
        all += own, edges += near_edges;
        if (scene.finished()) finished += own;
    });
    all.print("worlds"), finished.print("of these with finishes"), edges.print("edges");
    CHECK(all.pruned > 0);
    CHECK(all.plain.certain[1] > .85 * all.plain.values);
    CHECK(finished.plain.certain[1] > .6 * finished.plain.values);
    CHECK(edges.plain.certain[1] < .5 * edges.plain.values);
}

TEST_CASE("proofs by light buffers do not lie") {
    const int worlds = number("PROOF_CROWDS", sanitized() ? 2 : 8), first = number("PROOF_FIRST", 0);
    Judged all;
    std::mutex mutex;
    ThreadPool pool;
    share_out(pool, worlds, 1, [&](int i, int) {
        const Scene scene = proof::random_crowd(first + i);
        Judged own;
        judge(scene, view_of(scene, 48, 32), false, own);  // less, and they would not pay
        const std::lock_guard lock(mutex);
        CAPTURE(first + i);
        check_honest(own);
        all += own;
    });
    all.plain.print("crowds"), all.shifted.print("crowds, shifted");
    CHECK(all.plain.certain[1] > .85 * all.plain.values);
}

TEST_CASE("light through panes, one of them patterned, in worlds with bumps and without") {
    Scene scene;
    scene.camera.position = {0, -6, 4}, scene.camera.look_at = {0, 0, 0}, scene.camera.up = {0, 0, -1};
    scene.camera.fov = 20;
    scene.lights.push_back({.position = {.3, .2, 9}, .color = Color(.7)});
    Material dull;
    dull.ior = 1, dull.reflection = 0;
    Material pane = dull, stained = dull, bumpy = dull;
    pane.refraction = stained.refraction = .9, pane.rgb = Color(.5, .6, .8);
    stained.rgb = Pigment(Pattern{Gradient{{1, .4, .2}}, {{0, Color(.2, .5, .9)}, {1, Color(.9, .3, .1)}}, {}});
    bumpy.bump.height = .1, bumpy.bump.pattern = std::make_shared<const Pattern>(Pattern{Noise{}, {}, {}});
    scene.materials = {dull, stained, pane, bumpy};
    scene.primitives.push_back({Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0, {}});
    scene.primitives.push_back({Disc{{0, 0, 6}, {.1, .2, 1}, 5, 0}, 1, {}});
    scene.primitives.push_back({Disc{{0, 0, 7}, {.2, .1, 1}, 5, 0}, 2, {}});
    scene.primitives.push_back({Sphere{{1, 1, .5}, .5}, 3, {}});
    for (const bool bumps : {true, false}) {
        if (!bumps) scene.materials[3] = dull;
        Judged judged;
        judge(scene, view_of(scene, 40, 30), false, judged);
        judged.plain.print("panes"), judged.shifted.print("panes, shifted");
        check_honest(judged);
        CHECK(judged.shifted.certain[1] > .95 * judged.shifted.values);
    }
}

TEST_CASE("worlds to look at are proved") {
    for (const char* const name : {"article", "flythrough"})
        for (const double error : {0., 1e-9}) {
            const Scene scene = read_scene(name);
            Judged judged;
            View view = view_of(scene, 40, 30);
            view.error = error;
            judge(scene, view, true, judged);
            judged.print(name);
            CAPTURE(name);
            CAPTURE(error);
            check_honest(judged);
            CHECK(judged.plain.certain[1] > .99 * judged.plain.values);
            CHECK(judged.pruned == (error > 0 && name == std::string("article")));
        }
}

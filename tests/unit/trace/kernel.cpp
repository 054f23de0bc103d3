// Comparison with the referee: every precision and SIMD level, on scenes made by hand and random ones.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>

#include "scene/leaves.h"
#include "scene/overlap.h"
#include "tests/referee/examples.h"
#include "tests/referee/random_scene.h"
#include "tests/referee/referee.h"
#include "tests/unit/levels.h"
#include "tests/unit/sanitized.h"
#include "trace/tracer.h"

using namespace strahl;

namespace {

// Odd, so that the middle row and column look exactly along axes if the camera does (of 11 rows, the middle one is off
// by a last bit in double, and if the horizon of a plane is there, rounding decides the whole row). Small where long
// double is software.
const bool slow = sanitized() || LDBL_MANT_DIG == 113;
const int columns = slow ? 17 : 49, rows = slow ? 9 : 37, random_scenes = slow ? 8 : 90;

/// A value may be off by `tolerance`. A pixel that is off by more must be explained by a shift of `reach` pixels: an
/// edge, or a place where the picture changes fast. Only `share` of the pixels may need this explanation.
struct Bounds {
    double tolerance, reach, share;
};
Bounds bounds(Precision precision) {
    switch (precision) {
        case Precision::float32:
            return {1e-4, 3e-3, .004};
        case Precision::float64:
            return {1e-12, 1e-9, .0005};
        default:  // prisms, patterns and bumps have numbers of double
            return {1e-13, 1e-11, .0006};
    }
}

using Pixels = std::vector<std::array<long double, 3>>;
Pixels pixels(const Referee<long double>& referee) {
    Pixels list;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) list.push_back(referee.at(x + .5, y + .5).rgb);
    return list;
}

/// Comparison of a frame with the referee.
struct Verdict {
    int excused = 0, wrong = 0;
    std::string first;  // of the wrong ones
};
Verdict judge(const Frame& frame, const Referee<long double>& referee, const Pixels& truth, const Bounds& allowed) {
    Verdict verdict;
    for (int i = 0; i < columns * rows; ++i) {
        const double* rgb = &frame.rgb[3 * i];
        long double off = 0;
        for (int c = 0; c < 3; ++c)
            off = std::isfinite(rgb[c]) ? std::max(off, std::abs(rgb[c] - truth[i][c])) : INFINITY;
        if (off <= allowed.tolerance) continue;
        if (std::isfinite(off) && referee.explains(i % columns, i / columns, rgb, allowed.tolerance, allowed.reach)) {
            ++verdict.excused;
        } else if (verdict.wrong++ == 0) {
            std::ostringstream text;
            text.precision(17);
            text << "pixel (" << i % columns << ", " << i / columns << ")";
            for (int c = 0; c < 3; ++c) text << "\n  " << rgb[c] << " instead of " << truth[i][c];
            verdict.first = text.str();
        }
    }
    return verdict;
}

struct Tally {
    long pixels = 0, excused = 0;
};
/// Does a pattern reach the horizon? There it changes from one float to the next, and no shift explains a difference.
bool endless_pattern(const Scene& scene) {
    return std::any_of(scene.primitives.begin(), scene.primitives.end(), [&](const Primitive& primitive) {
        bool patterned = false;
        for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
            patterned |= scene.materials[leaf.material].patterned();
        });
        return patterned && !world_bounds(primitive).finite();
    });
}

/// Traces one scene in every way; those of fused_levels() must give the same bits.
void hold(const Scene& scene, int depth, std::array<Tally, 3>& tally) {
    const Referee<long double> referee(scene, scene.camera, columns, rows, depth);
    const Pixels truth = pixels(referee);
    const View view{.camera = scene.camera, .width = columns, .height = rows, .depth = depth};
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
        const Bounds allowed = bounds(precision);
        const bool too_coarse = precision == Precision::float32 && endless_pattern(scene);
        Frame scalar;
        for (const Simd simd : all_levels()) {
            if (precision == Precision::extended && simd != Simd::scalar) continue;
            CAPTURE(std::string(name(precision)));
            CAPTURE(std::string(name(simd)));
            const Frame frame = render(scene, view, precision, 2, simd);
            REQUIRE(frame.rgb.size() == 3u * columns * rows);
            if (simd == Simd::scalar) scalar = frame;
            if (simd != Simd::scalar && simd != Simd::v2) {
                CHECK(std::memcmp(frame.rgb.data(), scalar.rgb.data(), 8 * frame.rgb.size()) == 0);
                continue;
            }
            if (too_coarse) continue;
            const Verdict verdict = judge(frame, referee, truth, allowed);
            CHECK_MESSAGE(verdict.wrong == 0, verdict.wrong << " pixels, the first: " << verdict.first);
            CHECK(verdict.excused <= std::max(8., (precision == Precision::extended ? .13 : .1) * columns * rows));
            tally[int(precision)].pixels += columns * rows, tally[int(precision)].excused += verdict.excused;
        }
    }
}
/// Checks the share of excused pixels, of which `more` times as many as usual may be.
void conclude(const std::array<Tally, 3>& tally, double more = 1) {
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
        const auto [pixels, excused] = tally[int(precision)];
        MESSAGE(std::string(name(precision))
                << ": " << excused << " of " << pixels << " pixels are on an edge or vary too fast");
        CHECK(excused <= more * bounds(precision).share * pixels);
    }
}

}  // namespace

TEST_CASE("scenes made by hand") {
    std::array<Tally, 3> tally;
    for (const auto& [title, scene, depth] : examples()) {
        CAPTURE(std::string(title));
        hold(scene, depth, tally);
    }
    conclude(tally);
}

TEST_CASE("random scenes") {
    std::array<Tally, 3> tally;
    for (int seed = 0; seed < random_scenes; ++seed) {
        CAPTURE(seed);
        const RandomScene what{
            .transparent = seed % 4 != 0, .transformed = seed % 3 != 0, .camera_inside = seed % 5 == 4};
        hold(random_scene(seed, what), 2 + seed % 5, tally);
    }
    conclude(tally);
}

TEST_CASE("random scenes by cameras of other projections, of which orthographic ones may start in bodies") {
    std::array<Tally, 3> tally;
    int seed = 0;
    for (const Projection projection : {Projection::orthographic, Projection::fisheye, Projection::spherical,
                                        Projection::cylinder, Projection::orthographic, Projection::orthographic,
                                        Projection::cylinder2, Projection::cylinder3, Projection::cylinder4}) {
        CAPTURE(seed);
        Scene scene = random_scene(8000 + seed, {.lights = seed % 2 == 0, .any_kind = .4});
        scene.camera.projection = projection;
        if (seed >= 4) scene.camera.position = .4 * scene.camera.position;
        hold(scene, 2 + seed++ % 4, tally);
    }
    conclude(tally);
}

TEST_CASE("random scenes with patterns, or with fog, spots and parallel light") {
    for (const bool patterns : {true, false}) {
        CAPTURE(patterns);
        std::array<Tally, 3> tally;
        for (int seed = 0; seed < random_scenes; ++seed) {
            CAPTURE(seed);
            const RandomScene what{.transparent = seed % 3 != 0,
                                   .lights = !patterns,
                                   .patterns = patterns,
                                   .camera_inside = seed % 5 == 4};
            hold(random_scene((patterns ? 2000 : 4000) + seed, what), 2 + seed % 4, tally);
        }
        conclude(tally);
    }
}

TEST_CASE("random scenes with bumps and normal maps") {
    std::array<Tally, 3> tally;
    for (int seed = 0; seed < random_scenes; ++seed) {
        CAPTURE(seed);
        const RandomScene what{.transparent = seed % 3 != 0,
                               .transformed = seed % 2 != 0,
                               .patterns = seed % 4 == 0,
                               .bumps = seed % 5 < 3,
                               .normals = seed % 5 > 1,
                               .camera_inside = seed % 5 == 4};
        hold(random_scene(6000 + seed, what), 2 + seed % 3, tally);
    }
    // Difference quotients magnify rounding 40 times the height, and mirrors that bend it again.
    conclude(tally, 12);
}

TEST_CASE("every depth from 1 to 20, between two mirrors") {
    const Scene scene = facing_mirrors();
    Frame last;
    for (int depth = 1; depth <= 20; ++depth) {
        CAPTURE(depth);
        const Referee<long double> referee(scene, scene.camera, columns, rows, depth);
        const View view{.camera = scene.camera, .width = columns, .height = rows, .depth = depth};
        const Frame frame = render(scene, view, Precision::float64, 2);
        const Verdict verdict = judge(frame, referee, pixels(referee), bounds(Precision::float64));
        CHECK_MESSAGE(verdict.wrong == 0, verdict.wrong << " pixels, the first: " << verdict.first);
        CHECK(frame != last);
        last = frame;
    }
}

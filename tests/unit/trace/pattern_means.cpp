// Means of patterns over footprints, beside means over many points.
#include "trace/patterns/pattern_means.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "tests/referee/dice.h"
#include "text/parse.h"
#include "trace/cells/cell_picture.h"
#include "trace/tracer.h"

namespace strahl::pattern_means {

using Stops = std::array<ColorStopKernel<double>, 6>;
const Stops two{{{0, 0, {1, .9, .8}}, {1, 1, {.1, 0, .2}}}};
const Stops six{{{.1, 0, {1, 1, 1}},
                 {.4, 0, {.3, 1, 0}},
                 {.4, 0, {0, 0, 1}},
                 {.7, 0, {.6, .2, .1}},
                 {.95, 0, {0, .2, 1}},
                 {.95, 0, {1, 0, 0}}}};

double fraction(double x) { return x - std::floor(x); }
DVec3 mixed(const Stops& stops, double share) { return stops[0].color + share * (stops[1].color - stops[0].color); }
DVec3 mapped(const Stops& stops, double value) {
    if (value <= stops[0].at) return stops[0].color;
    for (std::size_t i = 1; i < stops.size(); ++i)
        if (value <= stops[i].at) {
            const double share = (value - stops[i - 1].at) / (stops[i].at - stops[i - 1].at);
            return stops[i - 1].color + share * (stops[i].color - stops[i - 1].color);
        }
    return stops.back().color;
}
/// The colour at a point, from the definition of the pattern.
DVec3 color_at(const PatternKernel<double>& pattern, const DVec3& p) {
    const double shift = fraction(p.y / 2) > .5 ? .5 : 0;
    switch (pattern.form) {
        case PatternForm::checker:
            return mixed(two, fraction((std::floor(p.x) + std::floor(p.y) + std::floor(p.z)) / 2) < .25 ? 0 : 1);
        case PatternForm::brick:
            return mixed(two, fraction(p.x + shift) > pattern.mortar.x && fraction(p.y) > pattern.mortar.y &&
                                      fraction(p.z + .5 - shift) > pattern.mortar.z
                                  ? 1
                                  : 0);
        default:
            return mapped(six, fraction(p.x));
    }
}

TEST_CASE("means of checks, bricks and ramps are those of many points") {
    Dice dice(7);
    for (const PatternForm form : {PatternForm::checker, PatternForm::brick, PatternForm::ramp}) {
        PatternKernel<double> pattern{};
        pattern.form = form, pattern.stops = form == PatternForm::ramp ? 6 : 2;
        for (int i = 0; i < 48; ++i) {
            const auto vector = [&] { return DVec3(dice.in(-1, 1), dice.in(-1, 1), dice.in(-1, 1)); };
            PatternArea area{10. * vector(), vector(), vector()};
            if (i % 3 == 0) area.across = {1, 0, 0}, area.down = {0, 1, 0};  // as on a floor
            if (i % 3 == 1) area.across.z = area.down.z = 0;
            area.across *= std::pow(10, dice.in(-3, .8)), area.down *= std::pow(10, dice.in(-3, .8));
            pattern.mortar = .1 * (DVec3(1.1) + vector());
            const PatternMean mean = mean_over(pattern, (form == PatternForm::ramp ? six : two).data(), area);
            constexpr int points = 200;
            DVec3 sum(0), low(2), high(-1);
            for (int j = 0; j < points; ++j)
                for (int k = 0; k < points; ++k) {
                    const double x = (k + dice.in(0, 1)) / points - .5, y = (j + dice.in(0, 1)) / points - .5;
                    const DVec3 color = color_at(pattern, area.middle + x * area.across + y * area.down);
                    sum += color, low = min(low, color), high = max(high, color);
                }
            for (int c = 0; c < 3; ++c) {
                CHECK(std::abs(mean.color[c] - sum[c] / (points * points)) < 2e-3);
                if (form != PatternForm::ramp && high[c] > low[c]) CHECK(mean.detailed);
            }
        }
    }
}

TEST_CASE("means over what a square of the view shows of a plane that recedes are those of many rays") {
    Dice dice(19);
    for (const PatternForm form : {PatternForm::checker, PatternForm::brick, PatternForm::ramp}) {
        PatternKernel<double> pattern{};
        pattern.form = form, pattern.stops = form == PatternForm::ramp ? 6 : 2;
        double squares = 0, even_squares = 0;
        for (int i = 0; i < 60; ++i) {
            pattern.mortar = DVec3(dice.in(.05, .2), dice.in(.05, .2), dice.in(.05, .2));
            const DVec3 middle = dice.vector(-9, 9), forward = dice.arrow(1, 1), normal = dice.arrow(1, 1);
            const double pixel = std::pow(10, dice.in(-2, -.5));
            const DVec3 ways[2] = {dice.arrow(pixel, pixel), dice.arrow(pixel, pixel)};
            const double steep = dot_product(normal, forward), distance = dice.in(.5, 2) / pixel;
            PatternArea area{middle, {}, {}};
            for (int k = 0; k < 2; ++k) {
                area.shrink[k] = dot_product(normal, ways[k]) / steep;
                (k ? area.down : area.across) = distance * (ways[k] - area.shrink[k] * forward);
            }
            if (!(std::abs(area.shrink[0]) + std::abs(area.shrink[1]) < .8)) continue;
            constexpr int rays = 200;
            DVec3 sum(0);
            for (int j = 0; j < rays; ++j)
                for (int k = 0; k < rays; ++k) {
                    const double x = (k + dice.in(0, 1)) / rays - .5, y = (j + dice.in(0, 1)) / rays - .5;
                    const DVec3 way = forward + x * ways[0] + y * ways[1];
                    const double t = distance * steep / dot_product(normal, way);
                    sum += 1. / (rays * rays) * color_at(pattern, middle - distance * forward + t * way);
                }
            const Stops& stops = form == PatternForm::ramp ? six : two;
            const DVec3 off = mean_over(pattern, stops.data(), area).color - sum;
            area.shrink = {0, 0};
            const DVec3 even_off = mean_over(pattern, stops.data(), area).color - sum;
            CHECK(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) < 6e-3);
            squares += dot_product(off, off), even_squares += dot_product(even_off, even_off);
        }
        CHECK(squares < even_squares / 25);  // parallelograms would not do
    }
}

TEST_CASE("means of solid patterns are near those of many points") {
    Dice dice(11);
    double squares = 0, of_points = 0;
    int tries = 0;
    for (int kind = 0; kind < static_cast<int>(solid_names.size()); ++kind)
        for (int i = 0; i < 4; ++i) {
            SolidPattern solid{.solid = static_cast<Solid>(kind)};
            const auto vector = [&] { return DVec3(dice.in(-1, 1), dice.in(-1, 1), dice.in(-1, 1)); };
            if (i % 2) solid.turbulence = .3 * vector(), solid.octaves = 1 + i % 4;
            solid.wave = i % 5, solid.frequency = i % 3 ? 1 : 1 + i;
            PatternKernel<double> pattern{};
            pattern.form = PatternForm::solid, pattern.stops = 6, pattern.solid = &solid;
            if (!details_of(solid).known) continue;
            const double size = std::pow(10, dice.in(-2, 0));
            const PatternArea area{3. * vector(), size * vector(), size * vector()};
            const PatternMean mean = mean_over(pattern, six.data(), area);
            constexpr int points = 20;
            DVec3 sum(0);
            for (int j = 0; j < points; ++j)
                for (int k = 0; k < points; ++k) {
                    const double x = (k + dice.in(0, 1)) / points - .5, y = (j + dice.in(0, 1)) / points - .5;
                    const DVec3 at = area.middle + x * area.across + y * area.down;
                    sum += mapped(six, value_at(solid, at));
                }
            const DVec3 exact = 1. / (points * points) * sum, off = mean.color - exact;
            const DVec3 point = mapped(six, value_at(solid, area.middle)) - exact;
            squares += dot_product(off, off) / 3, of_points += dot_product(point, point) / 3, ++tries;
        }
    const double rms = std::sqrt(squares / tries), points_rms = std::sqrt(of_points / tries);
    CAPTURE(rms);
    CHECK(rms < points_rms / 5);
}

TEST_CASE("means of detail that is finer than what was looked at are about as far off as they say") {
    Dice dice(17);
    for (const double size : {2., 6., 20.}) {
        double squares = 0, doubts = 0;
        for (int i = 0; i < 60; ++i) {
            SolidPattern solid{.solid = static_cast<Solid>(dice.upto(static_cast<int>(solid_names.size()) - 1))};
            if (dice.chance(.5)) solid.turbulence = dice.vector(0, .5), solid.octaves = 1 + dice.upto(4);
            solid.wave = dice.upto(4), solid.frequency = 1 + dice.upto(2);
            if (!details_of(solid).known) continue;
            PatternKernel<double> pattern{};
            pattern.form = PatternForm::solid, pattern.stops = 6, pattern.solid = &solid;
            const PatternArea area{dice.vector(-9, 9), dice.arrow(size / 2, size), dice.arrow(size / 2, size)};
            const PatternMean mean = mean_over(pattern, six.data(), area);
            constexpr int points = 60;  // in a row: their mean is off by less than .01
            DVec3 sum(0);
            for (int j = 0; j < points; ++j)
                for (int k = 0; k < points; ++k) {
                    const double x = (k + dice.in(0, 1)) / points - .5, y = (j + dice.in(0, 1)) / points - .5;
                    sum += mapped(six, value_at(solid, area.middle + x * area.across + y * area.down));
                }
            const DVec3 off = mean.color - 1. / (points * points) * sum;
            squares += std::max({off.x * off.x, off.y * off.y, off.z * off.z}), doubts += mean.doubt * mean.doubt;
        }
        CAPTURE(size);
        CAPTURE(std::sqrt(squares / 60));
        CAPTURE(std::sqrt(doubts / 60));
        CHECK(doubts > .25 * squares);
        CHECK(doubts < 4 * squares);
    }
}

TEST_CASE("solid patterns with waves keep their light where they are finer than what a pixel shows") {
    // Tests solid patterns with waves, since the wave of a mean is not the mean of the wave.
    for (const Solid kind : {Solid::quilted, Solid::bozo, Solid::spherical})
        for (const double wave : {2., 3., 4.}) {
            const SolidPattern solid{.solid = kind, .turbulence = {.3, .3, .6}, .frequency = 5, .wave = wave};
            CAPTURE(solid_names[static_cast<std::size_t>(kind)]);
            CAPTURE(wave);
            PatternKernel<double> pattern{};
            pattern.form = PatternForm::solid, pattern.stops = 6, pattern.solid = &solid;
            Dice dice(7);
            DVec3 means(0), points(0);
            constexpr int tries = 40, in_each = 400;
            for (int i = 0; i < tries; ++i) {
                const PatternArea area{{dice.in(-9, 9), dice.in(-9, 9), 0}, {.9, .2, 0}, {-2, 5, 0}};
                means += mean_over(pattern, six.data(), area).color;
                for (int k = 0; k < in_each; ++k) {
                    const DVec3 at = area.middle + dice.in(-.5, .5) * area.across + dice.in(-.5, .5) * area.down;
                    points += 1. / in_each * mapped(six, value_at(solid, at));
                }
            }
            for (int c = 0; c < 3; ++c) CHECK(std::abs(means[c] - points[c]) / tries < .05);
        }
}

TEST_CASE("where nothing is left of solid patterns their colours are those of many points, on floors, too") {
    for (const Solid kind : {Solid::agate, Solid::bozo, Solid::crackle, Solid::leopard, Solid::quilted})
        for (const double wave : {0., 1., 2., 3., 4.})
            for (const double height : {0., .3}) {
                const SolidPattern solid{
                    .solid = kind, .turbulence = {.05, .75, .4}, .octaves = 2, .frequency = 2, .wave = wave};
                CAPTURE(solid_names[static_cast<std::size_t>(kind)]);
                CAPTURE(wave);
                PatternKernel<double> pattern{};
                pattern.form = PatternForm::solid, pattern.stops = 6, pattern.solid = &solid;
                Dice dice(7);
                constexpr int points = 20000;
                DVec3 sum(0);
                for (int i = 0; i < points; ++i)
                    sum += 1. / points * mapped(six, value_at(solid, {dice.in(-300, 300), dice.in(-300, 300), height}));
                const PatternMean mean = mean_over(pattern, six.data(), {{9, 2, height}, {617, 0, 0}, {0, 583, 0}});
                for (int c = 0; c < 3; ++c) CHECK(std::abs(mean.color[c] - sum[c]) < .04);
            }
}

TEST_CASE("turbulence only moves points: values deviate no more than without it") {
    const auto variance_of = [](const SolidPattern& solid) {
        const SolidDetails details = details_of(solid);
        double sum = 0;
        for (int i = 0; i < details.count; ++i) sum += details.sizes[i].deviation * details.sizes[i].deviation;
        return sum;
    };
    for (const Solid kind : {Solid::bozo, Solid::bumps, Solid::granite, Solid::quilted, Solid::wrinkles}) {
        const double without = variance_of({.solid = kind});
        for (const double far : {.01, .5, 3.}) {
            CAPTURE(far);
            CHECK(variance_of({.solid = kind, .turbulence = {far, 0, far}}) < 1.001 * without);
        }
    }
}

TEST_CASE("the mean of granite is that of many points, on a floor at a whole number, too") {
    // A floor seen from far away: no grain is left of it.
    constexpr Stops grey{{{0, 0, {0, 0, 0}}, {1, 1, {1, 1, 1}}}};
    for (int generator = 1; generator <= 3; ++generator)
        for (const double height : {0., 1. / 16, 3.}) {
            const SolidPattern solid{.solid = Solid::granite, .generator = double(generator)};
            PatternKernel<double> pattern{};
            pattern.form = PatternForm::solid, pattern.stops = 2, pattern.solid = &solid;
            Dice dice(5);
            constexpr int points = 20000;
            double sum = 0;
            for (int i = 0; i < points; ++i)
                sum += value_at(solid, {dice.in(-300, 300), dice.in(-300, 300), height}) / points;
            const PatternMean mean =
                mean_over(pattern, grey.data(), {{.31, .77, height}, {617.3, 0, 0}, {0, 583.7, 0}});
            CHECK(std::abs(mean.color.x - sum) < .02);  // .03 if all points were alike
        }
}

TEST_CASE("a mean is the sum of the colours of stops by their weights") {
    Dice dice(5);
    const SolidPattern bozo{.solid = Solid::bozo}, marble{.solid = Solid::marble, .turbulence = {1, 1, 1}, .wave = 1};
    for (int i = 0; i < 60; ++i) {
        PatternKernel<double> pattern{};
        pattern.form = std::array{PatternForm::checker, PatternForm::brick, PatternForm::ramp, PatternForm::solid,
                                  PatternForm::noise}[i % 5];
        pattern.stops = i % 5 < 2 ? 2 : 6, pattern.solid = i % 2 ? &bozo : &marble, pattern.mortar = {.1, .2, .3};
        const Stops& stops = i % 5 < 2 ? two : six;
        const auto vector = [&] { return DVec3(dice.in(-1, 1), dice.in(-1, 1), dice.in(-1, 1)); };
        double weights[most_weighed];
        ValueGrid grid{.columns = 2, .rows = 2, .spread = dice.in(0, .1)};
        for (int k = 0; k < 9; ++k) grid.values[k] = dice.in(-.1, 1.1);
        const PatternMean mean = pattern.form == PatternForm::noise
                                     ? mean_over(pattern, stops.data(), grid, weights)
                                     : mean_over(pattern, stops.data(), {3. * vector(), vector(), vector()}, weights);
        double all = 0;
        DVec3 sum(0);
        for (int k = 0; k < pattern.stops; ++k) all += weights[k], sum += weights[k] * stops[k].color;
        CHECK(std::abs(all - 1) < 1e-9);
        for (int c = 0; c < 3; ++c) CHECK(std::abs(sum[c] - mean.color[c]) < 1e-9);
    }
}

TEST_CASE("means of patterns end and are finite, whatever the footprint") {
    const double infinite = std::numeric_limits<double>::infinity();
    const SolidPattern granite{.solid = Solid::granite};
    const SolidPattern rings{.solid = Solid::onion, .turbulence = {1, 1, 1}, .wave = 1};
    for (const auto& [form, solid] : {std::pair<PatternForm, const SolidPattern*>(PatternForm::checker, nullptr),
                                      {PatternForm::brick, nullptr},
                                      {PatternForm::ramp, nullptr},
                                      {PatternForm::layers, nullptr},
                                      {PatternForm::solid, &granite},
                                      {PatternForm::solid, &rings}})
        for (const double size : {0., 1e-300, 1e-9, 1e3, 1e12, 1e30, infinite, infinite - infinite})
            for (const double place : {0., -.5, 1e8, 1e17, 1e300, infinite, -infinite, infinite - infinite}) {
                PatternKernel<double> pattern{};
                pattern.form = form, pattern.stops = 2, pattern.mortar = {.1, .1, .1}, pattern.solid = solid;
                ValueGrid grid{.columns = 1, .rows = 1, .spread = size, .loose = size, .cells = size};
                grid.values[1] = size, grid.values[3] = place;
                const PatternMean mean =
                    form == PatternForm::layers
                        ? mean_over(pattern, two.data(), grid)
                        : mean_over(pattern, two.data(), {{place, 1, place}, {size, 1, 0}, {0, -size, 1}});
                for (int c = 0; c < 3; ++c) {
                    CHECK(mean.color[c] > -1e-6);
                    CHECK(mean.color[c] < 1 + 1e-6);
                }
            }
}

const char* const fine_floors[]{
    // all that is left of them is how often there is which value
    "noise { octaves 1  colors { 0 <.5, .4, .4>  .2 <.4, .1, .7>  .62 <.05, .05, .05>  .62 <1, 1, 1>\n"
    "                           1 <.05, .05, .05> }  scale .006 }",
    "solid { quilted  turbulence <.05, .75, .4>  octaves 2  frequency 5  wave 4\n"
    "        colors { 0 <.2, .6, .5>  .85 <.4, .3, .7>  1 <1, 1, 1> }  scale .004 }",
    "<.8, .8, .8>  bump wood { height .05  scale .02 }",
};
const char* const floors[]{
    "checker { <1, 1, 1>, <.05, .05, .05> }",
    "checker { <1, 1, 1>, <.05, .05, .05>  scale .4  rotate <0, 0, 20> }",
    "brick { <1, 1, 1>, <.5, .05, .05>  brick_size <.4, .2, .3>  mortar .02 }",
    "gradient { axis <0, 1, 0>  colors { 0 <1, 1, 1>  .98 <1, 1, 1>  .98 <0, 0, 0>  1 <0, 0, 0> }  scale .5 }",
    "checker { brick { <1, 1, 1>, <.5, .05, .05>  brick_size <.4, .2, .3>  mortar .02 },\n"
    "          checker { <1, 1, 1>, <.1, .2, .6>  scale .25 }  scale 1.5 }",
    "solid { agate  colors { 0 <.9, .8, .7>  .5 <.6, .3, .1>  .5 <.9, .9, .9>  1 <.3, .1, .05> } }  blinn .3",
};

/// A pattern of two colours, of which some are patterns if `depth` is more than 0.
std::string random_pattern(Dice& dice, int depth) {
    const auto number = [&](double low, double high) { return std::to_string(dice.in(low, high)); };
    const auto color = [&] {
        if (depth > 0 && dice.in(0, 1) < .7) return random_pattern(dice, depth - 1);
        return "<" + number(0, 1) + ", " + number(0, 1) + ", " + number(0, 1) + ">";
    };
    const double form = dice.in(0, 3);
    const std::string first = color(), second = color();
    const std::string own = form < 1   ? "checker { " + first + ", " + second
                            : form < 2 ? "brick { " + first + ", " + second + " brick_size <1, .5, .7>  mortar .1"
                                       : "gradient { axis <1, 1, 0>  colors { 0 " + first + " 1 " + second + " }";
    return own + "  scale " + number(.3, 1.2) + "  rotate <0, 0, " + number(0, 90) + "> }";
}

TEST_CASE("floors of checks, bricks and lines, and of patterns in these, come out as the mean of many rays") {
    std::vector<std::string> texts(std::begin(floors), std::end(floors));
    texts.insert(texts.end(), std::begin(fine_floors), std::end(fine_floors));
    Dice patterns(17);
    for (int depth : {1, 1, 2, 2}) texts.push_back(random_pattern(patterns, depth));
    for (const std::string& text : texts) {
        CAPTURE(text);
        const Scene scene = parse_scene(
            "camera { position <0, -10, 4>  look_at <0, 0, 1>  sky <0, 0, 1>  angle 40 }\n"
            "light { position <-6, -8, 10>  color <1, 1, 1> }\n"
            "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb " +
                text + "  diffuse .9  specular 0  reflection 0 } }\n",
            "floor", {}, {});
        const View view{.camera = scene.camera, .width = 80, .height = 60};
        const Lattice all{.columns = view.width, .rows = view.height};
        ThreadPool pool(2);
        Tracer tracer(scene, Precision::float64);
        // Each ray is anywhere in its part of the pixel: on regular grids lines along the rows would be off. The
        // product of differences from two such means is, on average, the square of the error, however noisy they are.
        constexpr int grid = 10;
        Dice dice(3);
        std::vector<double> means[2];
        for (std::vector<double>& mean : means) {
            mean.resize(std::size_t(3) * view.width * view.height);
            for (int i = 0; i < grid * grid; ++i) {
                View shifted = view;
                shifted.shift_x = (i % grid + dice.in(0, 1)) / grid - .5;
                shifted.shift_y = (i / grid + dice.in(0, 1)) / grid - .5;
                const std::vector<double> one = values_of(tracer, shifted, all, pool, {.grid = 1});
                for (std::size_t k = 0; k < one.size(); ++k) mean[k] += one[k] / (grid * grid);
            }
        }
        CellPicture picture(scene, view, all, 1. / 510);
        picture.check();
        double squares = 0;
        std::vector<double> rgb(means[0].size());
        const Counts counts =
            tracer.trace({view, pool, [&](const Tile& tile) { place(tile, all, rgb); }}, CellPass{picture, 0});
        for (std::size_t i = 0; i < rgb.size(); ++i) squares += (rgb[i] - means[0][i]) * (rgb[i] - means[1][i]);
        const double rms = 510 * std::sqrt(std::max(squares, 0.) / double(rgb.size()));
        const double estimate = 510 * picture.sampled().error(), taken = double(counts.camera) / (80 * 60);
        MESSAGE("RMS ", rms, ", estimate ", estimate, ", samples ", taken);
        CHECK(rms < 3);  // with colours of points it is 6 to 31, with 3 to 14 samples a pixel
        CHECK(taken < 3);
    }
}

TEST_CASE("pictures in motion show floors and what mirrors show of them nearly as the mean of many rays") {
    std::vector<std::string> texts(std::begin(floors), std::end(floors) - 1);  // solid patterns keep colours of points
    texts.push_back("marble { turbulence 1.2  octaves 5  colors { 0 <1, 1, 1>  1 <.1, .1, .2> }  scale .2 }");
    texts.push_back("wood { turbulence .2  octaves 3  colors { 0 <.9, .6, .3>  1 <.3, .2, .1> }  scale .1 }");
    texts.push_back("noise { octaves 4  colors { .3 <1, 1, 1>  .7 <.1, .2, .5> }  scale .1 }");
    Dice patterns(23);
    for (int depth : {0, 0, 0, 0, 1, 1, 2}) texts.push_back(random_pattern(patterns, depth));
    for (const std::string& text : texts) {
        CAPTURE(text);
        const Scene scene = parse_scene(
            "camera { position <0, -10, 4>  look_at <0, 0, 1>  sky <0, 0, 1>  angle 40 }\n"
            "light { position <-6, -8, 10>  color <1, 1, 1> }\n"
            "sphere { <-1, -2, 2>, 1  material { diffuse 0  reflection .9 } }\n"
            "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb " +
                text + "  diffuse .9  specular 0  reflection 0 } }\n",
            "floor", {}, {});
        const View view{.camera = scene.camera, .width = 80, .height = 60, .depth = 3};
        const Lattice all{.columns = view.width, .rows = view.height};
        ThreadPool pool(2);
        Tracer tracer(scene, Precision::float32);
        const std::vector<double> means = values_of(tracer, view, all, pool, {.grid = 13});
        std::vector<PicturePoint> points;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) points.push_back({static_cast<float>(x), static_cast<float>(y)});
        const auto error = [&](double side) {
            std::vector<float> rgb(means.size());
            tracer.trace({view, pool, {}}, PointList{points, rgb.data(), side});
            double squares = 0;
            for (std::size_t i = 0; i < rgb.size(); ++i) squares += (rgb[i] - means[i]) * (rgb[i] - means[i]);
            return std::sqrt(squares / double(rgb.size()));
        };
        MESSAGE("RMS in 255ths ", 255 * error(1), ", of points ", 255 * error(0));
        CHECK(error(1) < .7 * error(0));
    }
}

}  // namespace strahl::pattern_means

// Solid patterns beside POV-Ray 3.7.0.10, which prints these values by #debug str(F(...), 0, 12) for
// #declare F = function { pattern { NAME ... } }.
#include "scene/solid/solid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "num/pack.h"
#include "scene/solid/solid_lanes.h"
#include "tests/referee/dice.h"

using namespace strahl;

namespace {

/// Adds up what the corners of a cell give a point, one number after the other, as POV-Ray does: from the table's
/// numbers `shift` further on.
double summed_noise(const DVec3& p, int shift, const std::array<int, 8>& order) {
    const lattice::NoiseTables& tables = lattice::noise_tables();
    int cell[3];
    double offsets[3][2], shares[3][2];
    for (int c = 0; c < 3; ++c) {
        const int whole = static_cast<int>(p[c] >= 0 ? p[c] : p[c] - (1 - 1e-10));
        const double part = p[c] - whole;
        cell[c] = (whole + 10000) & 4095;
        offsets[c][0] = part, offsets[c][1] = part - 1;
        shares[c][1] = part * part * (3 - 2 * part), shares[c][0] = 1 - shares[c][1];
    }
    double sum = 0;
    for (const int corner : order) {
        const int x = corner % 2, y = corner / 2 % 2, z = corner / 4;
        const int column = tables.hash[tables.hash[cell[0] + x] ^ (cell[1] + y)];
        const double* const numbers = &tables.random[tables.hash[column ^ (cell[2] + z)] % 256 + shift];
        sum += shares[0][x] * shares[1][y] * shares[2][z] *
               (numbers[0] * .5 + numbers[1] * offsets[0][x] + numbers[2] * offsets[1][y] + numbers[3] * offsets[2][z]);
    }
    return sum;
}

/// Returns points of all sizes, and some on the planes between cells.
std::vector<DVec3> points_in_lattice(Dice& dice, int count) {
    std::vector<DVec3> points;
    for (int i = 0; i < count; ++i) {
        const double size = std::exp2(dice.in(-3, 12));
        DVec3 p(dice.in(-size, size), dice.in(-size, size), dice.in(-size, size));
        if (dice.chance(.2)) p[i % 3] = std::round(p[i % 3]);
        points.push_back(p);
    }
    return points;
}

}  // namespace

TEST_CASE("noise is the sum over the corners of a cell to the last bit, for points alone and in lanes") {
    Dice dice{11};
    const std::vector<DVec3> points = points_in_lattice(dice, 1001);
    const int count = static_cast<int>(points.size());
    std::vector<double> values(points.size());
    std::vector<DVec3> ways(points.size());
    const lattice::NoiseLanes& lanes = noise_lanes<Widest<double>>;
    lanes.noise(points.data(), count, 2, values.data());
    lanes.vector_turbulence(points.data(), count, 1, .5f, 2, ways.data());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double sum = summed_noise(points[i], 0, {0, 1, 2, 3, 4, 5, 6, 7});
        const double wanted = std::clamp((sum + 1.05242) * .48985582, 0., 1.);
        CHECK(lattice::noise(points[i], 2) == wanted);
        CHECK(values[i] == wanted);
        const DVec3 alone = lattice::vector_noise(points[i]);
        for (int c = 0; c < 3; ++c) {
            const double part = summed_noise(points[i], 4 * c, {0, 1, 3, 2, 6, 7, 5, 4});
            CHECK(alone[c] == part);
            CHECK(ways[i][c] == part);
        }
    }
}

TEST_CASE("fractals have in lanes the values that their points have alone") {
    Dice dice{12};
    for (int n = 0; n < 200; ++n) {
        FractalForm form;
        form.magnet = static_cast<int>(dice.in(0, 3)), form.julia = dice.chance(.5);
        form.re = dice.in(-1.5, 1.5), form.im = dice.in(-1.5, 1.5);
        form.iterations = static_cast<int>(dice.in(0, 40)), form.exponent = static_cast<int>(dice.in(2, 5));
        form.inside = static_cast<int>(dice.in(0, 7)), form.outside = static_cast<int>(dice.in(0, 7));
        form.inside_factor = dice.in(.1, 2), form.outside_factor = dice.in(.1, 2);
        std::vector<DVec3> points;
        for (int i = 0; i < 37; ++i) points.push_back(DVec3(dice.in(-2, 2), dice.in(-2, 2), dice.in(-2, 2)));
        std::vector<double> values(points.size());
        solid_lanes<Widest<double>>.fractal(form, points.data(), static_cast<int>(points.size()), values.data());
        for (std::size_t i = 0; i < points.size(); ++i)
            CHECK(values[i] == fractal_value(form, points[i].x, points[i].y));
    }
}

TEST_CASE("solid patterns have POV-Ray's values") {
    const struct {
        Solid solid;
        double plain;    // at <-7.25, .5, 100.125>
        double changed;  // at <1.1, 2.2, 3.3>, with turbulence, frequency, phase and a sine wave
    } rows[]{{Solid::agate, 0.828388159201, 0.422739583448},       {Solid::boxed, 0.000000000000, 0.975528246575},
             {Solid::bozo, 0.598904229010, 0.810119327703},        {Solid::bumps, 0.598904229010, 0.810119327703},
             {Solid::cells, 0.918624162441, 0.395840707471},       {Solid::crackle, 0.128526425055, 0.124525669447},
             {Solid::cylindrical, 0.000000000000, 0.975528246575}, {Solid::dents, 0.214818727300, 0.471041087572},
             {Solid::gradient, 0.423450112171, 0.799602718657},    {Solid::granite, 0.517257283716, 0.850338535601},
             {Solid::leopard, 0.060608001678, 0.104401490262},     {Solid::marble, 0.499860000000, 0.786229999857},
             {Solid::onion, 0.388386405002, 0.414634472212},       {Solid::planar, 0.500000000000, 0.975528246575},
             {Solid::quilted, 0.200690304217, 0.950484307246},     {Solid::radial, 0.738495750109, 0.991108143408},
             {Solid::ripples, 0.359595291333, 0.765602616597},     {Solid::spherical, 0.000000000000, 0.975528246575},
             {Solid::waves, 0.543904870639, 0.139406790607},       {Solid::wood, 0.534301853749, 0.391438415637},
             {Solid::wrinkles, 0.492994179795, 0.909924017148}};
    for (const auto& row : rows) {
        CAPTURE(solid_names[static_cast<std::size_t>(row.solid)]);
        SolidPattern own{.solid = row.solid};
        if (row.solid == Solid::gradient) own.axis = {1, 2, -.5};
        if (row.solid == Solid::marble || row.solid == Solid::wood) own.wave = 1;
        CHECK(value_at(own, {-7.25, .5, 100.125}) == doctest::Approx(row.plain).epsilon(1e-10));
        own.turbulence = {.3, .5, .2};
        own.octaves = 3, own.omega = .6, own.lambda = 1.7, own.frequency = 2.5, own.phase = .3, own.wave = 2;
        CHECK(value_at(own, {1.1, 2.2, 3.3}) == doctest::Approx(row.changed).epsilon(1e-10));
        // Points too far away, or none at all, have a value too.
        for (const double x : {1e30, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
            CHECK(value_at(own, {x, 0, 0}) == 0);
            CHECK(bend_at(own, {0, x, 0}, {0, 0, 1}) == DVec3(0));
        }
    }
}

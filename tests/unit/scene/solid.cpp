// Solid patterns beside POV-Ray 3.7.0.10, which prints these values by #debug str(F(...), 0, 12) for
// #declare F = function { pattern { NAME ... } }.
#include "scene/solid/solid.h"

#include <doctest/doctest.h>

#include <limits>

using namespace strahl;

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

// Solid patterns with POV-Ray's own values, so that its scenes keep their stones, woods and clouds.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <tuple>

#include "num/lattice_noise.h"
#include "scene/kinds/field.h"

namespace strahl {

/// The kinds of solid patterns, in the order of `solid_names`.
enum class Solid : std::int32_t {
    agate,
    boxed,
    bozo,
    bumps,
    cells,
    crackle,
    cylindrical,
    dents,
    gradient,
    granite,
    leopard,
    marble,
    onion,
    planar,
    quilted,
    radial,
    ripples,
    spherical,
    spiral1,
    spiral2,
    uniform,
    waves,
    wood,
    wrinkles,
};
inline constexpr std::array<std::string_view, 24> solid_names{
    "agate",    "boxed",     "bozo",    "bumps",   "cells",   "crackle", "cylindrical", "dents",
    "gradient", "granite",   "leopard", "marble",  "onion",   "planar",  "quilted",     "radial",
    "ripples",  "spherical", "spiral1", "spiral2", "uniform", "waves",   "wood",        "wrinkles"};

struct FractalForm;
struct SolidPattern;

/// Noise, and values of patterns, at several points at once, in the lanes of the caller's SIMD level.
struct SolidLanes {
    lattice::NoiseLanes noise;
    void (*values)(const SolidPattern& pattern, const DVec3* points, int count, double* values);
    void (*fractal)(const FractalForm& form, const DVec3* points, int count, double* values);
};

/// Values that a POV-Ray scene computes in a way of its own, such as by a function. Scene text cannot say them.
struct SolidFunction {
    virtual ~SolidFunction() = default;
    /// Returns the value at a point, before frequency, phase and wave. Several threads may call it at once.
    virtual double value_at(const DVec3& point) const = 0;
    /// Writes the values at several points.
    virtual void values_at(const DVec3* points, int count, double* values, const SolidLanes& lanes) const;
    /// Returns what is added at a point to the normal, of length 1; nothing if that is the slope of the values.
    virtual std::optional<DVec3> bend_at(const DVec3& point, const DVec3& normal) const;
};

/// A pattern of POV-Ray 3.7: what its manual calls the pattern's value goes through `frequency` and `phase`, repeats
/// every 1.00001 and then takes the form of a wave. It is computed in double, point by point, whatever the precision of
/// the picture.
struct SolidPattern {
    Solid solid = Solid::bozo;
    DVec3 axis{1, 0, 0}, turbulence{0};
    double octaves = 6, omega = .5, lambda = 2, frequency = 1, phase = 0, wave = 0, generator = 2;
    double arms = 1;
    std::shared_ptr<const SolidFunction> function{};  // has the values in place of `solid`

    static constexpr const char* name = "solid";
    static constexpr const char* help = "a pattern of POV-Ray; its name stands first in the block";
    static constexpr auto fields = std::make_tuple(
        Field{"axis", &SolidPattern::axis, "the direction of `gradient`", Range::direction},
        Field{"turbulence", &SolidPattern::turbulence, "how far noise moves the pattern", Range::any},
        Field{"octaves", &SolidPattern::octaves, "how many sizes of detail that noise has", Range::octaves},
        Field{"omega", &SolidPattern::omega, "strength of each octave relative to the one before", Range::any},
        Field{"lambda", &SolidPattern::lambda, "how many times finer each octave is than the one before", Range::any},
        Field{"frequency", &SolidPattern::frequency, "how often the colours repeat", Range::any},
        Field{"phase", &SolidPattern::phase, "by how much the values are moved; the value of `uniform`", Range::any},
        Field{"wave", &SolidPattern::wave, "0 ramp, 1 triangle, 2 sine, 3 scallop, 4 cubic", Range::zero_or_more},
        Field{"arms", &SolidPattern::arms, "how many arms `spiral1` and `spiral2` have", Range::any},
        Field{"generator", &SolidPattern::generator, "POV-Ray's noise_generator: 1, 2 or 3", Range::positive});
    bool operator==(const SolidPattern&) const = default;
};

/// Returns the value at a point, from 0 to 1.
double value_at(const SolidPattern& pattern, const DVec3& point);
/// A size of a pattern's detail: its cells in a length of 1, and the standard deviation that it gives to the values.
struct SolidDetail {
    double fineness, deviation;
};
/// Says how the values of a pattern become means.
struct SolidDetails {
    /// How values beyond 0 and 1 repeat: from 0 to 1 over and over, up and down within 1, or not at all.
    enum class Repeat { ramp, triangle, never } repeat;
    bool known;  // else only points have values
    bool jumps;  // values change by steps
    bool even;   // detail is alike everywhere
    int count = 0;
    std::array<SolidDetail, 20> sizes{};
};
SolidDetails details_of(const SolidPattern& pattern);
/// Returns the value at a point before it repeats, without detail too fine for points that are `step` apart. Where
/// values never repeat, the wave has been applied.
double smoothed_value(const SolidPattern& pattern, const DVec3& point, double step);
/// Returns what is added to the normal at a point, for a height of 1, which is POV-Ray's amount: noise or waves for
/// `bumps`, `dents`, `wrinkles`, `ripples` and `waves`, for all others the slope of the values. Functions may depend on
/// the normal.
DVec3 bend_at(const SolidPattern& pattern, const DVec3& point, const DVec3& normal);
/// Returns the way from the middle of a cell of `quilted`, which is longer the nearer its border is, as a curve with
/// these slopes at both ends; and the value at such a way.
DVec3 quilt(const DVec3& point, double middle = 1, double border = 1);
double quilt_value(const DVec3& way);
/// Returns three numbers from 0 to 1 for a cell, from POV-Ray's table of random numbers.
DVec3 random_at_cell(int x, int y, int z);

}  // namespace strahl

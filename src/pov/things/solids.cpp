#include "pov/things/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "pov/language/words.h"
#include "pov/things/pattern_values.h"

namespace strahl::pov {

TurbulenceWarp turbulence_of(const Blend& blend) {
    return {.by = blend.turbulence,
            .octaves = static_cast<int>(std::clamp(std::floor(blend.octaves), 1., 10.)),
            .omega = blend.omega,
            .lambda = blend.lambda};
}

SolidPattern of_function(std::shared_ptr<const SolidFunction> function) {
    return {.frequency = 0, .function = std::move(function)};
}

namespace {

/// The patterns that bend normals by formulas of their own, and not by the slope of their values: POV-Ray leaves waves
/// and slope_maps of these out.
constexpr std::array direct_bends{word("bumps"), word("dents"),    word("ripples"),
                                  word("waves"), word("wrinkles"), word("quilted")};

/// Returns the values without warps and slopes.
std::optional<SolidPattern> plain_solid_of(const Blend& blend, bool bends, int generator) {
    const std::string_view name = reserved_words[blend.word - first_word_code];
    const bool noise = name == "spotted" || (name == "bumps" && !bends);
    const auto found = std::ranges::find(solid_names, noise ? std::string_view("bozo") : name);
    const int noises = std::clamp(blend.noise_generator.value_or(generator), 1, 3);
    SolidPattern solid{.function = own_values_of(blend, noises)};
    if (!solid.function && found == solid_names.end()) return std::nullopt;
    if (found != solid_names.end()) solid.solid = static_cast<Solid>(found - solid_names.begin());
    const bool spiral = solid.solid == Solid::spiral1 || solid.solid == Solid::spiral2;
    const Wave usual = spiral || name == "marble" || name == "wood" ? Wave::triangle : Wave::ramp;
    const Wave wave = blend.wave.value_or(usual);
    if (name == "gradient" && blend.axis != DVec3(0)) solid.axis = blend.axis;
    if (spiral) solid.arms = blend.arms;
    solid.wave = wave == Wave::poly ? 0 : static_cast<int>(wave);
    solid.turbulence = blend.turbulence;
    if (blend.turbulence != DVec3(0) || name == "agate") {
        solid.octaves = turbulence_of(blend).octaves;
        solid.omega = blend.omega, solid.lambda = blend.lambda;
    }
    solid.frequency = listed_colors(blend.word) > 0 ? 0 : blend.frequency, solid.phase = blend.phase;
    solid.generator = noises;
    return solid;
}

}  // namespace

std::optional<SolidPattern> solid_of(const Blend& blend, bool bends, int generator) {
    if (!blend) return std::nullopt;
    if (blend.values) return of_function(blend.values);
    std::optional<SolidPattern> solid = plain_solid_of(blend, bends, generator);
    if (!solid) return solid;
    const bool directly = bends && std::ranges::find(direct_bends, blend.word) != direct_bends.end();
    const bool powers = blend.wave == Wave::poly && blend.exponent != 1;
    if ((powers || blend.slopes) && !directly) {
        // Turbulence moves a point before the slope there is found; that of a spiral counts in its values as well.
        SolidPattern raised{.octaves = solid->octaves, .omega = solid->omega, .lambda = solid->lambda, .frequency = 0};
        raised.generator = solid->generator;
        if (bends && moves_points(blend)) std::swap(raised.turbulence, solid->turbulence);
        raised.function = powers ? powers_of(*solid, blend.exponent) : nullptr;
        if (blend.slopes)
            raised.function = slope_values(powers ? of_function(raised.function) : *solid, blend.slopes->entries);
        solid = raised;
    }
    if (!blend.warps.empty()) {
        Blend still = blend;
        still.turbulence = DVec3(0);
        solid = of_function(moved_values(moves_of(still, false), *solid));
    }
    return solid;
}

void keep_values(Blend& blend, bool bends, int generator) {
    blend.values = nullptr;
    if (const auto solid = solid_of(blend, bends, generator); solid && solid->function)
        blend.values = *solid == of_function(solid->function) ? solid->function : moved_values({}, *solid);
}

}  // namespace strahl::pov

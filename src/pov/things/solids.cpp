#include "pov/things/solids.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "pov/language/words.h"

namespace strahl::pov {

std::optional<SolidPattern> solid_of(const Blend& blend, bool bends, int generator) {
    if (!blend) return std::nullopt;
    const std::string_view name = reserved_words[blend.word - first_word_code];
    const bool noise = name == "spotted" || (name == "bumps" && !bends);
    const auto found = std::ranges::find(solid_names, noise ? std::string_view("bozo") : name);
    if (found == solid_names.end()) return std::nullopt;
    SolidPattern solid{.solid = static_cast<Solid>(found - solid_names.begin())};
    const Wave usual = name == "marble" || name == "wood" ? Wave::triangle : Wave::ramp;
    const Wave wave = blend.wave.value_or(usual);
    if (name == "gradient" && blend.axis != DVec3(0)) solid.axis = blend.axis;
    solid.wave = wave == Wave::poly ? 0 : static_cast<int>(wave);
    solid.turbulence = blend.turbulence;
    if (blend.turbulence != DVec3(0) || name == "agate") {
        solid.octaves = std::clamp(std::floor(blend.octaves), 1., 10.);
        solid.omega = blend.omega, solid.lambda = blend.lambda;
    }
    solid.frequency = blend.frequency, solid.phase = blend.phase;
    solid.generator = std::clamp(blend.noise_generator.value_or(generator), 1, 3);
    return solid;
}

}  // namespace strahl::pov

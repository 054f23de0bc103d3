#include "text/light_block.h"

#include "num/decimal.h"
#include "scene/motion.h"
#include "text/blocks.h"
#include "text/motion_block.h"

namespace strahl {
namespace {

Spot read_spot(Reader& reader, std::string_view word, Block& outer) {
    Spot spot;
    Block block{word};
    auto parameters = spot_parameters(spot);
    reader.block(block, parameters);
    reader.require(block, parameters);
    if (block.good() && spot.falloff < spot.radius) {
        reader.diagnostics.add(word, "the falloff of this spot, " + text_of(spot.falloff) + ", is below its radius, " +
                                         text_of(spot.radius));
        block.bad = true;
    }
    outer.absorb(block);
    return spot;
}

}  // namespace

Light read_light(Reader& reader, const TextLimits& limits, std::string_view word) {
    Light light;
    Block block{word};
    auto parameters = light_parameters(light);
    std::string_view spot_at, motion_at;
    reader.block(
        block, parameters, std::array<std::string_view, 2>{"spot", "motion"}, [] {},
        [&](std::string_view inner) {
            if (inner == "motion") {
                const bool first = reader.once(motion_at, inner);
                Motion motion = read_motion(reader, limits, inner, block);
                if (first) light.motion = std::move(motion);
                return true;
            }
            if (inner != "spot") return false;
            const bool first = reader.once(spot_at, inner);
            const Spot spot = read_spot(reader, inner, block);
            if (first) light.spot = spot;
            return true;
        });
    reader.require(block, parameters);
    if (!block.good()) return light;
    if (light.direction && *light.direction == DVec3(0))
        reader.diagnostics.add(parameters[1].at, "this 'direction' of 'light' has no direction");
    if (light.spot && light.direction)
        reader.diagnostics.add(spot_at,
                               "parallel light has no place from which a spot could shine; give it a 'position'");
    else if (light.spot && light.spot->look_at == light.position)
        reader.diagnostics.add(spot_at, "this spot shines nowhere: 'look_at' is the light's own position");
    if (light.motion)
        for (const MotionKey& key : light.motion->keys)
            if (const std::string fault = transformations_fault(matrix(at(*light.motion, key.time))); !fault.empty())
                reader.diagnostics.add(motion_at,
                                       "at " + text_of(key.time) + " s this motion of a light would " + fault);
    return light;
}

}  // namespace strahl

#include "text/light_block.h"

#include "num/decimal.h"
#include "text/blocks.h"

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

Light read_light(Reader& reader, std::string_view word) {
    Light light;
    Block block{word};
    auto parameters = light_parameters(light);
    std::string_view spot_at;
    reader.block(
        block, parameters, std::array<std::string_view, 1>{"spot"}, [] {},
        [&](std::string_view inner) {
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
    return light;
}

}  // namespace strahl

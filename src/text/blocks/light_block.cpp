#include "text/blocks/light_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "num/decimal.h"
#include "num/vec_math.h"
#include "scene/moving_scene.h"
#include "text/blocks/blocks.h"
#include "text/blocks/motion_block.h"

namespace strahl {
namespace {

Spot read_spot(BlockReader& reader, std::string_view word, Block& outer) {
    Spot spot;
    Block block{word, false, false, outer.follows};
    auto parameters = spot_parameters(spot);
    reader.block(block, parameters);
    reader.require(block, parameters);
    if (block.good() && spot.falloff < spot.radius)
        reader.fault(
            block, word,
            "invalid spot: its falloff, " + text_of(spot.falloff) + ", is below its radius, " + text_of(spot.radius));
    outer.absorb(block);
    return spot;
}

/// Reads `<u>, <v>` after `edges`.
void read_edges(BlockReader& reader, Area& area, Block& outer) {
    Block block{outer.name};
    reader.read(area.u, coordinates, "edges", block);
    reader.lexer.accept(',');
    reader.read(area.v, coordinates, "edges", block);
    outer.absorb(block);
}
/// Reads `columns, rows` after `grid`.
void read_grid(BlockReader& reader, Area& area, Block& outer) {
    Block block{outer.name};
    double columns = 0, rows = 0;
    reader.read(columns, grid_sizes, "grid", block);
    reader.lexer.accept(',');
    reader.read(rows, grid_sizes, "grid", block);
    if (block.good()) area.columns = static_cast<int>(columns), area.rows = static_cast<int>(rows);
    outer.absorb(block);
}

constexpr std::array<std::string_view, 4> of_soft_grids{"adaptive", "circular", "orient", "jitter"};

/// Why these edges span no rectangle or, if there is a grid, no parallelogram, or "".
std::string edges_fault(const Area& area) {
    const double u = length(area.u), v = length(area.v);
    constexpr double square = 1e-6;  // the largest cosine of the angle between edges that count as perpendicular
    constexpr double flat = 1e-6;    // the largest sine of it between edges that count as parallel
    if (!(u > 0 && v > 0)) return "invalid edges: one has no length";
    const DVec3 along = 1 / u * area.u, across = 1 / v * area.v;
    if (area.columns == 0 && std::abs(dot_product(along, across)) > square)
        return "invalid edges: they are not perpendicular";
    if (length(cross_product(along, across)) <= flat) return "invalid edges: they are parallel";
    return "";
}

}  // namespace

Light read_light(BlockReader& reader, const TextLimits& limits, std::string_view word) {
    Light light;
    Block block{word, false, false, &light.follows};
    auto parameters = light_parameters(light);
    std::string_view spot_at, motion_at, edges_at, grid_at;
    Area area;
    reader.block(
        block, parameters, light_words, [] {},
        [&](std::string_view inner) {
            if (inner == "edges") return reader.once(edges_at, inner), read_edges(reader, area, block), true;
            if (inner == "grid") return reader.once(grid_at, inner), read_grid(reader, area, block), true;
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
    sort(light.follows);
    if (!block.good()) return light;
    const auto fault = [&](std::string_view at, const std::string& message) { reader.fault(block, at, message); };
    if (edges_at.data()) {
        light.area = area;
        if (const std::string why = edges_fault(area); !why.empty()) fault(edges_at, why);
        if (light.direction) fault(edges_at, "parallel light cannot be a rectangle; give it a 'position'");
        if (light.spot && !light.soft)
            fault(spot_at, "a light with 'edges' cannot have a spot unless it is 'soft': it shines in all directions");
    } else if (grid_at.data()) {
        fault(grid_at, "a grid of points needs 'edges'");
    } else if (light.soft) {
        reader.fault(block, word, "a soft light needs 'edges'");
    }
    for (const Parameter& own : parameters)
        if (own.given() && std::ranges::find(of_soft_grids, own.name) != of_soft_grids.end()) {
            if (!light.soft || area.columns == 0)
                fault(own.at, "'" + std::string(own.name) + "' is for soft lights with a 'grid'");
            else if ((own.name == "circular" || own.name == "orient") && std::min(area.columns, area.rows) < 2)
                fault(own.at, "this needs a grid of at least 2 by 2 points");
        } else if (own.given() && own.name == "from" && !light.direction) {
            fault(own.at, "only parallel light has 'from'; give it a 'direction'");
        } else if (own.given() && own.name == "beam" && !light.from) {
            fault(own.at, "only parallel light has a beam; give it a 'direction' and 'from'");
        } else if (own.given() && (own.name == "core" || own.name == "tightness") && light.beam == 0) {
            fault(own.at, "this is for parallel light with a 'beam'");
        }
    if (light.direction && *light.direction == DVec3(0)) fault(parameters[1].at, "invalid light: its 'direction' is 0");
    if (light.spot && light.direction)
        fault(spot_at, "parallel light cannot have a spot; give it a 'position'");
    else if (light.spot && light.spot->look_at == light.position)
        fault(spot_at, "invalid spot: 'look_at' is the light's own position");
    if (light.motion)
        for (const MotionKey& key : light.motion->keys)
            if (const std::string why = transformations_fault(matrix(at(*light.motion, key.time))); !why.empty())
                fault(motion_at, "invalid light: at " + text_of(key.time) + " s its transformations " + why);
    return light;
}

}  // namespace strahl

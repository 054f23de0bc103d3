// Meshes and their materials by uv.
#pragma once
#include <memory>
#include <utility>

#include "scene/kinds/mesh.h"
#include "scene/material.h"
#include "tests/referee/dice.h"

namespace strahl {

/// Gives the points of a mesh places.
inline void give_places(Mesh& mesh, Dice& dice) {
    MeshData data = *mesh.data;
    data.places.clear(), data.corner_places.clear();
    for (std::size_t i = 0; i < data.points.size(); ++i) data.places.push_back({dice.in(-1, 2), dice.in(-1, 2)});
    mesh.data = std::make_shared<const MeshData>(std::move(data));
}

/// Maps all patterns of a material by uv.
inline void map_by_uv(Material& material) {
    const auto mapped = [](Pattern pattern) {
        pattern.by_uv = true;
        if (auto* const image = std::get_if<ImagePattern>(&pattern.kind)) image->map = ImageMap::planar;
        return pattern;
    };
    if (material.rgb.pattern) material.rgb = Pigment(mapped(*material.rgb.pattern));
    for (Relief* const relief : material.reliefs())
        if (relief->pattern) relief->pattern = std::make_shared<const Pattern>(mapped(*relief->pattern));
}

}  // namespace strahl

#include "trace/world/split_unions.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <numeric>
#include <utility>

#include "scene/leaves.h"
#include "scene/overlap.h"
#include "scene/union_groups.h"

namespace strahl {
namespace {

using Steps = std::vector<Transformation>;

void append(Steps& steps, const Steps& then) { steps.insert(steps.end(), then.begin(), then.end()); }

Steps inverse(const Steps& steps) {
    Steps result;
    struct {
        Steps& result;
        void operator()(const Rotate& step) const {
            for (int c = 2; c >= 0; --c) {
                DVec3 degrees(0);
                degrees[c] = -step.degrees[c];
                if (degrees[c] != 0) result.push_back(Rotate{degrees});
            }
        }
        void operator()(const Translate& step) const { result.push_back(Translate{-step.by}); }
        void operator()(const Scale& step) const { result.push_back(Scale{1. / step.by}); }
        void operator()(const Motion&) const {}  // unions whose parts move stay whole
    } invert{result};
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) std::visit(invert, *step);
    return result;
}

/// Gives it another material, and its parts as far as they have theirs from it.
void repaint(Primitive& primitive, int material) {
    const int before = std::exchange(primitive.material, material);
    change_parts(primitive, [&](Primitive& part) {
        if (part.material == before) repaint(part, material);
    });
}

/// Returns the part with its pattern where it was, in a space from which `shared` steps of the way to the pattern are
/// still to come. It gets a material of its own if the others are not.
Primitive painted(const UnionPart& part, std::size_t shared, std::vector<Material>& materials,
                  std::vector<int>* copied) {
    Primitive own = part.primitive;
    Material material = materials[static_cast<std::size_t>(own.material)];
    if (!material.patterned() || part.to_pattern.size() == shared) return own;
    const auto moved = [&](Pattern pattern) {
        if (!pattern.by_uv) append(pattern.transformations, inverse(part.to_pattern));
        return pattern;
    };
    const auto move = [&](Material& layer) {
        for (Pigment* const pigment : {&layer.rgb, &layer.share})
            if (pigment->pattern) *pigment = Pigment(moved(*pigment->pattern));
        for (Relief* const relief : layer.reliefs())
            if (relief->pattern) relief->pattern = std::make_shared<const Pattern>(moved(*relief->pattern));
    };
    move(material);
    std::ranges::for_each(material.coats, move);
    if (copied) copied->push_back(own.material);
    repaint(own, static_cast<int>(materials.size()));
    materials.push_back(std::move(material));
    return own;
}

}  // namespace

std::vector<Primitive> split_union(const Primitive& whole, std::vector<Material>& materials, std::vector<int>* copied) {
    std::vector<Primitive> pieces;
    for (const UnionGroup& group : union_groups(whole, materials)) {
        if (group.size() == 1) {
            pieces.push_back(painted(group[0], 0, materials, copied));
            append(pieces.back().transformations, whole.transformations);
            continue;
        }
        std::vector<Primitive> parts;
        for (const UnionPart& part : group) {
            // In a union the material, if it is that of the union, has the union's space.
            const bool of_whole = part.primitive.material == whole.material;
            parts.push_back(painted(part, of_whole ? part.primitive.transformations.size() : 0, materials, copied));
        }
        pieces.push_back({Union{std::make_shared<const std::vector<Primitive>>(std::move(parts))}, whole.material,
                          whole.transformations});
    }
    if (pieces.empty()) pieces.push_back(whole);
    return pieces;
}

Scene with_split_unions(Scene scene, DeclaredAs* declared) {
    const auto is_union = [](const Primitive& primitive) { return std::holds_alternative<Union>(primitive.shape); };
    if (std::ranges::none_of(scene.primitives, is_union)) return scene;
    DeclaredAs own;
    own.materials.resize(scene.materials.size());
    std::iota(own.materials.begin(), own.materials.end(), 0);
    std::vector<Primitive> all;
    const auto around_eye = [&](const Primitive& body) {
        return contains(body, scene.camera.position) && leaves_of(body.shape) <= most_leaves;
    };
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        Primitive& primitive = scene.primitives[i];
        if (is_union(primitive) && !around_eye(primitive)) {
            std::vector<int> copied;
            std::ranges::move(split_union(primitive, scene.materials, &copied), std::back_inserter(all));
            for (const int material : copied)
                own.materials.push_back(own.materials[static_cast<std::size_t>(material)]);
        } else {
            all.push_back(std::move(primitive));
        }
        own.bodies.resize(all.size(), static_cast<int>(i));
    }
    scene.primitives = std::move(all);
    if (declared) *declared = std::move(own);
    return scene;
}

}  // namespace strahl

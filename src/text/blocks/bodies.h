// Checks that a transformed body can still be represented in double, and that its parts and materials fit together.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "num/decimal.h"
#include "scene/kinds/world_transform.h"
#include "scene/leaves.h"
#include "scene/moving_scene.h"
#include "scene/scene.h"
#include "scene/union_groups.h"
#include "text/blocks/transformations.h"

namespace strahl {

/// Does the transformation take opposite sides of the box to the same place?
inline bool flattened(const Box& box, const glm::dmat4& m) {
    for (int i = 0; i < 3; ++i) {
        if (box.low[i] == box.high[i]) continue;
        DVec3 low = box.centre(), high = low;
        low[i] = box.low[i], high[i] = box.high[i];
        if (transform_point(m, low) == transform_point(m, high)) return true;
    }
    return false;
}

/// Why the transformation is not allowed for a valid shape, or "". Of the arguments of a shape, vectors are taken for
/// points, or directions where the field says so, and numbers for lengths. If a kind says `arguments_move = false`, its
/// arguments have a meaning in its own space only, and its bounds are checked instead. Of a composite the parts are
/// checked.
template <class Kind>
std::string transformed_fault(const Kind& shape, const glm::dmat4& m) {
    const double largest = largest_entry(m);
    if (std::string fault = scale_fault(largest); !fault.empty()) return fault;

    bool inside = true;
    const auto look = [&](const DVec3& point) {
        for (int i = 0; i < 3; ++i) inside &= coordinates.contains(point[i]);
    };
    const char* fault = nullptr;
    if constexpr (is_composite<Kind>) {
        for (const Primitive& part : *shape.parts) {
            const glm::dmat4 whole = m * matrix(part.transformations);
            const std::string found =
                std::visit([&](const auto& own) { return transformed_fault(own, whole); }, part.shape);
            if (!found.empty()) return found;
        }
    } else if constexpr (std::tuple_size_v<std::remove_cvref_t<decltype(Kind::fields)>> == 0 ||
                         requires { requires !Kind::arguments_move; }) {
        const Box box = transformed(shape.bounds(), m);
        look(box.low), look(box.high);
        if (flattened(shape.bounds(), m)) fault = "it is flat";
    } else {
        Kind moved = shape;
        const auto move = [&](auto& value, Range range) {
            if constexpr (std::is_same_v<decltype(value), DVec3&>) {
                if (range == Range::direction)
                    value = glm::dmat3(m) * normalize(value);
                else
                    look(value = transform_point(m, value));
            } else if (value != 0) {
                value *= largest;
                inside &= argument_range(range).contains(value);
            }
        };
        std::apply([&](const auto&... field) { (move(moved.*field.member, field.range), ...); }, Kind::fields);
        fault = moved.fault();
    }
    if (!inside) return reach_fault;
    if (std::string flat = flat_fault(m); !flat.empty()) return flat;
    return fault ? std::string("leave nothing of it: ") + fault : "";
}

/// Returns what transformed_fault says of a shape that may also move: at the times of all keys, the first fault.
template <class Kind>
std::string moved_fault(const Kind& shape, std::span<const Transformation> steps) {
    const std::vector<double> times = key_times(steps);
    if (times.empty()) return transformed_fault(shape, matrix(steps));
    for (const double time : times)
        if (std::string fault = transformed_fault(shape, matrix(at(steps, time))); !fault.empty())
            return "at " + text_of(time) + " s " + fault;
    return "";
}

/// Why a body is invalid if too many of its simple bodies are connected, or "".
inline std::string crowd_fault(const Primitive& primitive, const std::vector<Material>& materials) {
    if (leaves_of(primitive.shape) <= most_leaves) return "";
    const int most = most_leaves_together(primitive, materials);
    if (most <= most_leaves) return "";
    return std::to_string(most) + " of its bodies are connected, and at most " + std::to_string(most_leaves) +
           " may be";
}

/// Why a body is invalid if its material, or that of a part, cannot be on it, or "". Materials are numbers in `list`.
inline std::string place_fault(const Primitive& primitive, const std::vector<Material>& list) {
    std::string fault;
    for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
        if (!list[leaf.material].by_uv()) return;
        const Mesh* const mesh = std::get_if<Mesh>(&leaf.shape);
        if (!mesh)
            fault = "its pattern is mapped by uv, which only meshes have";
        else if (mesh->data->places.empty())
            fault = "its pattern is mapped by uv, and " +
                    (mesh->file.empty() ? "no triangle has 'uv_vectors'" : "the file '" + mesh->file + "' has none");
    });
    return fault;
}

}  // namespace strahl

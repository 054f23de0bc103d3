// A body of a scene as the referee sees it: one simple body, or all those that a composite consists of.
#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "scene/leaves.h"
#include "tests/referee/basic.h"
#include "tests/referee/blob.h"
#include "tests/referee/box.h"
#include "tests/referee/cone.h"
#include "tests/referee/disc.h"
#include "tests/referee/julia.h"
#include "tests/referee/lathe.h"
#include "tests/referee/pattern.h"
#include "tests/referee/prism.h"
#include "tests/referee/superellipsoid.h"
#include "tests/referee/sweep.h"
#include "tests/referee/torus.h"
#include "tests/referee/triangle.h"

namespace strahl::referee {

/// A simple body with the transformation into its own space: local = rows * (world - offset), normal' = transposed rows
/// * normal. Its faces are numbered from `first_face`.
template <class R>
struct Leaf {
    Shape shape;
    Material material;
    Paint<R> paint;
    glm::dmat4 material_to_world;
    Space<R> shape_to_world;
    int first_face;
    std::array<Vector<R>, 3> rows;
    Vector<R> offset;

    Leaf(const Shape& shape, const Material& material, int first_face, const LeafMatrices& matrices)
        : shape(shape),
          material(material),
          paint(material.rgb, matrices.material),
          material_to_world(matrices.material),
          shape_to_world(matrices.shape),
          first_face(first_face) {
        const glm::dmat4& m = matrices.shape;
        const Vector<R> a{m[0].x, m[0].y, m[0].z}, b{m[1].x, m[1].y, m[1].z}, c{m[2].x, m[2].y, m[2].z};
        const R scale = R(1) / dot(a, cross(b, c));
        rows = {scale * cross(b, c), scale * cross(c, a), scale * cross(a, b)};
        offset = {m[3].x, m[3].y, m[3].z};
    }
    Vector<R> color(int face, const Vector<R>& point) const {
        if (!material.rgb.pattern || !material.rgb.pattern->by_uv) return paint.at(point);
        return paint.at(place_in<R>(*std::get<Mesh>(shape).data, face - first_face, turn(point - offset)));
    }
    Vector<R> bent(int face, const Vector<R>& point, Vector<R> normal) const {
        const Vector<R> flat = normal;
        const auto bend = [&](const auto& relief) {
            if (!relief.pattern) return;
            const Space<R> own(matrix(relief.pattern->transformations)), whole(material_to_world);
            if (!relief.pattern->by_uv) return void(normal = referee::bent(relief, whole.around(own), point, normal));
            const Mesh& mesh = std::get<Mesh>(shape);
            const Vector<R> place = place_in<R>(*mesh.data, face - first_face, turn(point - offset));
            const Space<R> by_uv = space_by_uv(*mesh.data, face - first_face, shape_to_world, point, place, flat);
            const Vector<R> bent = referee::bent(relief, by_uv.around(own), point, flat);
            normal = unit(bent + dot(bent, flat) * (normal - flat));  // what was bent before is bent further
        };
        bend(material.normal);
        bend(material.bump);
        return normal;
    }
    Vector<R> turn(const Vector<R>& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
    bool surrounds(const Vector<R>& p) const {
        return std::visit(
            [&]<class Kind>(const Kind& kind) {
                if constexpr (is_composite<Kind>)
                    return false;
                else
                    return contains<R>(kind, turn(p - offset));
            },
            shape);
    }
    LineCrossings<R> meet(const Line<R>& line, int source) const {
        const Line<R> local{turn(line.origin - offset), turn(line.direction)};
        LineCrossings<R> found = std::visit(
            [&]<class Kind>(const Kind& kind) {
                if constexpr (is_composite<Kind>)
                    return LineCrossings<R>();
                else
                    return crossings(kind, local, source - first_face);
            },
            shape);
        for (auto& [t, face, n] : found.list) {
            face += first_face;
            n = n.x * rows[0] + n.y * rows[1] + n.z * rows[2];
        }
        return found;
    }
};

template <class R>
struct Body {
    Primitive primitive;
    Material medium;  // that it is as a whole: its own, or that of its first glass part
    std::vector<Leaf<R>> leaves;

    Body(const Primitive& primitive, const std::vector<Material>& materials)
        : primitive(primitive), medium(materials[primitive.material]) {
        int faces = 0;
        for_each_leaf_placed(primitive, [&](const Primitive& leaf, const LeafMatrices& matrices) {
            leaves.emplace_back(leaf.shape, materials[leaf.material], faces, matrices);
            const Mesh* const mesh = std::get_if<Mesh>(&leaf.shape);
            const auto faces_of_kind = []<class Kind>(const Kind& kind) {
                if constexpr (has_contours<Kind>) return faces_of(kind);
                return kind.faces;
            };
            faces += mesh ? static_cast<int>(mesh->data->triangles.size()) : std::visit(faces_of_kind, leaf.shape);
        });
        const auto glass = [](const Leaf<R>& leaf) { return leaf.material.refraction > 0; };
        const auto first = std::find_if(leaves.begin(), leaves.end(), glass);
        if (!(medium.refraction > 0) && first != leaves.end()) medium = first->material;
    }
    bool transparent() const {
        return std::any_of(leaves.begin(), leaves.end(), [](const auto& leaf) { return leaf.material.refraction > 0; });
    }
    const Material& material(int face) const { return leaf_of(face).material; }
    Vector<R> bent(int face, const Vector<R>& point, const Vector<R>& normal) const {
        return leaf_of(face).bent(face, point, normal);
    }
    /// The colour at a point of a face.
    Vector<R> color(int face, const Vector<R>& point) const { return leaf_of(face).color(face, point); }
    bool surrounds(const Vector<R>& p) const {
        auto leaf = leaves.begin();
        return within(primitive, p, leaf);
    }
    LineCrossings<R> meet(const Line<R>& line, int self) const {
        const int source = line.body == self ? line.face : -1;
        if (leaves.size() == 1) return leaves[0].meet(line, source);
        return surface(line, source);
    }

  private:
    /// A mesh alone has more faces than its kind says.
    const Leaf<R>& leaf_of(int face) const {
        auto leaf = leaves.end() - 1;
        while (leaf->first_face > face) --leaf;
        return *leaf;
    }
    /// Is p within the part, by its operations? Advances `leaf` past the leaves of the part.
    bool within(const Primitive& part, const Vector<R>& p, typename std::vector<Leaf<R>>::const_iterator& leaf) const {
        const auto combine = [&]<class Kind>(const Kind& kind) {
            if constexpr (is_composite<Kind>) {
                bool any = false, all = true, first = within(kind.parts->front(), p, leaf);
                for (auto other = kind.parts->begin() + 1; other != kind.parts->end(); ++other) {
                    const bool in = within(*other, p, leaf);
                    any |= in, all &= in;
                }
                return Kind::operation == Operation::unite       ? first || any
                       : Kind::operation == Operation::intersect ? first && all
                                                                 : first && !any;
            } else {
                return (leaf++)->surrounds(p);
            }
        };
        return std::visit(combine, part.shape);
    }

    /// Returns crossings at which the line changes sides, by points halfway to the next crossings. Crossings in one
    /// place count as one, of the face declared first, and crossings at the line's start count as the start.
    LineCrossings<R> surface(const Line<R>& line, int source) const {
        LineCrossings<R> all, found;
        if (source >= 0) all.add(0, source, {});
        for (const Leaf<R>& leaf : leaves)
            for (const Crossing<R>& crossing : leaf.meet(line, source)) all.list.push_back(crossing);
        std::stable_sort(all.list.begin(), all.list.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
        const R reach = 1 + root(dot(line.origin, line.origin));
        std::vector<Crossing<R>> places;
        for (const Crossing<R>& crossing : all) {
            const R t = crossing.t;
            if (places.empty() || t - places.back().t > R(1e-15) * (reach + (t < 0 ? -t : t)))
                places.push_back(crossing);
            else if (places.back().t != 0 && crossing.face < places.back().face)
                places.back() = crossing;
        }
        if (places.empty()) return found;
        const auto inside = [&](R t) { return surrounds(line.origin + t * line.direction); };
        bool before = inside(places.front().t - 1);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const R t = places[i].t, next = i + 1 < places.size() ? (t + places[i + 1].t) / 2 : t + 1;
            const bool after = inside(next);
            if (before != after && !(source >= 0 && t == 0)) found.list.push_back(places[i]);
            before = after;
        }
        return found;
    }
};

}  // namespace strahl::referee

// The bodies of exact arithmetic: the referee's formulas, in numbers of any kind.
#pragma once
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "scene/leaves.h"
#include "scene/scene.h"
#include "tests/referee/basic.h"
#include "tests/referee/box.h"
#include "tests/referee/cone.h"
#include "tests/referee/disc.h"
#include "tests/referee/pattern.h"
#include "tests/referee/torus.h"
#include "tests/referee/triangle.h"

namespace strahl::exact {

using referee::Crossing;
using referee::Line;
using referee::Vector;

template <class R>
R radians(double degrees) {
    const R pi = R(0x1.921fb54442d18p+1) + R(0x1.1a62633145c07p-53) + R(-0x1.f1976b7ed8fbcp-109);
    return R(degrees) * pi / 180;
}
template <class R>
R cosine_of(R x) {
    const R half = sine_of(x / 2);
    return 1 - 2 * half * half;
}

/// local = rows * (world - moved)
template <class R = Quadruple>
struct Space {
    using Vector = referee::Vector<R>;
    std::array<Vector, 3> columns{Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}}, rows;
    Vector moved;

    explicit Space(const std::vector<Transformation>& steps) {
        for (const Transformation& step : steps) std::visit([&](const auto& own) { add(own); }, step);
        const auto& [a, b, c] = columns;
        const R scale = R(1) / dot(a, cross(b, c));
        rows = {scale * cross(b, c), scale * cross(c, a), scale * cross(a, b)};
    }
    Vector turn(const Vector& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }

  private:
    template <class Step>
    void then(const Step& step) {
        for (Vector& column : columns) column = step(column);
        moved = step(moved);
    }
    void add(const Rotate& r) {
        const auto sine = [](double degrees) { return sine_of(radians<R>(degrees)); };
        const auto cosine = [](double degrees) { return cosine_of(radians<R>(degrees)); };
        then([&, s = sine(r.degrees.x), c = cosine(r.degrees.x)](const Vector& v) {
            return Vector{v.x, c * v.y - s * v.z, s * v.y + c * v.z};
        });
        then([&, s = sine(r.degrees.y), c = cosine(r.degrees.y)](const Vector& v) {
            return Vector{c * v.x + s * v.z, v.y, c * v.z - s * v.x};
        });
        then([&, s = sine(r.degrees.z), c = cosine(r.degrees.z)](const Vector& v) {
            return Vector{c * v.x - s * v.y, s * v.x + c * v.y, v.z};
        });
    }
    void add(const Translate& t) { moved = moved + Vector(t.by); }
    void add(const Scale& s) {
        then([&](const Vector& v) { return v * Vector(s.by); });
    }
    void add(const Motion&) {}
};

/// A colour, the same everywhere or by a pattern in a space of its own within a body's.
template <class R>
struct Paint {
    Pigment pigment;
    Space<R> space;
    Paint(const Pigment& own, const std::vector<Transformation>& body)
        : pigment(own), space(steps_of(own.pattern, body)) {}
    Vector<R> at(const Vector<R>& p) const {
        return pigment.pattern ? referee::color_of(pigment, space.turn(p - space.moved)) : Vector<R>(pigment.color);
    }
    static std::vector<Transformation> steps_of(const std::shared_ptr<const Pattern>& own,
                                                const std::vector<Transformation>& body) {
        std::vector<Transformation> steps;
        if (own) steps = own->transformations;
        if (!own || !own->by_uv) steps.insert(steps.end(), body.begin(), body.end());
        return steps;
    }
};
/// A bump or normal map in its own space.
template <class R, class Relief>
struct Bender {
    Relief relief;
    Space<R> space;
    Bender(const Relief& own, const std::vector<Transformation>& body)
        : relief(own), space(Paint<R>::steps_of(own.pattern, body)) {}
    referee::Space<R> whole() const { return {space.columns[0], space.columns[1], space.columns[2], space.moved}; }
};

/// A simple body, by itself or as a part of another.
template <class R>
struct Leaf {
    Shape shape;
    Material material;
    Space<R> space;
    Paint<R> paint;
    Bender<R, NormalMap> map;
    Bender<R, Bump> bump;
    int first_face, faces;

    std::vector<Crossing<R>> meet(const Line<R>& line, int source) const {
        const Line<R> local{space.turn(line.origin - space.moved), space.turn(line.direction)};
        std::vector<Crossing<R>> found;
        std::visit(
            [&](const auto& own) {
                if constexpr (requires { crossings(own, local, source); })
                    found = crossings(own, local, source - first_face).list;
            },
            shape);
        for (auto& [t, face, n] : found)
            n = n.x * space.rows[0] + n.y * space.rows[1] + n.z * space.rows[2], face += first_face;
        return found;
    }
    bool surrounds(const Vector<R>& world) const {
        const Vector<R> p = space.turn(world - space.moved);
        return std::visit(
            [&](const auto& own) {
                if constexpr (requires { contains<R>(own, p); }) return contains<R>(own, p);
                return false;
            },
            shape);
    }
    Vector<R> color_at(const Vector<R>& world, int face) const {
        if (!paint.pigment.pattern || !paint.pigment.pattern->by_uv) return paint.at(world);
        const auto* const mesh = std::get_if<Mesh>(&shape);
        return paint.at(mesh ? referee::place_in(*mesh->data, face - first_face, space.turn(world - space.moved))
                             : Vector<R>{0, 0, 0});
    }
    /// A normal of length 1, which `flat` is.
    Vector<R> bent(const Vector<R>& point, int face, const Vector<R>& flat) const {
        Vector<R> normal = flat;
        const auto bend = [&](const auto& own) {
            if (!own.relief.pattern) return;
            if (!own.relief.pattern->by_uv) return void(normal = referee::bent(own.relief, own.whole(), point, normal));
            const MeshData& mesh = *std::get<Mesh>(shape).data;
            const referee::Space<R> body{space.columns[0], space.columns[1], space.columns[2], space.moved};
            const Vector<R> place = referee::place_in(mesh, face - first_face, space.turn(point - space.moved));
            const auto by_uv = referee::space_by_uv(mesh, face - first_face, body, point, place, flat);
            const Vector<R> once = referee::bent(own.relief, by_uv.around(own.whole()), point, flat);
            normal = unit(once + dot(once, flat) * (normal - flat));
        };
        bend(map), bend(bump);
        return normal;
    }
    bool owns(int face) const { return face >= first_face && face < first_face + faces; }
    /// Is the line inside at t? Given are all its crossings except the one that it starts with. Bodies are convex.
    bool inside(const Line<R>& line, int source, const std::vector<Crossing<R>>& all, R t) const {
        const Crossing<R>*before = nullptr, *after = nullptr;
        for (const auto& own : all) {
            if (own.t <= t && (!before || own.t > before->t)) before = &own;
            if (own.t > t && (!after || own.t < after->t)) after = &own;
        }
        if (after) return dot(after->normal, line.direction) > 0;
        if (owns(source) || std::ranges::count_if(all, [&](const auto& own) { return own.t <= t; }) > 1) {
            const auto* const plane = std::get_if<Plane>(&shape);
            return plane && dot(referee::normal<R>(*plane), space.turn(line.direction)) < 0;
        }
        if (before) return dot(before->normal, line.direction) < 0;
        return surrounds(line.origin);
    }
};

/// A primitive: one simple body or several.
template <class R>
struct Body {
    std::vector<Leaf<R>> leaves;
    std::vector<int> steps;  // leaf, or the operation by which the last two results become one
    static constexpr int leaf = -1;
    const Material* medium;  // what is inside

    Body(const Scene& scene, const Primitive& primitive) : medium(&scene.materials[primitive.material]) {
        int faces = 0;
        for_each_leaf_within(
            primitive,
            [&](const Primitive& part, const LeafWay& way) {
                const int own = std::visit([](const auto& shape) { return shape.faces; }, part.shape);
                const auto* const mesh = std::get_if<Mesh>(&part.shape);
                const int count = mesh ? static_cast<int>(mesh->data->triangles.size()) : own;
                const Material& material = scene.materials[part.material];
                leaves.push_back({part.shape,
                                  material,
                                  Space<R>(way.steps),
                                  {material.rgb, way.material},
                                  {material.normal, way.material},
                                  {material.bump, way.material},
                                  faces,
                                  count});
                steps.push_back(leaf), faces += count;
                if (!medium->transmits() && material.transmits()) medium = &material;
            },
            [&](Operation operation) { steps.push_back(static_cast<int>(operation)); });
    }

    const Leaf<R>& leaf_of(int face) const {
        return *std::ranges::find_if(leaves, [&](const auto& own) { return own.owns(face); });
    }
    const Material& material_of(int face) const { return leaf_of(face).material; }

    std::vector<Crossing<R>> meet(const Line<R>& line, int self) const {
        const int source = line.body == self ? line.face : -1;
        if (leaves.size() == 1) return leaves[0].meet(line, source);
        std::vector<std::vector<Crossing<R>>> all;
        std::vector<Crossing<R>> ends, found;
        for (const auto& own : leaves) {
            all.push_back(own.meet(line, source));
            for (const auto& end : all.back())
                if (end.t > 0) ends.push_back(end);
        }
        std::ranges::stable_sort(ends, {}, &Crossing<R>::t);
        const auto inside_at = [&](R t) {
            return whole([&](std::size_t i) { return leaves[i].inside(line, source, all[i], t); });
        };
        bool inside = inside_at(0);
        for (const auto& end : ends) {
            const bool after = inside_at(end.t);
            if (after != inside) found.push_back(end);
            inside = after;
        }
        return found;
    }
    bool surrounds(const Vector<R>& p) const {
        return whole([&](std::size_t i) { return leaves[i].surrounds(p); });
    }

  private:
    template <class In>
    bool whole(const In& in) const {
        std::vector<bool> stack;
        std::size_t next = 0;
        for (const int step : steps) {
            if (step == leaf) {
                stack.push_back(in(next++));
                continue;
            }
            const bool last = stack.back();
            stack.pop_back();
            const bool first = stack.back();
            stack.back() = step == int(Operation::unite)       ? first || last
                           : step == int(Operation::intersect) ? first && last
                                                               : first && !last;
        }
        return stack.back();
    }
};

}  // namespace strahl::exact

// Each formula of bodies that are scaled unevenly on its own, as formulas_of_bodies.cpp has those of others.
#include "tests/proof/cases.h"
#include "tests/proof/tori.h"
#include "trace/proof/affine_bounds.h"

using namespace strahl;
using namespace strahl::trial;

namespace {

/// A body in a space of its own: own = rows * (world - centre).
template <class Shape>
struct Uneven {
    static constexpr const char* name = Shape::name;
    static constexpr int max_crossings = Shape::max_crossings;
    static constexpr bool closed = Shape::closed, bounded = Shape::bounded;
    static constexpr bool plane_faces = requires { Shape::plane_faces; };
    Shape own;
    Vector rows[3], columns[3], centre;

    Vector turned(const Vector& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
    Vector placed(const Vector& p) const { return centre + p.x * columns[0] + p.y * columns[1] + p.z * columns[2]; }
    Vector normal(const Vector& n) const { return n.x * rows[0] + n.y * rows[1] + n.z * rows[2]; }
};
template <class Shape>
referee::LineCrossings<R> crossings(const Uneven<Shape>& shape, const Line<R>& line, int source) {
    const Line<R> own{shape.turned(line.origin - shape.centre), shape.turned(line.direction)};
    auto found = crossings(shape.own, own, source);
    for (auto& crossing : found.list) crossing.normal = shape.normal(crossing.normal);
    return found;
}

/// Rows of a space that is stretched along its own axes, along the world's, or along neither, by up to 10 or to 1000.
void stretch(Dice& dice, Vector (&rows)[3]) {
    const Vector x = unit(Vector(dice.direction())), y = perpendicular(dice, x), z = cross(x, y), axes[] = {x, y, z};
    const int along = dice.upto(2);
    const double most = dice.chance(.2) ? 3 : dice.chance(.5) ? .2 : 1;
    R factors[3];
    for (R& factor : factors) factor = std::pow(10, dice.in(-most / 2, most / 2));
    for (int i : {0, 1, 2}) {
        rows[i] = along == 1 ? Vector{axes[i].x * factors[0], axes[i].y * factors[1], axes[i].z * factors[2]}
                             : factors[i] * axes[i];
        if (along == 2) rows[i] = rows[i] + R(dice.in(0, .5)) * factors[i] * Vector(dice.direction());
        rows[i] = vector(rounded(rows[i]));
    }
}

}  // namespace

template <class Shape>
struct trial::Case<Uneven<Shape>> {
    Case<Shape> inner;
    Uneven<Shape> shape;
    AffineKernel<decltype(Case<Shape>::kernel), double> kernel;
    Slack<double> slack;
    double size;

    /// Either the space is off or what stands there, or both.
    explicit Case(Dice& dice) : inner(dice) {
        shape.own = inner.shape;
        Vector made[3];
        stretch(dice, made);
        invert(made, shape.columns);
        size = above(length(shape.columns[0]) + length(shape.columns[1]) + length(shape.columns[2])) / 3;
        const double off = dice.chance(.5) ? any_size(dice, -7) : 0;
        Vector error[3];  // exact rows are these times 1 + error
        for (Vector& row : error) row = R(off) * Vector(dice.direction());
        for (int i : {0, 1, 2}) {
            const Vector& row = made[i];
            shape.rows[i] = row + row.x * error[0] + row.y * error[1] + row.z * error[2];
        }
        invert(shape.rows, shape.columns);
        // Far from its own space's centre, nearly all roundings would be those of that.
        shape.centre = Vector(dice.vector(-3, 3)) - (shape.placed(at(inner.shape)) - shape.placed(Vector()));
        kernel.centre = rounded(shape.centre + R(off) * Vector(dice.direction()));
        kernel.row_x = rounded(made[0]), kernel.row_y = rounded(made[1]), kernel.row_z = rounded(made[2]);
        kernel.box = {kernel.centre, DVec3(20 * size)};
        kernel.shape = inner.kernel;
        slack.turn = std::max(inner.slack.turn,
                              above(root(dot(error[0], error[0]) + dot(error[1], error[1]) + dot(error[2], error[2]))));
        const R sizes = R(norm1(kernel.centre)) + R(norm1(kernel.box.half));
        slack.share =
            std::max(inner.slack.share, 1.0000001 * above(length(vector(kernel.centre) - shape.centre) / sizes));
    }
    double scale() const { return size * inner.scale(); }
    /// Returns the distance of a point from a face: that in the body's own space, divided by how fast it grows.
    R off(const Vector& p, int face) const {
        const Vector own = shape.turned(p - shape.centre);
        const Ray<double> from{rounded(own), DVec3(1, 0, 0), -1};
        const Vector normal = unit(vector(inner.kernel.at(from, 0., double(face)).normal));
        return inner.off(own, face) / length(shape.normal(normal));
    }
    std::pair<Vector, Vector> point(Dice& dice) const {
        const auto [own, normal] = inner.point(dice);
        return {shape.placed(own), unit(shape.normal(normal))};
    }

  private:
    static void invert(const Vector (&rows)[3], Vector (&columns)[3]) {
        const R volume = dot(rows[0], cross(rows[1], rows[2]));
        for (int i : {0, 1, 2}) columns[i] = R(1) / volume * cross(rows[(i + 1) % 3], rows[(i + 2) % 3]);
    }
    static Vector at(const auto& own) {
        if constexpr (requires { own.centre; })
            return own.centre;
        else
            return own.base;
    }
};

TEST_CASE("formulas of uneven balls") { try_body<Uneven<Sphere>>(15); }
TEST_CASE("formulas of uneven cylinders") { try_body<Uneven<Cylinder>>(16); }
TEST_CASE("formulas of uneven cones") { try_body<Uneven<Cone>>(17); }
TEST_CASE("formulas of uneven discs") { try_body<Uneven<Disc>>(18); }
TEST_CASE("formulas of uneven tori") { try_tori<Uneven<Torus>>(22); }

/// Bounds of a space: the most that lengths grow there, and along a surface.
TEST_CASE("formulas of uneven spaces") {
    Closest any{"the most a length grows"}, along{"along a surface"};
    Dice dice(19);
    for (int i = 0; i < trials(); ++i) {
        Vector rows[3];
        stretch(dice, rows);
        AffineKernel<SphereKernel<double>, double> kernel;
        kernel.centre = DVec3(0), kernel.shape = {DVec3(0), 1};
        kernel.row_x = rounded(rows[0]), kernel.row_y = rounded(rows[1]), kernel.row_z = rounded(rows[2]);
        const auto grown = [&](const Vector& v) { return Vector{dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; };
        const auto back = [&](const Vector& v) { return v.x * rows[0] + v.y * rows[1] + v.z * rows[2]; };
        const OwnPoint<SphereKernel<double>, double> point(kernel, dice.direction(), 0., Slack<double>{});
        const Vector n = unit(vector(point.normal));
        Vector v = unit(Vector(dice.direction())), w = perpendicular(dice, n);  // powers of R^T R, across n
        for (int k = 0; k < 40; ++k) {
            v = unit(back(grown(v)));
            const Vector next = back(grown(w));
            w = unit(next - dot(next, n) * n);
        }
        any.take(length(grown(v)), most_stretch(kernel));
        along.take(dot(grown(w), grown(w)), point.most_along(kernel));
    }
}

// Compares bounds of rays that are reflected inside balls and cylinders time and again with numbers of 113 bits, as
// formulas_of_bodies.cpp does for one hit.
#include "tests/proof/cases.h"

using namespace strahl;
using namespace strahl::trial;

namespace {

/// Returns what mirrors in a body keep of a line, as in bound_inside: its spin about the centre. The way between two
/// lines grows with the difference of their spins.
Vector spin_of(const Line<R>& line, const Vector& centre) { return cross(line.origin - centre, line.direction); }
R spin_error(const Case<Sphere>& ball, const Line<R>& exact, const Line<R>& computed) {
    return length(spin_of(exact, Vector(ball.shape.centre)) - spin_of(computed, vector(ball.kernel.centre))) /
           R(ball.kernel.radius);
}
R spin_error(const Case<Cylinder>& cylinder, const Line<R>& exact, const Line<R>& computed) {
    const Vector axis = unit(vector(cylinder.kernel.axis));
    const R about = dot(spin_of(exact, Vector(cylinder.shape.base)), cylinder.axis) -
                    dot(spin_of(computed, vector(cylinder.kernel.base)), axis);
    const R along = dot(exact.direction, cylinder.axis) - dot(computed.direction, axis);
    return std::max(size(about) / R(cylinder.kernel.radius), size(along));
}

struct Insides {
    Closest away{"point"}, turn{"mirrored direction"}, spin{"spin"}, told{"certain, or not"};

    /// Follows a ray from a point of the side on, until it leaves the side, or nothing is known of it any more.
    template <class Shape>
    void follow(const Case<Shape>& body, OffRay off, int bounces) {
        for (int i = 0; i < bounces; ++i) {
            const Span<double> span = body.kernel.span(off.ray, 0.);
            if (!span.hit || span.far_face != 0 || !(span.far > 0)) return;
            const SurfacePoint<double> point = body.kernel.at(off.ray, span.far, 0.);
            const PointBounds<double> known =
                point_bounds(body.kernel, off.ray, off.doubt, span.far, point, 0., body.slack);
            if (!known.sure) return;
            auto list = crossings(body.shape, off.line, 0).list;
            std::ranges::sort(list, {}, &referee::Crossing<R>::t);
            told.demand(!list.empty() && list.back().t > 0 && list.back().face == 0);
            if (list.empty()) return;
            const Vector exact = off.line.origin + list.back().t * off.line.direction, n = unit(list.back().normal);
            away.take(length(exact - vector(point.position)), known.away);
            off.line = {exact, off.line.direction - R(2) * dot(off.line.direction, n) * n};
            std::tie(off.ray, off.doubt) = mirrored(off.ray, off.doubt, point, known, 0.);
            turn.take(length(off.line.direction - unit(vector(off.ray.direction))), off.doubt.turn);
            spin.take(spin_error(body, off.line, {vector(off.ray.origin), unit(vector(off.ray.direction))}),
                      off.doubt.spin);
        }
    }
};

template <class Shape>
void try_insides(std::uint64_t seed) {
    Dice dice(seed);
    Insides insides;
    for (int i = 0; i < trials() / 4; ++i) {
        const Case<Shape> body(dice);
        const auto [exact, normal] = body.point(dice);
        const R c = std::pow(10, dice.in(dice.chance(.3) ? -3 : -.5, 0));
        const Vector towards = root(1 - c * c) * perpendicular(dice, normal) - c * normal;
        const DVec3 aim = rounded(exact + R(dice.in(.1, 2)) * towards);
        const Ray<double> back{aim, nearly_unit(dice, R(-1) * towards), -1};
        const Span<double> span = body.kernel.span(back, -1.);
        if (!span.hit || span.far_face != 0 || !(span.far > 0)) continue;
        const SurfacePoint<double> start = body.kernel.at(back, span.far, 0.);
        // The exact ray starts at a point of the exact side near the computed one.
        OffRay off = off_ray(dice, start.position, towards, any_of(dice, normal), any_of(dice, normal));
        const Line<R> out{off.line.origin - R(.01) * normal, normal};
        auto list = crossings(body.shape, out, -1).list;
        std::ranges::sort(list, {}, &referee::Crossing<R>::t);
        if (list.empty() || list.back().face != 0) continue;
        off.line.origin = out.origin + list.back().t * out.direction;
        const Vector apart = off.line.origin - vector(start.position);
        off.doubt = {above(length(apart)), off.doubt.turn, above(length(cross(apart, off.line.direction)))};
        off.ray.source = 0;
        insides.follow(body, off, 40);
    }
}

}  // namespace

TEST_CASE("formulas of rays in balls") { try_insides<Sphere>(31); }
TEST_CASE("formulas of rays in cylinders") { try_insides<Cylinder>(32); }

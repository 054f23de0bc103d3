// Trials of what span_bounds() and point_bounds() say of a kind of body: rays near its edges and along its surface.
#pragma once
#include <string_view>

#include "tests/proof/trial.h"

namespace strahl::trial {

/// A body, and as the kernel has it, whose numbers are off by some share.
template <class Shape>
struct Case;
/// Trials of the formulas of bodies that a ray crosses.
template <class Shape>
struct Spans {
    // A ray enters planes and leaves open bodies, no more.
    Closest near{"crossing", Shape::closed}, far{"last crossing", Shape::bounded}, other{"from its own surface"},
        away{"point"}, side{"line beside the point"}, height{"point off the exact one's plane"},
        surface{"point off its surface"}, normal{"normal"}, mirrored{"mirrored by the normal"}, told{"certain, or not"};

    void try_span(const Case<Shape>& body, const OffRay& off) {
        const SpanBounds<double> span = span_bounds(body.kernel, off.ray, off.doubt, -1., body.slack);
        auto list = crossings(body.shape, off.line, -1).list;
        std::ranges::sort(list, {}, &referee::Crossing<R>::t);
        told.demand(list.empty() ? !span.sure || !Shape::bounded : span.maybe || list.back().t < 0);
        if (list.empty() || !span.maybe) return;
        if (Shape::closed) take(near, list.front().t, span.near_low, span.near_high);
        if (!Shape::closed || list.size() > 1) take(far, list.back().t, span.far_low, span.far_high);
    }
    static void take(Closest& kind, R t, double low, double high) {
        if (!(low > -inf && high < inf)) return kind.demand(t <= 0 || (t >= low && t <= high));
        kind.take(size(t - (R(low) + R(high)) / 2), above((R(high) - R(low)) / 2));
    }
    void try_point(Dice& dice, const Case<Shape>& body, const OffRay& off) {
        const Span<double> span = body.kernel.span(off.ray, -1.);
        const double t = first_crossing(span), face = first_face(span);
        if (!span.hit || !(t > 0)) return;
        const SurfacePoint<double> point = body.kernel.at(off.ray, t, face);
        const PointBounds<double> known = point_bounds(body.kernel, off.ray, off.doubt, t, point, face, body.slack);
        if (!known.sure) return;
        const auto off_its_surface = [&] {
            if constexpr (requires { off_surface(body.kernel, point.position, body.slack); })
                return off_surface(body.kernel, point.position, body.slack);
            else
                return off_surface(body.kernel, point.position, face, body.slack);
        };
        surface.take(body.off(vector(point.position), static_cast<int>(face)), off_its_surface());
        const referee::Crossing<R>* met = nullptr;
        const auto list = crossings(body.shape, off.line, -1).list;
        for (const auto& crossing : list)
            if (crossing.face == static_cast<int>(face) && (!met || size(crossing.t - t) < size(met->t - t)))
                met = &crossing;
        told.demand(met && met->t > 0);
        if (!met) return;
        const Vector exact = off.line.origin + met->t * off.line.direction;
        away.take(length(exact - vector(point.position)), known.away);
        normal.take(length(unit(met->normal) - vector(point.normal)), known.normal);
        const auto mirror = [&](const Vector& n) { return R(2) * dot(off.line.direction, n) * n; };
        mirrored.take(length(mirror(unit(met->normal)) - mirror(unit(vector(point.normal)))), 2 * known.mirrored);
        const Vector apart = exact - vector(point.position);
        side.take(length(cross(apart, off.line.direction)), known.side);
        height.take(size(dot(apart, unit(met->normal))), known.height);
        Vector towards = any_of(dice, vector(point.normal)) + R(.9) * Vector(dice.direction());
        // Rays along a cone's side have a formula of their own.
        if (std::string_view(Shape::name) == Cone::name && dice.chance(.3))
            towards = perpendicular(dice, vector(point.normal)) + R(any_size(dice)) * vector(point.normal);
        OffRay on = off_ray(dice, point.position, towards, Vector(), any_of(dice, vector(point.normal)));
        on.line.origin = exact, on.doubt.away = above(length(exact - vector(point.position)));
        on.ray.source = face;
        const SpanBounds<double> from = span_bounds(body.kernel, on.ray, on.doubt, face, body.slack);
        auto ahead = crossings(body.shape, on.line, static_cast<int>(face)).list;
        std::ranges::sort(ahead, {}, &referee::Crossing<R>::t);
        const bool leaves = !ahead.empty() && ahead.back().t > 0;
        if constexpr (Shape::max_crossings == 1) return other.demand(!from.maybe);
        told.demand(leaves ? from.maybe : !(from.sure && from.far_low > 0));
        if (leaves) take(other, ahead.back().t, from.far_low, from.far_high);
    }
};

template <class Shape>
void try_body(std::uint64_t seed) {
    Dice dice(seed);
    Spans<Shape> spans;
    for (int i = 0; i < trials(); ++i) {
        const Case<Shape> body(dice);
        const auto [point, normal] = body.point(dice);
        const bool flat = requires { Shape::plane_faces; }
        &&Shape::bounded;
        const R c = std::pow(10, dice.chance(.3) ? dice.in(flat ? -17 : -9, 0) : dice.in(-.7, 0));
        const Vector along = R(dice.chance(.8) ? -1 : 1) * c * normal + root(1 - c * c) * perpendicular(dice, normal);
        const double way = std::pow(10, dice.in(-1, 1)), beside = dice.chance(.7) ? 0 : any_size(dice, -1);
        const Vector aim = point + R((dice.chance(.5) ? 1 : -1) * beside * body.scale()) * normal;
        const OffRay off =
            off_ray(dice, rounded(aim - R(way) * along), along, any_of(dice, normal), any_of(dice, normal));
        spans.try_span(body, off);
        spans.try_point(dice, body, off);
    }
}

}  // namespace strahl::trial

// Random tori, and trials of their formulas.
#pragma once
#include "tests/proof/spans.h"
#include "tests/referee/torus.h"
#include "trace/proof/torus_bounds.h"

namespace strahl::trial {

/// A torus for trials; one in three is a spindle.
template <>
struct Case<Torus> {
    Torus shape;
    TorusKernel<double> kernel;
    Slack<double> slack;
    Vector axis;

    explicit Case(Dice& dice) {
        shape.centre = dice.vector(-3, 3), shape.axis = dice.direction();
        shape.major = std::pow(10, dice.in(-1, .3));
        shape.minor = shape.major * (dice.chance(.3) ? dice.in(1, 4) : std::pow(10, dice.in(-2, 0)));
        axis = unit(Vector(shape.axis));
        const double off = any_size(dice, -7);
        kernel.axis = rounded(unit(axis + R(off) * perpendicular(dice, axis)));
        kernel.centre = rounded(Vector(shape.centre) + R(off) * Vector(dice.direction()));
        kernel.major = shape.major * (1 + off), kernel.minor = shape.minor * (1 - off);
        slack.turn = above(length(vector(kernel.axis) - axis));
        const R wrong = length(vector(kernel.centre) - Vector(shape.centre)) + size(R(kernel.major) - R(shape.major)) +
                        size(R(kernel.minor) - R(shape.minor));
        slack.share = 1.0000001 * above(wrong / (R(norm1(kernel.centre)) + R(kernel.major) + R(kernel.minor)));
    }
    double scale() const { return shape.minor; }
    R off(const Vector& p, int) const {
        const Vector f = p - Vector(shape.centre), across = f - dot(f, axis) * axis;
        const R out = length(across) - R(shape.major), along = dot(f, axis);
        return size(root(out * out + along * along) - R(shape.minor));
    }
    /// Returns a random point of the surface, and the normal there.
    std::pair<Vector, Vector> point(Dice& dice) const {
        const Vector out = perpendicular(dice, axis);
        for (;;) {
            const double angle = dice.in(-3.14159, 3.14159);
            const Vector n = R(std::cos(angle)) * out + R(std::sin(angle)) * axis;
            const Vector on = R(shape.major) * out + R(shape.minor) * unit(n);
            if (dot(on, out) > R(.001) * R(shape.minor)) return {Vector(shape.centre) + on, unit(n)};
        }
    }
};

template <class Shape>
struct TorusTrials {
    Closest first{"first crossing"}, away{"point"}, side{"line beside the point"},
        height{"point off the exact one's plane"}, surface{"point off its surface"}, normal{"normal"},
        told{"certain, or not"};
    int known = 0, all = 0;

    std::vector<referee::Crossing<R>> ahead(const Case<Shape>& torus, const Line<R>& line, int source) const {
        auto list = crossings(torus.shape, line, source).list;
        std::erase_if(list, [](const auto& own) { return !(own.t > 0); });
        std::ranges::sort(list, {}, &referee::Crossing<R>::t);
        return list;
    }
    void try_span(const Case<Shape>& torus, const OffRay& off, int source) {
        const auto span = span_bounds(torus.kernel, off.ray, off.doubt, double(source), torus.slack);
        const auto list = ahead(torus, off.line, source);
        ++all, known += !span.maybe || span.sure;
        const bool enters = span.near_low > 0;
        if (list.empty()) return told.demand(!span.maybe || !span.sure);
        const R t = list.front().t;
        told.demand(span.maybe && R(enters ? span.near_low : span.far_low) <= t);
        if (!span.sure) return;
        const double low = enters ? span.near_low : span.far_low, high = enters ? span.near_high : span.far_high;
        first.take(size(t - (R(low) + R(high)) / 2), above((R(high) - R(low)) / 2));
        if (list.size() > 1) told.demand(list[1].t >= R(span.later));
    }
    void try_point(Dice& dice, const Case<Shape>& torus, const OffRay& off) {
        const double t = first_crossing(torus.kernel.crossings(off.ray, -1.));
        if (!(t > 0)) return;
        const SurfacePoint<double> point = torus.kernel.at(off.ray, t, 0.);
        const PointBounds<double> bounds = point_bounds(torus.kernel, off.ray, off.doubt, t, point, 0., torus.slack);
        if (!bounds.sure) return;
        const auto off_its_surface = [&] {
            if constexpr (requires { off_surface(torus.kernel, point.position, torus.slack); })
                return off_surface(torus.kernel, point.position, torus.slack);
            else
                return off_surface(torus.kernel, point.position, 0., torus.slack);
        };
        surface.take(torus.off(vector(point.position), 0), off_its_surface());
        const referee::Crossing<R>* met = nullptr;
        const auto list = crossings(torus.shape, off.line, -1).list;
        for (const auto& own : list)
            if (!met || size(own.t - R(t)) < size(met->t - R(t))) met = &own;
        told.demand(met && met->t > 0);
        if (!met) return;
        const Vector exact = off.line.origin + met->t * off.line.direction, n = vector(point.normal);
        away.take(length(exact - vector(point.position)), bounds.away);
        normal.take(length(unit(met->normal) - n), bounds.normal);
        const Vector apart = exact - vector(point.position);
        side.take(length(cross(apart, off.line.direction)), bounds.side);
        height.take(size(dot(apart, unit(met->normal))), bounds.height);
        OffRay on = off_ray(dice, point.position, any_of(dice, n) + R(.9) * Vector(dice.direction()), Vector(),
                            any_of(dice, n));
        on.line.origin = exact, on.doubt.away = above(length(exact - vector(point.position))), on.ray.source = 0;
        try_span(torus, on, 0);
    }
};

template <class Shape>
void try_tori(std::uint64_t seed) {
    Dice dice(seed);
    TorusTrials<Shape> tori;
    for (int i = 0; i < trials() / 8; ++i) {  // their roots take 113 bits long
        const Case<Shape> torus(dice);
        const auto [point, normal] = torus.point(dice);
        const R c = std::pow(10, dice.chance(.3) ? dice.in(-7, 0) : dice.in(-.7, 0));
        const Vector along = R(dice.chance(.7) ? -1 : 1) * c * normal + root(1 - c * c) * perpendicular(dice, normal);
        const double way = std::pow(10, dice.in(-1, 1)), beside = dice.chance(.7) ? 0 : any_size(dice, -1);
        const Vector aim = point + R((dice.chance(.5) ? 1 : -1) * beside * torus.scale()) * normal;
        const OffRay off =
            off_ray(dice, rounded(aim - R(way) * along), along, any_of(dice, normal), any_of(dice, normal));
        tori.try_span(torus, off, -1);
        tori.try_point(dice, torus, off);
    }
    std::printf("    of %d rays it is known where they first meet a torus, if at all: %d\n", tori.all, tori.known);
    CHECK(tori.known > .7 * tori.all);
}

}  // namespace strahl::trial

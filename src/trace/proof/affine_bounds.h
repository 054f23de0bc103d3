// Error bounds for bodies that are scaled unevenly: of a ray's crossings with them, and of the points there. They
// follow from the bounds of the body in a space of its own, in which it is round.
#pragma once
#include "num/memory.h"
#include "trace/proof/cone_bounds.h"
#include "trace/proof/flat_bounds.h"
#include "trace/proof/point_bounds.h"
#include "trace/proof/torus_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Requires that error bounds of K are known in its own space.
template <class K, class S>
concept KnownInOwnSpace = requires(const K& shape, const Vec3<S>& p, const S& s, const Slack<Element<S>>& slack) {
    off_surface(shape, p, slack);
    bend_of(shape, p, s, s, slack);
    on_face(shape, p, s, s);
};

/// Bounds the factor by which lengths grow on the way into the body's own space: the largest singular value of the
/// rows' matrix R. Its square is at most the largest sum of the sizes in a row of R R^T, and of R^T R. The first is
/// exact where rows are perpendicular, as of a body that was scaled first, the second where columns are, as of one that
/// was turned first.
template <class K, class S>
STRAHL_INLINE S most_stretch(const AffineKernel<K, S>& body) {
    const auto bound = [](const Vec3<S>& x, const Vec3<S>& y, const Vec3<S>& z) {
        const S xy = abs(dot(x, y)), yz = abs(dot(y, z)), zx = abs(dot(z, x));
        return max(dot(x, x) + xy + zx, max(dot(y, y) + xy + yz, dot(z, z) + yz + zx));
    };
    const Vec3<S>&x = body.row_x, &y = body.row_y, &z = body.row_z;
    return S(1.001) * sqrt(min(bound(x, y, z), bound({x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z})));
}

/// Bounds the errors of a body's centre and space, as errors of positions in the world. Exact rows are R (1 + E) with E
/// no larger than slack.turn: they map a point to where R maps one that is moved by E of its distance from the centre.
template <class S, class K>
STRAHL_INLINE S own_error(const AffineKernel<K, S>& body, const Vec3<S>& from_centre, const Slack<Element<S>>& slack) {
    return S(slack.share) * (norm1(body.centre) + norm1(body.box.half)) +
           S(slack.turn) * sqrt(dot(from_centre, from_centre));
}

/// Bounds the span by that of K in its own space. Errors there are at most the largest stretch times those in the
/// world; that of the direction is relative to its length s there. Roundings: of R f, f has 1/2 unit and each row's
/// product 3/2, in all 3.1 of the largest stretch; the direction 2.6, 3 by its length and 1/2 where it is divided by s.
/// Distances there are s times those in the world; s has the relative error of the direction and 5/4 units.
template <class S, class K>
requires KnownInOwnSpace<K, S>
[[gnu::noinline]] auto span_bounds(const AffineKernel<K, S>& body, const Ray<S>& ray, const Doubt<S>& doubt,
                                   const S& start, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    constexpr auto inf = SpanBounds<S>::inf;
    const auto local = body.to_local(ray);
    const Vec3<S> f = ray.origin - body.centre;
    const S most = most_stretch(body), rounding = S(3.5 * u) * sqrt(dot(f, f));
    const S away = S(1.02) * most * (doubt.away + own_error<S>(body, f, slack) + rounding);
    const S turn = S(1.02) * most / local.stretch * (doubt.turn + S(slack.turn + 6.5 * u));
    const auto span = span_bounds(body.shape, local.ray, Doubt<S>{away, turn}, start, slack);
    const S inverse = S(1) / local.stretch, error = turn + S(4 * u);
    const S less = inverse * (S(1) - error), more = inverse * (S(1) + error);
    const Mask<S> told = turn < S(.01);
    const auto low = [&](const S& t) { return select(told, t * select(t > S(0), less, more), S(-inf)); };
    const auto high = [&](const S& t) { return select(told, t * select(t > S(0), more, less), S(inf)); };
    const SpanBounds<S> own{low(span.near_low),  high(span.near_high),        low(span.far_low),
                            high(span.far_high), Mask<S>(span.maybe | !told), Mask<S>(span.sure & told)};
    if constexpr (requires { span.later; })
        return FirstBounds<S>{own, low(span.later)};
    else
        return own;
}

/// Bounds the span in one body, the same in all lanes, by the function above: its code is too long to be compiled for
/// that once more.
template <class S, template <class> class K>
requires(!std::is_same_v<S, Element<S>>) STRAHL_INLINE
    auto span_bounds(const AffineKernel<K<Element<S>>, Element<S>>& body, const Ray<S>& ray, const Doubt<S>& doubt,
                     const S& start, const Slack<Element<S>>& slack) {
    return span_bounds(splat_item<AffineKernel<K<S>, S>, S>(body), ray, doubt, start, slack);
}

/// A point p in the body's own space, and the point found for it on the surface there.
///
/// The exact surface is no further from p there than `residual`, by which p was moved, with its rounding error, and
/// `off_found`, the error of the point that it was moved to. Distances there grow by `steep` = |R^T n| for each length
/// along the normal in the world, n being the normal there. `moved` is the error of the space, and `off` bounds how far
/// p is from the exact surface in the world.
template <class K, class S>
struct OwnPoint {
    SurfacePoint<S> found;
    Vec3<S> normal;  // in the world, of length `steep`
    S most, steep, moved, off_found, residual, off;

    STRAHL_INLINE OwnPoint(const AffineKernel<K, S>& body, const Vec3<S>& p, const S& face,
                           const Slack<Element<S>>& slack) {
        const Vec3<S> f = p - body.centre, own = body.to_local(f);
        const Vec3<S> any(S(1), S(0), S(0));
        found = body.shape.at(Ray<S>{own, any, S(-1)}, S(0), face);
        normal = fma(found.normal.x, body.row_x, fma(found.normal.y, body.row_y, scale(found.normal.z, body.row_z)));
        most = most_stretch(body), steep = sqrt(dot(normal, normal));
        const Vec3<S> way = found.position - own;
        off_found = off_surface(body.shape, found.position, slack);
        moved = own_error<S>(body, f, slack);
        residual = sqrt(dot(way, way)) + S(3.5 * unit_error<S>) * most * sqrt(dot(f, f));
        off = moved + S(1.02) * (residual + off_found) / steep;
    }
    /// Bounds the square of the factor by which lengths along the surface grow, the larger singular value of R there:
    /// the sum of both squares is known, and the product of both values is |det R| / |R^T n|. In narrow spaces det R is
    /// hardly known, and counts as 0.
    STRAHL_INLINE S most_along(const AffineKernel<K, S>& body) const {
        const Vec3<S>&x = body.row_x, &y = body.row_y, &z = body.row_z;
        const S xx = dot(x, x), yy = dot(y, y), zz = dot(z, z), all = xx + yy + zz;
        const Vec3<S> across = body.to_local(scale(S(1) / steep, normal));
        const S sum = max(all - dot(across, across), S(0)) + S(16 * unit_error<S>) * all;
        const S volume = dot(x, cross(y, z)), square = volume * volume;
        const S product = select(square > S(1e-6f) * xx * yy * zz, square / (steep * steep), S(0));
        return S(.505f) * (sum + sqrt(max(fma(sum, sum, S(-4) * product), S(0))));
    }
};
template <class S, class K>
STRAHL_INLINE S off_surface(const AffineKernel<K, S>& body, const Vec3<S>& p, const S& face,
                            const Slack<Element<S>>& slack) {
    return OwnPoint<K, S>(body, p, face, slack).off;
}

/// Bounds the errors of a point. The kernel does not put it onto the surface, so its distance from that is measured in
/// the body's own space.
///
/// A curvature k there is one of k |R v|^2 / |R^T n| along a unit vector v here, a twentieth more nearby, since R^T n
/// changes as the normal does. A turn of the normal there is one of at most |R| / |R^T n| times that here. The error of
/// the surface's nearest point counts in all directions, not only along the surface. Roundings: 3 units each of the
/// normal there, whose length is off too, and of the normal here.
template <class S, class K>
requires KnownInOwnSpace<K, S>
[[gnu::noinline]] PointBounds<S> point_bounds(const AffineKernel<K, S>& body, const Ray<S>& ray, const Doubt<S>& doubt,
                                              const S& t, const SurfacePoint<S>& point, const S& face,
                                              const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    const OwnPoint<K, S> own(body, point.position, face, slack);
    const Bend<S> bend = bend_of(body.shape, own.found.position, face, own.off_found, slack);
    const S k = S(1.05) * bend.curvature * own.most_along(body) / own.steep;
    const S widest = own.most / own.steep, across = S(1.1) * bend.curvature * own.most * widest;
    const S side = select(dot(own.normal, point.normal) < S(0), S(-1), S(1));
    const S wrong = norm1(fma(side, point.normal, scale(S(-1) / own.steep, own.normal)));
    const S turned = S(Element<S>(1.01f) * slack.turn + 3 * u) + wrong + S(1.02) * widest * (bend.turned + S(3 * u)) +
                     (S(1.1) * k + across) * own.off;
    PointBounds<S> known = point_bounds(ray, doubt, t, point, own.off, k, turned);
    const S edge = own.residual + own.off_found + S(1.02) * own.most * (known.away + own.moved);
    known.sure = known.sure & on_face(body.shape, own.found.position, face, edge) & (S(slack.turn) < S(1e-3f));
    return known;
}

}  // namespace strahl::inline STRAHL_LEVEL

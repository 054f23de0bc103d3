// The body that a contour makes when it turns about an axis.
#pragma once
#include <limits>

#include "scene/kinds/prism.h"
#include "scene/kinds/turning.h"

namespace strahl {

/// A lathe, whose contours turn about the y axis of its own space. Face i is the surface of piece i.
template <class T>
struct LatheKernel : ContourKernel<T> {
    static constexpr int caps = 0;
    static constexpr bool in_double = true;  // wants lines as doubles, for zeros of high degree lose half of the digits
    using Base = ContourKernel<T>;
    using Base::box, Base::centre, Base::count, Base::row_x, Base::row_y, Base::row_z, Base::turn;

    int face_count() const { return static_cast<int>(count); }

    /// As for a prism, but crossings behind the start may be left out. V has doubles, or more digits.
    template <class V, class PieceOf, class Crossed>
    STRAHL_INLINE void each_crossing(const ContourPiece<T>* pieces, const PieceOf&, const Ray<V>& ray, V start,
                                     Mask<V> lanes, const Crossed& crossed) const {
        using R = Element<V>;
        const V zero(0), one(1), infinite(std::numeric_limits<R>::infinity());
        Mask<V> starts = lanes & (start >= zero) & (start < V(count));
        lanes = lanes & (starts | box.may_meet(ray));
        if (none(lanes)) return;
        const auto [nearest, unit, shift, per] = this->own_line(ray, starts);
        const auto line = LineAroundAxis<V>::of(nearest, unit);
        lanes = lanes & (starts | line.meets(V(R(1.001)), V(R(1.001))));
        if (none(lanes)) return;
        const auto within = line.within(lanes, V(R(1.001)), R(.001));
        // A ray that starts on a piece leaves out the place nearest to its start, on this piece or else another:
        // rounding may have moved the start over an edge.
        const auto size = [](const auto& v) { return abs(v.x) + abs(v.y) + abs(v.z); };
        const V tolerance = V(32 * R(std::numeric_limits<T>::epsilon())) *
                            (one + V(R(size(row_x)) + R(size(row_y)) + R(size(row_z))) * size(ray.origin));
        const Mask<V> stays = starts;
        for (int pass = any(starts) ? 0 : 1; pass < 2; ++pass)
            for (int i = 0; i < static_cast<int>(count); ++i) {
                if (!within.may_hold(pieces[i])) continue;
                const Mask<V> here = start == V(static_cast<R>(i)),
                              own = lanes & (pass == 0 ? stays & here : !(stays & here));
                if (none(own)) continue;
                TurnedPlaces<V> places = cross_turned(pieces[i].template as<R>(), line, own);
                if (any(starts & own)) {
                    V nearest = infinite;
                    for (const V& place : places) nearest = min(abs(place), nearest);
                    const V limit = pass == 0 ? V(4) * sqrt(tolerance) : tolerance;
                    Mask<V> left_out = starts & own & (nearest < limit);
                    starts = starts & !left_out;
                    for (V& place : places) {
                        const Mask<V> now = left_out & (abs(place) == nearest);
                        place = select(now, infinite, place), left_out = left_out & !now;
                    }
                }
                for (const V& place : places) {
                    const Mask<V> known = own & (place < infinite);
                    if (none(known)) continue;
                    const V t = (place + shift) * per;
                    const Mask<V> there = known & (stays | box.holds(ray, t, abs(t)));
                    if (any(there)) crossed(there, t, V(static_cast<R>(i)));
                }
            }
    }
    /// Returns the points and the normals of pieces at `t`.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const ContourPiece<S>& piece, const Ray<S>& ray, S t, S) const {
        const S zero(0), one(1), two(2), least(std::numeric_limits<Element<S>>::min());
        const Vec3<S> position = fma(t, ray.direction, ray.origin), p = turn(position - splat<S>(centre));
        const S radius = sqrt(fma(p.x, p.x, p.z * p.z)), per = one / max(radius, least);
        // Turns points to the other side where a contour is beyond the axis.
        const auto off = [&](const S& place, const S& x) {
            const S u = fma(place, fma(two, piece.hx, place * fma(place, piece.dx, piece.ex)), piece.ax) - x;
            const S v = fma(place, fma(two, piece.hy, place * fma(place, piece.dy, piece.ey)), piece.ay) - p.y;
            return fma(u, u, v * v);
        };
        const S here = piece.nearest(radius, p.y), there = piece.nearest(-radius, p.y);
        const Mask<S> behind = off(there, -radius) < off(here, radius);
        const auto [out, up] = piece.way_at(select(behind, there, here));
        const S across = select(behind, -up, up) * per;
        const Mask<S> none_known = (up == zero) & (out == zero);
        return {position, this->normal(across * p.x, select(none_known, one, -out), across * p.z)};
    }
};

/// The surface that contours make when they turn about the y axis: x is the distance from the axis. It is closed if its
/// contours are, or end on the axis.
struct Lathe {
    std::shared_ptr<const ContourData> data = usual();

    bool operator==(const Lathe& other) const { return data == other.data || data->contours == other.data->contours; }

    static constexpr const char* name = "lathe";
    static constexpr int faces = 0, max_crossings = 4;  // each has faces of its own number
    static constexpr bool bounded = true, convex = false, closed = false, hot = false, arguments_move = false;
    static constexpr auto fields = std::make_tuple();
    static std::shared_ptr<const ContourData> usual();

    const char* fault() const { return data->pieces.empty() ? "it has no surface" : nullptr; }
    bool open() const;
    Box bounds() const;
    bool contains(const DVec3& p) const;
    int face_count() const { return static_cast<int>(data->pieces.size()); }

    template <class T>
    using Kernels = std::tuple<LatheKernel<T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        emit(LatheKernel<T>{
            ContourKernel<T>::of({0, data->centre[1], 0}, DVec3(data->unit), bounds(), data->pieces.size(), to_world)});
    }
};

}  // namespace strahl

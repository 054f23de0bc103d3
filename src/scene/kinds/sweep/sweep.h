// The body that a ball of varying radius fills on its way along a curve.
#pragma once
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "scene/kinds/capsule.h"
#include "scene/kinds/prism.h"
#include "scene/kinds/sweep/swept_line.h"

namespace strahl {

/// Balls that lead a curve, and the curve's pieces in a space of their own, in which all is between -1 and 1: there p
/// is at (p - centre) / unit. Each four balls in a row make a piece.
struct SweepData {
    static constexpr int group = 16;  // each of so many pieces in a row has a ball around them

    std::vector<SweptBall> balls;
    std::vector<SweepPiece> pieces;
    Box box;  // around all that is swept
    DVec3 centre{0};
    double unit = 1;

    explicit SweepData(std::vector<SweptBall> all);
    /// Is a point in one of the balls?
    bool contains(const DVec3& p) const;
    /// A wave.
    static std::shared_ptr<const SweepData> usual();
};

/// A sweep, whose own space reaches from -1 to 1. It has one face. Numbers are doubles, or have more digits.
template <class T>
struct SweepKernel : ContourKernel<T> {
    static constexpr bool in_double = true;
    using Base = ContourKernel<T>;
    using Base::box, Base::centre, Base::count, Base::row_x, Base::row_y, Base::row_z, Base::turn;

    static constexpr int face_count() { return 1; }

    /// Calls crossed(lanes, t, face) where rays cross the surface ahead of their starts, from near to far, perhaps only
    /// `enough` times for each ray. Those at a start on the surface are left out: the place nearest to it is taken for
    /// it, as rounding may have moved the start.
    template <class V, class Crossed>
    STRAHL_INLINE void each_crossing(const SweepPiece* pieces, int enough, const Ray<V>& ray, V start, Mask<V> lanes,
                                     const Crossed& crossed) const {
        using R = Element<V>;
        const V zero(0);
        const Mask<V> starts = lanes & (start == zero);
        lanes = lanes & (starts | box.may_meet(ray));
        if (none(lanes)) return;
        const OwnLine<V> line = this->own_line(ray, starts);
        const auto size = [](const auto& v) __attribute__((always_inline)) { return abs(v.x) + abs(v.y) + abs(v.z); };
        const V rounding = V(32 * R(std::numeric_limits<T>::epsilon())) *
                           (V(1) + V(R(size(row_x)) + R(size(row_y)) + R(size(row_z))) * size(ray.origin));
        const V limit = select(starts, V(4) * sqrt(rounding), V(-1));
        const auto meets = [&](const DVec3& middle, double reach) __attribute__((always_inline)) {
            const Vec3<V> away = splat<V>(middle) - line.nearest;
            const V along = dot(away, line.unit), most(R(reach * (1 + 1e-9)));
            return lanes & (dot(away, away) - along * along < most * most) &
                   (along + most + line.shift > -max(limit, zero));
        };
        SweptSpans<V> spans;
        for (int i = 0; i < static_cast<int>(count); ++i) {
            const SweepPiece& piece = pieces[i];
            if (i % SweepData::group == 0 && none(meets(piece.group_middle, piece.group_reach))) {
                i += SweepData::group - 1;
                continue;
            }
            const Mask<V> own = meets(piece.middle, piece.reach);
            if (none(own)) continue;
            if constexpr (width < V >> 1)
                call_sweep_along<V>(piece, line.nearest, line.unit, own, spans);
            else
                sweep_along<V>(piece, line.nearest, line.unit, own, spans);
        }
        for (int k = 0; k < width<V>; ++k) {
            const auto& list = spans.lists[static_cast<std::size_t>(k)];
            const Mask<V> own = first_lanes<V>(k + 1) & !first_lanes<V>(k);
            const auto place_of = [&](int i) __attribute__((always_inline)) {
                return i % 2 ? list.far[i / 2] : list.near[i / 2];
            };
            int itself = -1;  // where the ray starts
            R nearest = lane(limit, k);
            for (int i = 0; i < 2 * list.count; ++i)
                if (const R off = abs(place_of(i)); off < nearest) nearest = off, itself = i;
            int ahead = 0;
            for (int i = 0; i < 2 * list.count && ahead < enough; ++i) {
                if (i == itself) continue;
                const V t = (V(place_of(i)) + line.shift) * line.per;
                const Mask<V> there = own & (starts | box.holds(ray, t, abs(t)));
                if (none(there)) continue;
                ahead += lane(t, k) > 0;
                crossed(there, t, zero);
            }
        }
    }
    /// Returns the point of one ray at `t`, and the normal there: away from the centre of the ball that made it.
    STRAHL_INLINE SurfacePoint<T> at(const SweepPiece* pieces, const Ray<T>& ray, T t) const {
        using R = std::conditional_t<std::is_same_v<T, float>, double, T>;
        const Vec3<T> position = fma(t, ray.direction, ray.origin), p = turn(position - splat<T>(centre));
        const Vec3<R> own(R(p.x), R(p.y), R(p.z));
        DeepestBall<R> ball;
        visit_near(pieces, static_cast<int>(count), own, R(1e-3), ball);
        const R length = sqrt(dot(ball.out, ball.out)), per = length > 0 ? 1 / length : R(0);
        return {position, this->normal(T(per * ball.out.x), T(per * ball.out.y), T(per * ball.out.z))};
    }

    /// Looks for the deepest ball among those of pieces that come within `off` of a point.
    template <class R>
    STRAHL_INLINE static void visit_near(const SweepPiece* pieces, int count, const Vec3<R>& p, R off,
                                         DeepestBall<R>& ball) {
        const auto reaches = [&](const DVec3& middle, double reach) __attribute__((always_inline)) {
            const Vec3<R> away = splat<R>(middle) - p;
            return dot(away, away) < (R(reach) + off) * (R(reach) + off);
        };
        for (int i = 0; i < count; ++i) {
            if (i % SweepData::group == 0 && !reaches(pieces[i].group_middle, pieces[i].group_reach)) {
                i += SweepData::group - 1;
                continue;
            }
            if (reaches(pieces[i].middle, pieces[i].reach)) ball.visit(pieces[i], p);
        }
    }
};

/// All points in the ball on its way: along a cubic spline through all balls but the first and the last, as E. Catmull
/// and R. Rom have it ("A class of local interpolating splines", 1974), or along a B-spline towards them.
struct SphereSweep {
    std::shared_ptr<const SweepData> data = SweepData::usual();

    bool operator==(const SphereSweep& other) const { return data == other.data || data->balls == other.data->balls; }

    static constexpr const char* name = "sphere_sweep";
    static constexpr int faces = 1, max_crossings = 4;  // of each piece
    static constexpr bool bounded = true, convex = false, closed = false, hot = false, arguments_move = false;
    static constexpr auto fields = std::make_tuple();

    const char* fault() const;
    bool open() const { return false; }
    Box bounds() const { return data->box; }
    bool contains(const DVec3& p) const { return data->contains(p); }
    /// Capsules along chords of its curve, whose arcs are no further from them than a quarter of its radius there.
    std::vector<Capsule> capsules() const;
    static constexpr int face_count() { return 1; }

    template <class T>
    using Kernels = std::tuple<SweepKernel<T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        emit(SweepKernel<T>{
            ContourKernel<T>::of(data->centre, DVec3(data->unit), bounds(), data->pieces.size(), to_world)});
    }
};

}  // namespace strahl

// The body that a contour makes when it turns about an axis.
#pragma once
#include <type_traits>

#include "scene/kinds/prism.h"
#include "scene/kinds/turning.h"

namespace strahl {

/// A lathe, whose contours turn about the y axis of its own space. Face i is the surface of piece i.
template <class T>
struct LatheKernel : ContourKernel<T> {
    static constexpr int caps = 0;
    using Base = ContourKernel<T>;
    using Base::box, Base::centre, Base::count, Base::row_x, Base::row_y, Base::row_z, Base::turn;
    using R = std::conditional_t<sizeof(T) == 4, double, T>;

    /// As for a prism, but for one ray after the other, and crossings behind the start may be left out. In every number
    /// type but long double it is computed in double.
    template <class S, class PieceOf, class Crossed>
    STRAHL_INLINE void each_crossing(const ContourPiece<T>* pieces, const PieceOf&, const Ray<S>& ray, S start,
                                     Mask<S> lanes, const Crossed& crossed) const {
        lanes = lanes & (((start >= S(0)) & (start < S(count))) | box.may_meet(ray));
        for (int k = 0; k < width<S> && any(lanes); ++k) {
            const Mask<S> own = lanes & only(start, k);
            if (none(own)) continue;
            const auto pick = [k](const Vec3<S>& v) { return Vec3<T>(one_of(v.x, k), one_of(v.y, k), one_of(v.z, k)); };
            const T face = one_of(start, k);
            const bool starts_here = face >= 0 && face < count;
            const Mask<S> stays(starts_here ? own : own & !own);
            each_crossing<S>(
                pieces, pick(ray.origin), pick(ray.direction),
                starts_here ? static_cast<int>(face) : -1, [&](R place, int i) __attribute__((always_inline)) {
                    const S t(static_cast<T>(place));
                    const Mask<S> there = own & (stays | box.holds(ray, t, abs(t)));
                    if (any(there)) crossed(there, t, S(static_cast<T>(i)));
                });
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

  private:
    /// Returns lane k, and the mask of this lane.
    template <class S>
    STRAHL_INLINE static T one_of(const S& a, int k) {
        if constexpr (strahl::width<S> > 1)
            return lane(a, k);
        else
            return a;
    }
    template <class S>
    STRAHL_INLINE static Mask<S> only(const S&, int k) {
        if constexpr (strahl::width<S> > 1)
            return with_lane(S(T(0)), k, T(1)) > S(T(0));
        else
            return true;
    }
    /// Calls visit(t, i) where a ray crosses the surface of piece i. It may start on that of piece `own`.
    template <class S, class Visit>
    STRAHL_INLINE void each_crossing(const ContourPiece<T>* pieces, const Vec3<T>& origin, const Vec3<T>& direction,
                                     int own, const Visit& visit) const {
        const auto turned = [this](const Vec3<T>& v, const Vec3<T>& from) {
            const R x = R(v.x) - R(from.x), y = R(v.y) - R(from.y), z = R(v.z) - R(from.z);
            const auto along = [&](const Vec3<T>& row) { return x * R(row.x) + y * R(row.y) + z * R(row.z); };
            return Vec3<R>(along(row_x), along(row_y), along(row_z));
        };
        const auto dot = [](const Vec3<R>& v, const Vec3<R>& w) { return v.x * w.x + v.y * w.y + v.z * w.z; };
        const Vec3<R> start = turned(origin, centre), way = turned(direction, Vec3<T>(0));
        const R per = 1 / std::sqrt(dot(way, way));
        const Vec3<R> unit(way.x * per, way.y * per, way.z * per);
        // Counts places from where the line is nearest to the centre: there they have the most digits.
        const R shift = own >= 0 ? R(0) : -dot(start, unit);
        const auto line = LineAroundAxis<R>::of(
            Vec3<R>(start.x + shift * unit.x, start.y + shift * unit.y, start.z + shift * unit.z), unit);
        if (own < 0 && !line.meets(R(1.001), R(1.001))) return;
        // A ray that starts on a piece leaves out the place nearest to its start. Rounding may have made it cross
        // another piece there, or none.
        const auto size = [](const Vec3<T>& v) { return std::abs(R(v.x)) + std::abs(R(v.y)) + std::abs(R(v.z)); };
        const R tolerance =
            32 * R(std::numeric_limits<T>::epsilon()) * (1 + (size(row_x) + size(row_y) + size(row_z)) * size(origin));
        bool starts = own >= 0;
        for (int n = starts ? -1 : 0; n < static_cast<int>(count); ++n) {
            if (n == own) continue;
            const int i = n < 0 ? own : n;
            std::array<R, 6> places;
            int found = crossings<S>(pieces[i], line, places);
            if (starts && found > 0) {
                const auto size_less = [](R a, R b) { return std::abs(a) < std::abs(b); };
                R& nearest = *std::min_element(places.begin(), places.begin() + found, size_less);
                if (std::abs(nearest) < (i == own ? 4 * std::sqrt(tolerance) : tolerance))
                    nearest = places[--found], starts = false;
            }
            for (int m = 0; m < found; ++m) visit((places[m] + shift) * per, i);
        }
    }
    /// Calls a function with code of its own for packs: it is long, and the call costs little.
    template <class S>
    STRAHL_INLINE static int crossings(const ContourPiece<T>& piece, const LineAroundAxis<R>& line,
                                       std::array<R, 6>& places) {
        constexpr bool packed = strahl::width<S> != 1;
        if constexpr (packed)
            return call_crossings<S>(piece, line, places);
        else
            return cross_turned(piece, line, places);
    }
    template <class S>
    [[gnu::noinline]] static int call_crossings(const ContourPiece<T>& piece, const LineAroundAxis<R>& line,
                                                std::array<R, 6>& places) {
        return cross_turned(piece, line, places);
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

// The prism over a plane figure whose contours may be curved.
#pragma once
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>

#include "scene/kinds/affine.h"
#include "scene/kinds/contours.h"
#include "scene/kinds/field.h"

namespace strahl {

/// A line in the space of a body, by the place where it is nearest to the middle, or where it starts: there places have
/// the most digits. Places count from there, in that space's units; shift + place is how far from the origin they are,
/// and times `per` in the units of the ray.
template <class V>
struct OwnLine {
    Vec3<V> nearest, unit;
    V shift, per;
};

/// A body with contours, in a space of its own: own = rows * (world - centre). The world holds the pieces of all such
/// bodies, and those of this one are `count` from number `first` on.
template <class T>
struct ContourKernel {
    Vec3<T> centre, row_x, row_y, row_z;
    HitBox<T> box;
    T first, count;

    template <class V>
    STRAHL_INLINE Vec3<V> turn(const Vec3<V>& v) const {
        return {dot(splat<V>(row_x), v), dot(splat<V>(row_y), v), dot(splat<V>(row_z), v)};
    }
    /// Returns the lines of rays, which count from where these start in the lanes of `starts`.
    template <class V>
    STRAHL_INLINE OwnLine<V> own_line(const Ray<V>& ray, Mask<V> starts) const {
        const V zero(0), one(1);
        const Vec3<V> origin = turn(ray.origin - splat<V>(centre)), way = turn(ray.direction);
        const V per = one / sqrt(dot(way, way));
        const Vec3<V> unit = scale(per, way);
        const V shift = select(starts, zero, -dot(origin, unit));
        return {fma(shift, unit, origin), unit, shift, per};
    }
    /// Returns a normal in the world, of length 1.
    template <class S>
    STRAHL_INLINE Vec3<S> normal(const S& x, const S& y, const S& z) const {
        // Normals are transformed by the transposed inverse, whose rows these are.
        const Vec3<S> n = fma(x, splat<S>(row_x), fma(y, splat<S>(row_y), scale(z, splat<S>(row_z))));
        return scale(S(1) / sqrt(max(dot(n, n), S(std::numeric_limits<Element<S>>::min()))), n);
    }
    /// The kernel of a body whose own space has its origin at `centre` and units of `size`.
    static ContourKernel of(const DVec3& centre, const DVec3& size, const Box& bounds, std::size_t pieces,
                            const WorldTransform& to_world) {
        const glm::dmat3 inverse = glm::inverse(glm::dmat3(to_world.matrix));
        const auto row = [&](int i) {
            return cast<T>(DVec3(inverse[0][i], inverse[1][i], inverse[2][i]) / (size[i] * to_world.scale));
        };
        return {cast<T>(to_world.point(centre)),
                row(0),
                row(1),
                row(2),
                HitBox<T>::of(transformed(bounds, to_world.matrix), bounds, to_world),
                T(0),
                static_cast<T>(pieces)};
    }
};

/// A prism, whose figure is that of its pieces in its own space, where it reaches in z from -1 to 1. Face 0 is the
/// lower cap, face 1 the upper one, and 2 + i is the wall over piece i.
template <class T>
struct PrismKernel : ContourKernel<T> {
    T low = -1, high = 1;           // the z of the normals of its lower and its upper cap
    static constexpr int caps = 2;  // its faces before those of pieces
    using Base = ContourKernel<T>;
    using Base::box, Base::centre, Base::count, Base::row_x, Base::row_y, Base::turn;

    int face_count() const { return caps + static_cast<int>(count); }

    /// Calls crossed(lanes, t, face) for each crossing of rays with the surface, in any order; those at the start are
    /// at 0 or left out. What is inside along a ray follows from one list of crossings with the contours: walls and
    /// caps never contradict each other, and there is an even number of crossings. `pieces` are the prism's own;
    /// piece_of(face) returns those of walls, and of other faces any.
    template <class S, class PieceOf, class Crossed>
    STRAHL_INLINE void each_crossing(const ContourPiece<T>* pieces, const PieceOf& piece_of, const Ray<S>& ray, S start,
                                     Mask<S> lanes, const Crossed& crossed) const {
        constexpr T inf = std::numeric_limits<T>::infinity();
        const S zero(0), one(1);
        const Vec3<S> f = ray.origin - splat<S>(centre), d = ray.direction;
        const Mask<S> starts_here = (start >= zero) & (start < S(count) + S(2));
        // Counts distances from where the ray is nearest to the centre: there they have the most digits.
        const S shift = select(starts_here, zero, -dot(f, d));
        const Vec3<S> p = turn(fma(shift, d, f)), v = turn(d);
        const S across = sqrt(fma(v.x, v.x, v.y * v.y)), per = one / across;
        const Mask<S> upright = across == zero, level = v.z == zero;
        const PlaneLine<S> line{p.x, p.y, select(upright, one, v.x * per), select(upright, zero, v.y * per)};
        lanes = lanes & ((abs(p.z) < one) | Mask<S>(!level));
        if (none(lanes)) return;
        const S low = select(start == zero, zero, (S(-1) - p.z) / v.z);
        const S high = select(start == one, zero, (one - p.z) / v.z);
        const S enters = select(level, S(-inf), min(low, high)), leaves = select(level, S(inf), max(low, high));
        const S from = across * enters, to = across * leaves;
        const S twice = S(2) * abs(shift);
        const auto tell = [&](Mask<S> own, const S& t, const S& face) __attribute__((always_inline)) {
            own = own & (starts_here | box.holds(ray, t, abs(t) + twice));  // t is a sum with the shift
            if (any(own)) crossed(own, t, face);
        };
        Mask<S> begins_inside = lanes & !lanes, ends_inside = begins_inside, lost = begins_inside;
        const auto wall = [&](Mask<S> own, const S& w, const S& face) __attribute__((always_inline)) {
            const Mask<S> ahead = own & (w > from);
            begins_inside = either(begins_inside, ahead);
            ends_inside = either(ends_inside, Mask<S>(own & !(w < to)));
            tell(ahead & (w < to), fma(w, per, shift), face);
        };
        const Mask<S> on_wall = lanes & starts_here & (start > one);
        S tolerance(0);
        if (any(on_wall)) {
            tolerance =
                S(32 * std::numeric_limits<T>::epsilon()) * fma(S(size(row_x) + size(row_y)), size(ray.origin), one);
            lost = cross_own_piece(piece_of(start), line, start, on_wall, wall);
        }
        cross_contours(
            pieces, static_cast<int>(count), line,
            lanes, [&](Mask<S> own, const S& place, int i) __attribute__((always_inline)) {
                const S face(static_cast<T>(i + 2));
                const S w = select(lost & (abs(place) < tolerance), zero, place);
                wall(own & !(on_wall & (start == face)), w, face);
            });
        // A ray that is upright crosses no walls.
        ends_inside = (ends_inside & (from < to)) | (begins_inside & !(from < to));
        const Mask<S> up = v.z > zero;
        tell(lanes & begins_inside, enters + shift, select(up, zero, one));
        tell(lanes & ends_inside, leaves + shift, select(up, one, zero));
    }

    /// Returns the points and the normals of faces at `t`. `piece` is the wall's.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const ContourPiece<S>& piece, const Ray<S>& ray, S t, S face) const {
        const S zero(0);
        const Vec3<S> position = fma(t, ray.direction, ray.origin), p = turn(position - splat<S>(centre));
        const S s = piece.nearest(p.x, p.y);
        const Mask<S> cap = face < S(2);
        const auto [way_x, way_y] = piece.way_at(s);
        const S x = select(cap, zero, way_y), y = select(cap, zero, -way_x);
        const S z = select(cap, select(face == zero, S(low), S(high)), zero);
        return {position, this->normal(x, y, z)};
    }

  private:
    template <class V>
    STRAHL_INLINE static auto size(const V& v) {
        return abs(v.x) + abs(v.y) + abs(v.z);
    }
    /// Finds where rays that start on a wall cross it, at 0 and perhaps once more. Returns the lanes in which the line
    /// is seen to cross the piece beside it instead of this one, since it starts where these meet.
    template <class S, class Wall>
    STRAHL_INLINE Mask<S> cross_own_piece(const ContourPiece<S>& own, const PlaneLine<S>& line, const S& start,
                                          Mask<S> lanes, const Wall& wall) const {
        const S zero(0), one(1), two(2);
        const S from = line.across(own.ax - line.x, own.ay - line.y);
        const S to = line.across(own.cx - line.x, own.cy - line.y);
        const Mask<S> once = either(Mask<S>(from < zero), Mask<S>(to < zero));
        // The distance from the line at known + s is s (2 slope + s (bend + s third)): one zero is known.
        const S known = own.nearest(line.x, line.y), thrice = S(T(3)) * known;
        const auto [way_x, way_y] = own.way_at(known);
        const S bend_x = fma(thrice, own.dx, own.ex), bend_y = fma(thrice, own.dy, own.ey);
        const S slope = line.across(way_x, way_y), bend = line.across(bend_x, bend_y);
        const S third = line.across(own.dx, own.dy), square = fma(bend, bend, S(T(-8)) * third * slope);
        const S root = sqrt(max(square, zero)), sum = bend + select(bend < zero, -root, root);
        const auto within = [&](const S& s) { return Mask<S>((known + s >= zero) & (known + s <= one)); };
        const S near = S(T(-4)) * slope / sum, step = select(within(near), near, S(T(-.5)) * sum / third);
        const S other = known + step;
        const S place = step * fma(step, fma(step, line.along(own.dx, own.dy), line.along(bend_x, bend_y)),
                                   two * line.along(way_x, way_y));
        const Mask<S> again = within(step) & (square >= zero);
        const Mask<S> beside = once & again & (min(known, one - known) < min(other, one - other));
        wall(lanes & (once | again), select(beside, place, zero), start);
        wall(lanes & again & !once, place, start);
        return lanes & (beside | !(once | again));
    }
};

/// The points between two heights whose x and y are in a figure. It does not tell its inside by normals, which are on
/// the wrong side where contours cross each other: rays count the prisms that they are in.
struct Prism {
    double base = 0, top = 1;
    std::shared_ptr<const ContourData> data = ContourData::usual();
    /// Where the normals of both caps point, as in POV-Ray: up to z (1) or down (-1). 0: they point outwards.
    int caps = 0;

    bool operator==(const Prism& other) const {
        return base == other.base && top == other.top && caps == other.caps &&
               (data == other.data || data->contours == other.data->contours);
    }

    static constexpr const char* name = "prism";
    static constexpr int faces = 0, max_crossings = 4;  // each has faces of its own number, and is crossed by it
    static constexpr bool bounded = true, convex = false, closed = false, hot = false, arguments_move = false;
    static constexpr auto fields = std::make_tuple(Field{"base", &Prism::base, "the z of one cap"},
                                                   Field{"top", &Prism::top, "the z of the other one"});
    const char* fault() const {
        if (base == top) return "its base and its top have the same height";
        return data->pieces.empty() ? "it has no area" : nullptr;
    }
    bool open() const { return false; }
    Box bounds() const;
    bool contains(const DVec3& p) const;
    int face_count() const { return 2 + static_cast<int>(data->pieces.size()); }

    template <class T>
    using Kernels = std::tuple<PrismKernel<T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const auto& [x, y] = data->centre;
        const DVec3 middle(x, y, base / 2 + top / 2), size(data->unit, data->unit, std::abs(top - base) / 2);
        const auto normal = [&](int outwards) { return static_cast<T>(caps == 0 ? outwards : caps); };
        emit(PrismKernel<T>{ContourKernel<T>::of(middle, size, bounds(), data->pieces.size(), to_world), normal(-1),
                            normal(1)});
    }
};

}  // namespace strahl

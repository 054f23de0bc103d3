// The lumps of blobs, and where lines pass through them.
#pragma once
#include <cmath>
#include <limits>
#include <tuple>

#include "num/lanes.h"
#include "num/vec.h"
#include "scene/kinds/field.h"

namespace strahl {

/// A ball, or what is around a line. At a distance d from it, in a space of its own, its field is strength (1 - (d /
/// radius)^2)^2, and 0 beyond the radius. The axes of that space are x, y and z, of any length, and its origin is that
/// of the blob.
struct Lump {
    DVec3 from{0, 0, 0}, to{0, 0, 0};
    double radius = 1, strength = 1;
    DVec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    bool operator==(const Lump&) const = default;

    static constexpr auto fields = std::make_tuple(
        Field{"from", &Lump::from, "one end of the line in its middle"},
        Field{"to", &Lump::to, "the other end, or the same point for a ball"},
        Field{"radius", &Lump::radius, "how far from that line it reaches", Range::positive},
        Field{"strength", &Lump::strength, "what it adds in its middle; below 0 it takes away"},
        Field{"x axis", &Lump::x, "where <1, 0, 0> goes if the lump is stretched or turned about the blob's origin",
              Range::any, Given::optional},
        Field{"y axis", &Lump::y, "where <0, 1, 0> goes then", Range::any, Given::optional},
        Field{"z axis", &Lump::z, "where <0, 0, 1> goes then", Range::any, Given::optional});
};

/// A lump, or a part of one around a line: one half of a ball at each end, and the cylinder between. In a space of its
/// own, own = rows * (p - centre), it is from `low` to below `high` in z, and its field is strength q^2 where
/// q = 1 - x^2 - y^2 - round (z - end)^2 is above 0. Parts of a lump have one space: lines leave one where they enter
/// the next.
struct LumpPiece {
    DVec3 centre, row_x, row_y, row_z;
    double round, end, low, high, strength;
    DVec3 middle{0};    // centre of a ball around this piece and those after it
    double square = 0;  // square of that ball's radius

    template <class V>
    STRAHL_INLINE Vec3<V> turn(const Vec3<V>& v) const {
        return {dot(splat<V>(row_x), v), dot(splat<V>(row_y), v), dot(splat<V>(row_z), v)};
    }
    /// Returns q, or 0 outside, and how q changes along the axes.
    template <class V>
    STRAHL_INLINE V share(const Vec3<V>& p, Vec3<V>& slope) const {
        using R = Element<V>;
        const Vec3<V> own = turn(p - splat<V>(centre));
        const V zero(0), z = own.z - V(R(end)), q = V(1) - own.x * own.x - own.y * own.y - V(R(round)) * z * z;
        slope = scale(
            V(-2), fma(own.x, splat<V>(row_x), fma(own.y, splat<V>(row_y), scale(V(R(round)) * z, splat<V>(row_z)))));
        return select((q > zero) & (own.z >= V(R(low))) & (own.z < V(R(high))), q, zero);
    }
};

/// The parts of lines within a piece: from `enter` to `leave` their field is strength (most - bend (t - middle)^2)^2.
template <class V>
struct LumpSpan {
    V enter, leave, middle, most, bend, strength;

    /// Finds them for lines origin + t unit from t = `from` on; returns those that have one.
    STRAHL_INLINE Mask<V> find(const LumpPiece& piece, const Vec3<V>& origin, const Vec3<V>& unit, const V& from,
                               Mask<V> lanes) {
        using R = Element<V>;
        const Vec3<V> p = piece.turn(origin - splat<V>(piece.centre)), d = piece.turn(unit);
        const V zero(0), round(R(piece.round)), z = p.z - V(R(piece.end));
        bend = fma(d.x, d.x, fma(d.y, d.y, round * d.z * d.z));
        const Mask<V> bends = bend > V(std::numeric_limits<R>::min());
        middle = select(bends, -fma(p.x, d.x, fma(p.y, d.y, round * z * d.z)) / bend, zero);
        const Vec3<V> nearest = fma(middle, d, Vec3<V>(p.x, p.y, z));
        most = fma(-nearest.x, nearest.x, fma(-nearest.y, nearest.y, fma(-round * nearest.z, nearest.z, V(1))));
        lanes = lanes & (most > zero);
        if (none(lanes)) return lanes;
        const V half = select(bends, sqrt(max(most, zero) / bend), V(std::numeric_limits<R>::max()));
        enter = middle - half, leave = middle + half;
        if (piece.low > -std::numeric_limits<double>::infinity() ||
            piece.high < std::numeric_limits<double>::infinity()) {
            const Mask<V> level = d.z == zero;
            const V low = (V(R(piece.low)) - p.z) / d.z, high = (V(R(piece.high)) - p.z) / d.z;
            lanes = lanes & ((!level) | ((p.z >= V(R(piece.low))) & (p.z < V(R(piece.high)))));
            enter = select(level, enter, max(enter, min(low, high)));
            leave = select(level, leave, min(leave, max(low, high)));
        }
        enter = max(enter, from), strength = V(R(piece.strength));
        return lanes & (leave > enter);
    }
    /// Returns the most that the field is, if the strength is above 0.
    STRAHL_INLINE V highest() const {
        const V off = max(max(enter - middle, middle - leave), V(0)), share = fma(-bend * off, off, most);
        return strength * share * share;
    }
};

}  // namespace strahl

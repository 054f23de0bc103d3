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
        Field{"y axis", &Lump::y, "the same of <0, 1, 0>", Range::any, Given::optional},
        Field{"z axis", &Lump::z, "the same of <0, 0, 1>", Range::any, Given::optional});
};

/// A lump, or a part of one around a line: one half of a ball at each end, and the cylinder between. In a space of its
/// own, own = rows * (p - centre), it is from `low` to below `high` in z, and its field is strength q^2 where
/// q = 1 - x^2 - y^2 - round (z - end)^2 is above 0. Parts of a lump have one space: lines leave one where they enter
/// the next.
struct LumpPiece {
    DVec3 centre, row_x, row_y, row_z;
    double round, end, low, high, strength;
    DVec3 middle{0};    // of the ball around this piece and those after it
    double square = 0;  // of that ball's radius

    template <class V>
    STRAHL_INLINE Vec3<V> turn(const Vec3<V>& v) const {
        return {dot(splat<V>(row_x), v), dot(splat<V>(row_y), v), dot(splat<V>(row_z), v)};
    }
    /// Returns q, or 0 outside, and how q changes along the axes.
    template <class R>
    STRAHL_INLINE R share(const Vec3<R>& p, Vec3<R>& slope) const {
        const Vec3<R> own = turn(p - splat<R>(centre));
        const R z = own.z - R(end), q = R(1) - own.x * own.x - own.y * own.y - R(round) * z * z;
        if (!(q > 0 && own.z >= R(low) && own.z < R(high))) return R(0);
        slope = scale(R(-2),
                      fma(own.x, splat<R>(row_x), fma(own.y, splat<R>(row_y), scale(R(round) * z, splat<R>(row_z)))));
        return q;
    }
};

/// The part of a line within a piece: from `enter` to `leave` its field is strength (most - bend (t - middle)^2)^2.
template <class R>
struct LumpSpan {
    R enter, leave, middle, most, bend, strength;

    /// Finds it for the line origin + t unit from t = `from` on; false if there is none.
    STRAHL_INLINE bool find(const LumpPiece& piece, const Vec3<R>& origin, const Vec3<R>& unit, R from) {
        const Vec3<R> p = piece.turn(origin - splat<R>(piece.centre)), d = piece.turn(unit);
        const R round(piece.round), z = p.z - R(piece.end);
        bend = d.x * d.x + d.y * d.y + round * d.z * d.z;
        const bool level = !(bend > std::numeric_limits<R>::min());
        middle = level ? R(0) : -(p.x * d.x + p.y * d.y + round * z * d.z) / bend;
        const Vec3<R> nearest = fma(middle, d, Vec3<R>(p.x, p.y, z));
        most = R(1) - nearest.x * nearest.x - nearest.y * nearest.y - round * nearest.z * nearest.z;
        if (!(most > 0)) return false;
        const R half = level ? std::numeric_limits<R>::max() : std::sqrt(most / bend);
        enter = middle - half, leave = middle + half, strength = R(piece.strength);
        if (d.z == 0) {
            if (p.z < R(piece.low) || !(p.z < R(piece.high))) return false;
        } else {
            const R low = (R(piece.low) - p.z) / d.z, high = (R(piece.high) - p.z) / d.z;
            enter = max(enter, min(low, high)), leave = min(leave, max(low, high));
        }
        enter = max(enter, from);
        return leave > enter;
    }
};

}  // namespace strahl

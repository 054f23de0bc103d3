// The blob: lumps that melt into each other.
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <tuple>
#include <vector>

#include "num/memory.h"
#include "num/uninitialized.h"
#include "scene/kinds/blob/lump.h"
#include "scene/kinds/prism.h"
#include "scene/kinds/turning.h"

namespace strahl {

/// Lumps, and their pieces in a space of their own, in which those that add are between -1 and 1: there p is at (p -
/// centre) / unit.
struct BlobData {
    static constexpr int most_met = 1024;  // most pieces that a line passes through; it would miss others
    static constexpr int unlimited = std::numeric_limits<int>::max();
    static constexpr int group = 16;  // each of so many pieces, which are near each other, has a ball around them

    std::vector<Lump> lumps;
    std::vector<LumpPiece> pieces;
    Box box;  // around the lumps that add
    DVec3 centre{0};
    double unit = 1;

    explicit BlobData(std::vector<Lump> all);
    /// Returns the sum of all fields at a point.
    double field(const DVec3& p) const;
    /// Two balls.
    static std::shared_ptr<const BlobData> usual();
};

/// Calls found(t) where the sum of the fields of spans crosses `level`, in ascending order; it may leave out what comes
/// after `enough` of these. The sum is a polynomial of degree 4 between the places where a piece begins or ends.
/// It is compared with `level` there once for both sides, so that each line crosses a blob an even number of times.
/// Lines that `start` on the surface at 0 count from the sum there, which is rounded; its slope tells on which
/// side of it they go on.
template <class R, class Found>
STRAHL_INLINE void cross_spans(const LumpSpan<R>* spans, int count, R level, bool starts, int enough,
                               const Found& found) {
    struct End {
        R place;
        std::int16_t span;
        bool enters;
    };
    Room<End, 2 * BlobData::most_met> ends;
    Room<std::int16_t, BlobData::most_met> within;
    int length = 0, inside = 0, crossed = 0;
    R size = level;
    for (int i = 0; i < count; ++i) {
        size += std::abs(spans[i].strength);
        for (const bool enters : {true, false}) {
            const R place = enters ? spans[i].enter : spans[i].leave;
            int k = length++;
            for (; k > 0 && ends[k - 1].place > place; --k) ends[k] = ends[k - 1];
            ends[k] = {place, static_cast<std::int16_t>(i), enters};
        }
    }
    bool above = false, first = true;
    for (int i = 0; i + 1 < length && crossed < enough;) {
        const R low = ends[i].place;
        for (; i < length && ends[i].place == low; ++i) {
            if (ends[i].enters) {
                within[inside++] = ends[i].span;
                continue;
            }
            int k = 0;
            while (k < inside && within[k] != ends[i].span) ++k;
            if (k < inside) within[k] = within[--inside];
        }
        if (inside == 0 || i == length) {
            above = first = starts = false;
            continue;
        }
        // Counts x from -1 at this end to 1 at the next.
        const R high = ends[i].place, half = (high - low) / 2, middle = low + half;
        R p[5]{-level, 0, 0, 0, 0};
        for (int k = 0; k < inside; ++k) {
            const LumpSpan<R>& own = spans[within[k]];
            const R off = middle - own.middle, bent = own.bend * half, s = own.strength;
            const R a = own.most - own.bend * off * off, b = -2 * bent * off, c = -bent * half;
            p[0] += s * a * a, p[1] += 2 * s * a * b, p[2] += s * (b * b + 2 * a * c), p[3] += 2 * s * b * c;
            p[4] += s * c * c;
        }
        if (starts) {
            // Its zero at -1 is known, and divided out.
            level += p[0] - p[1] + p[2] - p[3] + p[4];
            const R third = p[4], second = p[3] - third, linear = p[2] - second;
            p[0] = p[1] - linear, p[1] = linear, p[2] = second, p[3] = third, p[4] = 0;
        }
        const R third = R(1) / 3;
        BernsteinPart<R> part{
            {p[0] - p[1] + p[2] - p[3] + p[4], p[0] - p[1] / 2 + p[3] / 2 - p[4], p[0] - third * p[2] + p[4],
             p[0] + p[1] / 2 - p[3] / 2 - p[4], p[0] + p[1] + p[2] + p[3] + p[4], 0, 0},
            R(-1),
            R(1),
            above,
            false,
            true};
        if (first) part.above_low = part.c[0] > 0;
        part.above_high = part.c[4] > 0;
        const R noise = 16 * std::numeric_limits<R>::epsilon() * size;
        above = part.above_high, first = starts = false;
        const auto& c = part.c;
        const R lowest = min(min(c[1], c[2]), c[3]), highest = max(max(c[1], c[2]), c[3]);
        if (part.above_low == above && (above ? lowest >= -noise : highest <= noise)) continue;
        const auto value = [&](const R& x) __attribute__((always_inline)) {
            return std::pair(p[0] + x * (p[1] + x * (p[2] + x * (p[3] + x * p[4]))),
                             p[1] + x * (2 * p[2] + x * (3 * p[3] + x * 4 * p[4])));
        };
        const auto find = [&](const BernsteinPart<R>& own) __attribute__((always_inline)) {
            const R place = middle + half * own.zero(4, value);
            crossed += place > ends[0].place;  // one there may be the start itself
            found(place);
        };
        isolate_zeros(
            part, 4, noise, [&](const R& x) __attribute__((always_inline)) { return value(x).first > 0; }, find);
    }
}

/// A blob, whose own space reaches from -1 to 1. It has one face. Numbers are doubles, or have more digits: a sum of
/// zeros of the fourth degree loses half of the digits.
template <class T>
struct BlobKernel : ContourKernel<T> {
    static constexpr bool in_double = true;
    using Base = ContourKernel<T>;
    using Base::box, Base::centre, Base::count, Base::turn;
    T threshold;

    static constexpr int face_count() { return 1; }

    /// Calls crossed(lanes, t, face) where rays cross the surface ahead of their starts, from near to far, perhaps only
    /// `enough` times for each ray; those at a start on the surface are left out.
    template <class V, class Crossed>
    STRAHL_INLINE void each_crossing(const LumpPiece* pieces, int enough, const Ray<V>& ray, V start, Mask<V> lanes,
                                     const Crossed& crossed) const {
        using R = Element<V>;
        const V zero(0), one(1);
        const Mask<V> starts = lanes & (start == zero);
        lanes = lanes & (starts | box.may_meet(ray));
        if (none(lanes)) return;
        const Vec3<V> origin = turn(ray.origin - splat<V>(centre)), way = turn(ray.direction);
        const V per = one / sqrt(dot(way, way));
        // Counts places from where the line is nearest to the centre: there they have the most digits.
        const Vec3<V> unit = scale(per, way);
        const V shift = select(starts, zero, -dot(origin, unit));
        const Vec3<V> middle = fma(shift, unit, origin);
        std::array<Room<int, BlobData::most_met>, width<V>> met;
        std::array<int, width<V>> counts{};
        for (int i = 0; i < static_cast<int>(count); ++i) {
            const LumpPiece& piece = pieces[i];
            if (i % BlobData::group == 0) {
                const Vec3<V> away = splat<V>(piece.middle) - middle;
                const V along = dot(away, unit);
                if (none(lanes & (dot(away, away) - along * along < V(R(piece.square))))) {
                    i += BlobData::group - 1;
                    continue;
                }
            }
            const Vec3<V> p = piece.turn(middle - splat<V>(piece.centre)), d = piece.turn(unit);
            const V round(R(piece.round)), z = round * (p.z - V(R(piece.end)));
            const V a = fma(d.x, d.x, fma(d.y, d.y, round * d.z * d.z)), b = fma(p.x, d.x, fma(p.y, d.y, z * d.z));
            const V c = fma(p.x, p.x, fma(p.y, p.y, z * z)) - one;
            for (unsigned left = bits(lanes & ((b * b > a * c) | (c < zero))); left; left &= left - 1) {
                const auto k = static_cast<std::size_t>(std::countr_zero(left));
                if (counts[k] < BlobData::most_met) met[k][counts[k]++] = i;
            }
        }
        for (int k = 0; k < width<V>; ++k) {
            const int most = counts[static_cast<std::size_t>(k)];
            if (most == 0) continue;
            const auto pick = [k](const Vec3<V>& v) { return Vec3<R>(lane(v.x, k), lane(v.y, k), lane(v.z, k)); };
            const Vec3<R> from = pick(middle), along = pick(unit);
            const R behind = -lane(shift, k);
            const Mask<V> own = first_lanes<V>(k + 1) & !first_lanes<V>(k);
            Places<R> places;
            int found;
            const int* const numbers = &met[static_cast<std::size_t>(k)][0];
            if constexpr (width < V >> 1)
                found = call_cross<V>(pieces, numbers, most, from, along, behind, any(own & starts), enough, places);
            else
                found = cross<R>(pieces, numbers, most, from, along, behind, any(own & starts), enough, places);
            for (int i = 0; i < found; ++i) {
                const V t = (V(places[i]) + shift) * per;
                const Mask<V> there = own & (starts | box.holds(ray, t, abs(t)));
                if (any(there)) crossed(there, t, zero);
            }
        }
    }
    /// Returns the point of one ray at `t`, and the normal there: where the field falls.
    STRAHL_INLINE SurfacePoint<T> at(const LumpPiece* pieces, const Ray<T>& ray, T t) const {
        using R = std::conditional_t<std::is_same_v<T, float>, double, T>;
        const Vec3<T> position = fma(t, ray.direction, ray.origin), p = turn(position - splat<T>(centre));
        const Vec3<R> own(R(p.x), R(p.y), R(p.z));
        Vec3<R> fall(0), slope;
        for (int i = 0; i < static_cast<int>(count); ++i) {
            if (i % BlobData::group == 0) {
                const Vec3<R> away = own - splat<R>(pieces[i].middle);
                if (!(dot(away, away) < R(pieces[i].square))) {
                    i += BlobData::group - 1;
                    continue;
                }
            }
            const R q = pieces[i].share(own, slope);
            if (q > 0) fall = fma(R(-pieces[i].strength) * q, slope, fall);
        }
        const R length = sqrt(dot(fall, fall)), per = length > 0 ? 1 / length : R(0);
        return {position, this->normal(T(per * fall.x), T(per * fall.y), T(per * fall.z))};
    }

  private:
    template <class R>
    using Places = Room<R, 8 * BlobData::most_met>;  // 4 between each two ends of pieces

    /// Finds where a line crosses the surface, from `behind` on, by the pieces that it meets; returns how often.
    template <class R>
    STRAHL_INLINE int cross(const LumpPiece* pieces, const int* numbers, int most, const Vec3<R>& from,
                            const Vec3<R>& along, R behind, bool starts, int enough, Places<R>& places) const {
        Room<LumpSpan<R>, BlobData::most_met> spans;
        int count = 0, found = 0;
        for (int i = 0; i < most; ++i) count += spans[count].find(pieces[numbers[i]], from, along, behind);
        cross_spans<R>(
            &spans[0], count, R(threshold), starts,
            enough, [&](R place) __attribute__((always_inline)) { places[found++] = place; });
        return found;
    }
    /// Does so by a call for packs: its code is long, and the call costs little.
    template <class V>
    [[gnu::noinline]] int call_cross(const LumpPiece* pieces, const int* numbers, int most,
                                     const Vec3<Element<V>>& from, const Vec3<Element<V>>& along, Element<V> behind,
                                     bool starts, int enough, Places<Element<V>>& places) const {
        return cross<Element<V>>(pieces, numbers, most, from, along, behind, starts, enough, places);
    }
};

/// All points where the fields of lumps add up to more than the threshold.
struct Blob {
    double threshold = .5;
    std::shared_ptr<const BlobData> data = BlobData::usual();

    bool operator==(const Blob& other) const {
        return threshold == other.threshold && (data == other.data || data->lumps == other.data->lumps);
    }

    static constexpr const char* name = "blob";
    static constexpr int faces = 1, max_crossings = 4;  // of each pair of lumps
    static constexpr bool bounded = true, convex = false, closed = false, hot = false, arguments_move = false;
    static constexpr auto fields =
        std::make_tuple(Field{"threshold", &Blob::threshold, "the sum of its lumps on its surface", Range::positive});

    const char* fault() const;
    bool open() const { return false; }
    Box bounds() const { return data->box; }
    bool contains(const DVec3& p) const { return data->field(p) > threshold; }
    static constexpr int face_count() { return 1; }

    template <class T>
    using Kernels = std::tuple<BlobKernel<T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        emit(BlobKernel<T>{
            ContourKernel<T>::of(data->centre, DVec3(data->unit), bounds(), data->pieces.size(), to_world),
            static_cast<T>(threshold)});
    }
};

}  // namespace strahl

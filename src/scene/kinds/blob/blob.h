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

/// Stretches of lines between places where pieces begin or end. There the sum of the fields less the level is a
/// polynomial in x, which is -1 at the one end and 1 at the other; `above_low` and `above_high` are 1 if it is above 0
/// there, else 0. The place on the line is middle + half x.
template <class V>
struct LumpStretch {
    std::array<V, 5> p;
    V middle, half, noise, above_low, above_high;

    /// Calls found(lanes, place) for each zero, of each line in ascending order.
    template <class Found>
    STRAHL_INLINE void each_zero(Mask<V> lanes, const Found& found) const {
        const V zero(0), half_one(Element<V>(.5)), third(Element<V>(1) / 3);
        const V even = p[0] + p[2] + p[4], odd = p[1] + p[3], inner = p[0] - p[4];
        const V slope = half_one * (p[1] - p[3]);
        const BernsteinPart<V> whole{{even - odd, inner - slope, p[0] - third * p[2] + p[4], inner + slope, even + odd},
                                     V(-1),
                                     V(1),
                                     above_low > zero,
                                     above_high > zero,
                                     lanes};
        const auto value = [&](const V& x) __attribute__((always_inline)) {
            return std::pair(fma(x, fma(x, fma(x, fma(x, p[4], p[3]), p[2]), p[1]), p[0]),
                             fma(x, fma(x, fma(x, V(4) * p[4], V(3) * p[3]), V(2) * p[2]), p[1]));
        };
        isolate_zeros(
            whole, 4, noise, [&](const V& x) __attribute__((always_inline)) { return value(x).first > V(0); },
            [&](const BernsteinPart<V>& own)
                __attribute__((always_inline)) { found(own.lanes, fma(half, own.zero(4, value), middle)); });
    }
};

/// Calls found(stretch) for the stretches of a line on which the sum of the fields of spans may cross `level`, in
/// ascending order; it may leave out what comes after `enough` crossings. The sum is compared with `level` once for
/// both sides of each place, so that each line crosses a blob an even number of times. Lines that `start` on the
/// surface at 0 count from the sum there, which is rounded; its slope tells on which side of it they go on.
template <class R, class Found>
STRAHL_INLINE void find_stretches(const LumpSpan<R>* spans, int count, R level, bool starts, int enough,
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
    const R noise = 16 * std::numeric_limits<R>::epsilon() * size;
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
        const R half = (ends[i].place - low) / 2, middle = low + half;
        std::array<R, 5> p{-level, 0, 0, 0, 0};
        for (int k = 0; k < inside; ++k) {
            const LumpSpan<R>& own = spans[within[k]];
            const R off = middle - own.middle, bent = own.bend * half, s = own.strength;
            const R a = own.most - own.bend * off * off, b = -2 * bent * off, c = -bent * half;
            p[0] += s * a * a, p[1] += 2 * s * a * b, p[2] += s * (b * b + 2 * a * c), p[3] += 2 * s * b * c;
            p[4] += s * c * c;
        }
        const bool started = starts;
        if (starts) {
            // The zero of the polynomial at -1 is known, and divided out.
            level += p[0] - p[1] + p[2] - p[3] + p[4];
            const R third = p[4], second = p[3] - third, linear = p[2] - second;
            p = {p[1] - linear, linear, second, third, 0};
        }
        // Bernstein's coefficients: where none of them is on the other side, nor is the polynomial.
        const R even = p[0] + p[2] + p[4], odd = p[1] + p[3], inner = p[0] - p[4], slope = R(.5) * (p[1] - p[3]);
        const R centre = p[0] - R(1) / 3 * p[2] + p[4], next = inner - slope, last = inner + slope;
        const bool before = first ? even - odd > 0 : above;
        above = even + odd > 0, first = starts = false;
        const R lowest = min(min(next, centre), last), highest = max(max(next, centre), last);
        if (before == above && (above ? lowest >= -noise : highest <= noise)) continue;
        found(LumpStretch<R>{p, middle, half, noise, R(before), R(above)});
        crossed += before != above && !started;  // of a stretch from the start on it may be the start itself
    }
}

/// Keeps such stretches side by side, of the lines of a pack S of rays, line by line.
template <class S>
struct LumpStretches {
    using V = Doubles<S>;
    using R = Element<V>;
    static constexpr int few = 2 * width<S>, most = few + 2 * BlobData::most_met;
    static constexpr int fields = sizeof(LumpStretch<R>) / sizeof(R);
    alignas(64) Room<R, fields*(most + width<V>)> columns;
    Room<std::int8_t, most> rays;
    int count = 0;
    alignas(64) R shift[width<S>], per[width<S>];  // of the rays: t = (place + shift) per
    // Crossings of rays with some of these lumps; a row holds at most one crossing of each ray.
    alignas(64) R rows[4 * width<V>][width<S>];
    unsigned crossed[4 * width<V>];

    STRAHL_INLINE void add(const LumpStretch<R>& own, int ray) {
        const auto values = std::bit_cast<std::array<R, fields>>(own);
        for (int f = 0; f < fields; ++f) columns[f * (most + width<V>)+count] = values[f];
        rays[count++] = static_cast<std::int8_t>(ray);
    }
    /// Finds the crossings of `width<V>` stretches from `first` on, in ascending order; returns the number of rows.
    STRAHL_INLINE int find_rows(int first) {
        const int own_count = std::min(count - first, width<V>);
        const auto own = load_items<LumpStretch<V>, V>(&columns[0], most + width<V>, first);
        R places[width<V>][4];
        int found[width<V>] = {};
        own.each_zero(first_lanes<V>(own_count), [&](Mask<V> lanes, const V& place) {
            for (unsigned left = bits(lanes); left; left &= left - 1) {
                const int i = std::countr_zero(left);
                if (found[i] < 4) places[i][found[i]++] = lane(place, i);
            }
        });
        int rank[width<S>] = {}, all = 0;
        for (int i = 0; i < own_count; ++i)
            for (int n = 0; n < found[i]; ++n) {
                const int ray = rays[first + i], row = rank[ray]++;
                if (row == all) {
                    for (R& t : rows[row]) t = 0;
                    crossed[all++] = 0;
                }
                rows[row][ray] = (places[i][n] + shift[ray]) * per[ray], crossed[row] |= 1U << ray;
            }
        return all;
    }
    /// Do so by a call for packs: the code is long, and the call costs little.
    template <class Own>
    [[gnu::noinline]] static int call_find_rows(LumpStretches<Own>& all, int first) {
        return all.find_rows(first);
    }
};

/// A blob, whose own space reaches from -1 to 1. It has one face. Numbers are doubles, or have more digits: a sum of
/// zeros of the fourth degree loses half of the digits.
template <class T>
struct BlobKernel : ContourKernel<T> {
    using Base = ContourKernel<T>;
    using Base::box, Base::centre, Base::count, Base::turn;
    T threshold;

    static constexpr int face_count() { return 1; }

    /// Calls crossed(lanes, t, face) where rays cross the surface ahead of their starts, from near to far, perhaps only
    /// `enough` times for each ray; those at a start on the surface are left out.
    template <class S, class Crossed>
    STRAHL_INLINE void each_crossing(const LumpPiece* pieces, int enough, const Ray<S>& ray, S start, Mask<S> lanes,
                                     const Crossed& crossed) const {
        using V = Doubles<S>;
        const Mask<S> starts = lanes & (start == S(0));
        lanes = lanes & (starts | box.may_meet(ray));
        if (none(lanes)) return;
        LumpStretches<S> stretches;
        const auto visit = [&]() {
            for (int first = 0; first < stretches.count; first += width<V>) {
                int rows;
                if constexpr (width < S >> 1)
                    rows = stretches.call_find_rows(stretches, first);
                else
                    rows = stretches.find_rows(first);
                for (int row = 0; row < rows; ++row) {
                    const S t = load_converted<S>(stretches.rows[row]);
                    const Mask<S> there = mask_of<S>(stretches.crossed[row]) & (starts | box.holds(ray, t, S(abs(t))));
                    if (any(there)) crossed(there, t, S(0));
                }
            }
            stretches.count = 0;
        };
        for (int part = 0; part < width<S> / width<V>; ++part) {
            const int first = part * width<V>;
            LineSpans<V> spans;
            const Mask<V> own_starts = mask_of<V>(bits(starts) >> first);
            const OwnLine<V> line =
                this->own_line(Ray<V>{doubles_of(ray.origin, part), doubles_of(ray.direction, part), V(0)}, own_starts);
            store_lanes(stretches.shift + first, line.shift), store_lanes(stretches.per + first, line.per);
            for (unsigned left = find_spans<V>(pieces, line.nearest, line.unit, -line.shift, own_starts,
                                               mask_of<V>(bits(lanes) >> first), spans);
                 left; left &= left - 1) {
                if (stretches.count >= stretches.few) visit();
                const int k = std::countr_zero(left);
                const bool on = any(own_starts & first_lanes<V>(k + 1) & !first_lanes<V>(k));
                if constexpr (width < V >> 1)
                    call_add_stretches<S>(spans, k, first + k, on, enough, stretches);
                else
                    add_stretches<S>(spans, k, first + k, on, enough, stretches);
            }
        }
        visit();
    }
    /// Returns the points of rays at `t`, and the normals there: where the field falls.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const LumpPiece* pieces, const Ray<S>& ray, S t) const {
        using V = Doubles<S>;
        const Vec3<S> position = fma(t, ray.direction, ray.origin), p = turn(position - splat<S>(centre));
        Vec3<S> fall(S(0), S(0), S(0));
        for (int part = 0; part < width<S> / width<V>; ++part) {
            const Vec3<V> own = fall_at(pieces, doubles_of(p, part));
            for (int c = 0; c < 3; ++c) fall[c] = fall[c] + lanes_of<S>(own[c], part);
        }
        return {position, this->normal(fall.x, fall.y, fall.z)};
    }

  private:
    /// Returns in which direction the field falls, as vectors of length 1; 0 where it does not.
    template <class V>
    STRAHL_INLINE Vec3<V> fall_at(const LumpPiece* pieces, const Vec3<V>& p) const {
        using R = Element<V>;
        const V zero(0);
        Vec3<V> fall(zero, zero, zero), slope;
        for (int i = 0; i < static_cast<int>(count); ++i) {
            if (i % BlobData::group == 0) {
                const Vec3<V> away = p - splat<V>(pieces[i].middle);
                if (none(dot(away, away) < V(R(pieces[i].square)))) {
                    i += BlobData::group - 1;
                    continue;
                }
            }
            const V q = pieces[i].share(p, slope);
            fall = select(q > zero, fma(V(R(-pieces[i].strength)) * q, slope, fall), fall);
        }
        const V length = sqrt(dot(fall, fall));
        return scale(select(length > zero, V(1) / length, zero), fall);
    }
    /// The spans of a pack of lines in the pieces that any of them meets, and which of them do.
    template <class V>
    struct LineSpans {
        Room<LumpSpan<V>, BlobData::most_met> spans;
        Room<unsigned, BlobData::most_met> lines;
        int count = 0;
    };
    /// Finds them for lines from + t unit beyond `behind`; returns as bits those on which the sum may cross the
    /// threshold.
    template <class V>
    STRAHL_INLINE unsigned find_spans(const LumpPiece* pieces, const Vec3<V>& from, const Vec3<V>& unit,
                                      const V& behind, Mask<V> starts, Mask<V> lanes, LineSpans<V>& found) const {
        using R = Element<V>;
        V most(0);               // largest value that the sum can have
        Mask<V> falls = starts;  // from the start on
        for (int i = 0; i < static_cast<int>(count) && any(lanes); ++i) {
            const LumpPiece& piece = pieces[i];
            if (i % BlobData::group == 0) {
                const Vec3<V> away = splat<V>(piece.middle) - from;
                const V along = dot(away, unit);
                if (none(lanes & (dot(away, away) - along * along < V(R(piece.square))))) {
                    i += BlobData::group - 1;
                    continue;
                }
            }
            LumpSpan<V>& span = found.spans[found.count];
            const Mask<V> own = span.find(piece, from, unit, behind, lanes);
            if (none(own) || found.count == BlobData::most_met - 1) continue;
            found.lines[found.count++] = bits(own);
            if (piece.strength > 0)
                most = select(own, most + span.highest(), most), falls = falls & ((span.middle <= span.enter) | !own);
            else
                falls = falls & !own;
        }
        return bits(lanes & !falls & (starts | (most > V(R(1 - 1e-9) * R(threshold)))));
    }
    /// Adds the stretches of line k of them that may cross the threshold, as those of a ray.
    template <class S>
    STRAHL_INLINE void add_stretches(const LineSpans<Doubles<S>>& all, int k, int ray, bool starts, int enough,
                                     LumpStretches<S>& found) const {
        using R = Element<Doubles<S>>;
        Room<LumpSpan<R>, BlobData::most_met> own;
        int number = 0;
        for (int i = 0; i < all.count; ++i) {
            if (!(all.lines[i] >> k & 1)) continue;
            const R* const lanes = reinterpret_cast<const R*>(&all.spans[i]) + k;
            own[number++] = of_fields<LumpSpan<R>, R>([&](std::size_t f) { return lanes[f * width<Doubles<S>>]; });
        }
        find_stretches<R>(&own[0], number, R(threshold), starts, enough,
                          [&](const LumpStretch<R>& stretch) { found.add(stretch, ray); });
    }
    template <class S>
    [[gnu::noinline]] void call_add_stretches(const LineSpans<Doubles<S>>& all, int k, int ray, bool starts, int enough,
                                              LumpStretches<S>& found) const {
        add_stretches<S>(all, k, ray, starts, enough, found);
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

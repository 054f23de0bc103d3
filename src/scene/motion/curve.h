// Smooth curves through keys in time, which flythroughs and motions follow. A key is a struct with a `time` and an
// `ease`.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "num/vec.h"

namespace strahl {

/// The cubic from p to q with slopes m and n, both times the length of the interval; exact at both ends.
template <class V>
V hermite(const V& p, const V& q, const V& m, const V& n, double h) {
    const double g = 1 - h;
    return p * (g * g * (1 + 2 * h)) + q * (h * h * (3 - 2 * h)) + (m * g - n * h) * (g * h);
}

/// The interval between two keys: its length and that of its neighbours, if there are any, and the share that is over.
struct Interval {
    std::array<double, 3> seconds{};
    bool key_before = false, key_after = false;
    double h = 0;
};

/// A quantity that changes by `change` in an interval, with the slopes m and n at its ends.
struct Monotone {
    double change, m, n;
    /// How much it has changed when the share h of the interval is over.
    double at(double h) const {
        return std::clamp(hermite(0.0, change, m, n, h), std::min(0.0, change), std::max(0.0, change));
    }
};
/// A smooth and monotone one, for a quantity that changes by `before` and `after` in the intervals beside.
Monotone monotone(const Interval& interval, double before, double here, double after);

/// The centripetal Catmull-Rom spline in an interval, whose knots lie the square root of a chord apart and which
/// therefore has no loops or cusps between keys (C. Yuksel, S. Schaefer, J. Keyser, "Parameterization and Applications
/// of Catmull-Rom Curves", 2011). Time is mapped to the knots by a monotone cubic, so that speed too is continuous at
/// the keys, whatever their times. The curve is hermite(p, q, m, n, share(h)), or p if `knots` is 0.
struct Spline {
    DVec3 m{0}, n{0};
    double knots = 0;
    Monotone way{};
    double share(double h) const { return way.at(h) / knots; }
};
/// The spline for the chords between keys: [1] is that of this interval, [0] and [2] are those beside.
Spline spline(const Interval& interval, const std::array<DVec3, 3>& chords);

/// The share of an interval that counts as over when the share t is, so that speed is multiplied by 1 - a at its start
/// and by 1 - b at its end: with 1 it stops there. It rises with t for a and b from 0 to 1, and is t for 0 and 0.
inline double eased(double t, double a, double b) { return t - a * t * (1 - t) * (1 - t) + b * t * t * (1 - t); }

/// The four keys around a time between [1] and [2]. At the ends of an open curve a neighbour is missing.
template <class Key>
struct Window : Interval {
    std::array<const Key*, 4> key{};

    /// difference(a, b) from each key to the next; 0 where a key is missing.
    template <class Difference>
    auto differences(const Difference& difference) const {
        std::array<decltype(difference(*key[1], *key[2])), 3> all{};
        if (key_before) all[0] = difference(*key[0], *key[1]);
        all[1] = difference(*key[1], *key[2]);
        if (key_after) all[2] = difference(*key[2], *key[3]);
        return all;
    }
};

/// A number along the curve, smooth and always between the values of the two keys.
template <class Key, class Value>
double number_at(const Window<Key>& w, const Value& value) {
    const double p = value(*w.key[1]), q = value(*w.key[2]);
    const auto [before, here, after] = w.differences([&](const Key& a, const Key& b) { return value(b) - value(a); });
    return std::clamp(p + monotone(w, before, here, after).at(w.h), std::min(p, q), std::max(p, q));
}

template <class Key>
Spline spline_of(const Window<Key>& w, DVec3 Key::*member) {
    return spline(w, w.differences([member](const Key& a, const Key& b) { return b.*member - a.*member; }));
}
/// A point along the curve.
template <class Key>
DVec3 point_at(const Window<Key>& w, DVec3 Key::*member) {
    const Spline s = spline_of(w, member);
    const DVec3 p = w.key[1]->*member, q = w.key[2]->*member;
    return s.knots == 0 ? p : hermite(p, q, s.m, s.n, s.share(w.h));
}

/// The interval between keys `i` and `i + 1` of `count`. A `period` above 0 makes the curve closed: key numbers past
/// the ends are keys of the period before or after.
template <class Key>
Window<Key> window_between(const Key* keys, int count, double period, int i) {
    const auto key = [&](int k) -> const Key* {
        return period > 0 ? &keys[(k + count) % count] : k >= 0 && k < count ? &keys[k] : nullptr;
    };
    const auto moment = [&](int k) { return key(k)->time + (k < 0 ? -period : k >= count ? period : 0.0); };
    Window<Key> w;
    for (int k = 0; k < 4; ++k) w.key[k] = key(i - 1 + k);
    w.key_before = w.key[0], w.key_after = w.key[3];
    w.seconds[1] = moment(i + 1) - moment(i);
    if (w.key_before) w.seconds[0] = moment(i) - moment(i - 1);
    if (w.key_after) w.seconds[2] = moment(i + 2) - moment(i + 1);
    return w;
}

/// The place of a time among keys: at `key`, which is the first for all times before it and the last for all times
/// after it; or else in `window`.
template <class Key>
struct Moment {
    const Key* key = nullptr;
    Window<Key> window;
};
template <class Key>
Moment<Key> moment_among(const std::vector<Key>& keys, double period, double time) {
    int count = static_cast<int>(keys.size());
    const bool closed = period > 0;
    if (closed) {
        time -= period * std::floor(time / period);
        if (time < keys.front().time) time += period;
        // A last key at exactly the time at which the first one comes round again is that first key.
        if (count > 1 && keys.back().time >= keys.front().time + period) --count;
    }
    if (count == 1 || !(time > keys.front().time)) return {&keys.front(), {}};
    const auto after = std::upper_bound(keys.begin(), keys.begin() + count, time,
                                        [](double t, const Key& key) { return t < key.time; });
    const int i = static_cast<int>(after - keys.begin()) - 1;
    if (time == keys[i].time || (!closed && i == count - 1)) return {&keys[i], {}};
    Moment<Key> moment{nullptr, window_between(keys.data(), count, period, i)};
    const double over = (time - keys[i].time) / moment.window.seconds[1];
    moment.window.h = eased(over, moment.window.key[1]->ease, moment.window.key[2]->ease);
    return moment;
}

}  // namespace strahl

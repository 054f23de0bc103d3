#include "pov/language/spline.h"

#include <algorithm>

#include "pov/language/interpreter.h"

namespace strahl::pov {

void SplineThing::add(double at, const std::array<double, 5>& value) {
    const auto place = std::ranges::lower_bound(knots, at, {}, &Knot::at);
    if (place == knots.end() || place->at != at)
        knots.insert(place, {at, value});
    else if (std::next(place) != knots.end())  // POV-Ray 3.7 never changes the last one
        place->value = value;
}

void SplineThing::finish() {
    // Natural cubic splines: a tridiagonal system for the second derivatives, which are 0 at the ends.
    const std::size_t n = knots.size();
    curvatures.assign(n, {});
    if (n < 3) return;
    for (int c = 0; c < 5; ++c) {
        std::vector<double> diagonal(n), right(n);
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const double before = knots[i].at - knots[i - 1].at, after = knots[i + 1].at - knots[i].at;
            diagonal[i] = 2 * (before + after);
            right[i] = 6 * ((knots[i + 1].value[c] - knots[i].value[c]) / after -
                            (knots[i].value[c] - knots[i - 1].value[c]) / before);
            if (i == 1) continue;
            const double ratio = before / diagonal[i - 1];
            diagonal[i] -= ratio * before;
            right[i] -= ratio * right[i - 1];
        }
        for (std::size_t i = n - 2; i > 0; --i)
            curvatures[i][c] = (right[i] - (knots[i + 1].at - knots[i].at) * curvatures[i + 1][c]) / diagonal[i];
    }
}

std::array<double, 5> SplineThing::at(double t, Type as) const {
    const std::size_t n = knots.size();
    if (as == Type::cubic && n == 2) {
        std::array<double, 5> mean;
        for (int c = 0; c < 5; ++c) mean[c] = (knots[0].value[c] + knots[1].value[c]) / 2;
        return mean;
    }
    const std::size_t first = as == Type::cubic && n > 2 ? 1 : 0, last = n - 1 - first;
    if (t <= knots[first].at) return knots[first].value;
    if (t >= knots[last].at) return knots[last].value;
    const std::size_t i = std::ranges::upper_bound(knots, t, {}, &Knot::at) - knots.begin() - 1;
    const auto &a = knots[i], &b = knots[i + 1];
    const double h = b.at - a.at, s = (t - a.at) / h;
    std::array<double, 5> result;
    const auto each = [&](const auto& value) {
        for (int c = 0; c < 5; ++c) result[c] = value(c);
        return result;
    };
    switch (as) {
        case Type::quadratic: {  // the parabola through both ends and the knot before, or after in the first interval
            if (n < 3) break;
            const std::size_t k = i == 0 ? 0 : i - 1;
            const auto &p = knots[k], &q = knots[k + 1], &r = knots[k + 2];
            const double lp = (t - q.at) * (t - r.at) / ((p.at - q.at) * (p.at - r.at));
            const double lq = (t - p.at) * (t - r.at) / ((q.at - p.at) * (q.at - r.at));
            const double lr = (t - p.at) * (t - q.at) / ((r.at - p.at) * (r.at - q.at));
            return each([&](int c) { return lp * p.value[c] + lq * q.value[c] + lr * r.value[c]; });
        }
        case Type::natural:
            return each([&](int c) {
                return (1 - s) * a.value[c] + s * b.value[c] +
                       h * h / 6 *
                           (((1 - s) * (1 - s) * (1 - s) - (1 - s)) * curvatures[i][c] +
                            (s * s * s - s) * curvatures[i + 1][c]);
            });
        case Type::cubic: {  // Catmull and Rom, only between the second knot and the last but one
            const auto slope = [&](std::size_t k, int c) {
                return (knots[k + 1].value[c] - knots[k].value[c]) / (knots[k + 1].at - knots[k].at);
            };
            return each([&](int c) {
                const double from = (slope(i - 1, c) + slope(i, c)) / 2, to = (slope(i, c) + slope(i + 1, c)) / 2;
                const double s2 = s * s, s3 = s2 * s;
                return (2 * s3 - 3 * s2 + 1) * a.value[c] + (s3 - 2 * s2 + s) * h * from +
                       (3 * s2 - 2 * s3) * b.value[c] + (s3 - s2) * h * to;
            });
        }
        case Type::linear:
            break;
    }
    return each([&](int c) { return a.value[c] + s * (b.value[c] - a.value[c]); });
}

bool SplineThing::type_of(std::uint16_t code, Type& type) {
    switch (code) {
        case word("linear_spline"):
            type = Type::linear;
            return true;
        case word("quadratic_spline"):
            type = Type::quadratic;
            return true;
        case word("cubic_spline"):
            type = Type::cubic;
            return true;
        case word("natural_spline"):
            type = Type::natural;
            return true;
        default:
            return false;
    }
}

NamedValue Interpreter::read_spline() {
    take();
    begin_block();
    auto curve = std::make_shared<SplineThing>();
    if (code() == value_code && next.value->kind == ValueKind::spline) {
        *curve = static_cast<const SplineThing&>(*next.value->thing);
        take();
        accept(',');
    }
    if (SplineThing::type_of(code(), curve->type)) {
        take();
        accept(',');
    }
    while (at_expression()) {
        const double at = read_number();
        accept(',');
        Components value;
        sum(value);
        if (value.count == 1) value.value[1] = value.value[0], value.count = 2;
        std::fill(value.value.begin() + value.count, value.value.end(), 0);
        curve->components = std::max(curve->components, value.count);
        curve->add(at, value.value);
        accept(',');
        if ((curve->knots.size() & 1023) == 0) *bytes += 1024 * sizeof(SplineThing::Knot), check_limits();
    }
    end_block();
    if (curve->knots.empty()) fail(last, "invalid spline: it has no entries");
    curve->finish();
    return {ValueKind::spline, {}, std::move(curve)};
}

}  // namespace strahl::pov

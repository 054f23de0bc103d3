#include "scene/solid/solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "num/vec_math.h"
#include "scene/solid/solid_lanes.h"

namespace strahl {
namespace {

bool begins_anew(Solid solid) { return solid == Solid::gradient || solid == Solid::onion || solid == Solid::radial; }
/// Is more known of its values than what they are at points?
bool is_known(const SolidPattern& own) {
    return !own.function && own.solid != Solid::spiral1 && own.solid != Solid::spiral2;
}

/// Returns the detail that a kind has everywhere alike, a deviation of 0 if it has none. Deviations are those of
/// 200,000 points.
SolidDetail even_detail(const SolidPattern& own) {
    switch (own.solid) {
        case Solid::agate:
            return {2.2, .34};
        case Solid::bozo:
        case Solid::bumps:
            return {1, own.generator == 1 ? .25 : .13};
        case Solid::cells:
            return {1, .29};
        case Solid::crackle:
            return {1.5, .16};
        case Solid::dents:
            return {1, own.generator == 1 ? .24 : .11};
        case Solid::leopard:
            return {1 / std::numbers::pi, .2};
        case Solid::quilted:
            return {1.5, .11};
        case Solid::ripples:
            return {2 * std::fabs(own.frequency), .12};
        case Solid::waves:  // the slowest one is the largest
            return {.34 * std::fabs(own.frequency), .12};
        default:
            return {0, 0};
    }
}

}  // namespace

void SolidFunction::values_at(const DVec3* points, int count, double* values, const SolidLanes&) const {
    for (int i = 0; i < count; ++i) values[i] = value_at(points[i]);
}
std::optional<DVec3> SolidFunction::bend_at(const DVec3&, const DVec3&) const { return {}; }

const double* random_numbers() {
    static const auto table = [] {
        std::array<double, 32768> all;
        std::mt19937 twister(5489);
        for (double& value : all) value = twister() * 0x1p-32;
        return all;
    }();
    return table.data();
}

DVec3 random_at_cell(int x, int y, int z) {
    const auto& hash = lattice::noise_tables().hash;
    const double* const first = random_numbers() + hash[hash[hash[x & 4095] ^ (y & 4095)] ^ (z & 4095)];
    return {first[0], first[1], first[2]};
}

const std::array<WaveSource, 10>& wave_sources() {
    static const auto all = [] {
        std::array<WaveSource, 10> own;
        auto state = static_cast<std::uint32_t>(-560851967);
        for (int i = 0; i < static_cast<int>(own.size()); ++i) {
            state = 1812433253u * state + 12345u;
            own[static_cast<std::size_t>(i)] = {normalize(lattice::vector_noise(DVec3(i, 0, 0))),
                                                (state >> 16 & 32767) * .000030518509476 + .01};
        }
        return own;
    }();
    return all;
}

DVec3 quilt(const DVec3& p, double middle, double border) { return quilted_way(p, middle, border); }
double quilt_value(const DVec3& way) { return value_of_quilt(way); }

double single_value(const SolidPattern& own, const DVec3& p, double step) {
    constexpr double pi = std::numbers::pi;
    if (own.solid == Solid::radial)
        return std::fabs(p.x) < .001 && std::fabs(p.z) < .001 ? .25 : .25 + (std::atan2(p.x, p.z) + pi) / (2 * pi);
    if (own.solid == Solid::uniform) return 0;
    const double away = rooted(p.x, p.y), slope = away > 0 ? std::asin(p.y / away) : 0;
    const double angle = away > 0 ? (p.x < 0 ? 3 : 1) * pi / 2 + (p.x < 0 ? -slope : slope) : 0;
    const double moved_by = own.turbulence.x == 0 ? 0 : own.turbulence.x * turbulent(own, p, step);
    const double value = p.z + away + std::trunc(own.arms) * angle / (2 * pi) + moved_by;
    return own.solid == Solid::spiral1 ? value : rise_and_fall(away) + rise_and_fall(value);
}

bool goes_on(const SolidPattern& own) {
    return (own.solid == Solid::gradient || own.solid == Solid::onion) && own.frequency == std::floor(own.frequency);
}

SolidDetails::Repeat repeat_of(const SolidPattern& own) {
    using Repeat = SolidDetails::Repeat;
    // Values of most kinds are between 0 and 1 by themselves.
    const bool beyond = begins_anew(own.solid) || own.solid == Solid::marble || own.solid == Solid::wood;
    const bool limited = own.frequency == 0 || (own.frequency == 1 && own.phase == 0 && !beyond);
    if (!is_known(own)) return Repeat::never;
    if (own.wave > 1) return Repeat::ramp;  // means are those of colours after the wave
    return own.wave == 1 ? Repeat::triangle : limited ? Repeat::never : Repeat::ramp;
}

double value_at(const SolidPattern& own, const DVec3& p) { return solid_value(own, p); }
double smoothed_value(const SolidPattern& own, const DVec3& p, double step) { return smoothed_solid(own, p, step); }
DVec3 bend_at(const SolidPattern& own, const DVec3& p, const DVec3& normal) { return solid_bend(own, p, normal); }

SolidDetails details_of(const SolidPattern& own) {
    const SolidDetail even = even_detail(own);
    const bool linear = own.solid == Solid::gradient || own.solid == Solid::marble;
    SolidDetails all{.repeat = repeat_of(own),
                     .known = is_known(own),
                     .jumps = own.solid == Solid::cells || (begins_anew(own.solid) && !goes_on(own)),
                     .even = even.deviation > 0 || own.solid == Solid::granite || own.solid == Solid::wrinkles};
    const double per = own.frequency == 0 ? 1 : std::fabs(own.frequency);
    const auto add = [&](double fineness, double deviation) {
        if (all.count < static_cast<int>(all.sizes.size())) all.sizes[all.count++] = {fineness, per * deviation};
    };
    double slope = 1;                            // of values, in the space that turbulence moves
    if (own.solid == Solid::crackle) add(4, 0);  // values fall and rise again at the borders of its cells
    if (own.solid == Solid::granite) {
        for (int i = 0; i < 6; ++i) add(std::ldexp(4, i), std::ldexp(.14, -i));
        slope = 3;
    } else if (own.solid == Solid::wrinkles) {
        for (int i = 0; i < 10; ++i) add(std::ldexp(1, i), std::ldexp(.125, -i));
    } else if (even.deviation > 0) {
        add(even.fineness, even.deviation), slope = 3 * even.fineness * even.deviation;
        if (own.solid == Solid::waves) add(2 * std::fabs(own.frequency), 0);  // the fastest one
    } else if (!linear) {
        add(1, 0);
    }
    double most = std::max({std::fabs(own.turbulence.x), std::fabs(own.turbulence.y), std::fabs(own.turbulence.z)});
    if (own.solid == Solid::marble) most = std::fabs(own.turbulence.x);
    if (own.solid == Solid::agate) most += 4;
    if (own.solid == Solid::uniform) most = 0;
    if (own.solid == Solid::wood && most > 0) add(2 * most, .5), most *= 2 * std::numbers::pi;
    const auto variance = [&] {
        double sum = 0;
        for (int i = 0; i < all.count; ++i) sum += all.sizes[i].deviation * all.sizes[i].deviation;
        return sum;
    };
    const double without = own.solid == Solid::wood ? 0 : variance();
    double strength = .25 * most * slope, fineness = 1;  // .25: the deviation of noise
    for (int i = 0; i < static_cast<int>(own.octaves) && strength > 0; ++i) {
        add(fineness, std::min(strength, .5));
        strength *= std::fabs(own.omega), fineness *= std::fabs(own.lambda);
    }
    // Turbulence only moves points: values deviate no more than without it.
    const double share = without > 0 ? std::min(1., std::sqrt(without / variance())) : 1;
    for (int i = 0; i < all.count; ++i) all.sizes[i].deviation *= share;
    return all;
}

}  // namespace strahl

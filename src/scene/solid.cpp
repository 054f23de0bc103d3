#include "scene/solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "num/lattice_noise.h"
#include "num/vec_math.h"

namespace strahl {
namespace {

constexpr double nearly = 1e-10;  // POV-Ray's EPSILON
constexpr int wave_sources = 10;
/// The corners of a tetrahedron around a point, where normals compare values.
constexpr std::array<DVec3, 4> bend_corners{
    DVec3(0.942809041582063366, -1. / 3, 0), DVec3(-0.471404520791031683, -1. / 3, 0.816496580927726033),
    DVec3(-0.471404520791031683, -1. / 3, -0.816496580927726033), DVec3(0, 1, 0)};

double fraction(double x) { return x - std::floor(x); }
/// sin(2 pi x).
double cycle(double x) { return std::sin(2 * std::numbers::pi * fraction(x)); }
double rise_and_fall(double x) {
    const double part = fraction(x);
    return part > .5 ? 2 - 2 * part : 2 * part;
}
DVec3 moved(const SolidPattern& own, const DVec3& p, const DVec3& by, double step) {
    return p + by * lattice::vector_turbulence(p, static_cast<int>(own.octaves), static_cast<float>(own.omega),
                                               static_cast<float>(own.lambda), step);
}
double turbulent(const SolidPattern& own, const DVec3& p, double step) {
    return lattice::turbulence(p, static_cast<int>(own.octaves), static_cast<float>(own.omega),
                               static_cast<float>(own.lambda), static_cast<int>(own.generator), step);
}
double noise(const SolidPattern& own, const DVec3& p) { return lattice::noise(p, static_cast<int>(own.generator)); }

/// The detail that a kind has everywhere alike; a deviation of 0 if it has none. Means and deviations are those of
/// 200,000 points.
struct EvenDetail {
    double fineness = 0, mean = 0, deviation = 0;
};
EvenDetail even_detail(const SolidPattern& own) {
    switch (own.solid) {
        case Solid::agate:
            return {2.2, .55, .34};
        case Solid::bozo:
        case Solid::bumps:
            return {1, .5, own.generator == 1 ? .25 : .13};
        case Solid::cells:
            return {1, .5, .29};
        case Solid::crackle:
            return {1.5, .2, .16};
        case Solid::dents:
            return {1, own.generator == 1 ? .2 : .15, own.generator == 1 ? .24 : .11};
        case Solid::leopard:
            return {1 / std::numbers::pi, 1. / 6, .2};
        case Solid::quilted:
            return {1.5, .25, .11};
        case Solid::ripples:
        case Solid::waves:
            return {2 * std::fabs(own.frequency), .5, .12};
        default:
            return {};
    }
}

/// POV-Ray's table of random numbers from 0 to 1, of the Mersenne twister.
const std::array<double, 32768>& random_numbers() {
    static const auto table = [] {
        std::array<double, 32768> all;
        std::mt19937 twister(5489);
        for (double& value : all) value = twister() * 0x1p-32;
        return all;
    }();
    return table;
}
int hash_of(int x, int y, int z) {
    const auto& hash = lattice::noise_tables().hash;
    return hash[hash[hash[x & 4095] ^ (y & 4095)] ^ (z & 4095)];
}
double random_at(int index) { return random_numbers()[static_cast<std::size_t>(index & 32767)]; }
}  // namespace

DVec3 random_at_cell(int x, int y, int z) {
    const int first = hash_of(x, y, z);
    return {random_at(first), random_at(first + 1), random_at(first + 2)};
}

namespace {

int whole(double x) { return static_cast<int>(std::floor(std::clamp(x, -1e9, 1e9))); }

/// The difference of the distances to the two nearest of points that are spread one to a cell.
double crackle_at(const DVec3& p) {
    const int x = whole(p.x - nearly), y = whole(p.y - nearly), z = whole(p.z - nearly);
    double nearest = 1e9, second = 1e9;
    for (int i = -2; i <= 2; ++i)
        for (int j = -2; j <= 2; ++j)
            for (int k = -2; k <= 2; ++k) {
                if ((std::abs(i) == 2) + (std::abs(j) == 2) + (std::abs(k) == 2) > 1) continue;
                const DVec3 way = p - (DVec3(x + i, y + j, z + k) + random_at_cell(x + i, y + j, z + k));
                const double squared = dot_product(way, way);
                if (squared < nearest)
                    second = nearest, nearest = squared;
                else
                    second = std::min(second, squared);
            }
    return std::clamp(std::sqrt(second) - std::sqrt(nearest), 0., 1.);
}

struct WaveSource {
    DVec3 centre;
    double frequency;
};
const std::array<WaveSource, wave_sources>& sources() {
    static const auto all = [] {
        std::array<WaveSource, wave_sources> own;
        auto state = static_cast<std::uint32_t>(-560851967);
        for (int i = 0; i < wave_sources; ++i) {
            state = 1812433253u * state + 12345u;
            own[static_cast<std::size_t>(i)] = {normalize(lattice::vector_noise(DVec3(i, 0, 0))),
                                                (state >> 16 & 32767) * .000030518509476 + .01};
        }
        return own;
    }();
    return all;
}

}  // namespace

DVec3 quilt(const DVec3& p, double middle, double border) {
    const DVec3 way(fraction(p.x) - .5, fraction(p.y) - .5, fraction(p.z) - .5);
    const double t = length(way), rest = 1 - t;
    return (t * t * t + 3 * t * rest * rest * middle + 3 * t * t * rest * border) * 1.154700538 * way;
}
double quilt_value(const DVec3& way) { return (std::fabs(way.x) + std::fabs(way.y) + std::fabs(way.z)) / 3; }

namespace {

/// The mean of a grain of granite at points that lie in their cells as this one does: on a floor at a whole number it
/// is not that of all points. Fitted to means of 400,000 points at random; off by up to .006.
double mean_of_grain(const SolidPattern& own, const DVec3& p) {
    double mean = own.generator == 3 ? .228 : .202;
    const double swing = own.generator == 3 ? -.0137 : .0133;
    for (int c = 0; c < 3; ++c) {
        const double t = fraction(p[c]), inwards = 2 * std::min(t, 1 - t);
        mean += swing * (1 - 2 * inwards * inwards * (3 - 2 * inwards));
    }
    return mean;
}

/// The value before frequency, phase and wave, at a point that turbulence has moved. Where a kind sums up several sizes
/// of detail, those too fine for points that are `step` apart fade to their means.
double raw_value(const SolidPattern& own, const DVec3& p, double step) {
    if (own.function) return own.function->value_at(p);
    const double frequency = static_cast<float>(own.frequency), phase = static_cast<float>(own.phase);
    const auto length_of = [](double a, double b) { return std::sqrt(a * a + b * b); };
    switch (own.solid) {
        case Solid::agate:
            return std::pow(std::clamp(.5 * (cycle(1.3 * turbulent(own, p, step) + 1.1 * p.z) + 1), 0., 1.), .77);
        case Solid::boxed:
            return std::max(0., 1 - std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}));
        case Solid::bozo:
        case Solid::bumps:
            return noise(own, p);
        case Solid::cells:
            return random_at(hash_of(whole(p.x + nearly), whole(p.y + nearly), whole(p.z + nearly)));
        case Solid::crackle:
            return crackle_at(p);
        case Solid::cylindrical:
            return std::max(0., 1 - length_of(p.x, p.z));
        case Solid::dents:
            return std::pow(noise(own, p), 3);
        case Solid::gradient: {
            const double along = dot_product(normalize(own.axis), p);
            return along > 1 ? std::fmod(along, 1.) : along;
        }
        case Solid::granite: {
            double sum = 0;
            for (int i = 0; i < 6; ++i) {
                const double fine = std::ldexp(1, i);
                const DVec3 grain = p * (4 * fine);
                const auto value = [&] {
                    const double n = noise(own, grain);
                    return own.generator > 1 ? std::min(.5, std::fabs(1 - 2 * n)) : std::fabs(.5 - n);
                };
                sum += lattice::faded(4 * fine * step, step > 0 ? mean_of_grain(own, grain) : 0, value) / fine;
            }
            return sum;
        }
        case Solid::leopard: {
            const double sum = (std::sin(p.x) + std::sin(p.y) + std::sin(p.z)) / 3;
            return sum * sum;
        }
        case Solid::marble:
            return p.x + own.turbulence.x * (own.turbulence.x == 0 ? 0 : turbulent(own, p, step));
        case Solid::onion:
            return std::fmod(length(p), 1.);
        case Solid::planar:
            return std::max(0., 1 - std::fabs(p.y));
        case Solid::quilted:
            return quilt_value(quilt(p));
        case Solid::radial:
            if (std::fabs(p.x) < .001 && std::fabs(p.z) < .001) return .25;
            return .25 + (std::atan2(p.x, p.z) + std::numbers::pi) / (2 * std::numbers::pi);
        case Solid::ripples: {
            double sum = 0;
            for (const WaveSource& source : sources())
                sum += cycle(length(p - source.centre) * frequency + phase);
            return .5 * (1 + sum / wave_sources);
        }
        case Solid::spiral1:
        case Solid::spiral2: {
            const double away = length_of(p.x, p.y), slope = away > 0 ? std::asin(p.y / away) : 0;
            const double angle = away > 0 ? (p.x < 0 ? 3 : 1) * std::numbers::pi / 2 + (p.x < 0 ? -slope : slope) : 0;
            const double moved_by = own.turbulence.x == 0 ? 0 : own.turbulence.x * turbulent(own, p, step);
            const double value = p.z + away + std::trunc(own.arms) * angle / (2 * std::numbers::pi) + moved_by;
            return own.solid == Solid::spiral1 ? value : rise_and_fall(away) + rise_and_fall(value);
        }
        case Solid::uniform:
            return 0;
        case Solid::waves: {
            double sum = 0;
            for (const WaveSource& source : sources())
                sum += cycle(length(p - source.centre) * frequency * source.frequency + phase) /
                       source.frequency;
            return .2 * (2.5 + sum / wave_sources);
        }
        case Solid::spherical:
            return std::max(0., 1 - length(p));
        case Solid::wood: {
            if (own.turbulence == DVec3(0)) return length_of(p.x, p.y);
            const DVec3 d = moved(own, p, DVec3(1), step) - p;
            return length_of(p.x + cycle((p.x + d.x) * own.turbulence.x), p.y + cycle((p.y + d.y) * own.turbulence.y));
        }
        case Solid::wrinkles: {
            double sum = 0;
            for (int i = 0; i < 10; ++i) {
                const double fine = std::ldexp(1, i);
                sum += lattice::faded(fine * step, .5, [&] {
                    const double n = noise(own, p * fine);
                    return own.generator > 1 ? std::clamp(2 * n - .5, 0., 1.) : n;
                }) / fine;
            }
            return sum / 2;
        }
    }
    return 0;
}

/// Are there digits left for where in a cell the point is?
bool within_reach(const DVec3& p) {
    return std::fabs(p.x) <= 1e9 && std::fabs(p.y) <= 1e9 && std::fabs(p.z) <= 1e9;
}
bool moves_itself(Solid solid) { return solid == Solid::marble || solid == Solid::wood; }
DVec3 place_of(const SolidPattern& own, const DVec3& p, double step = 0) {
    return own.turbulence == DVec3(0) || moves_itself(own.solid) ? p : moved(own, p, own.turbulence, step);
}

/// A value with its frequency and phase.
double repeated(const SolidPattern& own, double value) {
    return own.frequency == 0 ? value : value * static_cast<float>(own.frequency) + static_cast<float>(own.phase);
}
/// The value that comes of it.
double waved(const SolidPattern& own, double value) {
    if (own.frequency != 0) value = std::fmod(value, 1.00001);
    if (value < 0) value -= std::floor(value);
    switch (static_cast<int>(own.wave)) {
        case 1:
            value = rise_and_fall(value);
            break;
        case 2:
            value = (1 + cycle(value)) / 2;
            break;
        case 3:
            value = std::fabs(cycle(value / 2));
            break;
        case 4:
            value = value * value * (3 - 2 * value);
            break;
        default:
            break;
    }
    return std::isfinite(value) ? std::clamp(value, 0., 1.) : 0;
}
/// The value at a point that turbulence has moved.
double value_of(const SolidPattern& own, const DVec3& p) { return waved(own, repeated(own, raw_value(own, p, 0))); }

bool is_whole(double x) { return x == std::floor(x); }
/// Does the kind itself begin anew at whole numbers, where that makes no difference?
bool goes_on(const SolidPattern& own) {
    return (own.solid == Solid::gradient || own.solid == Solid::onion) && is_whole(own.frequency);
}

bool begins_anew(Solid solid) { return solid == Solid::gradient || solid == Solid::onion || solid == Solid::radial; }
/// Is more known of its values than what they are at points?
bool is_known(const SolidPattern& own) {
    return !own.function && own.solid != Solid::spiral1 && own.solid != Solid::spiral2;
}
SolidDetails::Repeat repeat_of(const SolidPattern& own) {
    using Repeat = SolidDetails::Repeat;
    // Values of most kinds are between 0 and 1 by themselves.
    const bool beyond = begins_anew(own.solid) || own.solid == Solid::marble || own.solid == Solid::wood;
    const bool limited = own.frequency == 0 || (own.frequency == 1 && own.phase == 0 && !beyond);
    if (!is_known(own) || own.wave > 1) return Repeat::never;
    return own.wave == 1 ? Repeat::triangle : limited ? Repeat::never : Repeat::ramp;
}

/// Returns what values add to a normal, by their differences around a point that turbulence has moved.
DVec3 slope_of(const SolidPattern& own, const DVec3& p) {
    DVec3 sum(0);
    for (const DVec3& corner : bend_corners) sum = sum - 5 * value_of(own, p + .02 * corner) * corner;
    return sum;
}

}  // namespace

double value_at(const SolidPattern& own, const DVec3& p) {
    return within_reach(p) ? value_of(own, place_of(own, p)) : 0;
}

SolidDetails details_of(const SolidPattern& own) {
    const EvenDetail even = even_detail(own);
    const bool linear = own.solid == Solid::gradient || own.solid == Solid::marble;
    SolidDetails all{.repeat = repeat_of(own),
                     .known = is_known(own),
                     .jumps = own.solid == Solid::cells || (begins_anew(own.solid) && !goes_on(own))};
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
    } else if (!linear) {
        add(1, 0);
    }
    double most = std::max({std::fabs(own.turbulence.x), std::fabs(own.turbulence.y), std::fabs(own.turbulence.z)});
    if (own.solid == Solid::marble) most = std::fabs(own.turbulence.x);
    if (own.solid == Solid::agate) most += 4;
    if (own.solid == Solid::wood && most > 0) add(2 * most, .5), most *= 2 * std::numbers::pi;
    double strength = .25 * most * slope, fineness = 1;  // .25: the deviation of noise
    for (int i = 0; i < static_cast<int>(own.octaves) && strength > 0; ++i) {
        add(fineness, std::min(strength, .5));
        strength *= std::fabs(own.omega), fineness *= std::fabs(own.lambda);
    }
    return all;
}

double smoothed_value(const SolidPattern& own, const DVec3& point, double step) {
    if (!within_reach(point)) return 0;
    const DVec3 p = place_of(own, point, step);
    double value;
    if (own.function) {
        value = raw_value(own, p, step);
    } else if (goes_on(own)) {
        value = own.solid == Solid::onion ? length(p) : dot_product(normalize(own.axis), p);
    } else if (const EvenDetail detail = even_detail(own); detail.deviation > 0) {
        value = lattice::faded(detail.fineness * step, detail.mean, [&] { return raw_value(own, p, step); });
    } else {
        value = raw_value(own, p, step);
    }
    value = repeated(own, value);
    if (repeat_of(own) == SolidDetails::Repeat::never) return waved(own, value);
    return std::isfinite(value) ? value : 0;
}

DVec3 bend_at(const SolidPattern& own, const DVec3& given) {
    if (!within_reach(given)) return DVec3(0);
    const DVec3 p = place_of(own, given);
    if (own.function) return own.function->bend_at(p).value_or(slope_of(own, p));
    switch (own.solid) {
        case Solid::bumps:
            return lattice::vector_noise(p);
        case Solid::dents:
            return std::pow(noise(own, p), 3) * lattice::vector_noise(p);
        case Solid::wrinkles: {
            DVec3 sum(0);
            for (int i = 0; i < 10; ++i) {
                const double fine = std::ldexp(1, i);
                const DVec3 n = lattice::vector_noise(p * fine);
                for (int c = 0; c < 3; ++c) sum[c] += std::fabs(n[c]) / fine;
            }
            return sum;
        }
        case Solid::quilted:
            return quilt(p);
        case Solid::ripples:
        case Solid::waves: {
            DVec3 sum(0);
            for (const WaveSource& source : sources()) {
                const double f = own.solid == Solid::waves ? source.frequency : 1;
                const DVec3 way = p - source.centre;
                const double away = length(way);
                if (away > 0) sum = sum + cycle(away * own.frequency * f + own.phase) / (away * 10 * f) * way;
            }
            return sum;
        }
        default:
            return slope_of(own, p);
    }
}

}  // namespace strahl

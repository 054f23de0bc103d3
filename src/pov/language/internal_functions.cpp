#include "pov/language/internal_functions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "num/lattice_noise.h"

namespace strahl::pov {
namespace {

using std::numbers::pi;

/// How many numbers each function takes after x, y and z.
constexpr std::array<int, 79> parameter_counts{5, 5, 5, 5, 2,  2, 5, 4, 2, 1, 4, 1, 1, 1, 1, 6, 6, 3, 1, 4,
                                               3, 6, 1, 1, 10, 7, 7, 1, 1, 6, 1, 3, 4, 3, 6, 1, 1, 4, 1, 6,
                                               5, 1, 1, 1, 4,  1, 3, 0, 1, 1, 7, 5, 6, 1, 1, 1, 3, 0, 6, 6,
                                               4, 1, 5, 4, 6,  1, 4, 7, 2, 0, 2, 3, 1, 1, 2, 6, 0, 0, 1};

double sqr(double v) { return v * v; }
double cube(double v) { return v * v * v; }

/// Turns the curve in x and y about the y axis if p[0] > 0: x becomes the distance from the axis less p[1], and both
/// are turned by p[2] degrees.
void around_axis(double& x, double& y, double z, const double* p) {
    if (!(p[0] > 0)) return;
    x = std::sqrt(x * x + z * z) - p[1];
    const double angle = p[2] * (pi / 180), c = std::cos(angle), s = std::sin(angle), from = x;
    x = from * c - y * s;
    y = from * s + y * c;
}

int generator_of(double number) { return static_cast<int>(std::clamp(number, 1., 3.)); }

/// Sums of noise over octaves, of which the last may count in part. `add(i, share)` adds an octave.
template <class Add>
void octaves(double count, const Add& add) {
    const int whole = static_cast<int>(std::clamp(std::floor(count), 0., 30.));
    for (int i = 0; i < whole; ++i) add(i, 1.);
    if (const double rest = count - whole; rest > 0) add(whole, rest);
}

/// F. K. Musgrave's heterogeneous terrain ("Texturing and Modeling", 1994); a fraction of an octave counts in part.
double hetero_terrain(DVec3 point, const double* p) {
    const int generator = generator_of(p[5]);
    double strength = 1, sum = 2 * lattice::noise(point, generator) - 1 + p[3];
    const auto next = [&] {
        point *= p[1];
        strength *= std::pow(p[1], -p[0]);
        return (2 * lattice::noise(point, generator) - 1 + p[3]) * strength;
    };
    const int count = static_cast<int>(std::clamp(std::ceil(p[2]), 0., 30.));
    const int power = static_cast<int>(std::clamp(p[4], 0., 30.));
    for (int i = 1; i < count; ++i) {
        double step = next();
        for (int k = 0; k < power; ++k) step *= sum;
        sum += step;
    }
    if (const double rest = p[2] - std::trunc(p[2]); rest != 0) sum += rest * next() * sum;
    return sum;
}

/// His ridged multifractal: the octave before decides how much each one counts.
double ridged_terrain(DVec3 point, const double* p) {
    const int generator = generator_of(p[5]);
    const auto ridge = [&] {
        const double value = p[3] - std::abs(2 * lattice::noise(point, generator) - 1);
        return value * value;
    };
    double signal = ridge(), sum = signal;
    const int count = static_cast<int>(std::clamp(std::ceil(p[2]), 0., 30.));
    for (int i = 1; i < count; ++i) {
        point *= p[1];
        signal = std::clamp(signal * p[4], 0., 1.) * ridge();
        sum += signal * std::pow(p[1], -p[0] * i);
    }
    return sum;
}

double ridge(DVec3 point, const double* p) {
    const int generator = generator_of(p[5]);
    const double ridge = p[4], offset = p[3];
    double sum = 0, most = 0, strength = 1;
    octaves(p[1], [&](int, double share) {
        const double value = std::abs(lattice::noise(point, generator) - ridge) / std::max(ridge, 1 - ridge);
        sum += share * strength * (value - offset);
        most += share * strength * std::max(offset, 1 - offset);
        point *= p[0];
        strength *= p[2];
    });
    return most == 0 ? 0 : sum / most;
}

double turned_fmod(double value) {
    const double rest = std::fmod(value, 2 * pi);
    return rest < 0 ? rest + 2 * pi : rest;
}
/// The norm of a point of a cross section: 1 is a circle, 0 a square.
double section(double x, double z, double shape) {
    if (shape == 1) return std::sqrt(x * x + z * z);
    if (shape == 0) return std::max(std::abs(x), std::abs(z));
    const double exponent = 2 / shape;
    return std::pow(std::pow(std::abs(x), exponent) + std::pow(std::abs(z), exponent), 1 / exponent);
}

double helix1(double x, double y, double z, const double* p) {
    const double h = turned_fmod(std::atan2(z, x) * p[0] + y * p[1] * p[0]);
    const double along = (h - pi) / p[4] / (p[1] * p[0]), across = std::sqrt(x * x + z * z) - p[3];
    const double angle = p[6] * (pi / 180), c = std::cos(angle), s = std::sin(angle);
    const double m = section(across * c - along * s, across * s + along * c, p[5]);
    return -p[2] + std::min(p[3] + std::sqrt(x * x + z * z), m);
}

double helix2(double x, double y, double z, const double* p) {
    const double c = std::cos(y * p[1]), s = std::sin(y * p[1]), dx = x - p[3] * c, dz = z - p[3] * s;
    return section(dx * c + dz * s, -dx * s + dz * c, p[5]) - p[2];
}

double spiral(double x, double y, double z, const double* p) {
    if (x == 0 && z == 0) x = .000001;
    const double away = std::sqrt(x * x + z * z) + p[0] * std::atan2(z, x) / (2 * pi);
    const double r = std::sqrt(x * x + y * y + z * z);
    return -std::min(p[2] - r, p[1] - std::min(section(std::fmod(away, p[0]) - p[0] * .5, y, p[5]), r));
}

/// The distances along and across an edge of a grid of hexagons with the periods √3 and 3.
DVec3 hexagonal(double x, double y) {
    const double half = std::numbers::sqrt3 / 2;
    double a = std::abs(std::fmod(std::abs(x), 2 * half) - half), b = std::abs(std::fmod(std::abs(y), 3) - 1.5);
    if (a * a + b * b > sqr(half - a) + sqr(1.5 - b)) a = half - a, b = 1.5 - b;
    if (std::atan2(b, a) < pi / 6) return {a, b, 0};
    const double c = std::cos(pi / 3), s = std::sin(pi / 3);
    return {c * a + s * b, std::abs(c * b - s * a), 0};
}

/// A mesh of threads along x and z that go over and under each other.
double woven(double x, double y, double z, const double* p) {
    const auto thread = [&](double across, double along, double spacing, double other, double sign) {
        double r = std::fmod(across, 2 * spacing);
        if (r < 0) r += 2 * spacing;
        return std::hypot(std::abs(r - spacing) * p[2], (y + sign * std::cos(along * pi / other) * p[3]) * p[4]);
    };
    return std::min({thread(x, z, p[0], p[1], -1), thread(x - p[0], z, p[0], p[1], 1), thread(z, x, p[1], p[0], 1),
                     thread(z - p[1], x, p[1], p[0], -1)});
}

/// Formulas of "The POV-Ray documentation", functions.inc; q = x² + y² + z², C(v) limits p[0] v to -10 to 10.
double value_of(int number, double x, double y, double z, const double* p, int generator) {
    const double xx = x * x, yy = y * y, zz = z * z, q = xx + yy + zz;
    const auto C = [&](double v) { return std::min(10., std::max(p[0] * v, -10.)); };
    const auto limited = [&](double v) { return std::min(p[1], std::max(p[0] * v, -p[1])); };
    const auto ellipsoids = [&](int which) {
        const double p0 = p[0], p1 = p[1];
        return std::exp(-p1 * ((which == 2 ? 1 : p0) * xx + (which == 1 ? 1 : p0) * yy + (which == 0 ? 1 : p0) * zz));
    };
    const auto around = [&](int i) { around_axis(x, y, z, p + i); };
    switch (number) {
        case 0:
            around(2);
            return -limited(-(x * x * std::abs(x) - x * x + y * y));
        case 1:
            around(2);
            return limited(-(2 * sqr(x * x) - 3 * x * x * y + y * y - 2 * cube(y) + sqr(y * y)));
        case 2:
            around(2);
            return limited(-(sqr(x * x) + x * x * y * y - 2 * x * x * y - x * y * y + y * y));
        case 3:
            around(2);
            return limited(-(sqr(x * x) + sqr(y * y) + 2 * x * x * y * y + 3 * x * x * y - cube(y)));
        case 4: {
            const double a = sqr(p[1]), w = xx + zz + 2 * p[1] * y - a;
            return C(yy * (a - xx - zz) - w * w);
        }
        case 5:
            return C(p[1] * (xx + zz) * y - q * q);
        case 6: {
            const double a = std::min(1., (sqr(x + p[0] / 2) + yy + zz) * sqr(p[2]));
            const double b = std::min(1., (sqr(x - p[0] / 2) + yy + zz) * sqr(p[4]));
            return -(p[1] * sqr(1 - a) + p[3] * sqr(1 - b));
        }
        case 7:
            return p[3] - p[2] * (std::exp(-p[1] * q) + std::exp(-p[1] * (sqr(x - p[0]) + yy + zz)));
        case 8: {
            const double w = 1 - z, h = xx + yy, r2 = std::numbers::sqrt2;
            return C(p[1] *
                     (64 * cube(w) * cube(z) - 48 * sqr(w) * zz * (3 * h + 2 * zz) +
                      12 * w * z * (27 * h * h - 24 * zz * h + 36 * r2 * y * z * (yy - 3 * xx) + 4 * zz * zz) +
                      (9 * h - 2 * zz) * (-81 * h * h - 72 * zz * h + 108 * r2 * x * z * (xx - 3 * yy) + 4 * zz * zz)));
        }
        case 9: {
            if (x == 0 && z == 0) x = .0001;
            const double r = std::hypot(x + p[0] / 4, z);
            const double a = std::min(z, std::cos(std::atan2(z, x) / 2) * p[0] / 2 - std::hypot(r - .75 * p[0], y));
            return -std::max(a, p[0] / 2 - std::sqrt(sqr(x - p[0] / 2) + zz + yy));
        }
        case 10:
            return p[3] - p[2] * std::max({ellipsoids(0), ellipsoids(1), ellipsoids(2)});
        case 11:
            return C(xx * zz - y);
        case 12:
            return C(cube(y) + z - cube(x));
        case 13:
        case 43:
            return C(zz * xx - zz * zz - 2 * z * xx + 2 * cube(z) + xx - zz - sqr(xx - z) - yy * yy - 2 * xx * yy -
                     yy * zz + 2 * yy * z + yy);
        case 14:
            return C(-(xx * xx + 2 * xx * zz - .36 * xx - yy * yy + .25 * yy + zz * zz));
        case 15:
            around(3);
            return C(y * y * (y * y - sqr(p[2])) - x * x * (x * x - sqr(p[1])));
        case 16: {
            const double r = sqr(p[5]), b = sqr(p[2]), d = sqr(p[4]), a = sqr(p[1]);
            const double product = (b - d - sqr(p[3] + p[1])) * (b - d - sqr(p[3] - p[1]));
            return C(-(product * q * q +
                       2 * r * ((b + a - d - sqr(p[3])) * (2 * x * p[3] + 2 * y * p[4] - r) - 4 * p[4] * b * y) * q +
                       4 * r * r * (p[3] * x + p[4] * y) * (p[4] * y + p[3] * x - r) + 4 * r * r * a * yy +
                       r * r * r * r));
        }
        case 17:
            return std::sqrt(xx * sqr(p[0]) + yy * sqr(p[1]) + zz * sqr(p[2]));
        case 18: {
            if (std::abs(z) < .2) z = .2;
            const double r = (yy - xx) / (2 * z) + 2 * zz / 9, s = (yy - xx) / (4 * z);
            return C(6 * s * s - cube(r));
        }
        case 19:
            return p[3] - p[2] * (ellipsoids(0) + ellipsoids(1) + ellipsoids(2));
        case 20:
            return C((yy + zz) * (1 + (p[2] - 4 * p[1]) * x) + xx * (1 + p[2]));
        case 21:
            around(3);
            return C(-(y * y * (1 + (p[2] - 4 * p[1]) * x) + x * x * (1 + p[2])));
        case 22:
            return C(.5 * xx * xx * x + .5 * xx * xx - yy - zz);
        case 23:
            return C(-(cube(2 * xx + yy + zz - 1) - .1 * xx * cube(z) - yy * cube(z)));
        case 24: {
            const double away = std::hypot(x, z), f = std::atan2(x, z), t = std::atan2(away - p[0], y);
            const double r = std::hypot(away - p[0], y), h = turned_fmod(f * p[1] + t * p[2]) - pi;
            const double turn = std::atan2(h * p[8], r - p[5]), bump = std::cos(turn * p[7] + f * p[9]) * p[3] + p[4];
            return -std::max(p[4] + p[5] - p[0] - away,
                             bump - std::min(std::sqrt(sqr(r - p[5]) + h * h * p[6]), r + p[5]));
        }
        case 25:
            return helix1(x, y, z, p);
        case 26:
            return helix2(x, y, z, p);
        case 27:
            return hexagonal(x, y).x;
        case 28:
            return hexagonal(x, y).y;
        case 29:
            return hetero_terrain({x, y, z}, p);
        case 30:
            return C(-(4 * cube(q - 13) + 27 * sqr(3 * xx + yy - 4 * zz - 12)));
        case 31: {
            const double a = sqr(p[1]), b = sqr(p[2]);
            return C(-(xx * xx + 2 * xx * yy - 2 * xx * zz - 2 * (a + b) * xx + yy * yy - 2 * yy * zz +
                       2 * (a - b) * yy + zz * zz + 2 * (a + b) * zz + sqr(a - b)));
        }
        case 32:
            return p[3] - p[2] * std::min({ellipsoids(0), ellipsoids(1), ellipsoids(2)});
        case 33:
            return C(-(yy + zz - sqr(p[2]) * xx * xx + sqr(p[1]) * sqr(p[2]) * xx));
        case 34:
            around(3);
            return C(-(y * y - sqr(p[2]) * sqr(x * x) + sqr(p[2]) * p[1] * p[2] * x * x));
        case 35:
            return C(-((q + 2 * y - 1) * (sqr(q - 2 * y - 1) - 8 * zz) + 16 * x * z * (q - 2 * y - 1)));
        case 36:
            return C(-(xx * xx + yy * yy + zz * zz - q - xx * yy - xx * zz - yy * zz + 1));
        case 37:
            return C(-(xx * xx + yy * yy + zz * zz + p[1] * q + p[2] * (xx * yy + xx * zz + yy * zz) +
                       p[3] * x * y * z - 1));
        case 38:
            return C(-(xx * xx - xx + yy + zz));
        case 39:
            around(3);
            return C(-(y * y - sqr(p[1]) * sqr(p[2]) * x * x + sqr(p[2]) * sqr(x * x)));
        case 40:
            return woven(x, y, z, p);
        case 41:
            return C(-(4 * xx * q - yy * (1 - yy - zz)));
        case 42:
            return C(6 * y * z - cube(y) - cube(z));
        case 44:
            return C(-(sqr(q + sqr(p[1])) - p[3] * sqr(p[1]) * (xx + zz) - sqr(p[2])));
        case 45:
            return C(y - xx - zz);
        case 46: {
            const double a = sqr(p[1]), b = sqr(p[2]);
            return C(-(xx * xx + 2 * xx * yy - 2 * xx * z - (a + b) * xx + yy * yy - 2 * yy * z + (a - b) * yy + zz +
                       (a + b) * z + sqr(a - b)));
        }
        case 47:
            return std::atan2(std::sqrt(xx + zz), y);
        case 48:
            return C(xx * xx + yy * yy + zz * zz - q);
        case 49:
            return C(xx * xx - xx * x + yy + zz);
        case 50:
            around(4);
            return C(-(y * y - p[1] * sqr(p[3]) * cube(x) - p[2] * sqr(p[3]) * sqr(x * x)));
        case 51:
            return std::sqrt(xx + zz) - std::max(-5., p[0] + p[1] * y + p[2] * yy + p[3] * yy * y + p[4] * yy * yy);
        case 52: {
            const double r = p[1] + p[2] * y + p[3] * yy + p[4] * yy * y + p[5] * yy * yy;
            double nearest = std::numeric_limits<double>::infinity();
            const int count = static_cast<int>(std::clamp(p[0], 0., 1000.));
            for (int i = 0; i < count; ++i) {
                const double angle = 2 * pi * i / count;
                nearest = std::min(nearest, std::hypot(x - r * std::sin(angle), z - r * std::cos(angle)));
            }
            return nearest;
        }
        case 53: {
            const double c2 = q == 0 ? 0 : yy / q, r = 2 * std::sqrt(q);
            return (12 - sqr(r * r * std::exp(-.33333333 * r) * (3 * c2 - 1))) / 10;
        }
        case 54:
            return C(y - xx * xx - zz * zz);
        case 55:
            return C(y - xx * xx + zz * zz);
        case 56:
            return C(sqr(p[1]) * sqr(p[2]) - (xx + zz) * yy - sqr(p[2]) * (xx + zz));
        case 57:
            return std::sqrt(q);
        case 58:
            return ridge({x, y, z}, p);
        case 59:
            return ridged_terrain({x, y, z}, p);
        case 60: {
            const auto beyond = [&](double v, double size) { return std::max(0., std::abs(v) - (size - p[0])); };
            return std::sqrt(sqr(beyond(x, p[1])) + sqr(beyond(y, p[2])) + sqr(beyond(z, p[3]))) - p[0] - 1e-6;
        }
        case 61:
            return std::sqrt(q) - p[0];
        case 62:
            return p[2] * (ellipsoids(0) + ellipsoids(1) + ellipsoids(2) - p[4] * std::exp(-p[3] * q));
        case 63:
            return y - p[0] * std::cos(p[1] * x) * std::cos(p[2] * z) * std::exp(-p[3] * (xx + zz));
        case 64:
            return spiral(x, y, z, p);
        case 65:
            return C(-(xx * yy + xx * zz + yy * zz + x * y * z));
        case 66:
            return C(-((p[2] - x) * (yy + zz) - sqr(p[3]) * p[1] * xx - sqr(p[3]) * xx * x));
        case 67:
            around(4);
            return C(-((p[2] - x) * y * y - sqr(p[3]) * p[1] * x * x - sqr(p[3]) * cube(x)));
        case 68: {
            const double e = 2 / p[0], n = 2 / p[1];
            const double ring = std::pow(std::pow(std::abs(x), e) + std::pow(std::abs(y), e), n / e);
            return 1 - std::pow(ring + std::pow(std::abs(z), n), 1 / n);
        }
        case 69:
            return std::atan2(x, z);
        case 70:
            return std::sqrt(sqr(std::sqrt(xx + zz) - p[0]) + yy) - p[1];
        case 71: {
            const double a = sqr(p[1]), b = sqr(p[2]);
            return C(-(q * q - 2 * (a + b) * xx + 2 * (a - b) * yy - 2 * (a + b) * zz + sqr(a - b)));
        }
        case 72:
            return C(-(4 * (xx * xx + sqr(yy + zz)) + 17 * xx * (yy + zz) - 20 * q + 17));
        case 73:
            return C(y * zz - xx);
        case 74:
            return C(-(p[1] * (y - 1) + (xx + zz) * y));
        case 75:
            around(3);
            return C(p[2] - sqr(p[1]) * y - x * x * y);
        case 76:
            return lattice::noise({x, y, z}, generator);
        case 78:
            return lattice::noise({x, y, z}, generator_of(p[0]));
    }
    return std::numeric_limits<double>::quiet_NaN();
}

constexpr int noise_function = 76;  // f_noise3d

struct InternalFunction : FunctionThing {
    int number;
    std::shared_ptr<const int> generator;
    InternalFunction(int number, std::shared_ptr<const int> generator)
        : number(number), generator(std::move(generator)) {
        arguments = 3 + parameter_counts[number];
    }
    void evaluate(const double* given, double* result) const override {
        *result = value_of(number, given[0], given[1], given[2], given + 3, *generator);
    }
    void evaluate_lanes(const Lanes* given, Lanes* result, const lattice::NoiseLanes& noise) const override {
        if (number != noise_function) return FunctionThing::evaluate_lanes(given, result, noise);
        std::array<DVec3, std::tuple_size_v<Lanes>> points;
        for (std::size_t lane = 0; lane < points.size(); ++lane)
            points[lane] = {given[0][lane], given[1][lane], given[2][lane]};
        noise.noise(points.data(), static_cast<int>(points.size()), *generator, result->data());
    }
};

}  // namespace

std::shared_ptr<const FunctionThing> internal_function(int number, std::shared_ptr<const int> generator) {
    if (number < 0 || number >= static_cast<int>(parameter_counts.size())) return nullptr;
    return std::make_shared<InternalFunction>(number, std::move(generator));
}

}  // namespace strahl::pov

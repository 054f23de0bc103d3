#include "pov/things/warps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "num/lattice_noise.h"
#include "num/vec_math.h"
#include "scene/solid/solid.h"

namespace strahl::pov {
namespace {

constexpr double farthest = 1e17;  // POV-Ray's COORDINATE_LIMIT
constexpr double full_turn = 2 * std::numbers::pi;

/// Returns x, y and z of the plane z = 0 as those of the plane across `orientation`, which is an axis.
DVec3 oriented(const DVec3& p, const DVec3& orientation) {
    if (orientation == DVec3(0, 0, 1)) return p;
    const DVec3& o = orientation;
    return {o.x * p.z + o.y * p.x + o.z * p.x, o.x * p.y - o.y * p.z + o.z * p.y, -o.x * p.x + o.y * p.y + o.z * p.z};
}

/// Returns the angle of (x, z) from the x axis, from 0 to 1.
double turn_of(double x, double z, double away) {
    if (z == 0) return x > 0 ? 0 : .5;
    const double angle = std::acos(x / away) / full_turn;
    return z < 0 ? 1 - angle : angle;
}

struct WarpPoint {
    DVec3 p;

    DVec3 operator()(const TurbulenceWarp& own) const {
        return p + own.by * lattice::vector_turbulence(p, own.octaves, static_cast<float>(own.omega),
                                                       static_cast<float>(own.lambda));
    }
    DVec3 operator()(const RepeatWarp& own) const {
        DVec3 q = p;
        const double number = static_cast<float>(std::floor(p[own.axis] / own.width));
        q[own.axis] -= number * own.width;
        if (std::fmod(number, 2) != 0) {
            q = q * own.flip;
            if (own.flip[own.axis] < 0) q[own.axis] += own.width;
        }
        return q + number * own.offset;
    }
    DVec3 operator()(const BlackHoleWarp& own) const {
        DVec3 centre = own.centre;
        if (own.repeats) {
            int block[3]{};
            for (int c = 0; c < 3; ++c)
                if (own.repeat[c] >= 1e-10)
                    block[c] = static_cast<int>(std::clamp(std::floor(p[c] / own.repeat[c]), -1e9, 1e9));
            if (own.uncertain != DVec3(0)) centre += own.uncertain * random_at_cell(block[0], block[1], block[2]);
            centre += DVec3(block[0], block[1], block[2]) * own.repeat;
        }
        const DVec3 way = p - centre;
        const double away = length(way);
        if (away >= own.radius) return p;
        const double pull = std::min(1., std::pow(1 - away / own.radius, own.falloff) * own.strength);
        return p + (own.inverse ? -pull : pull) * way;
    }
    DVec3 operator()(const RoundWarp& own) const {
        double across, up = p.y, away;
        const double level = std::sqrt(p.x * p.x + p.z * p.z);
        if (own.shape == RoundWarp::Shape::ball) {
            away = length(p);
            if (away == 0) return p;
            across = level == 0 ? 0 : turn_of(p.x, p.z, level);
            up = .5 + std::asin(p.y / away) / std::numbers::pi;
        } else {
            if (level == 0) return p;
            across = turn_of(p.x, p.z, level);
            away = level;
            if (own.shape == RoundWarp::Shape::torus) {
                const double x = level - own.major_radius;
                away = std::sqrt(x * x + p.y * p.y);
                up = std::acos(-x / away) / full_turn;
                if (p.y > 0) up = 1 - up;
            }
        }
        const double factor = own.exponent == 0 ? 1 : std::pow(away, own.exponent);
        if (own.shape != RoundWarp::Shape::cylinder) up *= factor;
        return oriented({across * factor, up, away}, own.orientation);
    }
    DVec3 operator()(const PlanarWarp& own) const { return oriented({p.x, p.y, own.offset}, own.orientation); }
    DVec3 operator()(const TurnedWarp& own) const {
        const double away = std::sqrt(p.x * p.x + p.z * p.z);
        return {away == 0 ? 0 : turn_of(p.x, p.z, away), (*own.height)(away, p.y), 0};
    }
    DVec3 operator()(const PlaceWarp& own) const {
        const DVec3 to = moved(own.moves->list, p);
        return {to.x, to.y, 0};
    }
    DVec3 operator()(const CubicWarp&) const {
        const double x = std::fabs(p.x), y = std::fabs(p.y), z = std::fabs(p.z);
        const auto third = [](double part, double t) { return part / 3 + (t + 1) / 6; };
        const auto quarter = [](double t) { return .25 * (t + 1) / 2; };
        if (p.x >= 0 && x >= y && x >= z) return {.75 - quarter(p.z / x), third(1, p.y / x), x};
        if (p.y >= 0 && y >= x && y >= z) return {.25 + quarter(p.x / y), 1 - third(0, p.z / y), y};
        if (p.z >= 0 && z >= x && z >= y) return {.25 + quarter(p.x / z), third(1, p.y / z), z};
        if (p.x < 0 && p.x <= -y && p.x <= -z) return {quarter(p.z / x), third(1, p.y / x), x};
        if (p.y < 0 && p.y <= -x && p.y <= -z) return {.25 + quarter(p.x / y), third(0, p.z / y), y};
        return {1 - quarter(p.x / z), third(1, p.y / z), z};
    }
};

}  // namespace

DVec3 moved(std::span<const Move> moves, DVec3 point) {
    move_points(moves, {&point, 1}, lattice::noise_by_points);
    return point;
}
void move_points(std::span<const Move> moves, std::span<DVec3> points, const lattice::NoiseLanes& noise) {
    std::vector<DVec3> ways;
    for (const Move& move : moves) {
        const Warp* const warp = std::get_if<Warp>(&move);
        const TurbulenceWarp* const turbulence = warp ? std::get_if<TurbulenceWarp>(warp) : nullptr;
        if (turbulence && points.size() > 1) {
            ways.resize(points.size());
            noise.vector_turbulence(points.data(), static_cast<int>(points.size()), turbulence->octaves,
                                    static_cast<float>(turbulence->omega), static_cast<float>(turbulence->lambda),
                                    ways.data());
            for (std::size_t i = 0; i < points.size(); ++i) points[i] += turbulence->by * ways[i];
            continue;
        }
        for (DVec3& point : points)
            point = warp ? std::visit(WarpPoint{point}, *warp) : transform_point(std::get<glm::dmat4>(move), point);
    }
    for (DVec3& point : points)
        for (int c = 0; c < 3; ++c) point[c] = std::clamp(point[c], -farthest, farthest);
}

MovedNormals::MovedNormals(std::span<const Move> moves) {
    for (const Move& move : moves)
        if (const auto* const matrix = std::get_if<glm::dmat4>(&move))
            back = back * glm::transpose(glm::dmat3(*matrix));
    there = glm::inverse(back);
}
DVec3 MovedNormals::moved(const DVec3& normal) const { return quick_unit(there * normal); }
DVec3 MovedNormals::unmoved(const DVec3& change, const DVec3& normal) const {
    return quick_length(there * normal) * (back * change);
}

}  // namespace strahl::pov

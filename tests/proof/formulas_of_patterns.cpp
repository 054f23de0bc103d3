// Compares errors of patterns' colours with the formulas of pattern_bounds_kernel.h, with the numbers that worlds
// have: at places that are off, near the borders of pieces and in them, against numbers of 113 bits.
#include "num/thread_pool.h"
#include "tests/proof/painted.h"
#include "tests/proof/trial.h"
#include "trace/proof/pattern_bounds_kernel.h"
#include "trace/proof/slack.h"
#include "trace/world/build_world.h"

using namespace strahl;
using namespace strahl::trial;

namespace {

/// Returns a place of the pattern's space, often near a border of its pieces.
Vector any_place(Dice& dice, const Pattern& pattern) {
    constexpr double border = 1e-10;
    const double far = std::pow(10, dice.in(-1, dice.chance(.1) ? 9 : 3));
    DVec3 p = dice.vector(-far, far);
    const Brick* const brick = std::get_if<Brick>(&pattern.kind);
    const Gradient* const gradient = std::get_if<Gradient>(&pattern.kind);
    Vector place = p;
    const auto near = [&] { return R(border) + R(dice.chance(.5) ? 1 : -1) * any_size(dice, -1); };
    const auto near_border = [&](double& x, R& exact, double size, double mortar) {
        if (dice.chance(.5)) return;
        x = size / 2 * std::floor(x / size), exact = R(x) - near() - R(dice.chance(.5) ? mortar : 0);
    };
    if (gradient) {
        const Vector axis = unit(Vector(gradient->axis));
        const R along = dot(axis, place);
        if (dice.chance(.6)) place = place + (R(std::floor(static_cast<double>(along))) - near() - along) * axis;
        return place;
    }
    near_border(p.x, place.x, brick ? brick->size.x : 2, brick ? brick->mortar : 0);
    near_border(p.y, place.y, brick ? brick->size.y : 2, brick ? brick->mortar : 0);
    near_border(p.z, place.z, brick ? brick->size.z : 2, brick ? brick->mortar : 0);
    return place;
}

/// Errors of colours in worlds of T, and their bounds.
template <class T>
struct ColorDifferences {
    Closest kinds[7] = {{"checker"}, {"gradient"}, {"brick"}, {"noise"}, {"marble"}, {"wood"}, {"image"}};
    Closest sky{"sky"}, untold{"any colour"};
    ThreadPool pool{1};

    static R off(const Vec3<T>& computed, const Vector& exact) {
        const Vector wrong = Vector{computed.x, computed.y, computed.z} - exact;
        return std::max({size(wrong.x), size(wrong.y), size(wrong.z)});
    }
    static Vec3<T> nearest(const Vector& v) { return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)}; }
    static double rounded_up(T bound) { return std::nextafter(static_cast<double>(bound), inf); }

    /// `own` is in the pattern's space; the place that is known is `away` along a direction from it.
    void take(const Scene& scene, const Vector& own, R away, const Vector& along) {
        const Placement placement = strahl::placement(extent_of(scene), scene.camera.position);
        const BuiltWorld<T> built(scene, placement, pool, nullptr, nullptr, true);
        const World<T>& world = built.world();
        const Pigment& pigment = scene.materials[0].rgb;
        const exact::Paint<R> paint(pigment, scene.primitives[0].transformations);
        const auto& [a, b, c] = paint.space.columns;
        const Vector in_world =
            R(placement.scale) * (own.x * a + own.y * b + own.z * c + paint.space.moved - Vector(placement.origin));
        const Vec3<T> known = nearest(in_world + away * length(in_world) * along);
        const Vector known_exactly{known.x, known.y, known.z};
        const T bound_of_place =
            static_cast<T>(length(known_exactly - in_world)) * (1 + 2 * std::numeric_limits<T>::epsilon());
        const Vector exact = paint.at(R(1) / R(placement.scale) * in_world + Vector(placement.origin));
        const PatternKernel<T>& kernel = world.patterns.list[0];
        const Vec3<T> color = color_at(world, kernel, known, T(-1));
        const T bound = color_error(world, kernel, off_place(kernel, known, bound_of_place));
        Closest& kind = bound < kernel.slack.apart ? kinds[pigment.pattern->kind.index()] : untold;
        kind.take(off(color, exact), rounded_up(bound));

        const Vector direction = unit(own), turned = unit(direction + away * along);
        const Vec3<T> ray = nearest(turned);
        const T turn = static_cast<T>(length(direction - unit(Vector{ray.x, ray.y, ray.z}))) *
                       (1 + 2 * std::numeric_limits<T>::epsilon());
        sky.take(off(PatternCalls<T>::sky(world, ray), exact::Paint<R>(scene.background, {}).at(direction)),
                 rounded_up(PatternBounds<T>::of_sky(world, ray, turn)));
    }
};

/// Errors of colours by uv, at a point of a triangle with given weights of its first two corners.
template <class T>
struct DifferencesByUv {
    Closest place{"places by uv"}, colors{"colours by uv"}, untold{"any colour by uv"};
    ThreadPool pool{1};

    void take(const Scene& scene, R first, R second, R away, const Vector& along) {
        const Placement placement = strahl::placement(extent_of(scene), scene.camera.position);
        const BuiltWorld<T> built(scene, placement, pool, nullptr, nullptr, true);
        const World<T>& world = built.world();
        const Slack<T> slack = slack_of<T>(scene, placement);
        const exact::Body<R> body(scene, scene.primitives[0]);
        const exact::Leaf<R>& leaf = body.leaves[0];
        const MeshData& mesh = *std::get<Mesh>(scene.primitives[0].shape).data;
        const auto corner = [&](int k) { return Vector(mesh.points[k]); };
        const auto& [a, b, c] = leaf.space.columns;
        const Vector own = first * corner(0) + second * corner(1) + (1 - first - second) * corner(2);
        const Vector point = own.x * a + own.y * b + own.z * c + leaf.space.moved;
        const Vector in_world = R(placement.scale) * (point - Vector(placement.origin));
        const Vec3<T> known = ColorDifferences<T>::nearest(in_world + away * R(placement.scale) * along);
        const Vector known_exactly{known.x, known.y, known.z};
        const T bound_of_point =
            static_cast<T>(length(known_exactly - in_world)) * (1 + 2 * std::numeric_limits<T>::epsilon());
        const PatternKernel<T>& kernel = world.patterns.list[0];
        const OffPlace<T> computed = off_place(world, kernel, known, T(0), bound_of_point, slack);
        const T bound = color_error(world, kernel, computed),
                color_off = static_cast<T>(
                    ColorDifferences<T>::off(color_at(world, kernel, known, T(0)), leaf.color_at(point, 0)));
        Closest& kind = bound < kernel.slack.apart ? colors : untold;
        kind.take(color_off, ColorDifferences<T>::rounded_up(bound));
        const Pattern& pattern = *scene.materials[0].rgb.pattern;
        if (!std::holds_alternative<ImagePattern>(pattern.kind) && !std::holds_alternative<Noise>(pattern.kind)) return;
        const auto& space = leaf.paint.space;  // that of the kernel, but for whole periods
        const Vector exact = space.turn(referee::place_in(mesh, 0, own) - space.moved);
        const R exactly[3]{exact.x, exact.y, exact.z};
        for (int i = 0; i < 3; ++i) {
            if (!(computed.off[i] < T(1e30))) continue;
            R wrong = R(computed.p[i]) - exactly[i];
            const R period = std::holds_alternative<Noise>(pattern.kind) ? 289 : 1;
            wrong = wrong - period * R(std::round(static_cast<double>(wrong / period)));
            place.take(size(wrong), ColorDifferences<T>::rounded_up(computed.off[i]));
        }
    }
};

std::vector<Transformation> any_steps(Dice& dice) {
    std::vector<Transformation> steps;
    for (int left = dice.upto(3); left > 0; --left) {
        const int which = dice.upto(2);
        if (which == 0) steps.push_back(Rotate{dice.vector(-200, 200)});
        if (which == 1) steps.push_back(Scale{std::pow(10, dice.in(-1, 1)) * dice.vector(.3, 1)});
        if (which == 2) steps.push_back(Translate{std::pow(10, dice.in(-1, 4)) * dice.direction()});
    }
    return steps;
}

}  // namespace

TEST_CASE("formulas of patterns") {
    ColorDifferences<double> differences;
    ColorDifferences<long double> in_extended;
    Dice dice(11);
    for (int i = 0; i < trials(); ++i) {
        Scene scene;
        scene.camera.position = std::pow(10, dice.in(-1, 4)) * dice.direction();
        scene.materials.emplace_back();
        scene.materials[0].rgb = proof::random_paint(dice, std::pow(10, dice.in(-1, 1)), dice.vector(-3, 3));
        scene.background = proof::random_paint(dice, .3, DVec3(0));
        scene.primitives.push_back({Sphere{{0, 0, 0}, 1}, 0, any_steps(dice)});
        const Vector own = any_place(dice, *scene.materials[0].rgb.pattern);
        const R away = any_size(dice, -1);
        const Vector along = dice.direction();
        differences.take(scene, own, away, along), in_extended.take(scene, own, away, along);
    }
}

TEST_CASE("formulas of patterns by uv") {
    DifferencesByUv<double> differences;
    DifferencesByUv<long double> in_extended;
    Dice dice(12);
    for (int i = 0; i < trials(); ++i) {
        Scene scene;
        scene.camera.position = std::pow(10, dice.in(-1, 4)) * dice.direction();
        scene.materials.emplace_back();
        const DVec3 a = std::pow(10, dice.in(-1, 3)) * dice.direction(), along = dice.direction();
        const double narrow = dice.chance(.3) ? std::pow(10, dice.in(-5, 0)) : 1;
        const DVec3 c = a + dice.in(.2, 2) * along + narrow * dice.direction();
        Mesh mesh{std::make_shared<const MeshData>(MeshData{{a, a + along, c}, {}, {{0, 1, 2}}, {}}), ""};
        proof::paint_by_uv(dice, mesh, scene.materials[0], 0);
        scene.primitives.push_back({mesh, 0, any_steps(dice)});
        const R first = dice.in(0, 1), second = dice.chance(.2) ? R(0) : (1 - first) * R(dice.in(0, 1));
        const R away = any_size(dice, -1);
        const Vector moved = dice.direction();
        differences.take(scene, first, second, away, moved), in_extended.take(scene, first, second, away, moved);
    }
}

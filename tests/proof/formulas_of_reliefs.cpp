// Compares errors of bent normals with the formulas of relief_bounds_kernel.h, with the numbers that
// worlds have: at places and for normals that are off, against numbers of 113 bits.
#include "num/thread_pool.h"
#include "tests/proof/painted.h"
#include "tests/proof/trial.h"
#include "trace/proof/relief_bounds_kernel.h"
#include "trace/proof/slack.h"
#include "trace/world/build_world.h"

using namespace strahl;
using namespace strahl::trial;

namespace {

/// Errors of bent normals in worlds of T, and their bounds.
template <class T>
struct NormalDifferences {
    Closest map{"normal maps"}, bump{"bumps"}, both{"bumps on normal maps"}, untold{"any normal"};
    ThreadPool pool{1};

    static Vec3<T> nearest(const Vector& v) { return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)}; }
    static Vector exactly(const Vec3<T>& v) { return {v.x, v.y, v.z}; }
    static double rounded_up(T bound) { return std::nextafter(static_cast<double>(bound), inf); }
    static T length_above(const Vector& v) {
        return static_cast<T>(length(v)) * (1 + 2 * std::numeric_limits<T>::epsilon());
    }

    /// At a point of the scene.
    void take(const Scene& scene, const Vector& point, const Vector& n, R away, R turned, const Vector& along) {
        const Placement placement = strahl::placement(extent_of(scene), scene.camera.position);
        const BuiltWorld<T> built(scene, placement, pool, nullptr, nullptr, true);
        const World<T>& world = built.world();
        const exact::Body<R> body(scene, scene.primitives[0]);
        const exact::Leaf<R>& leaf = body.leaves[0];
        const bool has_map = leaf.material.normal.pattern != nullptr, has_bump = leaf.material.bump.pattern != nullptr;
        const Vector in_world = R(placement.scale) * (point - Vector(placement.origin));
        const Vec3<T> known = nearest(in_world + away * R(placement.scale) * along);
        const Vec3<T> flat = nearest(unit(n + turned * along));
        const int materials[width<T>] = {world.patterns.first};
        const Vec3<T> computed = PatternCalls<T>::bent(world, materials, known, T(0), flat);
        const BentBounds<T> bound =
            PatternBounds<T>::of_normals(world, materials, known, T(0), flat, length_above(n - unit(exactly(flat))),
                                         length_above(exactly(known) - in_world), slack_of<T>(scene, placement));
        const R error = length(unit(exactly(computed)) - leaf.bent(point, 0, n));
        Closest& kind = !any(bound.told) ? untold : has_map && has_bump ? both : has_map ? map : bump;
        kind.take(error, any(bound.told) ? rounded_up(bound.off) : inf);
    }
};

std::vector<Transformation> some_steps(Dice& dice) {
    std::vector<Transformation> steps;
    if (dice.chance(.5)) steps.push_back(Rotate{dice.vector(-200, 200)});
    if (dice.chance(.5)) steps.push_back(Scale{std::pow(10, dice.in(-1, 1)) * dice.vector(.3, 1)});
    if (dice.chance(.5)) steps.push_back(Rotate{dice.vector(-200, 200)});
    if (dice.chance(.5)) steps.push_back(Translate{std::pow(10, dice.in(-1, 3)) * dice.direction()});
    return steps;
}

/// A world of one body with a bent material, and a point of it.
Scene bent_ball(Dice& dice, Vector& point) {
    Scene scene;
    scene.materials.emplace_back();
    proof::bend(dice, std::pow(10, dice.in(-1, 1)), dice.vector(-3, 3), scene.materials[0]);
    scene.primitives.push_back({Sphere{{0, 0, 0}, 1}, 0, some_steps(dice)});
    const exact::Body<R> body(scene, scene.primitives[0]);
    const exact::Leaf<R>& leaf = body.leaves[0];
    const bool by_bump = leaf.material.bump.pattern != nullptr;
    const Vector own = std::pow(10, dice.in(-1, 1)) * dice.direction();  // in the space of what bends last
    point = (by_bump ? leaf.bump.whole() : leaf.map.whole()).point(own);
    return scene;
}
/// A world of one triangle with a material bent by uv, and a point of it. The normal is often that of the triangle.
Scene bent_triangle(Dice& dice, Vector& point, Vector& n) {
    Scene scene;
    scene.materials.emplace_back();
    const DVec3 a = std::pow(10, dice.in(-1, 3)) * dice.direction(), along = dice.direction();
    const double narrow = dice.chance(.3) ? std::pow(10, dice.in(-4, 0)) : 1;
    const DVec3 c = a + dice.in(.2, 2) * along + narrow * dice.direction();
    Mesh mesh{std::make_shared<const MeshData>(MeshData{{a, a + along, c}, {}, {{0, 1, 2}}, {}}), ""};
    do proof::paint_by_uv(dice, mesh, scene.materials[0], .6);
    while (!scene.materials[0].bends());
    scene.primitives.push_back({mesh, 0, some_steps(dice)});
    const exact::Body<R> body(scene, scene.primitives[0]);
    const auto& [x, y, z] = body.leaves[0].space.columns;
    const auto in_world = [&](const Vector& v) { return v.x * x + v.y * y + v.z * z; };
    const R first = dice.in(0, 1), second = (1 - first) * R(dice.in(0, 1));
    point = in_world(first * Vector(a) + second * Vector(a + along) + (1 - first - second) * Vector(c)) +
            body.leaves[0].space.moved;
    const Vector across = unit(cross(in_world(Vector(a + along) - Vector(a)), in_world(Vector(c) - Vector(a))));
    if (dice.chance(.8)) n = unit(across + R(dice.chance(.5) ? 0 : dice.in(0, 1)) * n);
    return scene;
}

}  // namespace

TEST_CASE("formulas of reliefs") {
    NormalDifferences<double> differences;
    NormalDifferences<long double> in_extended;
    Dice dice(13);
    for (int i = 0; i < trials(); ++i) {
        Vector point, n = unit(Vector(dice.direction()));
        Scene scene = bent_ball(dice, point);
        scene.camera.position = std::pow(10, dice.in(-1, 4)) * dice.direction();
        const R away = any_size(dice), turned = any_size(dice);
        const Vector along = dice.direction();
        differences.take(scene, point, n, away, turned, along), in_extended.take(scene, point, n, away, turned, along);
    }
}

TEST_CASE("formulas of reliefs by uv") {
    NormalDifferences<double> differences;
    NormalDifferences<long double> in_extended;
    Dice dice(14);
    for (int i = 0; i < trials(); ++i) {
        Vector point, n = unit(Vector(dice.direction()));
        Scene scene = bent_triangle(dice, point, n);
        scene.camera.position = std::pow(10, dice.in(-1, 4)) * dice.direction();
        const R away = any_size(dice), turned = any_size(dice);
        const Vector along = dice.direction();
        differences.take(scene, point, n, away, turned, along), in_extended.take(scene, point, n, away, turned, along);
    }
}

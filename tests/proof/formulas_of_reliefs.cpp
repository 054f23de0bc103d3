// How far normals that reliefs bend may be off, by the formulas of relief_bounds_kernel.h and with the numbers that
// worlds have: at places and of normals that are off, against numbers of 113 bits.
#include "tests/proof/painted.h"
#include "tests/proof/trial.h"
#include "trace/build.h"
#include "trace/relief_bounds_kernel.h"
#include "trace/thread_pool.h"

using namespace strahl;
using namespace strahl::trial;

namespace {

/// Of worlds in T.
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

    /// The place is in the space of the pattern that bends last.
    void take(const Scene& scene, const Vector& own, const Vector& n, R away, R turned, const Vector& along) {
        const Placement placement = strahl::placement(extent_of(scene), scene.camera.position);
        const BuiltWorld<T> built(scene, placement, pool, nullptr, nullptr, true);
        const World<T>& world = built.world();
        const exact::Leaf<R>& leaf = exact::Body<R>(scene, scene.primitives[0]).leaves[0];
        const bool has_map = leaf.material.normal.pattern != nullptr, has_bump = leaf.material.bump.pattern != nullptr;
        const auto space = has_bump ? leaf.bump.whole() : leaf.map.whole();
        const Vector point = space.point(own), in_world = R(placement.scale) * (point - Vector(placement.origin));
        const Vec3<T> known = nearest(in_world + away * length(in_world) * along);
        const Vec3<T> flat = nearest(unit(n + turned * along));
        const int material = world.first_pattern;
        const int materials[width<T>] = {material};
        const Vec3<T> computed = PatternCalls<T>::bent(world, materials, known, T(0), flat);
        const BentBounds<T> bound =
            PatternBounds<T>::of_normals(world, materials, known, T(0), flat, length_above(n - unit(exactly(flat))),
                                         length_above(exactly(known) - in_world));
        const R error = length(unit(exactly(computed)) - leaf.bent(point, 0, n));
        Closest& kind = !any(bound.told) ? untold : has_map && has_bump ? both : has_map ? map : bump;
        kind.take(error, any(bound.told) ? rounded_up(bound.off) : inf);
    }
};

}  // namespace

TEST_CASE("formulas of reliefs") {
    NormalDifferences<double> differences;
    NormalDifferences<long double> in_extended;
    Dice dice(13);
    for (int i = 0; i < trials(); ++i) {
        Scene scene;
        scene.camera.position = std::pow(10, dice.in(-1, 4)) * dice.direction();
        scene.materials.emplace_back();
        proof::bend(dice, std::pow(10, dice.in(-1, 1)), dice.vector(-3, 3), scene.materials[0]);
        scene.primitives.push_back({Sphere{{0, 0, 0}, 1}, 0, {}});
        std::vector<Transformation>& steps = scene.primitives[0].transformations;
        if (dice.chance(.5)) steps.push_back(Rotate{dice.vector(-200, 200)});
        if (dice.chance(.5)) steps.push_back(Scale{std::pow(10, dice.in(-1, 1)) * dice.vector(.3, 1)});
        if (dice.chance(.5)) steps.push_back(Rotate{dice.vector(-200, 200)});
        if (dice.chance(.5)) steps.push_back(Translate{std::pow(10, dice.in(-1, 3)) * dice.direction()});
        const Vector own = std::pow(10, dice.in(-1, 1)) * dice.direction(), n = unit(Vector(dice.direction()));
        const R away = any_size(dice), turned = any_size(dice);
        const Vector along = dice.direction();
        differences.take(scene, own, n, away, turned, along), in_extended.take(scene, own, n, away, turned, along);
    }
}

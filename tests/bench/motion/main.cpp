// Measures the time before rays of a moving frame are traced: bench_motion [BALLS [FRAMES [THREADS [WORLDS]]]]
//
// Balls in a cube, each on a way of its own through three keys, or turning about the middle besides. Prints medians and
// ranges; the first frame builds the hierarchy.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "tests/bench/measure.h"
#include "trace/hierarchy/moving_hierarchy.h"
#include "trace/scene_in_time.h"
#include "trace/world/build_world.h"

namespace {

using namespace strahl;

Scene balls(int count, bool turning) {
    std::mt19937 random(1);
    const auto vector = [&](double reach) {
        std::uniform_real_distribution<double> within(-reach, reach);
        return DVec3(within(random), within(random), within(random));
    };
    Scene scene;
    scene.camera = {{0, -60, 30}, {0, 0, 0}, {0, 0, -1}, 30, {}};
    scene.lights = {{{-30, -40, 60}, Color(1)}};
    scene.materials.emplace_back();
    for (int i = 0; i < count; ++i) {
        Motion motion;
        const DVec3 start = vector(30), about = vector(170);
        for (int k = 0; k < 3; ++k)
            motion.keys.push_back({double(k), start + vector(3), turning ? about * (k / 2.) : DVec3(0), DVec3(1)});
        scene.primitives.push_back({Sphere{{0, 0, 0}, .08}, 0, {motion}});
    }
    return scene;
}

template <class T>
void measure(const Scene& scene, const char* what, int frames, ThreadPool& pool) {
    SceneInTime stage{Scene(scene)};
    std::vector<double> moved, made, whole;
    std::unique_ptr<BuiltWorld<T>> world;
    MovingHierarchy moving;
    for (int frame = 0; frame < frames; ++frame) {
        const double start = bench::seconds();
        stage.set(1.9 / 25 * frame / 3 + .05, nullptr, pool);
        const double set = bench::seconds();
        const Placement placed = placement(extent_of(stage.scene()), scene.camera.position);
        world.reset();
        world = std::make_unique<BuiltWorld<T>>(stage.scene(), placed, pool, &moving);
        const double end = bench::seconds();
        moved.push_back(set - start), made.push_back(end - set), whole.push_back(end - start);
    }
    const auto print = [](const char* stage, const std::vector<double>& seconds) {
        const auto [least, most] = std::ranges::minmax(seconds);
        std::printf("  %s %.1f (%.1f to %.1f)", stage, 1000 * bench::median(seconds), 1000 * least, 1000 * most);
    };
    std::printf("%s, in ms:", what);
    print("scene", moved), print("world", made), print("together", whole);
    std::puts("");
}

}  // namespace

int main(int argc, char** argv) {
    const auto argument = [&](int i, int otherwise) { return argc > i ? std::atoi(argv[i]) : otherwise; };
    const int count = argument(1, 100000), frames = argument(2, 30);
    ThreadPool pool(argument(3, 0));
    const Scene moved = balls(count, false), turned = balls(count, true);
    const int worlds = argument(4, 3);
    measure<float>(moved, "float", frames, pool);
    if (worlds > 1) measure<double>(moved, "double", frames, pool);
    if (worlds > 2) measure<float>(turned, "float, turning", frames, pool);
}

// Pictures are the same bit for bit however pixels are divided into batches, tiles, crops and threads, and whatever was
// traced before: of random worlds of every kind of body, pattern, finish and light. So are their files and films.
#include <doctest/doctest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "num/thread_pool.h"
#include "tests/referee/dice.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/scenes.h"
#include "tests/unit/scratch.h"
#include "tests/unit/trace/cut_out.h"
#include "text/write.h"
#include "trace/cells/cell_picture.h"
#include "trace/tracer.h"

namespace strahl::history {

/// Gives some materials other finishes and media: any number of the field table may change, but those of geometry.
void change_finishes(Scene& scene, Dice& dice) {
    const auto change = [&]<class Value>(Value& value) {
        if (!dice.chance(.15)) return;
        if constexpr (std::is_same_v<Value, double>)
            value = dice.in(0, 1);
        else if constexpr (std::is_same_v<Value, Color>)
            value = dice.vector(0, 1);
    };
    for (Material& material : scene.materials) {
        if (dice.chance(.4)) continue;
        const double ior = material.ior;
        std::apply([&](const auto&... field) { (change(material.*field.member), ...); }, Material::fields);
        material.ior = ior, material.roughness = dice.in(.01, .3);
        material.irid *= .3, material.seen = material.mirrored = 1;
    }
}

Scene scene_of(int seed) {
    Dice dice(seed);
    Scene scene = random_scene(seed, {.lights = seed % 2 == 1,
                                      .patterns = seed % 3 != 0,
                                      .bumps = seed % 4 == 1,
                                      .camera_inside = seed % 5 == 2,
                                      .any_kind = .5});
    if (seed % 2 == 0) change_finishes(scene, dice);
    return scene;
}

/// Shapes of the pictures: none is 4:3.
constexpr std::array<std::array<int, 2>, 7> shapes{
    {{32, 18}, {19, 19}, {14, 25}, {42, 18}, {1, 40}, {40, 1}, {35, 22}}};

const Sampling averages{.error = .02};
constexpr int whole_queue = std::numeric_limits<int>::max();  // batches are as large as fits

/// Traces pictures in one precision, and counts the batches that were split.
struct Pictures {
    View view;
    std::uint64_t split = 0;

    std::vector<double> trace(Tracer& tracer, const Lattice& part, const Sampling& sampling, int threads, int queue) {
        ThreadPool pool(threads);
        std::vector<double> values(std::size_t(3) * part.columns * part.rows);
        const auto keep = [&](const Tile& tile) { place(tile, part, values); };
        split += tracer.trace({view, pool, keep, nullptr, queue}, SampledRegion{part, sampling}).split;
        return values;
    }
    /// Traces it as the option --stats does: pixels are checked in between.
    std::vector<double> trace_checked(Tracer& tracer, const Lattice& part, int queue) {
        ThreadPool pool(1);
        std::vector<double> values(std::size_t(3) * part.columns * part.rows);
        CellPicture picture(tracer.scene(), view, part, averages.error);
        picture.check(40);
        const auto keep = [&](const Tile& tile) { place(tile, part, values); };
        split += tracer.trace({view, pool, keep, nullptr, queue}, CellPass{picture, 0}).split;
        return values;
    }
};

/// Does a pixel take few enough rays that the test ends in seconds?
bool affordable(const Scene& scene, const View& view) {
    constexpr int most = 30, step = 3;
    ThreadPool one(1);
    const Lattice few{0, 0, (view.width + step - 1) / step, (view.height + step - 1) / step, step, step};
    const Counts counts = Tracer(scene, Precision::float32).trace({view, one, [](const Tile&) {}}, few);
    return counts.total() < std::uint64_t(most) * few.columns * few.rows;
}

template <class Check>
void each_world(int count, const Check& check) {
    for (int seed = 1, left = count; left > 0; ++seed) {
        CAPTURE(seed);
        const Scene scene = scene_of(seed);
        const auto [width, height] = shapes[static_cast<std::size_t>(seed) % shapes.size()];
        const Precision precision = seed % 3 == 0 ? Precision::float32 : Precision::float64;
        const View view{
            .camera = scene.camera, .width = width, .height = height, .depth = 5, .error = seed % 2 ? 1. / 510 : 0};
        if (affordable(scene, view)) check(seed, scene, view, precision), --left;
    }
}

TEST_CASE("pictures of random worlds do not depend on batches, threads, crops or what was traced before") {
    std::uint64_t split = 0;
    each_world(16, [&](int seed, const Scene& scene, const View& view, Precision precision) {
        Dice dice(1000 + seed);
        Pictures pictures{view};
        const Lattice all{.columns = view.width, .rows = view.height};
        View other = view;
        other.camera.position = other.camera.position + .3 * dice.direction();
        other.depth = 2;
        for (const Sampling& sampling : {averages, Sampling{.grid = 1}}) {
            CAPTURE(sampling.grid);
            Tracer fresh(scene, precision);
            const auto whole = pictures.trace(fresh, all, sampling, 1, whole_queue);
            const auto again = [&](Tracer& tracer, const Lattice& part, int threads, int queue) {
                CAPTURE(part.x);
                CAPTURE(part.y);
                CAPTURE(part.columns);
                CAPTURE(part.rows);
                CAPTURE(threads);
                CAPTURE(queue);
                CHECK(pictures.trace(tracer, part, sampling, threads, queue) == cut_out(whole, view.width, part));
            };
            Tracer used(scene, precision);
            {
                Pictures before{other};
                before.trace(used, all, sampling, 2, 30);
            }
            for (const int threads : {1, 2, 3, 7}) again(used, all, threads, 1 << dice.upto(12));
            for (const int queue : {1, 17, 100, 400}) again(used, all, 1, queue);
            for (int i = 0; i < 4; ++i) {
                const int multiple = 1 << dice.upto(3);  // corners are at multiples of 1, 2, 4 or 8
                const int x = dice.upto(view.width - 1) / multiple * multiple;
                const int y = dice.upto(view.height - 1) / multiple * multiple;
                const Lattice crop{x, y, 1 + dice.upto(view.width - x - 1), 1 + dice.upto(view.height - y - 1)};
                again(i % 2 ? used : fresh, crop, 1 + i % 2, i % 2 ? 50 : whole_queue);
            }
            if (sampling.grid == 0) {
                CHECK(pictures.trace_checked(fresh, all, whole_queue) == whole);
                CHECK(pictures.trace_checked(used, all, 60) == whole);
            }
        }
        split += pictures.split;
    });
    MESSAGE(split << " batches were split");
    CHECK(split > 1000);
}

TEST_CASE("a moment of a flight is the same picture, whichever moments were traced before") {
    for (const char* name : {"flythrough", "beat"}) {
        CAPTURE(name);
        const Scene scene = read_scene(name);
        Pictures moment{{.camera = scene.camera, .width = 48, .height = 27, .depth = 4}};
        const Lattice all{.columns = 48, .rows = 27};
        const auto at = [&](Tracer& tracer, double time, int threads, int queue) {
            moment.view.time = time;
            return moment.trace(tracer, all, {}, threads, queue);
        };
        Tracer tracer(scene, Precision::float64);
        at(tracer, 0, 2, whole_queue);
        for (const double time : {3.7, 1.2, 9.}) {
            Tracer fresh(scene, Precision::float64);
            CHECK(at(tracer, time, 2, 70) == at(fresh, time, 1, whole_queue));
        }
    }
}

/// Runs strahl in a folder, where a script `ffmpeg` may replace the program.
bool run(const Scratch& folder, const std::string& arguments) {
    const std::string command =
        "cd '" + (folder / "") + "' && PATH=\"$PWD:$PATH\" " STRAHL_EMULATOR " '" STRAHL_BINARY "/strahl' " + arguments;
    CAPTURE(command);
    const bool done = std::system(command.c_str()) == 0;
    CHECK(done);
    return done;
}

TEST_CASE("files are the same, whether a picture is made in parts, and a frame alone or in a film") {
    const Scratch folder;
    // A film is what ffmpeg is given.
    std::ofstream(folder / "ffmpeg") << "#!/bin/sh\nfor film; do :; done\nexec cat >\"${film#file:}\"\n";
    std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
    int used = 0;
    each_world(16, [&](int seed, Scene scene, const View&, Precision precision) {
        Dice dice(2000 + seed);
        const Camera& camera = scene.camera;
        scene.flythrough = Flythrough{.duration = 1, .keys = {{0, camera.position, camera.look_at, {}, {}}}};
        scene.flythrough->keys.push_back({1, camera.position + .3 * dice.direction(), camera.look_at, {}, {}});
        const std::string text = write_scene(scene);
        if (used == 4 || text.find('"') != text.npos) return;  // its pictures are in no files
        ++used;
        std::ofstream(folder / "scene.rt") << text;
        const std::string all = "render scene.rt --quiet --fps 3 --depth 5 --precision " +
                                std::string(precision == Precision::float32 ? "float" : "double");
        const auto render = [&](const std::string& options) {
            return run(folder, all + " --threads " + std::to_string(1 + dice.upto(2)) + options);
        };
        const auto bytes = [&](const std::string& name) { return bytes_of(folder / name); };

        // Four bands of 64 rows, in three parts.
        const std::string tall = " --size 12x200 -o tall.png";
        if (!render(tall)) return;
        const std::string whole = bytes("tall.png");
        for (const int part : {2, 3, 1}) render(tall + " --part " + std::to_string(part) + "/3");
        std::filesystem::remove(folder / "tall.png");
        run(folder, "join tall.png.part-* -o tall.png");
        CHECK(bytes("tall.png") == whole);

        const std::string small = " --size 28x16";
        std::string frames;
        for (int i = 0; i < 3; ++i) {
            const std::string number = std::to_string(i);
            render(small + " -o - --format y4m --frames " + number + " > frame.y4m");
            const std::string frame = bytes("frame.y4m");
            frames += i == 0 ? frame : frame.substr(frame.find('\n') + 1);
        }
        render(small + " -o film.mkv --frames 0-2");
        CHECK(bytes("film.mkv") == frames);
        for (const int part : {2, 1})
            render(small + " -o film%d.png --frames 0-2 --part " + std::to_string(part) + "/2");
        render(small + " -o alone%d.png --frames 2");
        CHECK(bytes("film2.png") == bytes("alone2.png"));
    });
    CHECK(used == 4);
}

}  // namespace strahl::history

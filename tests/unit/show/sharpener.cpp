// Pictures in motion, sharpened where they change most.
#include "show/motion/sharpener.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <string>

#include "num/thread_pool.h"
#include "show/motion/quality.h"
#include "show/motion/quick_pictures.h"
#include "tests/unit/scenes.h"

namespace strahl::sharpening {

constexpr int width = 331, height = 243;  // no multiples of steps or blocks

/// A scene, its view, and pictures of it.
struct Pictures {
    explicit Pictures(const std::string& name, int threads = 2)
        : scene(read_scene(name)), pool(threads), tracer(scene, Precision::float32) {}

    /// Returns a picture of a level, sharpened with so many rays after the first ones; with none, as it was.
    ScreenImage sharpened(int level, double rays, const std::atomic<bool>* stop = nullptr) {
        const Lattice pixels = pixels_of(level, width, height);
        ScreenImage traced{pixels.columns, pixels.rows, {}}, whole;
        const auto keep = [&](const Tile& tile) {
            const std::vector<std::uint32_t> colors = encoded(tile, table);
            const Lattice& part = tile.lattice;
            store({part.x / pixels.step_x, part.y / pixels.step_y, part.columns, part.rows}, colors.data(), traced);
        };
        traced.resize(pixels.columns, pixels.rows), whole.resize(width, height);
        tracer.trace({view, pool, keep}, pixels);
        if (level == finest_level)
            whole = traced;
        else
            expand(traced, steps_of(level), whole, pool);
        if (rays <= 0) return whole;
        // By this clock tracing takes a second each time, and so does what is done before, between and after that.
        int calls = 0;
        const auto clock = [&] { return double(calls++); };
        Sharpener sharpener;
        ScreenImage first = whole;
        const Job job{view, pool, {}, stop};
        const Counts before = sharpener.sharpen(tracer, job, table, traced, steps_of(level), 1, clock, first);
        CHECK(before.camera <= 4096);
        const double traced_times = (calls - 2) / 2., choices = calls - 1 - traced_times;
        CHECK(sharpener.sharpen(tracer, job, table, traced, steps_of(level), .9 * choices, clock, first).camera == 0);
        const double seconds = before.camera > 0 ? traced_times * rays / static_cast<double>(before.camera) : 1;
        taken = sharpener.sharpen(tracer, job, table, traced, steps_of(level), choices + seconds, clock, whole);
        return whole;
    }
    /// Returns how far a picture is from the finished one, which is traced once.
    double rms(const ScreenImage& image) {
        if (finished.pixels.empty()) finished = traced_picture(tracer, view, pool, table, {});
        QualityLog log;
        log.add(image, finished, false);
        return log.quality().rms;
    }

    Scene scene;
    ThreadPool pool;
    Tracer tracer;
    TransferTable table{scene.settings.assumed_gamma};
    View view{.camera = scene.camera, .width = width, .height = height};
    Counts taken;
    ScreenImage finished;
};

TEST_CASE("the more rays sharpen a picture, the better it is, and it soon beats one ray in each pixel") {
    for (const std::string name : {"article", "flythrough", "mirror_ball"}) {
        CAPTURE(name);
        Pictures pictures(name);
        double last = pictures.rms(pictures.sharpened(ninth_level, 0));
        const double one = pictures.rms(pictures.sharpened(finest_level, 0));
        for (const double share : {.04, .12, .36}) {
            CAPTURE(share);
            const double rays = share * width * height, off = pictures.rms(pictures.sharpened(ninth_level, rays));
            CHECK(static_cast<double>(pictures.taken.camera) <= 1.02 * rays);
            CHECK(off < last);
            last = off;
        }
        CHECK(pictures.rms(pictures.sharpened(finest_level, .2 * width * height)) < .9 * one);
        // With less than half of its rays; nearly all pixels of mirror_ball differ from their neighbours.
        CHECK(last < (name == "mirror_ball" ? 1 : .8) * one);
    }
}

TEST_CASE("the steps of the next picture suit the last one: a floor is seen better with as many pixels") {
    Pictures pictures("mirror_ball");
    QuickPictures quick;
    const auto off = [&] {
        ScreenImage image;
        const Job job{pictures.view, pictures.pool, {}};
        quick.trace(
            pictures.tracer, job, pictures.table, {}, ninth_level, [] { return 0.; }, true, image);
        return pictures.rms(image);
    };
    const double square = off(), suited = off();
    CHECK(suited < .9 * square);
    CHECK(off() == suited);
}

TEST_CASE("sharpened pictures do not depend on threads, and all levels can be sharpened") {
    Pictures one("article", 1), three("article", 3);
    for (int level = 0; level <= finest_level; ++level) {
        CAPTURE(level);
        const ScreenImage plain = one.sharpened(level, 0), sharp = one.sharpened(level, 9000);
        CHECK(sharp.pixels == three.sharpened(level, 9000).pixels);
        CHECK(one.rms(sharp) < one.rms(plain));
    }
}

TEST_CASE("a smooth picture needs no sharpening, and a stopped job changes nothing") {
    Pictures pictures("article");
    const std::atomic<bool> stop = true;
    const ScreenImage plain = pictures.sharpened(ninth_level, 0);
    CHECK(pictures.sharpened(ninth_level, 9000, &stop).pixels == plain.pixels);
    pictures.view.camera.fov = 1e-3;
    CHECK(pictures.sharpened(ninth_level, 9000).pixels == pictures.sharpened(ninth_level, 0).pixels);
    CHECK(pictures.taken.camera == 0);
}

}  // namespace strahl::sharpening

// Pictures of a scene in motion, sharpened with a number of rays.
#pragma once
#include <doctest/doctest.h>

#include <atomic>
#include <string>

#include "num/thread_pool.h"
#include "show/motion/quality.h"
#include "show/motion/quick_pictures.h"
#include "show/motion/sharpener.h"
#include "tests/unit/scenes.h"

namespace strahl::sharpening {

inline constexpr int width = 331, height = 243;  // no multiples of steps or blocks

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
        // A clock that is a second later at each look: tracing takes a second each time, and so does what is around it.
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

}  // namespace strahl::sharpening

// The window's tracing thread: the newest view is traced, coarse and then finer.
#include <doctest/doctest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "image/transfer.h"
#include "show/work/trace_thread.h"
#include "tests/unit/show/show_scene.h"

using namespace strahl;

namespace {

Order order_of(std::uint64_t number, std::shared_ptr<const Scene> scene, int width, int height, double fov = 12) {
    Order order{.number = number, .scene = scene, .view = {.camera = scene->camera, .width = width, .height = height}};
    order.view.camera.fov = fov;
    return order;
}

/// Watches a tracing thread as the window does.
class Watcher {
  public:
    explicit Watcher(int threads = 2) : tracing(threads, [this] { hear(); }) {}

    /// Takes updates until `enough`; false after a minute without one.
    bool watch(const std::function<bool(const Refinement&)>& enough) {
        while (true) {
            {
                std::unique_lock lock(mutex);
                if (!wake.wait_for(lock, std::chrono::seconds(60), [this] { return heard; })) return false;
                heard = false;
            }
            const auto notify = tracing.take([this](const Fresh& fresh) { copy(fresh); });
            if (notify) state = *notify;
            if (notify && enough(state)) return true;
        }
    }
    bool finish(std::uint64_t number) {
        return watch([=](const Refinement& r) { return r.number == number && r.finished(); });
    }

    Refinement state;
    ScreenImage screen;  // only rows that were reported as new are copied
    int whole_images = 0;

  private:
    void hear() {
        {
            std::lock_guard lock(mutex);
            heard = true;
        }
        wake.notify_one();
    }
    void copy(const Fresh& fresh) {
        if (fresh.image.width != screen.width || fresh.image.height != screen.height)
            CHECK((fresh.first_row == 0 && fresh.rows == fresh.image.height));
        whole_images += fresh.rows == fresh.image.height;
        screen.resize(fresh.image.width, fresh.image.height);
        const auto from = std::ptrdiff_t(fresh.first_row) * screen.width,
                   size = std::ptrdiff_t(fresh.rows) * screen.width;
        std::copy_n(fresh.image.pixels.begin() + from, size, screen.pixels.begin() + from);
    }

    std::mutex mutex;
    std::condition_variable wake;
    bool heard = false;

  public:
    TraceThread tracing;  // the last member, so that it ends before those that it calls are gone
};

struct Exact {
    ScreenImage image;
    Counts rays;
};
Exact exact(const Order& order) {
    const View& view = order.view;
    Frame frame{view.width, view.height, std::vector<double>(std::size_t(3) * view.width * view.height)};
    const Lattice whole{.columns = view.width, .rows = view.height};
    ThreadPool pool(1);
    Tracer tracer(*order.scene, Precision::float32);
    const auto keep = [&](const Tile& tile) { place(tile, whole, frame.rgb); };
    const Counts rays = tracer.trace({view, pool, keep}, SampledRegion{whole, {}});
    ScreenImage image;
    image.resize(frame.width, frame.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = 0xff000000u;
        for (int c = 0; c < 3; ++c)
            image.pixels[i] |= quantise(frame.rgb[3 * i + c], order.scene->settings.assumed_gamma, 255) << 8 * (2 - c);
    }
    return {image, rays};
}

}  // namespace

TEST_CASE("the finished picture equals one rendered in float") {
    for (const char* more : {"", "global_settings { assumed_gamma 1 }"})
        for (const auto& [width, height] : {std::pair{64, 48}, {77, 35}, {5, 3}}) {
            Watcher watcher;
            const Order order = order_of(1, shown_scene(more), width, height);
            watcher.tracing.want(order);
            REQUIRE(watcher.finish(1));
            CHECK(watcher.screen.pixels == exact(order).image.pixels);
            CHECK(watcher.state.rays.camera > std::uint64_t(width * height));
            CHECK(watcher.state.share == doctest::Approx(1));
        }
}

TEST_CASE("the newest view wins") {
    Watcher watcher;
    const auto scene = shown_scene();
    Order order;
    for (int i = 1; i <= 200; ++i) {
        order = order_of(i, scene, 64 + i % 3, 48, 10 + 0.01 * i);
        watcher.tracing.want(order);
    }
    REQUIRE(watcher.finish(200));
    CHECK(watcher.screen.pixels == exact(order).image.pixels);
    CHECK(watcher.tracing.finished());
}

TEST_CASE("in motion a picture is not refined; at rest refinement continues") {
    Watcher watcher;
    Order order = order_of(1, shown_scene(), 64, 48);
    order.moving = true, order.finest = 3;
    watcher.tracing.want(order);
    REQUIRE(watcher.watch([](const Refinement& r) { return r.number == 1; }));
    CHECK(watcher.state.level == 2);    // to begin with
    CHECK(watcher.screen.width == 64);  // between every 8th pixel it is interpolated
    const std::uint64_t first = watcher.state.rays.camera;
    CHECK(first <= 9 * 9);  // a cell of 8x8 pixels of the level, with its corners
    CHECK(!watcher.tracing.finished());
    order.moving = false;
    watcher.tracing.want(order);
    REQUIRE(watcher.watch([](const Refinement& r) { return r.level > 2; }));
    REQUIRE(watcher.finish(1));
    // The passes are levels of one hierarchy: together they have the rays of the finished picture.
    CHECK(watcher.state.rays.camera == first + exact(order).rays.camera);
    CHECK(watcher.screen.pixels == exact(order).image.pixels);
}

TEST_CASE("in motion a picture has all pixels, with rays where they are needed; the finished one is exact") {
    Watcher watcher;
    Order order = order_of(1, shown_scene(), 96, 64);
    order.moving = true;
    for (; order.number <= 20; ++order.number, order.view.camera.fov += .01) {
        watcher.tracing.want(order);
        REQUIRE(watcher.watch([&](const Refinement& r) { return r.number == order.number; }));
        CHECK(watcher.screen.width == 96);
        CHECK(watcher.state.rays.camera < 96 * 64 * 3 / 2);
    }
    order.moving = false;
    watcher.tracing.want(order);
    REQUIRE(watcher.finish(order.number));
    CHECK(watcher.screen.pixels == exact(order).image.pixels);
}

TEST_CASE("the resolution follows the budget, up to the limit") {
    Watcher watcher;
    const auto scene = shown_scene();
    for (const auto& [budget, finest, level] : {std::tuple{1e9, 5, 5}, {1e9, finest_level, finest_level}, {1e-9, 8, 0}})
        for (int i = 1; i <= 50; ++i) {
            Order order = order_of(watcher.state.number + 1, scene, 32, 24, 10 + 0.01 * i);
            order.moving = true, order.budget = budget, order.finest = finest;
            watcher.tracing.want(order);
            REQUIRE(watcher.watch([&](const Refinement& r) { return r.number == order.number; }));
            if (i == 50) CHECK(watcher.state.level == level);
        }
}

TEST_CASE("another scene, another depth, another size") {
    Watcher watcher;
    Order order = order_of(1, shown_scene(), 64, 48);
    watcher.tracing.want(order);
    REQUIRE(watcher.finish(1));
    order.number = 2, order.view.depth = 1;
    watcher.tracing.want(order);
    REQUIRE(watcher.finish(2));
    CHECK(watcher.screen.pixels == exact(order).image.pixels);
    order = order_of(3, shown_scene("background { color <1,0,0> } global_settings { assumed_gamma 1 }"), 40, 30);
    watcher.tracing.want(order);
    REQUIRE(watcher.finish(3));
    CHECK(watcher.screen.pixels == exact(order).image.pixels);
}

TEST_CASE("tracing can be stopped at any time") {
    const auto scene = shown_scene();
    for (int i = 0; i < 30; ++i) {
        TraceThread tracing(2, [] {});
        if (i % 3 > 0) tracing.want(order_of(1, scene, 400, 300));
        if (i % 3 > 1) std::this_thread::sleep_for(std::chrono::microseconds(100 * i));
    }
    CHECK(true);
}

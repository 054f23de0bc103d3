// The second picture, to the right of the window's divider, without a window.
#include <doctest/doctest.h>
#include <signal.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "image/transfer_table.h"
#include "scene/ray_hits.h"
#include "show/second/second_pictures.h"
#include "show/session/body_editor.h"
#include "show/session/divider.h"
#include "tests/unit/scratch.h"
#include "tests/unit/show/show_scene.h"
#include "tests/unit/show/soon.h"
#include "trace/tracer.h"

using namespace strahl;

namespace {

/// Takes the place of POV-Ray: notes its process and its arguments, and runs `script` in its folder.
class StandInForPovray {
  public:
    explicit StandInForPovray(const std::string& script) {
        std::ofstream(folder / "povray") << "#!/bin/sh\necho $$ \"$@\" >>'" + folder / "runs" + "'\n" << script << '\n';
        std::filesystem::permissions(folder / "povray", std::filesystem::perms::owner_all);
        ::setenv("PATH", ((folder / "") + ":" + path).c_str(), 1);
        ::setenv("TMPDIR", (folder / "").c_str(), 1);
    }
    ~StandInForPovray() {
        ::setenv("PATH", path.c_str(), 1);
        ::unsetenv("TMPDIR");
    }
    std::string runs() const { return bytes_of(folder / "runs"); }

    Scratch folder;

  private:
    std::string path = ::getenv("PATH");
};

SecondOrder order_of(std::shared_ptr<const Scene> scene, SecondKind kind, double fov = 12) {
    SecondOrder order{kind, scene, {.camera = scene->camera, .width = 20, .height = 15, .depth = 4}, "scene.rt"};
    order.view.camera.fov = fov;
    return order;
}

}  // namespace

TEST_CASE("the divider is taken hold of where it is, and stays in the picture") {
    const ScreenArea area{100, 50, 400, 300};
    Divider line;
    CHECK(!line.reached(area, 300, 100, 6));
    line.next();
    CHECK(line.second == SecondKind::povray);
    CHECK(line.column(area) == 300);
    CHECK(line.reached(area, 306, 50, 6));
    CHECK(!line.reached(area, 307, 50, 6));
    CHECK(!line.reached(area, 300, 49, 6));
    CHECK(!line.reached(area, 300, 350, 6));
    line.pull(area, 200);
    CHECK(line.at == .25);
    line.pull(area, 9999), CHECK(line.column(area) == 500);
    line.pull(area, -9999), CHECK(line.column(area) == 100);
    line.at = .25;
    CHECK(!line.other_view());
    CHECK(line.second_area(area) == ScreenArea{200, 50, 300, 300});
    line.second = SecondKind::flight;
    CHECK(line.other_view());
    CHECK(line.second_area(area) == ScreenArea{200, 87, 300, 225});  // with the proportions of the picture
    line.at = 1;
    CHECK(line.second_area(area).height == 0);
    line.second = SecondKind::povray;
    while (line.shown()) CHECK(second_name(line.second) != ""), line.next();
    CHECK(second_name(line.second) == "");
}

TEST_CASE("a picture of one ray, and one in long double, are what the tracer makes") {
    const auto scene = shown_scene();
    ThreadPool pool(1);
    const std::atomic<bool> stop = false;
    const SecondOrder order = order_of(scene, SecondKind::one_ray);
    int stages = 0;
    make_second(order, pool, stop, [&](const SecondPicture& made) {
        ++stages;
        const Frame frame = render(*scene, order.view, Precision::float32, 1);
        for (std::size_t i = 0; i < made.image.pixels.size(); ++i)
            CHECK(made.image.pixels[i] == TransferTable(false).pixel(&frame.rgb[3 * i]));
        CHECK(made.finished);
        CHECK(made.differing > 10);  // edges
        CHECK(made.differing < 150);
    });
    make_second(order_of(scene, SecondKind::extended), pool, stop, [&](const SecondPicture& made) {
        ++stages;
        CHECK(made.differing == 0);
        CHECK(made.image.pixels.size() == 300);
        // Each precision chooses its own number of rays: averages differ by less than a step, which is shown 16 times.
        for (const std::uint32_t pixel : made.difference.pixels) CHECK((pixel & 0xff) <= 16);
    });
    CHECK(stages == 2);
    // Compares what the camera of the flight sees with nothing, and in motion traces it with one ray.
    SecondOrder of_flight = order_of(scene, SecondKind::flight);
    for (const bool brief : {true, false}) {
        of_flight.brief = brief;
        make_second(of_flight, pool, stop, [&](const SecondPicture& made) {
            ++stages;
            CHECK(made.finished);
            CHECK(made.difference.pixels.empty());
            View view = of_flight.view;
            const Lattice whole{.columns = view.width, .rows = view.height};
            Tracer tracer(*scene, Precision::float32);
            const Sampling sampling = brief ? Sampling{.grid = 1} : Sampling{};
            const auto values = values_of(tracer, view, whole, pool, sampling, &stop);
            for (std::size_t i = 0; i < made.image.pixels.size(); ++i)
                CHECK(made.image.pixels[i] == TransferTable(false).pixel(&values[3 * i]));
        });
    }
    CHECK(stages == 4);
}

TEST_CASE("a layer knows the distance, the normal and the point of each pixel's middle") {
    const auto scene = shown_scene();
    ThreadPool pool(1);
    const std::atomic<bool> stop = false;
    int bodies = 0, stages = 0;
    for (const SecondKind kind : {SecondKind::depth, SecondKind::normals}) {
        const SecondOrder order = order_of(scene, kind);
        make_second(order, pool, stop, [&](const SecondPicture& made) {
            ++stages;
            CHECK((made.finished && made.difference.pixels.empty() && made.seen.size() == 300));
            float nearest = std::numeric_limits<float>::infinity();
            for (const auto& seen : made.seen) nearest = std::min(nearest, seen.distance);
            for (int i = 0; i < 300; ++i) {
                const auto ray = ray_at(order.view, i % 20 + .5, i / 20 + .5);
                const auto hits = bodies_along(*scene, ray);
                const auto& [distance, normal, position] = made.seen[std::size_t(i)];
                const std::uint32_t pixel = made.image.pixels[std::size_t(i)] & 0xffffff;
                REQUIRE(std::isinf(distance) == hits.empty());
                if (hits.empty()) {
                    CHECK(pixel == 0);
                    continue;
                }
                ++bodies;
                const auto& hit = hits[0].hit;
                CHECK(double(distance) == doctest::Approx(hit.t).epsilon(1e-5));
                const DVec3 point = ray.origin + hit.t * ray.direction;
                for (int c = 0; c < 3; ++c) {
                    CHECK(std::abs(double(position[std::size_t(c)]) - point[c]) < 1e-4);
                    CHECK(std::abs(double(normal[std::size_t(c)]) - hit.normal[c]) < 1e-4);
                    const double share = kind == SecondKind::depth ? double(nearest) / hit.t : (1 + hit.normal[c]) / 2;
                    CHECK(std::abs(double(pixel >> (8 * (2 - c)) & 255) - 255 * share) < .51);
                }
            }
        });
    }
    CHECK((stages == 2 && bodies > 100));
}

TEST_CASE("pictures on the screen are compared by steps of 8 bits") {
    SecondPicture result;
    result.image.resize(2, 1), result.image.pixels = {0xff102030u, 0xff102030u};
    ScreenImage other;
    other.resize(2, 1), other.pixels = {0xff112030u, 0xff10221fu};
    compare(other, result);
    CHECK(result.difference.pixels == std::vector<std::uint32_t>{0xff100000u, 0xff0020ffu});
    CHECK(result.differing == 1);
    compare(result.image, result);
    CHECK(result.differing == 0);
}

TEST_CASE("POV-Ray's picture comes in two stages, is kept, and ends when another one is wanted") {
    const StandInForPovray povray(
        "(printf 'P6 20 15 255\\n'; head -c 900 /dev/zero | tr '\\0' '\\200') >scene.ppm; "
        "[ ! -e \"${TMPDIR}slow\" ] || exec sleep 1000");
    const auto scene = shown_scene();
    SecondPictures pictures(1, [] {});
    const SecondOrder first = order_of(scene, SecondKind::povray);
    bool unfinished = false;
    const auto finish = [&] {
        return soon([&] {
            pictures.take();
            unfinished |= pictures.picture() && !pictures.picture()->finished;
            return !pictures.under_way();
        });
    };
    pictures.want(first);
    CHECK(pictures.under_way());
    REQUIRE(finish());
    CHECK(pictures.fault() == "");
    REQUIRE(pictures.picture());
    const auto kept = pictures.picture();
    CHECK(kept->image.pixels[7] == 0xff808080);
    CHECK(kept->differing > 290);
    const std::string runs = povray.runs();
    CHECK(runs.find("Antialias_Depth=3") != runs.npos);
    CHECK(std::ranges::count(runs, '\n') == 2);

    // POV-Ray does not run again for the same view of an equal scene.
    pictures.drop();
    CHECK(!pictures.picture());
    pictures.want(order_of(shown_scene(), SecondKind::povray));
    CHECK(pictures.picture() == kept);
    CHECK(!pictures.under_way());
    CHECK(povray.runs() == runs);

    std::ofstream(povray.folder / "slow") << "yes";
    pictures.want(order_of(scene, SecondKind::povray, 13));
    CHECK(!pictures.picture());
    REQUIRE(soon([&] { return std::ranges::count(povray.runs(), '\n') == 3; }));
    const std::string all = povray.runs();
    const pid_t process = std::stoi(all.substr(runs.size()));
    pictures.want(order_of(scene, SecondKind::one_ray, 13));
    CHECK(soon([&] { return ::kill(process, 0) != 0; }));
    REQUIRE(finish());
    CHECK(pictures.picture()->differing < 200);
    CHECK(pictures.fault() == "");
    const auto left = [&] {
        const std::filesystem::directory_iterator all(povray.folder / "");
        return std::count_if(begin(all), end(all), [](const auto& entry) { return entry.is_directory(); });
    };
    CHECK(left() == 0);
    {
        SecondPictures others(1, [] {});
        others.want(order_of(scene, SecondKind::povray, 14));
        REQUIRE(soon([&] { return std::ranges::count(povray.runs(), '\n') == 4; }));
    }
    CHECK(left() == 0);  // the window has been closed
}

TEST_CASE("without POV-Ray its package is named; what it says of a fault is passed on") {
    const auto scene = shown_scene();
    const auto fault = [&](SecondPictures& pictures) {
        pictures.want(order_of(scene, SecondKind::povray));
        REQUIRE(soon([&] { return pictures.take(); }));
        CHECK(!pictures.under_way());
        CHECK(!pictures.picture());
        return pictures.fault();
    };
    {
        const StandInForPovray povray("echo 'Parse Error: no such thing'; exit 1");
        SecondPictures pictures(1, [] {});
        CHECK(fault(pictures).find("Parse Error: no such thing") != std::string::npos);
    }
    const std::string path = ::getenv("PATH");
    ::setenv("PATH", "/nowhere", 1);
    SecondPictures pictures(1, [] {});
    CHECK(fault(pictures) == "povray is not installed; on Debian: apt install povray");
    ::setenv("PATH", path.c_str(), 1);
}

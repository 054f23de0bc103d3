// Flights without a window, and their figures.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

#include "num/thread_pool.h"
#include "show/motion/benchmark.h"
#include "show/motion/flown_pictures.h"
#include "tests/unit/show/flight_scene.h"

using namespace strahl;

TEST_CASE("a flight follows the clock at any frame rate and can be paused") {
    Session session(scene_of(path_text));
    session.perform({Action::play}, 10);
    CHECK(session.flight.under_way());
    session.follow(12);
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 2));
    const Answer paused = session.perform({Action::pause}, 13);
    CHECK(paused.note == "paused at 3 s");
    CHECK(!session.follow(20));
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 3));
    session.perform({Action::pause}, 30);
    session.follow(30.5);
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 3.5));
    CHECK(session.follow(31.5));  // the flight ends
    CHECK(!session.flight.flying());
    CHECK(session.camera.position == DVec3(-3, 0, 0));
    session.perform({Action::play}, 40);  // flies from the beginning again
    CHECK(session.camera.position == DVec3(1, 0, 0));
    session.follow(40.5);
    CHECK(session.steer({.right = 0.1}, 40.5).note == "flight ended at 0.5 s; F continues");
    CHECK(!session.flight.flying());
    CHECK(session.steer({.right = 0.1}, 40.6).note == "");
    session.perform({Action::play}, 50);  // where it was left
    CHECK(session.flight.time(50) == 0.5);
}

TEST_CASE("a flight can start at any moment") {
    Session session(scene_of(path_text));
    CHECK(session.go_to(2.5, 7));
    CHECK(session.flight.paused());
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 2.5));
    CHECK(!Session(scene_of("")).go_to(1, 0));
}

TEST_CASE("what moves plays without a flythrough, and the camera is free meanwhile") {
    Session session(scene_of("sphere { <0,0,0>, 1 motion { key { time 1 } key { time 5 translate <1,0,0> } } }"));
    CHECK(session.time == 0);
    session.perform({Action::play}, 10);
    session.follow(12.5);
    CHECK(session.time == 2.5);
    CHECK(session.camera == camera);
    session.steer({.push = {1, 0, 0}}, 13);
    CHECK(session.flight.under_way());
    const Camera there = session.camera;
    session.follow(14);
    CHECK(session.time == 4);
    CHECK(session.camera == there);
    CHECK(there != camera);
    CHECK(session.perform({Action::pause}, 14.25).note == "paused at 4.25 s");
    CHECK(session.time == 4.25);
    session.perform({Action::pause}, 20);
    CHECK(session.follow(21));  // the flight ends
    CHECK(!session.flight.flying());
    CHECK(session.camera == there);
    CHECK(session.go_to(1.5, 30));
    CHECK(session.time == 1.5);
    CHECK(session.flight.paused());
}

TEST_CASE("without a flythrough the flight orbits the scene") {
    Session session(scene_of(""));
    session.perform({Action::play}, 0);
    CHECK(distance(session.camera.position, camera.position) < 1e-9);
    const double away = length(camera.position);
    for (double t = 0; t < 40; t += 0.37) {
        session.follow(t);
        CHECK(session.camera.look_at == camera.look_at);
        CHECK(std::abs(length(session.camera.position) / away - 1) < 1e-4);
        CHECK(std::abs(session.camera.position.z - 18) < 1e-9);
    }
    session.follow(20);
    CHECK(distance(session.camera.position, {-5, 20, 18}) < 1e-3);
    session.follow(400);
    CHECK(session.flight.under_way());
    CHECK(distance(session.camera.position, camera.position) < 1e-6);
}

TEST_CASE("the wheel changes the speed of what moves the camera") {
    Session session(scene_of(path_text));
    const double speed = session.speed;
    CHECK(session.change_speed(2, 0).note.starts_with("speed "));
    CHECK(session.speed == 2 * speed);
    session.perform({Action::play}, 10);
    session.follow(11);
    CHECK(session.change_speed(0.5, 11).note == "flight at 0.5 times its speed");
    CHECK(session.speed == 2 * speed);
    CHECK(session.flight.time(11) == 1);
    session.follow(13);
    CHECK(session.flight.time(13) == 2);
}

TEST_CASE("a flight continues along the changed path") {
    Session session(scene_of(path_text));
    session.perform({Action::play}, 0);
    auto other = std::make_shared<Scene>(*session.scene);
    other->flythrough->keys[1].position = {0, 5, 0};
    session.replace(other, false);
    CHECK(session.flight.under_way());
    session.follow(2);
    CHECK(session.camera.position == DVec3(0, 5, 0));
    session.replace(scene_of(""), false);
    CHECK(!session.flight.flying());
}

TEST_CASE("a pause is at a time with few digits") {
    Session session(scene_of(path_text));
    session.perform({Action::play}, 0);
    CHECK(session.perform({Action::pause}, 1.23456).note == "paused at 1.235 s");
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 1.235));
}

TEST_CASE("a flight that is played once ends after a round") {
    Session session(scene_of(""));
    session.flight.once = true;
    session.perform({Action::play}, 0);
    CHECK(!session.follow(39.9));
    CHECK(session.follow(40.1));
    CHECK(!session.flight.flying());
}

TEST_CASE("figures of a flight are those of its times and levels") {
    // A picture of averages, from the rest before, counts as all pixels.
    CHECK(shown_picture(0, averaged_level, 40, 30).pixels == 1200);
    CHECK(shown_picture(0, averaged_level, 40, 30).level == finest_level);
    CHECK(shown_picture(0, 0, 40, 30).pixels == 6);
    std::vector<ShownPicture> shown;
    double time = 5;
    for (int i = 0; i < 101; ++i) {
        shown.push_back({time, i < 51 ? finest_level : finest_level - 2, 1000});
        time += i == 40 ? 0.5 : i % 2 ? 0.01 : 0.02;
    }
    const Benchmark b = benchmark_of(shown);
    CHECK(b.pictures == 101);
    CHECK(b.seconds == doctest::Approx(1.98));
    CHECK(b.median == doctest::Approx(0.01));
    CHECK(b.p99 == doctest::Approx(0.02));
    CHECK(b.worst == doctest::Approx(0.5));
    CHECK(b.levels.size() == 2);
    CHECK(b.levels.at(finest_level) == doctest::Approx(51. / 101));
    CHECK(b.pixels_per_second == doctest::Approx(100000 / 1.98));
    const BenchmarkSetting setting{.scene = "a \"b\".rt",
                                   .precision = "float",
                                   .simd = "scalar",
                                   .width = 640,
                                   .height = 480,
                                   .window = {640, 481},
                                   .wanted = PictureSize{640, 480},
                                   .depth = 20,
                                   .threads = 2,
                                   .fps = 60,
                                   .draw_seconds = 0.002};
    const std::string text = report_of(b, setting), json = json_of(b, setting);
    CHECK(text.find("median 10.00 ms, 99th percentile 20.00 ms, worst 500.00 ms") != std::string::npos);
    CHECK(text.find("all pixels in 50.5 %, 1/4 of the pixels in 49.5 %") != std::string::npos);
    const auto says_size = [&](BenchmarkSetting other) {
        return report_of(b, other).find("the window manager made the window 640x481 instead of 640x480") != text.npos;
    };
    CHECK(says_size(setting));
    BenchmarkSetting other = setting;
    other.wanted = {};
    CHECK(!says_size(other));
    other.wanted = other.window;
    CHECK(!says_size(other));
    CHECK(json.find("\"scene\": \"a \\\"b\\\".rt\"") != std::string::npos);
    CHECK(json.find("\"1/4\": 0.495") != std::string::npos);
    CHECK(text.find("SSIM") == text.npos);
    CHECK(json.find("quality") == json.npos);
    Benchmark compared = b;
    compared.quality = {.pictures = 2, .rms = 1.5, .p99 = 9, .ssim = .9, .visible = .02, .flicker = 2.5};
    CHECK(report_of(compared, setting)
              .find("2 pictures beside the finished ones, in steps of 1/255: RMS 1.50, 99 % off "
                    "by at most 9, SSIM 0.9000, 2.00 % off by more than 8, flicker 2.50\n") != text.npos);
    CHECK(json_of(compared, setting).find("\"visible\": 0.02,\n    \"flicker\": 2.5\n  }\n}\n") != json.npos);
    CHECK(benchmark_of({}).pictures == 0);
    CHECK(report_of(benchmark_of({}), setting) != "");
}

TEST_CASE("a flight of hours keeps the figures of its last pictures only, unless it is measured") {
    for (const bool all : {false, true}) {
        MotionLog log;
        log.keeps_all = all;
        log.begin(1);
        for (int i = 0; i < 30000; ++i) log.picture({2 + i / 60., finest_level, 1000});
        CHECK(log.keeps_all == all);
        CHECK((all ? log.pictures().size() == 30000 : log.pictures().size() <= 10000));
        CHECK(log.pictures().back().time == 2 + 29999 / 60.);
        CHECK(log.rate(2 + 29999 / 60.) == doctest::Approx(61));
        CHECK(log.report(501).starts_with("30000 pictures in 500.00 s (60.0/s; the first after 1000 ms)"));
    }
}

namespace {

ScreenImage grey(int width, int height, std::uint32_t brightness) {
    ScreenImage image;
    image.resize(width, height);
    std::ranges::fill(image.pixels, brightness * 0x010101u | 0xff000000u);
    return image;
}

}  // namespace

TEST_CASE("the quality of pictures is that of their differences and of what changes between them") {
    QualityLog log;
    CHECK(log.quality().pictures == 0);
    log.add(grey(16, 8, 100), grey(16, 8, 103), false);
    Quality quality = log.quality();
    CHECK(quality.rms == doctest::Approx(3));
    CHECK(quality.p99 == 3);
    CHECK(quality.visible == 0);
    CHECK(quality.flicker == 0);
    log.add(grey(16, 8, 120), grey(16, 8, 107), true);  // off by 13 the other way
    quality = log.quality();
    CHECK(quality.pictures == 2);
    CHECK(quality.rms == doctest::Approx(std::sqrt((9 + 169) / 2.)));
    CHECK(quality.visible == doctest::Approx(.5));
    CHECK(quality.flicker == doctest::Approx(16));
    log.add(grey(32, 8, 90), grey(32, 8, 90), true);  // another size: no change to be seen
    quality = log.quality();
    CHECK(quality.rms == doctest::Approx(std::sqrt((9 + 169) / 4.)));
    CHECK(quality.flicker == doctest::Approx(16));
    CHECK(structural_similarity(grey(16, 8, 50), grey(16, 8, 50)) == doctest::Approx(1));
}

TEST_CASE("two pictures of each eighth of a flight are compared with the finished ones") {
    const auto scene = scene_of(path_text + "sphere { <0,0,0>, 1 } light { position <5,-20,18> color <1,1,1> }");
    Session session(scene);
    ThreadPool pool(1);
    Tracer tracer(*scene, Precision::float32);
    const TransferTable table(scene->settings.assumed_gamma);
    FlownPictures flown;
    const std::atomic<bool> stopped = true, going = false;
    CHECK(flown.compare(1, {}, going)->pictures == 0);
    for (int round = 0; round < 2; ++round)
        for (int i = 0; i < 40; ++i) {
            session.go_to(.1 * i, 0);
            const View view = session.view(16, 12);
            ScreenImage image = traced_picture(tracer, view, pool, table, {.grid = FlownPictures::grid});
            const bool kept = i % 5 < 2;
            if (!kept || round == 0) std::ranges::fill(image.pixels, 0xffffffffu);
            flown.shown(i / 40., image, scene, view);
        }
    CHECK(flown.count() == 16);
    CHECK(!flown.compare(1, {}, stopped));
    const auto quality = flown.compare(1, {}, going);
    REQUIRE(quality);
    CHECK(quality->pictures == 16);
    CHECK(quality->rms == 0);
    CHECK(quality->flicker == 0);
}

// Images filtered by the footprints of samples.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "num/thread_pool.h"
#include "tests/referee/dice.h"
#include "tests/unit/trace/cut_out.h"
#include "text/parse.h"
#include "trace/cells/cell_picture.h"
#include "trace/tracer.h"
#include "trace/world/mip_maps.h"

namespace strahl::footprints {

/// Black and white squares of 4 pixels.
Pixels checks(const std::string&) {
    Pixels pixels{32, 32, false, {}, Color(.9)};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) pixels.values.insert(pixels.values.end(), 3, (x / 4 + y / 4) % 2 ? .9f : .1f);
    return pixels;
}

constexpr const char* lit =
    "light { position <-9, -20, 30>  color <1, 1, 1> }\n"
    "defaultmaterial { ambient .2  diffuse .8  specular 0  reflection 0 }\n";
const std::string eye = std::string(lit) + "camera { position <0, -9, 3>  look_at <0, 0, 1>  sky <0, 0, 1>  fov 20 }\n";
const std::string floor_to_horizon =
    std::string(lit) +
    "camera { position <0, 0, 2>  look_at <0, 10, .6>  sky <.1, 0, 1>  fov 25 }\n"
    "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb image { \"checks\"  scale 4  rotate <0, 0, 25> } } }\n";

/// Bodies with images of all maps, one that is there once, and one that is mirrored along x and ends along y.
const std::vector<std::string> bodies{
    "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>\n"
    "        material { rgb image { \"checks\"  scale 2  rotate <0, 0, 25> }  reflection .2 } }\n",
    "sphere { <-1.5, 0, 1>, 1  material { rgb image { \"checks\"  map spherical  translate <-1.5, 0, 1> } } }\n",
    "cylinder { <.8, 0, 0>, <.8, 0, 1.8>, .6\n"
    "           material { rgb image { \"checks\"  map cylindrical  scale <1, 1, 1.7>  translate <.8, 0, 0> } } }\n",
    "mesh { triangle { <1.5, -2, 0>, <3, -1, 0>, <1.5, -1, 2>  uv_vectors <0, 0>, <3, 0>, <0, 4> }\n"
    "       material { rgb image { \"checks\"  map uv } } }\n",
    "box { <-4, 2, .2>, <-2, 2.1, 2>\n"
    "      material { rgb image { \"checks\"  once <.7, .2, .1>  scale 1.5  rotate <90, 0, 0>  translate <-3.8, 0, .4> "
    "} "
    "} }\n",
    "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>\n"
    "        material { rgb image { \"checks\"  wrap mirror clamp  scale 2  rotate <0, 0, 25> } } }\n"};
const std::string sky = "background { color image { \"checks\"  map spherical  scale <1, 1, .9> } }\n";
const std::string mirror_ball = "sphere { <0, -2.5, .5>, .5  material { reflection .9  diffuse .1 } }\n";
const std::string many_images = eye + sky + bodies[0] + bodies[1] + bodies[2] + bodies[3] + bodies[4] + mirror_ball;

Scene scene_of(const std::string& text) { return parse_scene(text, "images", {}, checks); }
View view_of(const Scene& scene, int width, int height) {
    return {.camera = scene.camera, .width = width, .height = height, .depth = 4};
}

struct Traced {
    std::vector<double> rgb;
    double samples;   // a pixel
    double estimate;  // in 1/510
};
Traced refined(Tracer& tracer, const View& view, const Lattice& part, int threads = 2, double error = 1. / 510) {
    ThreadPool pool(threads);
    CellPicture picture(tracer.scene(), view, part, error);
    picture.check();
    Traced result;
    result.rgb.resize(std::size_t(3) * part.columns * part.rows);
    const auto keep = [&](const Tile& tile) { place(tile, part, result.rgb); };
    const Counts counts = tracer.trace({view, pool, keep}, CellPass{picture, 0});
    result.samples = double(counts.camera) / (double(part.columns) * part.rows);
    result.estimate = 510 * picture.sampled().error();
    return result;
}
std::vector<double> grid(Tracer& tracer, const View& view, int n) {
    ThreadPool pool(2);
    return values_of(tracer, view, {.columns = view.width, .rows = view.height}, pool, {.grid = n});
}

/// A refined picture and its error against a grid of rays.
struct Compared {
    Traced own;
    double error;
};
Compared compared(const Scene& scene, int width, int height, int rays) {
    const View view = view_of(scene, width, height);
    Tracer tracer(scene, Precision::float64);
    const Traced own = refined(tracer, view, {.columns = width, .rows = height});
    const double error = 510 * rms(own.rgb, grid(tracer, view, rays));
    MESSAGE("RMS ", error, ", estimate ", own.estimate, ", samples ", own.samples);
    return {own, error};
}

TEST_CASE("every mip level has the mean of its picture") {
    Dice dice(5);
    for (const auto& [width, height] : {std::pair{96, 64}, {7, 5}, {33, 2}, {1, 9}, {1, 1}, {100, 37}}) {
        CAPTURE(width);
        CAPTURE(height);
        std::vector<float> values(std::size_t(3) * width * height);
        for (float& value : values) value = static_cast<float>(dice.in(0, 1));
        const MipMap map(values.data(), width, height);
        const MipMapKernel kernel = map.kernel();
        const auto mean = [](const MipLevel& level, int c) {
            double sum = 0;
            const int count = level.width * level.height;
            for (int i = 0; i < count; ++i) sum += level.pixels[3 * i + c];
            return sum / count;
        };
        int pixels = 0;
        for (int i = 0; i < kernel.count; ++i) {
            const MipLevel& level = kernel.levels[i];
            pixels += level.width * level.height;
            for (int c = 0; c < 3; ++c)
                CHECK(mean(level, c) == doctest::Approx(mean(kernel.levels[0], c)).epsilon(1e-6));
        }
        const MipLevel& last = kernel.levels[kernel.count - 1];
        CHECK(kernel.levels[0].pixels == values.data());
        CHECK(last.width * last.height == 1);
        CHECK(pixels <= (std::min(width, height) > 2 ? 4. / 3 : 2) * width * height);
    }
}

TEST_CASE("images become linear light before they are averaged, and reliefs of the same file stay as they are") {
    const auto given = std::make_shared<const Pixels>(checks(""));
    Images images;
    const int encoded = images.add(given, false, false), linear = images.add(given, true, true);
    CHECK(images.add(given, true, false) == linear);
    CHECK(images[encoded].own == given);
    CHECK(images[linear].own->values[0] == doctest::Approx(std::pow((.1 + .055) / 1.055, 2.4)));
    const MipMapKernel* const maps = images.mip_maps();
    CHECK(maps[encoded].count == 0);
    const double mean = .5 * (images[linear].own->values[0] + images[linear].own->values[3 * 4]);
    CHECK(maps[linear].levels[maps[linear].count - 1].pixels[0] == doctest::Approx(mean));
}

TEST_CASE("cameras of all projections find the means of images") {
    double in_perspective = 0;
    for (const Projection projection :
         {Projection::perspective, Projection::orthographic, Projection::fisheye, Projection::spherical}) {
        CAPTURE(static_cast<int>(projection));
        Scene scene = scene_of(many_images);
        scene.camera.projection = projection;
        if (angular(projection)) scene.camera.fov = 30;
        const Compared found = compared(scene, 60, 45, 12);
        if (projection == Projection::perspective) in_perspective = found.error;
        CHECK(found.error <= in_perspective);
        CHECK(found.own.samples < 40);
    }
}

TEST_CASE("a floor of checks to the horizon comes out as the mean of 4096 rays a pixel") {
    const Scene scene = scene_of(floor_to_horizon);
    const View view = view_of(scene, 80, 60);
    const Lattice all{.columns = view.width, .rows = view.height};
    Tracer reference(scene, Precision::float32);
    const std::vector<double> exact = grid(reference, view, 64);
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Tracer tracer(scene, precision);
        const Traced own = refined(tracer, view, all);
        const double error = 510 * rms(own.rgb, exact);
        CAPTURE(error);
        CAPTURE(own.estimate);
        CAPTURE(own.samples);
        MESSAGE("RMS ", error, ", estimate ", own.estimate, ", samples ", own.samples);
        CHECK(error < 2);  // without filters 12, with 18 samples a pixel
        CHECK(own.samples < 8);
        CHECK(own.estimate > error / 2);
        CHECK(own.estimate < error * 2);
    }
}

TEST_CASE("images of all maps are filtered") {
    std::vector<std::string> texts{eye + sky};
    for (const std::string& body : bodies) texts.push_back(eye + body);
    // Pixels of the picture are from a fortieth to nine pixels of the view wide.
    for (std::size_t i = 0; i < 7; ++i) {
        texts.push_back(texts[i]);
        const std::string name = "\"checks\"";
        texts.back().insert(texts[i].find(name) + name.size(), " sharp");
    }
    for (const std::string& text : texts) {
        CAPTURE(text);
        const auto [own, error] = compared(scene_of(text), 64, 48, 32);
        CAPTURE(own.samples);
        CHECK(error < (text.find("sharp") == text.npos ? 3 : 4));
    }
}

TEST_CASE("images in mirrors and behind glass are filtered by what a sample sees there") {
    struct Case {
        std::string body;
        double error, samples;  // at most; the comment says how much there was when camera rays alone were filtered
    };
    const std::string floor =
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>\n"
        "        material { rgb image { \"checks\"  scale 3  rotate <0, 0, 25> } } }\n";
    const std::string mirror = "  material { diffuse 0  ambient 0  reflection .9 } }\n";
    const std::string glass = "  material { diffuse 0  ambient 0  refraction .9  ior 1.5 } }\n";
    for (const auto& [body, error, samples] : {
             Case{"plane { <0, 1, 0>, <1, 1, 0>, <.05, 1, 1>" + mirror, 4, 13},  // 20 and 25
             Case{"sphere { <0, 4, 1>, 4" + mirror, 3.1, 12},                    // 9 and 14
             Case{"cylinder { <-3, 0, 1>, <3, 0, 1>, 1" + mirror, 5.5, 12},      // 11 and 11
             Case{"box { <-2, -5, 0>, <2, -4.9, 3>" + glass, 4, 12},             // 15 and 23
             Case{"torus { <0, 0, 1>, <0, 1, 0>, 1, .4" + mirror, 5.5, 16},      // 7 and 13
             Case{"sphere { <0, -20, 1>, 24" + mirror, 1.5, 8},                  // 4 and 11
             Case{"sphere { <0, -3, 1.5>, 1.2" + glass, 4.5, 13},                // 6 and 13
         }) {
        CAPTURE(body);
        const auto [own, off] = compared(scene_of(eye + floor + body), 64, 48, 32);
        CHECK(off < error);
        CHECK(own.samples < samples);
    }
}

/// Seen in a mirror, a scene looks as it does to the camera behind the mirror.
TEST_CASE("an image in a flat mirror looks as it does from behind the mirror") {
    const std::string floor =
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>\n"
        "        material { rgb image { \"checks\"  scale 2  rotate <0, 0, 25> } } }\n";
    const auto camera = [](double x, double to) {
        return "camera { position <" + std::to_string(x) + ", 0, 2>  look_at <" + std::to_string(to) +
               ", 0, 1>  sky <0, 0, 1>  fov 15 }\n";
    };
    const Scene mirrored = scene_of(lit + camera(0, 4) + floor +
                                    "plane { <4, 0, 0>, <4, 1, 0>, <4, 0, 1>  material { diffuse 0  ambient 0  "
                                    "reflection 1 } }\n");
    const Scene direct = scene_of(lit + camera(8, 4) + floor);
    const View view = view_of(mirrored, 64, 48), from_behind = view_of(direct, 64, 48);
    const Lattice all{.columns = 64, .rows = 48};
    Tracer one(mirrored, Precision::float64), other(direct, Precision::float64);
    const Traced seen = refined(one, view, all), expected = refined(other, from_behind, all);
    const std::vector<double> exact = grid(one, view, 32);
    double squares = 0;
    int count = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x, ++count)
            for (int c = 0; c < 3; ++c) {
                const double off = seen.rgb[3 * (64 * y + x) + c] - expected.rgb[3 * (64 * y + 63 - x) + c];
                squares += off * off / 3;
            }
    const double off = 510 * std::sqrt(squares / count);
    MESSAGE("off ", off, ", RMS ", 510 * rms(seen.rgb, exact), ", samples ", seen.samples, " and ", expected.samples);
    CHECK(off < .1);
    CHECK(seen.samples < 1.1 * expected.samples);
}

TEST_CASE("grids, one ray and pictures in motion stay as they are, before and after a picture that is filtered") {
    const Scene scene = scene_of(many_images);
    const View view = view_of(scene, 60, 45);
    const Lattice all{.columns = view.width, .rows = view.height};
    Tracer tracer(scene, Precision::float64);
    const std::vector<double> one = grid(tracer, view, 1), four = grid(tracer, view, 2);
    CHECK(one == render(scene, view).rgb);
    const Traced filtered = refined(tracer, view, all);
    CHECK(one == grid(tracer, view, 1));
    CHECK(four == grid(tracer, view, 2));
    CHECK(510 * rms(filtered.rgb, four) > 1);
}

TEST_CASE("filtered pictures depend neither on threads, crops nor lanes") {
    for (const std::string& text : {many_images, floor_to_horizon}) {
        const Scene scene = scene_of(text);
        const View view = view_of(scene, 75, 61);
        const Lattice all{.columns = view.width, .rows = view.height};
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            Tracer tracer(scene, precision), scalar(scene, precision, Simd::scalar);
            const std::vector<double> picture = refined(tracer, view, all).rgb;
            CHECK(picture == refined(tracer, view, all, 3).rgb);
            if (best_simd() != Simd::v2) CHECK(picture == refined(scalar, view, all).rgb);
            for (const Lattice crop : {Lattice{33, 17, 20, 30}, Lattice{0, 0, 1, 1}, Lattice{7, 40, 40, 9}})
                CHECK(refined(tracer, view, crop).rgb == cut_out(picture, view.width, crop));
        }
    }
}

}  // namespace strahl::footprints

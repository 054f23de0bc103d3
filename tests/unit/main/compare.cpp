// The comparison of pictures: every figure is compared with one computed by hand.
#include "image/compare.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "main/commands/command_compare.h"
#include "tests/unit/scratch.h"

namespace strahl {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

Picture flat(int width, int height, int channels, double value) {
    return {width, height, channels, std::vector<double>(std::size_t(1) * width * height * channels, value), 32};
}

TEST_CASE("equal pictures") {
    Picture a = flat(4, 3, 3, .25);
    a.values[0] = nan, a.values[1] = inf;
    const PictureDifference d = compare(a, a, 0);
    CHECK(d.pixels == 12);
    CHECK(d.max == 0);
    CHECK(d.mean == 0);
    CHECK(d.rms == 0);
    CHECK(d.psnr == inf);
    CHECK(d.share_beyond_8bit == 0);
    CHECK(d.share_beyond == 0);
    CHECK(heatmap(a, a).values == std::vector<double>(36, 0.));
    CHECK(report(d, 0).find("worst") == std::string::npos);
}

TEST_CASE("two differences, one of them small") {
    const Picture a = flat(4, 2, 3, .5);
    Picture b = a;
    b.values[3 * 1 + 2] += .25;       // pixel 1, 0, blue
    b.values[3 * 6 + 0] -= 1. / 512;  // pixel 2, 1, red
    const PictureDifference d = compare(a, b, 1e-3);
    CHECK(d.max == .25);
    CHECK(d.mean == doctest::Approx((.25 + 1. / 512) / 24).epsilon(1e-14));
    const double rms = std::sqrt((.0625 + 1. / 512 / 512) / 24);
    CHECK(d.rms == doctest::Approx(rms).epsilon(1e-14));
    CHECK(d.psnr == doctest::Approx(10 * std::log10(1 / (rms * rms))).epsilon(1e-14));
    CHECK(d.share_beyond_8bit == 1 / 8.);
    CHECK(d.share_beyond == 2 / 8.);
    CHECK(d.x == 1);
    CHECK(d.y == 0);
    CHECK(d.channel == 2);
    CHECK(d.value_a == .5);
    CHECK(d.value_b == .75);
    CHECK(report(d, 1e-3).find("worst at x 1, y 0, channel 2: 0.5 and 0.75") != std::string::npos);
}

TEST_CASE("neighbouring 8-bit codes are never beyond 1/255") {
    Picture a = flat(255, 1, 1, 0), b = a, c = a;
    for (int i = 0; i < 255; ++i) a.values[i] = i / 255., b.values[i] = (i + 1) / 255., c.values[i] = (i + 2) / 255.;
    CHECK(compare(a, b, 1 / 255.).share_beyond_8bit == 0);
    CHECK(compare(a, b, 1 / 255.).share_beyond == 0);
    CHECK(compare(a, b, 0).share_beyond == 1);
    CHECK(compare(a, c, 0).share_beyond_8bit == 1);
}

TEST_CASE("NaN differs infinitely from every number") {
    const Picture a = flat(2, 1, 3, .5);
    Picture b = a;
    b.values[4] = nan;
    for (const PictureDifference& d : {compare(a, b, 1e9), compare(b, a, 1e9)}) {
        CHECK(d.max == inf);
        CHECK(d.rms == inf);
        CHECK(d.psnr == -inf);
        CHECK(d.share_beyond == .5);
        CHECK(d.x == 1);
        CHECK(d.channel == 1);
    }
    CHECK(heatmap(a, b).values == std::vector<double>{0, 0, 0, 1, 1, 1});
}

TEST_CASE("alpha counts only if both have it") {
    const Picture rgb = flat(2, 2, 3, .5), rgba = flat(2, 2, 4, .5), grey = flat(2, 2, 1, .5);
    Picture see_through = rgba;
    see_through.values[3] = 0;
    CHECK(compare(rgb, see_through, 0).max == 0);
    CHECK(compare(see_through, rgb, 0).max == 0);
    CHECK(compare(rgba, see_through, 0).max == .5);
    CHECK(compare(grey, flat(2, 2, 2, .5), 0).max == 0);
    CHECK_THROWS_AS(compare(rgb, grey, 0), FileError);
    CHECK_THROWS_AS(compare(rgb, flat(2, 3, 3, .5), 0), FileError);
    CHECK_THROWS_AS(heatmap(rgb, flat(3, 2, 3, .5)), FileError);
}

TEST_CASE("the heat map is brighter for larger differences") {
    const std::vector<double> differences{1e-9, 1 / 65535., 1e-3, .01, .1, 1, 7};
    Picture a = flat(7, 1, 1, 0), b = a;
    b.values = differences;
    const Picture map = heatmap(a, b);
    const auto light = [&](int i) {
        return .2 * map.values[3 * i] + .7 * map.values[3 * i + 1] + .1 * map.values[3 * i + 2];
    };
    CHECK(light(0) > 0);
    CHECK(light(0) == light(1));
    for (int i = 2; i <= 5; ++i) CHECK(light(i) > light(i - 1));
    CHECK(light(5) == doctest::Approx(1));
    CHECK(light(6) == doctest::Approx(1));
}

TEST_CASE("pictures side by side") {
    const Picture sheet = beside({flat(2, 1, 3, 1), flat(1, 2, 4, .25), flat(1, 1, 1, 0)}, 1);
    CHECK(sheet.width == 6);
    CHECK(sheet.height == 2);
    std::vector<double> expected;
    for (const double v : {1., 1., .5, .25, .5, 0., .5, .5, .5, .25, .5, .5}) expected.insert(expected.end(), 3, v);
    CHECK(sheet.values == expected);
    CHECK(beside({}, 3).values.empty());
}

TEST_CASE("the command's status says whether the pictures agree") {
    const Scratch folder;
    const std::string a = folder / "a.png", b = folder / "b.png", map = folder / "map.png";
    write_picture(flat(8, 8, 3, .5), a, {});
    Picture other = flat(8, 8, 3, .5);
    other.values[17] = 1;
    write_picture(other, b, {});
    CHECK(compare_command({a, a, "", 0}) == 0);
    CHECK(compare_command({a, b, map, 0}) == 1);
    CHECK(compare_command({a, b, "", .6}) == 0);
    const Picture seen = read_picture(map);
    CHECK(seen.width == 8);
    CHECK(seen.values[3 * 5] > 0);
    CHECK(seen.values[3 * 6] == 0);
    CHECK_THROWS_AS(compare_command({a, folder / "none.png", "", 0}), FileError);
    CHECK_THROWS_AS(compare_command({a, b, folder / "map.gif", 0}), FileError);
}

}  // namespace
}  // namespace strahl

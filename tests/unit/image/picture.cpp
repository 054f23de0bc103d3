// Picture files: written values are read back to the last bit, and broken files are reported.
#include "image/picture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <random>

#include "files/output_file.h"
#include "image/pixels.h"
#include "image/transfer.h"
#include "image/transfer_table.h"
#include "image/uncompressed.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"

// OpenImageIO leaks one string when libpng longjmps at a truncated file; a leak checker can attribute it only with the
// whole stack.
extern "C" const char* __asan_default_options() { return "fast_unwind_on_malloc=0"; }
extern "C" const char* __lsan_default_suppressions() { return "leak:ImageInput::geterror\nleak:PngReadCallback"; }

namespace strahl {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

/// Returns a picture of values from 0 to 1 and beyond.
Picture noise(int width, int height, int channels = 3) {
    Picture picture{width, height, channels, {}, 32};
    std::minstd_rand random(width * 1000 + height);
    std::uniform_real_distribution<double> value(-.2, 1.2);
    for (int i = 0; i < width * height * channels; ++i) picture.values.push_back(value(random));
    return picture;
}

TEST_CASE("8- and 16-bit files hold the quantised values exactly") {
    const Scratch folder;
    struct Form {
        const char* ending;
        int bits;
    };
    for (const auto& [ending, bits] : {Form{".bmp", 8}, Form{".png", 8}, Form{".png", 16}})
        for (const double gamma : {0., 1., 2.2})
            for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {17, 5}, {2, 33}, {257, 129}}) {
                CAPTURE(ending);
                CAPTURE(bits);
                CAPTURE(gamma);
                CAPTURE(width);
                const Picture picture = noise(width, height);
                const std::string path = folder / ("picture" + std::string(ending));
                write_picture(picture, path, {bits, gamma});
                const Picture back = read_picture(path);
                CHECK(back.width == width);
                CHECK(back.height == height);
                CHECK(back.channels == 3);
                CHECK(back.bits == bits);
                const int steps = bits == 8 ? 255 : 65535;
                std::vector<double> expected;
                for (const double v : picture.values) expected.push_back(quantise(v, gamma, steps) / double(steps));
                CHECK(back.values == expected);
            }
}

TEST_CASE("every 16-bit value is written and read back") {
    const Scratch folder;
    Picture picture{256, 256, 1, {}, 16};
    for (int code = 0; code < 65536; ++code) picture.values.push_back(code / 65535.);
    write_picture(picture, folder / "codes.png", {16, false});
    CHECK(read_picture(folder / "codes.png").values == picture.values);
}

TEST_CASE("float files hold the values themselves") {
    const Scratch folder;
    Picture picture = noise(19, 7);
    picture.values[0] = nan, picture.values[1] = inf, picture.values[2] = -inf, picture.values[3] = -3e38;
    picture.values[4] = 1e-45, picture.values[5] = 12345.678, picture.values[6] = -0.;
    write_picture(picture, folder / "picture.exr", {});
    const Picture back = read_picture(folder / "picture.exr");
    CHECK(back.bits == 32);
    REQUIRE(back.values.size() == picture.values.size());
    CHECK(std::isnan(back.values[0]));
    for (std::size_t i = 1; i < picture.values.size(); ++i)
        CHECK(back.values[i] == static_cast<double>(static_cast<float>(picture.values[i])));
}

TEST_CASE("NaN is black in 8 and 16 bits, infinities are clamped") {
    const Scratch folder;
    const Picture picture{1, 1, 3, {nan, inf, -inf}, 32};
    for (const char* name : {"a.bmp", "a.png"}) {
        write_picture(picture, folder / name, {});
        CHECK(read_picture(folder / name).values == std::vector<double>{0, 1, 0});
    }
}

TEST_CASE("the transfer curve: round(255 v) as in 1999, or sRGB of the light") {
    CHECK(quantise(.5, false, 255) == 128);
    CHECK(quantise(126.5 / 255, false, 255) == 127);
    CHECK(quantise(.3, false, 65535) == 19661);
    CHECK(quantise(-1, false, 255) == 0);
    CHECK(quantise(2, true, 255) == 255);
    CHECK(quantise(nan, true, 65535) == 0);
    // Middle grey and the end of the straight piece, from the standard's own formula.
    CHECK(quantise(.21403, true, 255) == 127);
    CHECK(quantise(.21405, true, 255) == 128);
    CHECK(quantise(.0031308, true, 65535) == 2651);
    CHECK(std::abs(srgb(.0031308) - srgb(.00313081)) < 1e-6);
    // .5^2.2 is .21764 of the light, whose encoding is .50387.
    CHECK(quantise(.5, 2.2, 65535) == 33021);
    for (const double gamma : {0., 1., 1.3, 2.2, 3., 5.}) {
        double most = 0;
        for (int i = 0; i < 100000; ++i)
            most = std::max(most, 1e5 * (shown((i + 1) / 1e5, gamma) - shown(i / 1e5, gamma)));
        CHECK(most <= steepest(gamma) * (1 + 1e-9));
        CHECK(most > .98 * steepest(gamma));
    }
}

TEST_CASE("the tabulated transfer curve equals quantise") {
    for (const double gamma : {0., 1., 2.2}) {
        const TransferTable table(gamma);
        const auto check = [&](double v) { CHECK(table(v) == quantise(v, gamma, 255)); };
        for (const double v : {0., -0., -1., 1., 2., HUGE_VAL, -HUGE_VAL, double(NAN), 1e-310, 1 - 0x1p-53}) check(v);
        for (int i = 0; i <= 50000; ++i) check(i / 49999.), check(static_cast<float>(i / 49999.));
        // Around each step of the curve, number by number.
        for (int code = 1; code < 256; ++code) {
            double low = 0, high = 1;
            for (int i = 0; i < 60; ++i) {
                const double middle = (low + high) / 2;
                (quantise(middle, gamma, 255) < code ? low : high) = middle;
            }
            for (int i = 0; i < 4; ++i) low = std::nextafter(low, 0.);
            for (int i = 0; i < 8; ++i, low = std::nextafter(low, 1.)) check(low);
        }
    }
}

TEST_CASE("an exposure multiplies light, and keeps below white what is brighter") {
    CHECK(exposed(.3, 1) == .6);
    CHECK(exposed(.7, 0) == .7);
    CHECK(exposed(1, 0) == doctest::Approx(.9));
    CHECK(exposed(0, 20) == 0);
    CHECK(exposed(-1, 3) == -8);
    double before = 0;
    for (double v = .001; v < 1e9; v *= 1.01) {
        CHECK(exposed(v, .5) > before);
        before = exposed(v, .5);
    }
    CHECK(before < 1);
    for (const double gamma : {0., 1., 2.2})
        for (const double stops : {-20., -1.3, 0., .5, 3., 20.}) {
            CAPTURE(stops);
            const TransferTable table(gamma, stops);
            const auto check = [&](double v) { CHECK(table(v) == quantise(exposed(v, stops), gamma, 255)); };
            for (const double v : {0., -1., 1e-310, double(NAN), 1e300}) check(v);
            for (double v = 1e-9; v < 1e9; v *= 1.003) check(v);
        }
    CHECK(TransferTable(false, 0)(HUGE_VAL) == 255);
}

TEST_CASE("pictures without compression hold what the file holds from which they were read") {
    const Scratch folder;
    for (const auto& [ending, bits] : {std::pair{".png", 8}, {".png", 16}, {".exr", 32}})
        for (const int channels : {1, 3}) {
            const std::string compressed = folder / std::string("a").append(ending), plain = folder / "a.plain";
            write_picture(noise(17, 5, channels), compressed, {bits, false, Compression::fast});
            const Picture picture = read_picture(compressed);
            write_file(plain, netpbm_of(picture));
            const Picture same = read_picture(plain);
            CHECK(same.width == 17);
            CHECK(same.height == 5);
            CHECK(same.channels == channels);
            CHECK(same.bits == bits);
            CHECK(same.values == picture.values);
        }
    // By the formats' pages, 16 bits have the high byte first; floats start at the bottom, in either byte order.
    write_file(folder / "a.pgm", std::string("P5\n2 1\n65535\n\x80\0\0\1", 19));
    CHECK(read_picture(folder / "a.pgm").values == std::vector<double>{32768 / 65535., 1 / 65535.});
    write_file(folder / "a.pgm", "P2 # a row\n2 1 100\n100\n25");
    CHECK(read_picture(folder / "a.pgm").values == std::vector<double>{1, .25});
    write_file(folder / "a.ppm", "P3 1 1 65535\n65535 0 1\n");
    CHECK(read_picture(folder / "a.ppm").values == std::vector<double>{1, 0, 1 / 65535.});
    write_file(folder / "a.pfm", std::string("Pf\n1 2\n1.0\n\x3f\x80\0\0\x40\0\0\0", 19));
    CHECK(read_picture(folder / "a.pfm").values == std::vector<double>{2, 1});
}

TEST_CASE("alpha is a channel like any other") {
    const Scratch folder;
    Picture picture = noise(5, 3, 4);
    for (double& v : picture.values) v = quantise(v, false, 65535) / 65535.;
    picture.values[3] = 0;  // an alpha of 0: the colour is not seen, and is kept nevertheless
    write_picture(picture, folder / "a.png", {16, false});
    const Picture back = read_picture(folder / "a.png");
    CHECK(back.channels == 4);
    CHECK(back.values == picture.values);
    CHECK(says(fault_of([&] { write_picture(picture, folder / "a.bmp", {}); }), "red, green and blue"));
}

TEST_CASE("a BMP is 24 bits a pixel, bottom-up, rows padded to 4 bytes") {
    const Scratch folder;
    write_picture({1, 2, 3, {1, 0, 0, 0, 0, 1}, 8}, folder / "a.bmp", {});
    const std::string bytes = bytes_of(folder / "a.bmp");
    REQUIRE(bytes.size() == 62);
    CHECK(bytes.substr(0, 2) == "BM");
    CHECK(bytes[28] == 24);
    CHECK(bytes.substr(54) == std::string("\xff\0\0\0\0\0\xff\0", 8));
}

TEST_CASE("BMP files of other programs: rows from the top, longer headers, palettes") {
    const Scratch folder;
    const auto word = [](std::uint32_t value, int bytes = 4) {
        return std::string(reinterpret_cast<const char*>(&value), static_cast<std::size_t>(bytes));
    };
    const auto read = [&](std::uint32_t header, std::int32_t height, std::uint32_t bits, const std::string& rest) {
        const std::uint32_t start = 14 + header + (bits == 8 ? 8 : 0);
        std::string bytes = "BM" + word(0) + word(0) + word(start) + word(header) + word(2) +
                            word(static_cast<std::uint32_t>(height)) + word(1, 2) + word(bits, 2) + word(0);
        bytes += word(0) + word(0) + word(0) + word(bits == 8 ? 2 : 0) + word(0);
        bytes.resize(14 + header);
        write_file(folder / "a.bmp", bytes + rest);
        return read_picture(folder / "a.bmp");
    };
    const std::string first("\xff\0\0\0\xff\0..", 8), second("\0\0\xff\xff\xff\xff..", 8);  // blue, green, red
    const std::vector<double> top{0, 0, 1, 0, 1, 0}, bottom{1, 0, 0, 1, 1, 1};
    std::vector<double> from_top = top, from_bottom = bottom;
    from_top.insert(from_top.end(), bottom.begin(), bottom.end());
    from_bottom.insert(from_bottom.end(), top.begin(), top.end());
    for (const std::uint32_t header : {40, 108, 124}) {
        CHECK(read(header, 2, 24, first + second).values == from_bottom);
        CHECK(read(header, -2, 24, first + second).values == from_top);
    }
    // A run-length encoded .bmp of 8 bits is read by the library.
    const Picture coloured = read(40, 1, 8, std::string("\xff\0\0\0\0\0\xff\0\1\0\0\0", 12));
    CHECK(coloured.values == std::vector<double>{1, 0, 0, 0, 0, 1});
}

TEST_CASE("a PNG is marked as sRGB, and equal pictures make equal files") {
    const Scratch folder;
    for (const double gamma : {0., 1., 2.2})
        for (const int bits : {8, 16}) {
            write_picture(noise(9, 9), folder / "a.png", {bits, gamma});
            const std::string bytes = bytes_of(folder / "a.png");
            CHECK(says(bytes, "sRGB"));
            CHECK(says(bytes, std::string("gAMA\0\0\xb1\x8f", 8)));  // 1 / 2.2
        }
    write_picture(noise(9, 9), folder / "a.exr", {});
    const std::time_t now = std::time(nullptr);
    std::array<char, 16> today;
    REQUIRE(std::strftime(today.data(), today.size(), "%Y:%m:%d", std::localtime(&now)) == 10);
    CHECK_FALSE(says(bytes_of(folder / "a.exr"), today.data()));
}

TEST_CASE("file endings in upper and lower case, and their formats") {
    const Scratch folder;
    write_picture(noise(2, 2), folder / "A.PNG", {});
    CHECK(bytes_of(folder / "A.PNG").substr(1, 3) == "PNG");
    for (const char* good : {"a.bmp", ".png", "a.b/c.ExR", "a.jpg.png"}) CHECK(format_fault(good, 0) == "");
    for (const char* bad : {"a.jpg", "a", "", "png", ".png/a", "a.png.", "a.pngx"}) CHECK(format_fault(bad, 0) != "");
    CHECK(format_fault("a.png", 16) == "");
    CHECK(format_fault("a.exr", 32) == "");
    CHECK(says(format_fault("a.bmp", 16), ".png for 16"));
    CHECK(says(format_fault("a.png", 32), ".exr"));
    CHECK(says(format_fault("a.exr", 8), ".png"));
    CHECK(format_fault("a.png", 7) != "");
}

TEST_CASE("an older picture survives a failed write") {
    const Scratch folder;
    write_file(folder / "a.jpg", "old");
    CHECK(says(fault_of([&] { write_picture(noise(2, 2), folder / "a.jpg", {}); }), ".bmp, .png or .exr"));
    CHECK(bytes_of(folder / "a.jpg") == "old");
    CHECK(says(fault_of([&] { write_picture(noise(2, 2), folder / "no/a.png", {}); }), "folder does not exist"));
    CHECK(folder.files() == 1);
}

TEST_CASE("broken files are reported with name and reason") {
    const Scratch folder;
    const auto reading = [&](const std::string& name) { return fault_of([&] { read_picture(folder / name); }); };
    CHECK(says(reading("none.png"), "no such file"));
    CHECK(says(reading(""), "folder"));
    for (const char* name : {"a.png", "a.bmp", "a.exr"}) {
        write_picture(noise(40, 40), folder / name, {});
        write_file(folder / name, bytes_of(folder / name).substr(0, 1000));
        CHECK(says(reading(name), folder / name));
        CHECK_FALSE(says(reading(name), "\n"));
    }
    write_file(folder / "text.png", "sphere { <0,0,0>, 1 }");
    CHECK(says(reading("text.png"), "text.png"));
    write_file(folder / "empty.png", "");
    CHECK(says(reading("empty.png"), "empty.png"));
    // A header that promises 10 billion pixels.
    write_picture(noise(2, 2), folder / "huge.bmp", {});
    std::string bytes = bytes_of(folder / "huge.bmp");
    const std::int32_t size = 100000;
    std::memcpy(&bytes[18], &size, 4), std::memcpy(&bytes[22], &size, 4);
    write_file(folder / "huge.bmp", bytes);
    CHECK(says(reading("huge.bmp"), "huge.bmp"));
}

TEST_CASE("pictures as patterns: grey is of three equal colours, and what no pattern can be is refused") {
    const Scratch folder;
    const auto written = [&](const Picture& picture, const char* name, int bits) {
        write_picture(picture, folder / name, {bits, false});
        return folder / name;
    };
    const Pixels grey = read_pixels(written({2, 1, 1, {0, 1}, 8}, "grey.png", 8));
    CHECK(grey.values == std::vector<float>{0, 0, 0, 1, 1, 1});
    CHECK(grey.largest == Color(1));
    CHECK(!grey.linear);
    const FilePixels opaque = read_pixels(written({1, 2, 4, {.5, 0, 1, 1, 0, .25, 0, 1}, 16}, "opaque.png", 16));
    CHECK(opaque.values == std::vector<float>{32768 / 65535.f, 0, 1, 0, 16384 / 65535.f, 0});
    CHECK(opaque.largest == Color(32768 / 65535.f, 16384 / 65535.f, 1));
    const Pixels bright = read_pixels(written({1, 1, 3, {5, .5, 1e6}, 32}, "bright.exr", 32));
    CHECK(bright.linear);
    CHECK(bright.largest == Color(5, .5, 1e6));
    const auto refused = [&](const Picture& picture, const char* name, int bits, const char* why) {
        const std::string said = fault_of([&] { read_pixels(written(picture, name, bits)); });
        CAPTURE(said);
        CHECK(says(said, why));
    };
    CHECK(opaque.opacity.empty());
    // Puts chunks with a gamma before the pixels: a length, a name, numbers and a checksum.
    const auto with_chunk = [&](const std::string& chunk) {
        std::string bytes = bytes_of(folder / "grey.png");
        for (const auto& [name, size] : {std::pair("sRGB", 13), std::pair("gAMA", 16)})
            if (const std::size_t own = bytes.find(name); own != bytes.npos) bytes.erase(own - 4, std::size_t(size));
        bytes.insert(33, chunk);
        write_file(folder / "said.png", bytes);
        return read_pixels(folder / "said.png").gamma;
    };
    CHECK(!with_chunk(""));
    CHECK(with_chunk(std::string("\0\0\0\4gAMA\0\0\xb1\x8f\x0b\xfc\x61\x05", 16)) == 1e5 / 45455);
    CHECK(with_chunk(std::string("\0\0\0\1sRGB\0\xae\xce\x1c\xe9", 13)) == 0);
    const FilePixels glass = read_pixels(written({2, 1, 4, {1, 1, 1, 1, 1, 1, 1, .2}, 8}, "glass.png", 8));
    CHECK(glass.opacity == std::vector<float>{1, .2f});
    const Pixels ringing = read_pixels(written({1, 2, 3, {5, -.5, 1, -.1, 0, 0}, 32}, "ringing.exr", 32));
    CHECK(ringing.values == std::vector<float>{5, 0, 1, 0, 0, 0});
    refused({1, 2, 3, {1, 1, 1, 1, -.125, 0}, 32}, "dark.exr", 32, "it has the value -0.125 at column 0, row 1");
    refused({1, 1, 3, {-.1, -1, 0}, 32}, "darkest.exr", 32, "it has the value -1 at column 0, row 0");
    refused({1, 1, 3, {1, nan, 1}, 32}, "none.exr", 32, "it has the value nan");
    refused({1, 1, 3, {1, 2e9, 1}, 32}, "sun.exr", 32, "it has the value 2e+09");
    refused({1, 32769, 1, std::vector<double>(32769), 8}, "long.png", 8, "each side may have at most 32768");
}

TEST_CASE("letters are white on black, in the size asked for, or the lack of a font is told") {
    try {
        const Picture small = text_picture("12.5 s", 14), large = text_picture("12.5 s", 28);
        CHECK(small.channels == 1);
        CHECK(small.values.size() == std::size_t(small.width) * small.height);
        CHECK(std::abs(large.width - 2 * small.width) < 9);
        CHECK(small.height < 20);
        const auto [least, most] = std::ranges::minmax(large.values);
        CHECK(least == 0);
        CHECK(most == 1);
        CHECK(text_picture("12.5", 14).width < small.width);
    } catch (const FileError& error) {
        CHECK(says(error.what(), "cannot draw text: there is no font"));
    }
}

TEST_CASE("run away from its module" * doctest::skip()) {
    const Scratch folder;
    write_picture(noise(3, 2), folder / "a.bmp", {});
    CHECK(read_picture(folder / "a.bmp").width == 3);
    CHECK(read_picture(STRAHL_SOURCE "/assets/balls.png").channels == 3);
    write_picture(noise(3, 2), folder / "a.exr", {});
    CHECK(says(fault_of([&] { read_picture(folder / "a.exr"); }), "libstrahl_image.so"));
}

TEST_CASE("a program without its picture module reports what is missing") {
    const Scratch folder;
    std::filesystem::copy(std::filesystem::read_symlink("/proc/self/exe"), folder / "program");
    const std::string command = STRAHL_EMULATOR " '" + (folder / "program") +
                                "' --no-skip --test-case='run away from its module' > '" + (folder / "log") + "'";
    CHECK(std::system(command.c_str()) == 0);
    CHECK(says(bytes_of(folder / "log"), "1 passed"));
}

}  // namespace
}  // namespace strahl

// Files made of bands: with pixels in any order, and after damage to a checkpoint.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <thread>

#include "files/output_file.h"
#include "image/band_file.h"
#include "image/picture_writer.h"
#include "tests/unit/scratch.h"

namespace strahl {
namespace {

Picture noise(int width, int height, int channels = 3) {
    Picture picture{width, height, channels, {}, 32};
    std::minstd_rand random(unsigned(width * 1000 + height));
    std::uniform_real_distribution<double> value(-.2, 1.2);
    for (int i = 0; i < width * height * channels; ++i) picture.values.push_back(value(random));
    return picture;
}

TEST_CASE("a file does not depend on the order in which its pixels come, nor on the threads") {
    const Scratch folder;
    for (const char* name : {"a.bmp", "a.png", "a.exr"})
        for (const auto& [width, height] : {std::pair{1, 1}, {5, 63}, {70, 64}, {3, 65}, {90, 200}}) {
            CAPTURE(name);
            CAPTURE(height);
            const Picture picture = noise(width, height);
            write_picture(picture, folder / name, {});
            const std::string bytes = bytes_of(folder / name);
            PictureWriter writer(width, height, 3, name, {});
            // Tiles of 7x50 pixels, each by one of three threads, from the last to the first.
            const int columns = (width + 6) / 7, tiles = columns * ((height + 49) / 50);
            std::atomic<int> left = tiles;
            const auto put = [&] {
                for (int i; (i = --left) >= 0;) {
                    const int x = i % columns * 7, y = i / columns * 50;
                    const int right = std::min(x + 7, width), bottom = std::min(y + 50, height);
                    std::vector<double> tile;
                    for (int row = y; row < bottom; ++row)
                        for (int k = 3 * (row * width + x); k < 3 * (row * width + right); ++k)
                            tile.push_back(picture.values[unsigned(k)]);
                    writer.put(x, y, right - x, bottom - y, tile.data());
                }
            };
            { const std::jthread one(put), two(put), three(put); }
            writer.write(folder / name);
            CHECK(bytes_of(folder / name) == bytes);
        }
}

TEST_CASE("pixels that did not come are black") {
    const Scratch folder;
    PictureWriter writer(3, 150, 3, ".png", {});
    const std::vector<double> white(9, 1.);
    writer.put(0, 70, 3, 1, white.data());
    writer.write(folder / "a.png");
    const Picture back = read_picture(folder / "a.png");
    CHECK(std::count(back.values.begin(), back.values.end(), 0) == 3 * 3 * 149);
    CHECK(back.values[3 * 3 * 70] == 1);
}

TEST_CASE("the smallest PNG holds the same pixels, and is smaller") {
    const Scratch folder;
    for (const int bits : {8, 16}) {
        Picture picture{200, 150, 3, {}, bits};
        for (int i = 0; i < 200 * 150; ++i)
            for (const double v : {i % 200 / 200., i / 200 / 150., .5 + .5 * std::sin(i * i * 1e-7)})
                picture.values.push_back(v);
        write_picture(picture, folder / "fast.png", {bits});
        write_picture(picture, folder / "small.png", {bits, false, Compression::small});
        CHECK(read_picture(folder / "small.png").values == read_picture(folder / "fast.png").values);
        CHECK(bytes_of(folder / "small.png").size() < .9 * bytes_of(folder / "fast.png").size());
    }
}

TEST_CASE("float files of one to four channels, of floats too regular and too random to be packed") {
    const Scratch folder;
    for (int channels = 1; channels <= 4; ++channels)
        for (const bool regular : {false, true}) {
            Picture picture = noise(33, 70, channels);
            for (double& value : picture.values) value = regular ? .25 : static_cast<float>(value);
            write_picture(picture, folder / "a.exr", {});
            const Picture back = read_picture(folder / "a.exr");
            CHECK(back.channels == channels);
            CHECK(back.values == picture.values);
        }
}

TEST_CASE("of a checkpoint that was cut off or damaged the whole bands before that place are there") {
    const Scratch folder;
    const std::string path = folder / "checkpoint";
    const BandHeader header{"program", "scene", "options", ".png", {3, 200, 3, 8}, Compression::fast, 1, 1};
    std::vector<std::size_t> ends;
    {
        BandFile file(path, header);
        ends.push_back(bytes_of(path).size());
        for (int band = 0; band < 4; ++band) {
            file.append(3 - band, {std::string(unsigned(20 * band), char('a' + band)), "note"});
            file.sync();
            ends.push_back(bytes_of(path).size());
        }
    }
    const std::string whole = bytes_of(path);
    const auto expect = [&](std::size_t damaged_at) {
        const BandFile file(path);
        CHECK(file.header().difference(header) == "");
        for (int band = 0; band < 4; ++band) {
            const bool there = ends[unsigned(band) + 1] <= damaged_at;
            REQUIRE(file.has(3 - band) == there);
            if (there) CHECK(file.bytes(3 - band) == std::string(unsigned(20 * band), char('a' + band)));
            if (there) CHECK(file.note(3 - band) == "note");
        }
    };
    expect(whole.size());
    for (std::size_t at = ends[0]; at < whole.size(); ++at) {
        CAPTURE(at);
        write_file(path, whole.substr(0, at));
        expect(at);
        std::string damaged = whole;
        damaged[at] = char(damaged[at] + 1);
        write_file(path, damaged);
        expect(at);
    }
    // Going on overwrites what is damaged.
    {
        BandFile file(path);
        file.open_to_append();
        for (int band = 0; band < 4; ++band)
            if (const std::string bytes(unsigned(20 * band), char('a' + band)); !file.has(3 - band))
                file.append(3 - band, {bytes, "note"});
    }
    expect(whole.size());
    CHECK(bytes_of(path) == whole);
    for (const std::size_t size : {std::size_t(0), std::size_t(10), ends[0] - 1}) {
        write_file(path, whole.substr(0, size));
        CHECK_THROWS_AS(BandFile{path}, FileError);
    }
}

TEST_CASE("one writer at a time appends to a checkpoint") {
    const Scratch folder;
    BandFile one(folder / "checkpoint", {"", "", "", ".bmp", {1, 1, 3, 8}});
    BandFile two(folder / "checkpoint");
    CHECK_THROWS_AS(two.open_to_append(), OutputError);
}

}  // namespace
}  // namespace strahl

// Files that are made to harm programs that read them as pictures.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>

#include "files/output_file.h"
#include "image/picture.h"
#include "tests/unit/faults.h"
#include "tests/unit/image/exr_bytes.h"
#include "tests/unit/image/other_pictures.h"
#include "tests/unit/scratch.h"

namespace strahl {
namespace {

Picture picture(int width, int height) {
    return {width, height, 3, std::vector<double>(std::size_t(3) * width * height, .5), 32};
}

std::string fault_in(const std::string& path, std::uint64_t most = most_values_read) {
    return fault_of([&] { read_picture(path, most); });
}

TEST_CASE("only .bmp, .png, .exr, .jpg, .gif, .tga, .ppm, .pgm and .pfm are read, recognised by their contents") {
    const Scratch folder;
    const auto reading = [&](const std::string& name) { return fault_in(folder / name); };
    write_picture(picture(4, 4), folder / "a.png", {});
    std::filesystem::rename(folder / "a.png", folder / "a.bmp");
    CHECK(reading("a.bmp").empty());
    const std::string no_channels("\x01\xda\0\1\0\3\0\4\0\4\0\0", 12);  // of an SGI file
    const std::string icon("\0\0\1\0\1\0", 6), dds("DDS \x7c\0\0\0", 8), cineon("\x80\x2a\x5f\xd7", 4);
    for (const std::string& start :
         {no_channels, icon, dds, cineon, std::string("P4 8 1\n1"), std::string("P1 1 1\n1")})
        for (const char* name : {"b.png", "b.sgi", "b.ico", "b.dds", "b.cin", "b.ppm"}) {
            write_file(folder / name, start + std::string(2000, '\0'));
            CHECK(says(reading(name), "is not a .bmp, .png, .exr, .jpg, .gif, .tga, .ppm, .pgm or .pfm file"));
        }
}

TEST_CASE("pictures without compression: headers that are forged, and files that are cut off") {
    const Scratch folder;
    const auto reading = [&](const std::string& bytes, std::uint64_t most = most_values_read) {
        write_file(folder / "a.ppm", bytes);
        return fault_in(folder / "a.ppm", most);
    };
    const std::string values(2000, '\7');
    CHECK(reading("P6 # red first\n2 1\t255\n123456").empty());
    CHECK(says(reading("P6 2 1 255\n12345"), "cut off"));
    CHECK(says(reading("P6 2 1 65535\n12345678901"), "cut off"));
    CHECK(says(reading("P6 2"), "cut off"));
    CHECK(says(reading("P6 2 1 255#"), "cut off"));
    CHECK(says(reading("P6 " + std::string(30, '1') + values), "cut off"));
    CHECK(says(reading("P6 1000000 1000000 255\n" + values), "1000000x1000000 pixels"));
    CHECK(says(reading("P6 2 1 255\n123456", 5), "2x1 pixels"));
    for (const char* wrong : {"P6 0 1 255", "P6 -1 1 255", "P6 1 9999999 255", "P6 1 x 255", "P6 1 1 0", "P6 1.5 1 255",
                              "PF 1 1 x", "PF 1 1 nan", "PF 1 1 2"})
        CHECK(says(reading(wrong + ('\n' + values)), "where a number is expected"));
    CHECK(reading("P3 1 1 255\n1 2 # green\n 3").empty());
    CHECK(says(reading("P3 1 1 255\n1 2"), "cut off"));
    CHECK(says(reading("P3 1 1 255\n1 2 "), "cut off"));
    CHECK(says(reading("P2 9 9 255\n1 2 3"), "9x9 pixels"));
    for (const char* wrong : {"P2 1 1 255 -1", "P2 1 1 255 256", "P3 1 1 255 1 x 1", "P2 1 1 65536 1"})
        CHECK(says(reading(wrong + ('\n' + values)), "where a number is expected"));
    CHECK(says(reading("PF 1 1 0\n" + values), "neither 1 nor -1"));
    CHECK(says(reading("P6_" + values), "cut off"));
    CHECK(says(reading("P61 1 255\n" + values), "it is not a .ppm"));
}

TEST_CASE("BMP headers that are forged, and files that are cut off") {
    const Scratch folder;
    const auto reading = [&](std::int32_t start, std::int32_t width, std::int32_t height, std::size_t size) {
        std::string bytes =
            "BM" + little_endian(0, 0, start, 40, width, height, std::uint16_t(1), std::uint16_t(24), 0, 0, 0, 0, 0, 0);
        bytes.resize(size, '\7');
        write_file(folder / "a.bmp", bytes);
        return fault_in(folder / "a.bmp");
    };
    CHECK(reading(54, 2, 2, 54 + 14).empty());  // the padding of the last row may be missing
    CHECK(says(reading(54, 2, 2, 54 + 13), "cut off"));
    CHECK(says(reading(54, 2, -2, 54 + 13), "cut off"));
    CHECK(says(reading(60, 2, 2, 54 + 14), "cut off"));
    CHECK(says(reading(-1, 2, 2, 100), "cut off"));
    CHECK(says(reading(53, 2, 2, 100), "begin inside its header"));
    CHECK(says(reading(54, 50, 50, 1000), "50x50 pixels"));
    constexpr std::int32_t lowest = std::numeric_limits<std::int32_t>::min();
    for (const std::int32_t wrong : {0, -3, lowest, 1 << 21})
        CHECK(says(reading(54, wrong, 2, 1000), "impossible sizes"));
    for (const std::int32_t wrong : {0, lowest, 1 << 21, -(1 << 21)})
        CHECK(says(reading(54, 2, wrong, 1000), "impossible sizes"));
    // Whatever the first bytes are, reading ends.
    std::minstd_rand random(7);
    write_picture(picture(9, 5), folder / "a.bmp", {});
    const std::string whole = bytes_of(folder / "a.bmp");
    int read = 0;
    for (int i = 0; i < 2000; ++i) {
        std::string bytes = whole.substr(0, i % 4 ? whole.size() : random() % whole.size());
        for (int k = 0; k < 3 && bytes.size() > 2; ++k)
            bytes[2 + random() % (std::min<std::size_t>(54, bytes.size()) - 2)] = static_cast<char>(random());
        if (bytes.size() > 34) bytes.replace(28, 6, std::string("\x18\0\0\0\0\0", 6));  // else the library reads it
        if (bytes.size() > 18) bytes.replace(14, 4, std::string("\x28\0\0\0", 4));
        write_file(folder / "b.bmp", bytes);
        read += fault_in(folder / "b.bmp").empty();
    }
    CHECK(read > 100);
}

TEST_CASE(".jpg and .gif files: their values, and headers that are forged") {
    const Scratch folder;
    const auto reading = [&](const std::string& bytes) {
        write_file(folder / "a", bytes);
        return fault_in(folder / "a");
    };
    write_file(folder / "a.gif", gif(40, 9));
    const Picture grey = read_picture(folder / "a.gif");
    REQUIRE(grey.width == 40);
    REQUIRE(grey.height == 9);
    const auto channels = static_cast<std::size_t>(grey.channels);
    for (std::size_t i = 0; i < 360; ++i) CHECK(grey.values[channels * i + 1] == double(i % 256) / 255);
    for (const int channels : {1, 3}) {
        write_file(folder / "a.jpg", jpeg(20, 9, channels));
        const Picture blocks = read_picture(folder / "a.jpg");
        REQUIRE(blocks.width == 20);
        REQUIRE(blocks.height == 9);
        REQUIRE(blocks.channels == channels);
        const double left = blocks.values[0], right = blocks.values[static_cast<std::size_t>(8 * channels)];
        CHECK(left != right);
        CHECK(blocks.values[static_cast<std::size_t>(7 * channels)] == left);
    }
    const std::string whole = jpeg(200, 90, 3);
    CHECK(reading(whole).empty());
    CHECK(says(reading(whole.substr(0, whole.size() - 100)), "as a picture"));
    std::string forged = whole;
    forged.replace(whole.find("\xff\xc0") + 5, 4, "\xff\xff\xff\xff");
    CHECK(says(reading(forged), "more pixels than fit into such a file"));
    CHECK(says(reading("\xff\xd8\xff" + std::string(3000, '\xff')), "it has no size"));
    CHECK(says(reading(std::string("\xff\xd8\xff\xe0\0\0", 6) + std::string(3000, '\0')), "it has no size"));
    std::string canvas = gif(40, 9);
    CHECK(says(reading(canvas.substr(0, canvas.size() - 100)), "as a picture"));
    canvas.replace(6, 4, "\xff\xff\xff\xff");
    CHECK(says(reading(canvas), "more pixels than fit into such a file"));
}

TEST_CASE(".tga files: their values, which are POV-Ray's, and headers that are forged") {
    const Scratch folder;
    const std::string colors("\x0a\x14\x1e\x3c\x78\xf0\xff\x80\x40\1\2\3", 12);  // blue first
    const std::string clear("\x0a\x14\x1e\xff\x3c\x78\xf0\x80\xff\x80\x40\0\1\2\3\x40", 16);
    const std::string packed("\x81\x0a\x14\x1e\1\x3c\x78\xf0\xff\x80\x40", 11);  // a pixel twice, and two pixels
    const std::string short_codes("\0\x7c\xe0\x83\x1f\0\xad\xb5", 8), numbers("\0\1\2\3", 4);
    struct Row {
        std::string bytes;
        std::vector<int> values;
    };
    const std::vector<int> three{30, 20, 10, 240, 120, 60, 64, 128, 255, 3, 2, 1};
    const std::vector<int> four{30, 20, 10, 255, 240, 120, 60, 128, 64, 128, 255, 0, 3, 2, 1, 64};
    const std::vector<int> bits{248, 0, 0, 0, 0, 248, 0, 255, 0, 0, 248, 0, 104, 104, 104, 255};
    for (const Row& row :
         {Row{targa(2, 24, 32, colors), three},
          {targa(2, 32, 32, clear), four},
          {targa(2, 16, 32, short_codes), bits},
          {targa(2, 15, 32, short_codes), {248, 0, 0, 0, 248, 0, 0, 0, 248, 104, 104, 104}},
          {targa(3, 8, 32, std::string("\0\x32\x80\xff", 4)), {0, 50, 128, 255}},
          {targa(1, 8, 32, numbers, colors, 24), three},
          {targa(1, 8, 32, numbers, clear, 32), four},
          {targa(1, 8, 32, numbers, short_codes, 16), bits},
          {targa(9, 8, 32, "\x81\1\1\2\3", colors, 24), {240, 120, 60, 240, 120, 60, 64, 128, 255, 3, 2, 1}},
          {targa(10, 24, 32, packed), {30, 20, 10, 30, 20, 10, 240, 120, 60, 64, 128, 255}},
          {targa(11, 8, 32, "\x81\x32\1\x80\xff"), {50, 50, 128, 255}}}) {
        CAPTURE(int(row.bytes[2]));
        CAPTURE(int(row.bytes[16]));
        write_file(folder / "a.tga", row.bytes);
        const Picture own = read_picture(folder / "a.tga");
        CHECK(own.width == 4);
        CHECK(own.bits == 8);
        REQUIRE(own.values.size() == row.values.size());
        for (std::size_t i = 0; i < own.values.size(); ++i) CHECK(own.values[i] == row.values[i] / 255.);
        write_file(folder / "a.tga", row.bytes.substr(0, row.bytes.size() - 1));
        CHECK(says(fault_in(folder / "a.tga"), "cut off"));
    }
    std::string rows = targa(2, 24, 0, colors);
    rows[12] = 2, rows[14] = 2;
    write_file(folder / "a.tga", rows);
    CHECK(read_picture(folder / "a.tga").values[0] == 64 / 255.);  // from the lowest row
    const Picture left = read_picture(folder / "a.tga");
    rows[17] |= 0x10;  // from the right
    write_file(folder / "a.tga", rows);
    const Picture right = read_picture(folder / "a.tga");
    CHECK(right.from_right);
    for (std::size_t i = 0; i < 12; ++i) CHECK(right.values[i] == left.values[i / 6 * 6 + (3 + i) % 6]);
    write_file(folder / "a.tga", targa(1, 8, 32, std::string("\0\1\2\4", 4), colors, 24));
    CHECK(says(fault_in(folder / "a.tga"), "beyond its palette"));
    rows.replace(12, 4, "\xff\xff\xff\xff");
    write_file(folder / "a.tga", rows);
    CHECK(says(fault_in(folder / "a.tga"), "more than are read"));
    for (const int place : {1, 2, 16}) {
        rows = targa(2, 24, 32, colors), rows[std::size_t(place)] = 7;
        write_file(folder / "a.tga", rows);
        CHECK(says(fault_in(folder / "a.tga"), "is not a .bmp"));
    }
}

TEST_CASE("devices and pipes are not read") {
    const Scratch folder;
    CHECK(says(fault_in("/dev/zero"), "not a regular file"));
    REQUIRE(::mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
    CHECK(says(fault_in(folder / "pipe.png"), "not a regular file"));
}

TEST_CASE("a forged header costs no memory, and a large picture no more than was allowed") {
    const Scratch folder;
    const auto reading = [&](const std::string& name) { return fault_in(folder / name); };
    struct Forgery {
        int width, height, tile;
    };
    for (const auto& [width, height, tile] : {Forgery{9000, 9000, 9000}, {8, 6, 8000}}) {
        CAPTURE(width);
        CAPTURE(tile);
        write_file(folder / "a.exr", tiled_exr(width, height, tile, '\3'));
        CHECK(says(reading("a.exr"), "than fit into such a file"));
    }
    std::string bmp(1100, '\0');  // run-length encoded, with the end right after the palette
    const std::array<std::int32_t, 8> header{1078, 40, 20000, 20000, 8 << 16 | 1, 1, 0, 0};
    bmp.replace(0, 2, "BM"), bmp[1079] = 1;
    std::memcpy(&bmp[10], header.data(), sizeof header);
    write_file(folder / "a.bmp", bmp);
    CHECK(says(reading("a.bmp"), "than fit into such a file"));
    write_picture(picture(20, 10), folder / "a.png", {});
    CHECK(fault_in(folder / "a.png", 600).empty());
    CHECK(says(fault_in(folder / "a.png", 599), "20x10 pixels"));
}

TEST_CASE("what the header says is longer than the file is refused before anything is allocated for it") {
    const Scratch folder;
    write_picture(picture(4, 4), folder / "a.png", {});
    write_picture(picture(4, 4), folder / "a.exr", {});
    const auto forged = [&](const char* name, const std::string& word, std::ptrdiff_t offset, const std::string& size) {
        std::string bytes = bytes_of(folder / name);
        const std::size_t at = bytes.find(word);
        REQUIRE(at != bytes.npos);
        bytes.replace(at + static_cast<std::size_t>(offset), size.size(), size);
        write_file(folder / "forged", bytes);
        return fault_in(folder / "forged");
    };
    const double before = memory();
    CHECK(says(forged("a.png", "gAMA", -4, std::string("\x60\0\0\1", 4)), "announces more than is in the file"));
    const std::string type("lineOrder\0lineOrder", 19);
    CHECK(says(forged("a.exr", type, 20, std::string("\1\0\0\x60", 4)), "announces more than is in the file"));
    CHECK(says(forged("a.exr", type, 20, std::string("\1\0\0\x80", 4)), "announces more than is in the file"));
    // With the right size both files can be read.
    CHECK(forged("a.png", "gAMA", 0, "gAMA").empty());
    CHECK(forged("a.exr", type, 0, type).empty());
    CHECK(memory() - before < 100);
}

TEST_CASE("rows that a file promises and does not have cost no memory") {
    const Scratch folder;
    Picture noise = picture(64, 64);
    for (std::size_t i = 0; i < noise.values.size(); ++i) noise.values[i] = double(i * i % 1009) / 1009;
    write_picture(noise, folder / "a.exr", {});
    std::string bytes = bytes_of(folder / "a.exr");
    for (const std::string window : {"dataWindow", "displayWindow"}) {
        const std::size_t at = bytes.find(window + std::string("\0box2i\0\x10\0\0\0", 11));
        REQUIRE(at != bytes.npos);
        bytes.replace(at + window.size() + 11, 16, little_endian(0, 0, 7999, 7999));
    }
    bytes.resize(std::max<std::size_t>(bytes.size(), 8000));
    write_file(folder / "a.exr", bytes);
    const double before = memory();
    CHECK(says(fault_in(folder / "a.exr"), "as a picture"));
    CHECK(memory() - before < 200);
}

TEST_CASE("a picture at the end of all numbers is refused, and read where its place is not asked for") {
    const Scratch folder;
    write_picture(picture(4, 4), folder / "a.exr", {});
    std::string bytes = bytes_of(folder / "a.exr");
    const std::string window = std::string("dataWindow\0box2i\0", 17);
    const std::size_t at = bytes.find(window);
    REQUIRE(at != bytes.npos);
    const int far = 1 << 25;
    bytes.replace(at + window.size() + 4, 16, little_endian(0, far, 3, far + 3));
    write_file(folder / "a.exr", bytes);
    CHECK(says(fault_in(folder / "a.exr"), "lies too far"));

    write_picture(picture(4, 4), folder / "a.png", {});
    bytes = bytes_of(folder / "a.png");
    // The chunk with the place on a page, after the header.
    constexpr std::size_t header_end = 8 + 12 + 13;
    bytes.insert(header_end, std::string("\0\0\0\x9oFFs\0\0\0\0\x7f\xff\0\0\0\x7f\xad\xc7\x21", 21));
    write_file(folder / "b.png", bytes);
    CHECK(read_picture(folder / "b.png").values == read_picture(folder / "a.png").values);
}

TEST_CASE("run lengths of other bits than the pixels are refused") {
    const Scratch folder;
    const auto fault = [&](std::uint16_t bits, std::int32_t compression) {
        std::string bytes =
            "BM" + little_endian(1110, 0, 1078, 40, 8, 8, std::uint16_t(1), bits, compression, 32, 0, 0, 256, 0);
        bytes += std::string(1024, '\x40');
        for (int row = 0; row < 8; ++row) bytes += std::string("\x08\x01\0", 3) + (row < 7 ? '\0' : '\1');
        write_file(folder / "a.bmp", bytes);
        return fault_in(folder / "a.bmp");
    };
    CHECK(fault(8, 1).empty());
    for (const std::uint16_t bits : {16, 24, 32, 4}) CHECK(says(fault(bits, 1), "run lengths"));
    for (const std::uint16_t bits : {16, 24, 32, 8}) CHECK(says(fault(bits, 2), "run lengths"));
}

}  // namespace
}  // namespace strahl

// A Targa file (Truevision, "TGA File Format Specification") is a header, a palette and pixels, blue first, in run
// lengths or not. What it leaves open is as in POV-Ray: 5 bits are the upper ones of 8, and a fourth byte is opacity.
#include <algorithm>
#include <array>
#include <vector>

#include "image/recognise.h"
#include "image/uncompressed.h"
#include "num/turn_rows.h"

namespace strahl {
namespace {

using Pixel = std::array<unsigned char, 4>;  // red, green, blue, opacity

/// Reads a file from one place on.
class Bytes {
  public:
    Bytes(const RegularFile& file, std::uint64_t place) : file(file), begin(place) {}
    [[noreturn]] void fail(const std::string& why) const { fail_reading(file.path(), why); }
    unsigned next() {
        if (at == part.size()) {
            begin += part.size(), at = 0, part = file.bytes(begin, 65536);
            if (part.empty()) fail("it is cut off");
        }
        return static_cast<unsigned char>(part[at++]);
    }
    Pixel color(int bits) {
        const auto byte = [](unsigned value) { return static_cast<unsigned char>(value); };
        const unsigned first = next();
        if (bits == 8) return {byte(first), byte(first), byte(first), 255};
        const unsigned second = next();
        if (bits < 24) {
            const unsigned code = first | second << 8, opacity = bits == 15 || code >> 15 ? 255 : 0;
            return {byte(code >> 7 & 0xf8), byte(code >> 2 & 0xf8), byte(code << 3), byte(opacity)};
        }
        const unsigned third = next(), fourth = bits == 32 ? next() : 255;
        return {byte(third), byte(second), byte(first), byte(fourth)};
    }

  private:
    const RegularFile& file;
    std::uint64_t begin;
    std::string part;
    std::size_t at = 0;
};

}  // namespace

Picture read_targa(const RegularFile& file, std::uint64_t most) {
    const TargaHeader header(file.bytes(0, TargaHeader::size));
    Bytes bytes(file, TargaHeader::size + header.comment);
    const int bits = header.paletted() ? header.palette_bits : header.bits;
    const bool grey = bits == 8, alpha = bits == 16 || bits == 32;
    const unsigned channels = (grey ? 1 : 3) + alpha;
    const std::uint64_t pixels = std::uint64_t(header.width) * header.height;
    require_room(file.path(), {header.width, header.height, channels, 0}, most);
    std::vector<Pixel> palette(header.palette_size);
    for (Pixel& own : palette) own = bytes.color(header.palette_bits);
    const auto next = [&]() -> Pixel {
        if (!header.paletted()) return bytes.color(header.bits);
        const unsigned number = bytes.next();
        if (number >= palette.size()) bytes.fail("a pixel is beyond its palette");
        return palette[number];
    };
    Picture picture{header.width, header.height, static_cast<int>(channels), {}, 8};
    picture.values.resize(channels * pixels);
    Pixel pixel{};
    unsigned same = 0, others = 0;  // how many of the next pixels are like `pixel`, or have bytes of their own
    for (unsigned y = 0; y < header.height; ++y) {
        double* to =
            &picture.values[std::size_t(channels) * header.width * (header.top_down() ? y : header.height - 1u - y)];
        for (unsigned x = 0; x < header.width; ++x) {
            if (header.packed() && same + others == 0) {
                const unsigned count = bytes.next();
                (count & 128 ? same : others) = (count & 127) + 1;
                if (same > 0) pixel = next();
            }
            if (same > 0)
                --same;
            else
                pixel = next(), others -= header.packed();
            for (unsigned c = 0; c < channels; ++c) *to++ = pixel[alpha && c + 1 == channels ? 3 : c] / 255.;
        }
    }
    picture.from_right = header.from_right();
    if (picture.from_right) turn_rows(picture.values, header.width, channels);
    return picture;
}

}  // namespace strahl

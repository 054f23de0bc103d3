// Picture files that need no library: .bmp with 24 bits a pixel (Microsoft, "Bitmap Storage"), .ppm and .pgm with 8 or
// 16 bits or a decimal number a value, .pfm with floats (netpbm.sourceforge.net/doc), and .tga.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "files/bytes.h"
#include "files/regular_file.h"
#include "image/picture.h"

namespace strahl {

/// The header of a .bmp file. That of OS/2, 12 bytes long, is not read: its pixels count as 0.
struct BmpHeader {
    static constexpr std::size_t size = 54;        // bytes of the file that it is read from
    std::uint32_t start, length, compression = 0;  // where the pixels begin; the length of the second header
    std::int32_t width = 0, height = 0;            // a height below 0: rows from the top
    std::uint16_t bits = 0;                        // of a pixel

    explicit BmpHeader(std::string_view bytes)
        : start(get_little<std::uint32_t>(bytes, 10)), length(get_little<std::uint32_t>(bytes, 14)) {
        if (length == 12) return;
        width = static_cast<std::int32_t>(get_little<std::uint32_t>(bytes, 18));
        height = static_cast<std::int32_t>(get_little<std::uint32_t>(bytes, 22));
        bits = get_little<std::uint16_t>(bytes, 28);
        compression = get_little<std::uint32_t>(bytes, 30);
    }
    std::uint64_t rows() const { return static_cast<std::uint64_t>(std::abs(std::int64_t(height))); }
    std::uint64_t columns() const { return static_cast<std::uint64_t>(std::abs(std::int64_t(width))); }
    /// Red, green and blue, a byte each, without compression?
    bool plain() const { return length >= 40 && length <= 124 && bits == 24 && compression == 0; }
};

/// The header of a .tga file.
struct TargaHeader {
    static constexpr std::size_t size = 18;
    unsigned comment, map, type, palette_size;  // comment: its length
    int palette_bits, bits;
    std::uint16_t width, height;
    unsigned flags;

    explicit TargaHeader(std::string_view bytes)
        : comment(get_little<std::uint8_t>(bytes, 0)),
          map(get_little<std::uint8_t>(bytes, 1)),
          type(get_little<std::uint8_t>(bytes, 2)),
          palette_size(get_little<std::uint16_t>(bytes, 5)),
          palette_bits(get_little<std::uint8_t>(bytes, 7)),
          bits(get_little<std::uint8_t>(bytes, 16)),
          width(get_little<std::uint16_t>(bytes, 12)),
          height(get_little<std::uint16_t>(bytes, 14)),
          flags(get_little<std::uint8_t>(bytes, 17)) {}
    bool paletted() const { return (type & 7) == 1; }
    bool packed() const { return type >= 8; }
    bool top_down() const { return flags & 0x20; }
    bool from_right() const { return flags & 0x10; }
    /// Can this be one? Such files do not begin with a word of their own.
    bool valid() const {
        const auto is_color = [](int own) { return own == 15 || own == 16 || own == 24 || own == 32; };
        const unsigned kind = type & 7;
        const bool known = (type & ~8u) == kind && kind >= 1 && kind <= 3 && width > 0 && height > 0;
        const bool palette = map == 1 ? is_color(palette_bits) && palette_size > 0 : map == 0 && palette_size == 0;
        return known && palette && (kind == 2 ? is_color(bits) : bits == 8) && (kind != 1 || map == 1);
    }
};
Picture read_targa(const RegularFile& file, std::uint64_t most);

/// Does a file that begins with these bytes hold a .bmp, .ppm, .pgm or .pfm picture without compression?
bool is_uncompressed(std::string_view bytes);

/// Reads such a picture, or that of a .tga file. Throws FileError, also if it has more than `most` values.
Picture read_uncompressed(const RegularFile& file, std::uint64_t most);

/// Returns a picture of 1 or 3 channels as the bytes of a .pgm, .ppm or .pfm file: 8 or 16 bits, or floats.
std::string netpbm_of(const Picture& picture);

}  // namespace strahl

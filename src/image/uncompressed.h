// Picture files without compression, which need no library: .bmp with 24 bits a pixel (Microsoft, "Bitmap Storage"),
// .ppm and .pgm with 8 or 16 bits or a decimal number a value, and .pfm with floats (netpbm.sourceforge.net/doc).
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
    static constexpr std::size_t size = 54;  // bytes of the file that it is read from
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

/// Does a file that begins with these bytes hold such a picture?
bool is_uncompressed(std::string_view bytes);

/// Reads such a picture. Throws FileError, also if it has more than `most` values.
Picture read_uncompressed(const RegularFile& file, std::uint64_t most);

/// Returns a picture of 1 or 3 channels as the bytes of a .pgm, .ppm or .pfm file: 8 or 16 bits, or floats.
std::string netpbm_of(const Picture& picture);

}  // namespace strahl

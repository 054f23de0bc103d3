// Encodes PNG (W3C, "Portable Network Graphics Specification"). Bands are parts of one deflate stream that end at a
// byte, each in a chunk of its own, so that they can be compressed on different threads (as M. Adler's pigz does).
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "files/bytes.h"
#include "image/encoder.h"

namespace strahl {
namespace {

/// Compresses a part of a raw deflate stream, which ends at a byte.
std::string deflated(const std::string& plain, int level, int strategy) {
    z_stream stream{};
    if (::deflateInit2(&stream, level, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL, strategy) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, ::deflateEnd);
    std::string packed(::deflateBound(&stream, plain.size()) + 16, '\0');  // 16: for the empty block at the end
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
    stream.avail_in = static_cast<uInt>(plain.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    ::deflate(&stream, Z_SYNC_FLUSH);
    packed.resize(stream.total_out);
    return packed;
}

void put_chunk(std::string& file, const char* type, std::string_view content) {
    put_big(file, static_cast<std::uint32_t>(content.size()));
    const std::size_t start = file.size();
    file.append(type).append(content);
    const auto* const from = reinterpret_cast<const Bytef*>(&file[start]);
    put_big(file, static_cast<std::uint32_t>(::crc32(0, from, static_cast<uInt>(file.size() - start))));
}

enum class Filter : char { sub = 1, paeth = 4 };

int paeth(int left, int above, int corner) {
    const int by_left = std::abs(above - corner), by_above = std::abs(left - corner),
              by_corner = std::abs(left + above - 2 * corner);
    return by_left <= by_above && by_left <= by_corner ? left : by_above <= by_corner ? above : corner;
}

class Png : public Encoder {
  public:
    Png(const Layout& own_layout, Compression wanted) : Encoder(own_layout), compression(wanted) {}

    EncodedBand encode(const std::byte* codes, int rows) const override {
        const std::string bytes = in_order(codes, rows);
        std::string plain = filtered(bytes, rows, Filter::sub), packed;
        if (compression == Compression::small) {
            packed = deflated(plain, 9, Z_FILTERED);
            std::string other = filtered(bytes, rows, Filter::paeth), packed_other = deflated(other, 9, Z_FILTERED);
            if (packed_other.size() < packed.size()) plain = std::move(other), packed = std::move(packed_other);
        } else {  // measured: tests/bench/files.md
            packed = deflated(plain, 1, layout.bits == 8 ? Z_RLE : Z_DEFAULT_STRATEGY);
        }
        EncodedBand band;
        put_chunk(band.bytes, "IDAT", packed);
        const auto* const from = reinterpret_cast<const Bytef*>(plain.data());
        put_big(band.note, static_cast<std::uint32_t>(::adler32(1, from, static_cast<uInt>(plain.size()))));
        return band;
    }

    void assemble(const Notes& notes, const BytesOf& bytes_of, const Append& append) const override {
        append(head());
        uLong sum = 1;
        for (int i = 0; i < bands(); ++i) {
            append(bytes_of(i));
            const auto own = get_big<std::uint32_t>(notes[unsigned(i)], 0);
            sum = ::adler32_combine(sum, own, static_cast<z_off_t>((layout.row_bytes() + 1) * unsigned(rows(i))));
        }
        std::string end("\x03\0", 2), tail;  // the last block, which is empty
        put_big(end, static_cast<std::uint32_t>(sum));
        put_chunk(tail, "IDAT", end);
        put_chunk(tail, "IEND", "");
        append(tail);
    }

  private:
    std::string head() const {
        constexpr char color_types[] = {0, 4, 2, 6};  // grey, grey and alpha, RGB, RGB and alpha
        std::string header, file = "\x89PNG\r\n\x1a\n";
        for (const int side : {layout.width, layout.height}) put_big(header, static_cast<std::uint32_t>(side));
        header += {static_cast<char>(layout.bits), color_types[layout.channels - 1], 0, 0, 0};
        put_chunk(file, "IHDR", header);
        put_chunk(file, "sRGB", std::string_view("\0", 1));
        put_chunk(file, "gAMA", std::string_view("\0\0\xb1\x8f", 4));  // 1 / 2.2, for readers that know no sRGB
        put_chunk(file, "IDAT", "\x78\x01");                           // zlib's header: a window of 32 KiB
        return file;
    }

    /// The codes as bytes; those of 16 bits have the most significant byte first.
    std::string in_order(const std::byte* codes, int rows) const {
        std::string bytes(reinterpret_cast<const char*>(codes), layout.row_bytes() * unsigned(rows));
        if (layout.bits == 16) {
            const auto* const values = reinterpret_cast<const std::uint16_t*>(codes);
            for (std::size_t i = 0; i < bytes.size() / 2; ++i) {
                bytes[2 * i] = static_cast<char>(values[i] >> 8);
                bytes[2 * i + 1] = static_cast<char>(values[i]);
            }
        }
        return bytes;
    }

    /// Filters rows. The first row of a band must not depend on the row above it.
    std::string filtered(const std::string& bytes, int rows, Filter filter) const {
        const std::size_t row = layout.row_bytes(), pixel = unsigned(layout.channels * layout.bits / 8);
        std::string plain((row + 1) * unsigned(rows), '\0');
        for (std::size_t y = 0; y < unsigned(rows); ++y) {
            const auto* const own = reinterpret_cast<const unsigned char*>(&bytes[y * row]);
            char* const to = &plain[y * (row + 1)];
            const bool sub = filter == Filter::sub || y == 0;
            to[0] = static_cast<char>(sub ? Filter::sub : filter);
            for (std::size_t i = 0; i < pixel; ++i) to[1 + i] = static_cast<char>(own[i] - (sub ? 0 : (own - row)[i]));
            if (sub)
                for (std::size_t i = pixel; i < row; ++i) to[1 + i] = static_cast<char>(own[i] - own[i - pixel]);
            else
                for (std::size_t i = pixel; i < row; ++i) {
                    const auto* const above = own - row;
                    to[1 + i] = static_cast<char>(own[i] - paeth(own[i - pixel], above[i], above[i - pixel]));
                }
        }
        return plain;
    }

    const Compression compression;
};

}  // namespace

std::unique_ptr<Encoder> png_encoder(const Layout& layout, Compression compression) {
    return std::make_unique<Png>(layout, compression);
}

}  // namespace strahl

// Encodes OpenEXR: one part of scan lines, 32-bit floats, ZIP compression of 16 lines at a time ("OpenEXR File Layout",
// openexr.com).
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <new>

#include "files/bytes.h"
#include "image/encoder.h"

namespace strahl {
namespace {

constexpr int chunk_rows = 16;
static_assert(band_rows % chunk_rows == 0);

void put_float(std::string& bytes, float value) { put_little(bytes, std::bit_cast<std::uint32_t>(value)); }

void put_attribute(std::string& head, const char* name, const char* type, const std::string& value) {
    head.append(name) += '\0';
    head.append(type) += '\0';
    put_little(head, static_cast<std::uint32_t>(value.size()));
    head += value;
}

/// The bytes at even places, then those at odd ones, each minus the one before it, which zlib packs better.
std::string separated(const std::string& plain) {
    std::string bytes(plain.size(), '\0');
    const std::size_t half = plain.size() / 2;  // floats have an even number of bytes
    for (std::size_t i = 0; i < plain.size() / 2; ++i) bytes[i] = plain[2 * i], bytes[half + i] = plain[2 * i + 1];
    for (std::size_t i = bytes.size(); i-- > 1;) bytes[i] = static_cast<char>(bytes[i] - bytes[i - 1] + 128);
    return bytes;
}

class Exr : public Encoder {
  public:
    explicit Exr(const Layout& own_layout) : Encoder(own_layout) {
        std::vector<std::string> names = layout.named.names;
        for (const char* name = layout.channels < 3 ? "YA" : "RGBA"; static_cast<int>(names.size()) < layout.channels;)
            names.emplace_back(1, *name++);
        for (std::size_t i = 0; i < names.size(); ++i) channels[names[i]] = i;
    }

    /// Encodes chunks without the number of their first row; the note is their sizes.
    EncodedBand encode(const std::byte* codes, int rows) const override {
        EncodedBand band;
        for (int first = 0; first < rows; first += chunk_rows) {
            const std::byte* const from = codes + unsigned(first) * layout.row_bytes();
            const std::string plain = planes(from, std::min(chunk_rows, rows - first));
            const std::string bytes = separated(plain);
            uLongf size = ::compressBound(bytes.size());
            std::string packed(size, '\0');
            if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                            reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 4) != Z_OK)
                throw std::bad_alloc();
            packed.resize(size);
            const std::string& chosen = packed.size() < plain.size() ? packed : plain;
            put_little(band.note, static_cast<std::uint32_t>(chosen.size()));
            band.bytes += chosen;
        }
        return band;
    }

    void assemble(const Notes& notes, const BytesOf& bytes_of, const Append& append) const override {
        std::string table = head();
        std::uint64_t place = table.size() + std::size_t((layout.height - 1) / chunk_rows + 1) * 8;
        for (const std::string& note : notes)
            for (std::size_t at = 0; at < note.size(); at += 4)
                put_little(table, place), place += 8 + get_little<std::uint32_t>(note, at);
        append(table);
        std::uint32_t row = 0;
        for (int i = 0; i < bands(); ++i) {
            const std::string bytes = bytes_of(i);
            const std::string& note = notes[unsigned(i)];
            for (std::size_t at = 0, from = 0; at < note.size(); at += 4, row += chunk_rows) {
                const auto size = get_little<std::uint32_t>(note, at);
                std::string start;
                put_little(start, row), put_little(start, size);
                append(start);
                append(std::string_view(bytes).substr(from, size));
                from += size;
            }
        }
    }

  private:
    std::string head() const {
        std::string file("\x76\x2f\x31\x01\x02\0\0\0", 8), list, window, zero, one;
        for (const auto& [name, place] : channels) {
            list.append(name) += '\0';
            for (const std::uint32_t value : {2, 0, 1, 1}) put_little(list, value);  // float; every pixel has one
        }
        for (const int value : {0, 0, layout.width - 1, layout.height - 1})
            put_little(window, static_cast<std::uint32_t>(value));
        put_float(zero, 0), put_float(one, 1);
        put_attribute(file, "channels", "chlist", list + '\0');
        put_attribute(file, "compression", "compression", "\x03");  // ZIP
        put_attribute(file, "dataWindow", "box2i", window);
        put_attribute(file, "displayWindow", "box2i", window);
        put_attribute(file, "lineOrder", "lineOrder", std::string(1, '\0'));  // from the top
        put_attribute(file, "pixelAspectRatio", "float", one);
        put_attribute(file, "screenWindowCenter", "v2f", zero + zero);
        put_attribute(file, "screenWindowWidth", "float", one);
        for (const auto& [name, value] : layout.named.attributes) put_attribute(file, name.c_str(), "string", value);
        return file += '\0';
    }

    /// The values of each row, one channel after the other.
    std::string planes(const std::byte* codes, int rows) const {
        static_assert(std::endian::native == std::endian::little);
        std::string bytes(layout.row_bytes() * unsigned(rows), '\0');
        const std::size_t pixel = unsigned(layout.channels) * sizeof(float);
        char* to = bytes.data();
        for (std::size_t y = 0; y < unsigned(rows); ++y)
            for (const auto& [name, place] : channels) {
                const std::byte* from = codes + y * layout.row_bytes() + place * sizeof(float);
                for (int x = 0; x < layout.width; ++x, to += sizeof(float), from += pixel)
                    std::memcpy(to, from, sizeof(float));
            }
        return bytes;
    }

    std::map<std::string, std::size_t> channels;  // their places in a pixel, by name, as files have them
};

}  // namespace

std::unique_ptr<Encoder> exr_encoder(const Layout& layout) { return std::make_unique<Exr>(layout); }

}  // namespace strahl

// Netpbm's files are a header of words, then the values: in .ppm and .pgm from the top row, the high byte of 16 bits
// first, or as words (P2, P3); in .pfm from the bottom row. A .bmp file has two binary headers, then rows of 4 n bytes,
// blue first.
#include "image/uncompressed.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "image/recognise.h"

namespace strahl {
namespace {

constexpr bool little_endian = std::endian::native == std::endian::little;
constexpr int most_pixels = 1 << 20;  // along a side

/// Describes how a file stores the values of a picture.
struct ValueLayout {
    int channels = 0, width = 0, height = 0, bits = 0;
    int most = 255;  // of whole numbers: what 1 is
    bool bottom_up = false, blue_first = false;
    bool words = false;       // decimals with blanks between them
    bool swapped = false;     // floats: not in the processor's byte order
    std::size_t padding = 0;  // bytes after each row
    std::uint64_t start = 0;  // where the first row begins
};

class HeaderWords {
  public:
    explicit HeaderWords(const RegularFile& own_file) : file(own_file) {}

    [[noreturn]] void fail(const std::string& why) const { fail_reading(file.path(), why); }
    /// Reads the header to its end.
    ValueLayout read() {
        const std::string start = file.bytes(0, BmpHeader::size);
        return start.starts_with("BM") ? bmp(BmpHeader(start)) : netpbm();
    }
    /// Reads the next value of a file of words.
    double value(const ValueLayout& layout) { return double(number(0, layout.most)) / layout.most; }

  private:
    ValueLayout bmp(const BmpHeader& header) const {
        if (header.width < 1 || header.width > most_pixels || header.rows() < 1 || header.rows() > most_pixels)
            fail("its header has impossible sizes: " + std::to_string(header.width) + "x" +
                 std::to_string(header.height) + " pixels");
        if (header.start < BmpHeader::size) fail("its pixels begin inside its header");
        return {.channels = 3,
                .width = header.width,
                .height = static_cast<int>(header.rows()),
                .bits = 8,
                .bottom_up = header.height > 0,
                .blue_first = true,
                .padding = static_cast<std::size_t>(header.width % 4),  // to 4 n bytes
                .start = header.start};
    }
    ValueLayout netpbm() {
        const std::string kind = word();
        const bool floats = kind == "PF" || kind == "Pf";
        const bool words = kind == "P2" || kind == "P3";
        if (!floats && !words && kind != "P5" && kind != "P6") fail("it is not a .ppm, .pgm or .pfm file");
        const bool grey = kind == "P2" || kind == "P5" || kind == "Pf";
        ValueLayout layout{grey ? 1 : 3, number(1, most_pixels), number(1, most_pixels), 32};
        if (floats) {
            const double scale = number(-1., 1.);
            if (std::abs(scale) != 1) fail("its scale is neither 1 nor -1");
            layout.swapped = (scale < 0) != little_endian;
            layout.bottom_up = true;
        } else {
            layout.most = number(1, 65535);
            layout.bits = layout.most < 256 ? 8 : 16;
            layout.words = words;
        }
        layout.start = place;
        return layout;
    }

    /// Reads the next byte; -1 at the end of the file.
    int next() {
        if (place >= begin + part.size()) begin = place, part = file.bytes(place, 4096);
        return part.empty() ? -1 : static_cast<unsigned char>(part[place++ - begin]);
    }
    /// Reads the next word, and one white space after it.
    std::string word() {
        std::string result;
        for (int c; (c = next()) >= 0 && result.size() < 20;) {
            if (c == '#')
                while ((c = next()) >= 0 && c != '\n') continue;
            if (c < 0) break;
            const bool space = c == ' ' || (c >= '\t' && c <= '\r');
            if (!space) result += static_cast<char>(c);
            if (space && !result.empty()) return result;
        }
        if (!result.empty() && result.size() < 20) return result;
        fail("it is cut off");
    }
    template <class Number>
    Number number(Number low, Number high) {
        const std::string text = word();
        Number value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size() || !(value >= low && value <= high))
            fail("it has '" + text + "' where a number is expected");
        return value;
    }

    const RegularFile& file;
    std::uint64_t place = 0, begin = 0;  // of the next byte, and of `part`
    std::string part;
};

double value_of(const char* bytes, const ValueLayout& layout) {
    const auto byte = [&](int i) { return static_cast<unsigned char>(bytes[i]); };
    if (layout.bits == 8) return std::min(byte(0) / double(layout.most), 1.);
    if (layout.bits == 16) return std::min((256 * byte(0) + byte(1)) / double(layout.most), 1.);
    std::uint32_t code;
    std::copy_n(bytes, 4, reinterpret_cast<char*>(&code));
    return std::bit_cast<float>(layout.swapped ? __builtin_bswap32(code) : code);
}

void put(std::string& bytes, double value, int bits) {
    if (bits == 32) {
        const auto number = static_cast<float>(value);
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
        return;
    }
    const long code = std::lround(value * (bits == 8 ? 255 : 65535));
    if (bits == 16) bytes += static_cast<char>(code >> 8);
    bytes += static_cast<char>(code & 255);
}

}  // namespace

bool is_uncompressed(std::string_view bytes) {
    if (bytes.starts_with("BM")) return BmpHeader(bytes).plain();
    return bytes.size() > 1 && bytes[0] == 'P' && std::string_view("2356Ff").find(bytes[1]) != std::string_view::npos;
}

Picture read_uncompressed(const RegularFile& file, std::uint64_t most) {
    if (TargaHeader(file.bytes(0, TargaHeader::size)).valid()) return read_targa(file, most);
    HeaderWords header(file);
    const ValueLayout layout = header.read();
    const auto row = std::size_t(layout.width) * unsigned(layout.channels);
    require_room(file.path(), {unsigned(layout.width), unsigned(layout.height), unsigned(layout.channels), 0}, most);
    Picture picture{layout.width, layout.height, layout.channels, {}, layout.bits};
    picture.values.resize(row * unsigned(layout.height));
    if (layout.words) {
        for (double& own : picture.values) own = header.value(layout);
        return picture;
    }
    const std::size_t size = unsigned(layout.bits) / 8;
    std::string bytes(row * size, '\0');
    for (int y = 0; y < layout.height; ++y) {
        const std::uint64_t at = layout.start + std::uint64_t(y) * (bytes.size() + layout.padding);
        if (file.read(at, bytes.data(), bytes.size()) < bytes.size()) header.fail("it is cut off");
        if (layout.blue_first)
            for (std::size_t i = 0; i < row; i += 3) std::swap(bytes[i], bytes[i + 2]);
        double* const to = &picture.values[row * unsigned(layout.bottom_up ? layout.height - 1 - y : y)];
        for (std::size_t i = 0; i < row; ++i) to[i] = value_of(&bytes[i * size], layout);
    }
    return picture;
}

std::string netpbm_of(const Picture& picture) {
    const bool grey = picture.channels == 1, floats = picture.bits == 32;
    std::string bytes = std::string("P") + (floats ? (grey ? "f" : "F") : (grey ? "5" : "6")) + "\n" +
                        std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n" +
                        (!floats         ? picture.bits == 8 ? "255" : "65535"
                         : little_endian ? "-1.0"
                                         : "1.0") +
                        "\n";
    const auto row = std::size_t(picture.width) * unsigned(picture.channels);
    for (int y = 0; y < picture.height; ++y) {
        const double* const values = &picture.values[row * unsigned(floats ? picture.height - 1 - y : y)];
        for (std::size_t i = 0; i < row; ++i) put(bytes, values[i], picture.bits);
    }
    return bytes;
}

}  // namespace strahl

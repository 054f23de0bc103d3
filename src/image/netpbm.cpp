// A header of words, then the values: of .ppm from the top, the high byte of 16 bits first; of .pfm from the bottom.
#include "image/netpbm.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

#include "image/memory.h"

namespace strahl {
namespace {

constexpr bool little_endian = std::endian::native == std::endian::little;

struct Header {
    int channels = 0, width = 0, height = 0, bits = 0;
    bool swapped = false;  // floats
};

class Reader {
  public:
    explicit Reader(const std::string& own_path) : path(own_path), file(path, std::ios::binary) {}

    [[noreturn]] void fail(const std::string& why) const {
        throw FileError("cannot read '" + path + "' as a picture: " + why);
    }
    /// The next word of the header, and the white space after it.
    std::string word() {
        std::string result;
        for (int c; (c = file.get()) != EOF && result.size() < 20;) {
            if (c == '#')
                while ((c = file.get()) != EOF && c != '\n') continue;
            const bool space = c == ' ' || (c >= '\t' && c <= '\r');
            if (!space) result += static_cast<char>(c);
            if (space && !result.empty()) return result;
        }
        fail("its header is cut off");
    }
    template <class Number>
    Number number(Number low, Number high) {
        const std::string text = word();
        Number value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size() || !(value >= low && value <= high))
            fail("its header has '" + text + "' where a number is expected");
        return value;
    }
    Header header() {
        const std::string kind = word();
        const bool floats = kind == "PF" || kind == "Pf";
        if (!floats && kind != "P5" && kind != "P6") fail("it is no .ppm, .pgm or .pfm file");
        Header head{kind == "P5" || kind == "Pf" ? 1 : 3, number(1, 1 << 20), number(1, 1 << 20), 32};
        if (floats) {
            const double scale = number(-1., 1.);
            if (std::abs(scale) != 1) fail("its scale is neither 1 nor -1");
            head.swapped = (scale < 0) != little_endian;
        } else {
            const int most = number(1, 65535);
            if (most != 255 && most != 65535) fail("its largest value is neither 255 nor 65535");
            head.bits = most == 255 ? 8 : 16;
        }
        return head;
    }
    void read(std::string& bytes) {
        if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) fail("it is cut off");
    }

  private:
    const std::string& path;
    std::ifstream file;
};

double value_of(const char* bytes, const Header& head) {
    const auto byte = [&](int i) { return static_cast<unsigned char>(bytes[i]); };
    if (head.bits == 8) return byte(0) / 255.;
    if (head.bits == 16) return (256 * byte(0) + byte(1)) / 65535.;
    std::uint32_t code;
    std::memcpy(&code, bytes, 4);
    return std::bit_cast<float>(head.swapped ? __builtin_bswap32(code) : code);
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

bool is_netpbm(std::string_view bytes) {
    return bytes.starts_with("P5") || bytes.starts_with("P6") || bytes.starts_with("PF") || bytes.starts_with("Pf");
}

Picture read_netpbm(const std::string& path, std::uint64_t most) {
    Reader reader(path);
    const Header head = reader.header();
    const auto row = std::size_t(head.width) * unsigned(head.channels);
    const std::uint64_t values = std::uint64_t(row) * unsigned(head.height);
    if (values > most || 8. * double(values) > available_memory())
        reader.fail("it has " + std::to_string(head.width) + "x" + std::to_string(head.height) +
                    " pixels, which are too many for the file or the memory");
    Picture picture{head.width, head.height, head.channels, {}, head.bits};
    picture.values.resize(values);
    const std::size_t size = unsigned(head.bits) / 8;
    std::string bytes(row * size, '\0');
    for (int y = 0; y < head.height; ++y) {
        reader.read(bytes);
        double* const values = &picture.values[row * unsigned(head.bits == 32 ? head.height - 1 - y : y)];
        for (std::size_t i = 0; i < row; ++i) values[i] = value_of(&bytes[i * size], head);
    }
    return picture;
}

std::string netpbm_of(const Picture& picture) {
    const bool grey = picture.channels == 1, floats = picture.bits == 32;
    std::string bytes = std::string("P") + (floats ? (grey ? "f" : "F") : (grey ? "5" : "6")) + "\n" +
                        std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n" +
                        (!floats ? picture.bits == 8 ? "255" : "65535" : little_endian ? "-1.0" : "1.0") + "\n";
    const auto row = std::size_t(picture.width) * unsigned(picture.channels);
    for (int y = 0; y < picture.height; ++y) {
        const double* const values = &picture.values[row * unsigned(floats ? picture.height - 1 - y : y)];
        for (std::size_t i = 0; i < row; ++i) put(bytes, values[i], picture.bits);
    }
    return bytes;
}

}  // namespace strahl

// Mutations of picture files: bytes, lengths and pieces, with the check sums put right again, or no reader would look
// further.
#include "tests/attack/mutated_picture.h"

#include <algorithm>
#include <array>

#include "image/picture.h"
#include "tests/attack/mutator.h"
#include "tests/unit/image/exr_bytes.h"
#include "tests/unit/image/other_pictures.h"
#include "tests/unit/scratch.h"

namespace strahl {
namespace {

const std::string png_start = "\x89PNG\r\n\x1a\n";

std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    return bytes;
}

std::uint32_t crc(const char* bytes, std::size_t count) {
    std::uint32_t sum = ~std::uint32_t(0);
    for (std::size_t i = 0; i < count; ++i) {
        sum ^= static_cast<unsigned char>(bytes[i]);
        for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320 : 0);
    }
    return ~sum;
}
std::string chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(crc(body.data(), body.size()));
}

/// Zlib's format without compression, of fewer than 65536 bytes.
std::string stored(const std::string& data) {
    std::uint32_t a = 1, b = 0;
    for (const char c : data) a = (a + static_cast<unsigned char>(c)) % 65521, b = (b + a) % 65521;
    const auto size = static_cast<std::uint16_t>(data.size());
    return "\x78\x01\x01" + little_endian(size, static_cast<std::uint16_t>(~size)) + data + big_endian(b << 16 | a);
}
/// A .png file of black pixels.
std::string png(int size, char bits, char color, char interlaced) {
    const int channels = color == 2 ? 3 : color == 6 ? 4 : color == 4 ? 2 : 1;
    std::string data;
    const auto rows = [&](int width, int height) {
        data += std::string(std::size_t(height) * (1 + (std::size_t(width) * channels * bits + 7) / 8), '\0');
    };
    constexpr int x0[]{0, 4, 0, 2, 0, 1, 0}, y0[]{0, 0, 4, 0, 2, 0, 1}, dx[]{8, 8, 4, 4, 2, 2, 1},
        dy[]{8, 8, 8, 4, 4, 2, 2};
    for (int i = 0; interlaced && i < 7; ++i)
        if (size > x0[i] && size > y0[i]) rows((size - x0[i] + dx[i] - 1) / dx[i], (size - y0[i] + dy[i] - 1) / dy[i]);
    if (!interlaced) rows(size, size);
    const std::string header = big_endian(size) + big_endian(size) + std::string{bits, color, 0, 0, interlaced};
    return png_start + chunk("IHDR", header) + (color == 3 ? chunk("PLTE", std::string(3 << bits, '\x40')) : "") +
           chunk("tRNS", std::string(color == 3 ? 2 : 6, '\1')) + chunk("IDAT", stored(data)) + chunk("IEND", "");
}

/// A .bmp of 8x8 pixels with a palette, and run lengths if `compression` is 1 (of 8 bits) or 2 (of 4).
std::string bmp(std::uint16_t bits, std::int32_t compression) {
    std::string pixels;
    for (int row = 0; row < 8; ++row)
        pixels += compression ? std::string("\x08\x01\0", 3) + (row < 7 ? '\0' : '\1')
                              : std::string(std::max<std::size_t>(4, bits), '\1');
    const std::string palette(std::size_t(4) << bits, '\x40');
    const auto start = static_cast<std::int32_t>(54 + palette.size());
    return "BM" +
           little_endian(std::int32_t(start + pixels.size()), 0, start, 40, 8, 8, std::uint16_t(1), bits, compression,
                         std::int32_t(pixels.size()), 0, 0, 1 << bits, 0) +
           palette + pixels;
}

class PictureMutator : Mutator {
  public:
    using Mutator::Mutator;

    std::string picture() {
        file = any();
        for (int i = dice.upto(5); i >= 0; --i) change();
        if (file.starts_with(png_start) && dice.chance(.9)) repair_chunks();
        return file;
    }

  private:
    /// Headers are at the start.
    std::size_t place() { return below(dice.chance(.7) ? std::min<std::size_t>(file.size(), 400) : file.size()); }

    void change();
    void put_number();
    void put_compression();
    void repair_chunks();
};

void PictureMutator::put_number() {
    constexpr std::array<std::uint32_t, 18> numbers{0,     1,      2,          3,          7,          8,
                                                    16,    255,    256,        4096,       32767,      65535,
                                                    65536, 100000, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};
    const std::uint32_t number = numbers[below(numbers.size())];
    const std::string bytes = dice.chance(.5) ? little_endian(number) : big_endian(number);
    file.replace(std::min(place(), file.size()), bytes.size(), bytes);
}

/// Gives the header of an .exr another way of packing.
void PictureMutator::put_compression() {
    const std::string name("compression\0compression\0\1\0\0\0", 28);
    if (const std::size_t found = file.find(name); found != file.npos && found + name.size() < file.size())
        file[found + name.size()] = static_cast<char>(dice.upto(10));
}

void PictureMutator::change() {
    if (file.empty()) return;
    const std::size_t at = place(), length = below(dice.chance(.8) ? 16 : file.size());
    const int kind = dice.upto(9);
    if (kind < overwrite)
        change_bytes(static_cast<Change>(kind), at, length, [&] { return place(); });
    else if (kind == overwrite)
        put_compression();
    else if (kind <= overwrite + 2)
        put_number();
    else
        change_bytes(overwrite, at, length, [&] { return place(); });
}

void PictureMutator::repair_chunks() {
    for (std::size_t at = png_start.size(); at + 12 <= file.size();) {
        std::size_t length = 0;
        for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(file[at + i]);
        if (length > file.size() - at - 12) return;
        file.replace(at + 8 + length, 4, big_endian(crc(&file[at + 4], length + 4)));
        at += 12 + length;
    }
}

}  // namespace

std::vector<std::string> valid_pictures() {
    const Scratch folder;
    std::vector<std::string> files;
    Dice dice(1);
    const auto add = [&](const char* ending, int bits, int width, int height, int channels) {
        Picture picture{width, height, channels, std::vector<double>(std::size_t(width) * height * channels), 32};
        for (double& value : picture.values) value = dice.in(0, 1);
        write_picture(picture, folder / ending, {.bits = bits});
        files.push_back(bytes_of(folder / ending));
    };
    for (const auto& [width, height] : {std::pair<std::uint16_t, std::uint16_t>{1, 1}, {7, 5}, {33, 17}}) {
        for (const int channels : {1, 3}) files.push_back(jpeg(width, height, channels));
        files.push_back(gif(width, height));
        add("a.bmp", 8, width, height, 3);
        for (const int channels : {1, 2, 3, 4}) {
            for (const int bits : {8, 16}) add("a.png", bits, width, height, channels);
            add("a.exr", 32, width, height, channels);
        }
    }
    for (const char interlaced : {'\0', '\1'})
        for (const char bits : {'\1', '\2', '\4', '\10'}) {
            files.push_back(png(9, bits, 3, interlaced));
            files.push_back(png(9, bits, 0, interlaced));
        }
    files.push_back(png(9, 16, 2, 1));
    for (const std::uint16_t bits : {1, 4, 8}) files.push_back(bmp(bits, 0));
    files.push_back(targa(2, 32, 32, std::string(16, '\7')));
    files.push_back(targa(9, 8, 0, "\x81\1\1\2\3", std::string(12, '\7'), 24));
    files.push_back(bmp(8, 1));
    files.push_back(bmp(4, 2));
    files.push_back(tiled_exr(4, 4, 4, '\0') + little_endian(0, 0, 0, 0, 192) + std::string(192, '\x3c'));
    return files;
}

std::string mutated_picture(const std::vector<std::string>& valid, std::uint64_t number) {
    return PictureMutator(valid, number).picture();
}

}  // namespace strahl

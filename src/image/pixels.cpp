#include "image/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "files/bytes.h"
#include "files/regular_file.h"
#include "image/picture.h"
#include "num/decimal.h"

namespace strahl {

namespace {

/// Returns the gamma by which a .png file says that its values are encoded, 0 for sRGB (W3C, "Portable Network
/// Graphics", 11.3.2).
std::optional<double> png_gamma(const RegularFile& file) {
    std::optional<double> gamma;
    if (!file.bytes(0, 8).starts_with("\x89PNG")) return gamma;
    for (std::uint64_t at = 8; at + 8 <= file.size();) {
        const std::string head = file.bytes(at, 12);
        const std::string type = head.size() < 12 ? "IEND" : head.substr(4, 4);
        if (type == "IDAT" || type == "IEND") break;
        if (type == "sRGB") return 0;
        const auto code = get_big<std::uint32_t>(head, 8);
        if (type == "gAMA" && code >= 10'000 && code <= 1'000'000) gamma = 1e5 / code;
        at += 12 + std::uint64_t(get_big<std::uint32_t>(head, 0));
    }
    return gamma;
}

/// Returns the colours of a .png or .gif file whose pixels are numbers of them (PNG, 11.2.3; CompuServe, "Graphics
/// Interchange Format 89a", 19), and none of other files.
std::vector<std::array<int, 3>> palette_of(const RegularFile& file) {
    const std::string head = file.bytes(0, 26);
    std::string bytes;
    if (head.starts_with("GIF8") && head.size() == 26 && head[10] & 0x80) {
        bytes = file.bytes(13, std::size_t(6) << (head[10] & 7));
    } else if (head.starts_with("\x89PNG") && head.size() == 26 && head[25] == 3) {
        for (std::uint64_t at = 8; bytes.empty() && at + 8 <= file.size();) {
            const std::string chunk = file.bytes(at, 8);
            const auto size = get_big<std::uint32_t>(chunk, 0);
            if (chunk.ends_with("PLTE")) bytes = file.bytes(at + 8, std::min<std::uint32_t>(size, 3 * 256));
            at += 12 + std::uint64_t(size);
        }
    }
    std::vector<std::array<int, 3>> colors;
    for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t c) { return int(static_cast<unsigned char>(bytes[i + c])); };
        colors.push_back({byte(0), byte(1), byte(2)});
    }
    return colors;
}

}  // namespace

FilePixels read_pixels(const std::string& path) {
    const auto fail = [&](const std::string& why) { throw FileError("cannot use '" + path + "': " + why); };
    constexpr std::uint64_t most_values = std::uint64_t(1) << 27;
    constexpr double largest_value = 1e9;  // as for colours in scene text
    constexpr int most_pixels = 1 << 15;   // along a side: of a float's 24 bits 9 are left for places between pixels
    const Picture picture = read_picture(path, most_values);
    const std::string size = std::to_string(picture.width) + "x" + std::to_string(picture.height);
    if (std::max(picture.width, picture.height) > most_pixels)
        fail("it has " + size + " pixels; each side may have at most " + std::to_string(most_pixels));
    if (picture.channels > 4)
        fail("it has " + std::to_string(picture.channels) + " channels; a picture of colours has at most 4");
    const bool grey = picture.channels < 3, alpha = picture.channels % 2 == 0;
    FilePixels pixels(Pixels{picture.width, picture.height, picture.bits == 32, {}});
    const RegularFile file(path);
    pixels.gamma = png_gamma(file), pixels.from_right = picture.from_right;
    pixels.grey_png = picture.channels == 1 && picture.bits <= 8 && file.bytes(0, 8).starts_with("\x89PNG");
    pixels.more_bits = picture.bits > 8, pixels.palette = palette_of(file);
    const auto count = std::size_t(picture.width) * static_cast<unsigned>(picture.height);
    pixels.values.reserve(3 * count);
    double lowest = 0;
    std::string lowest_at;
    for (std::size_t i = 0; i < count; ++i) {
        const double* const own = &picture.values[i * static_cast<unsigned>(picture.channels)];
        const auto at = [&] {
            return " at column " + std::to_string(i % unsigned(picture.width)) + ", row " +
                   std::to_string(i / unsigned(picture.width));
        };
        if (alpha) {
            const double opacity = own[picture.channels - 1];
            if (opacity != 1 && pixels.opacity.empty()) pixels.opacity.assign(i, 1);
            if (opacity != 1 || !pixels.opacity.empty())
                pixels.opacity.push_back(static_cast<float>(opacity >= 0 ? std::min(opacity, 1.) : 0));
        }
        for (int c = 0; c < 3; ++c) {
            const double value = own[grey ? 0 : c];
            if (!(std::abs(value) <= largest_value))
                fail("it has the value " + text_of(value) + at() + "; colours are from 0 to 1e9");
            if (value < lowest) lowest = value, lowest_at = at();
            pixels.values.push_back(static_cast<float>(std::max(value, 0.)));
            pixels.largest[c] = std::max(pixels.largest[c], double(pixels.values.back()));
        }
    }
    // The filters of other programs leave small negative values beside bright places.
    const Color& largest = pixels.largest;
    if (-lowest > .1 * std::max({largest.x, largest.y, largest.z}))
        fail("it has the value " + text_of(lowest) + lowest_at +
             "; colours are from 0 to 1e9, and negative values count as 0 up to a tenth of the largest value only");
    return pixels;
}

}  // namespace strahl

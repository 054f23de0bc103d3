// Makes small .jpg, .gif and .tga files, which Strahl reads and does not write.
#pragma once
#include <cstdint>
#include <string>

#include "tests/unit/image/exr_bytes.h"

namespace strahl {

inline std::string big_endian(std::uint16_t value) { return {static_cast<char>(value >> 8), static_cast<char>(value)}; }

/// Returns a baseline .jpg file (ISO 10918-1) of 1 or 3 channels, whose blocks of 8 x 8 pixels are alternately dark and
/// bright: their means alone differ, by one code of the two that there are.
inline std::string jpeg(std::uint16_t width, std::uint16_t height, int channels) {
    const auto segment = [](char marker, const std::string& data) {
        return std::string{'\xff', marker} + big_endian(static_cast<std::uint16_t>(data.size() + 2)) + data;
    };
    std::string frame = '\x08' + big_endian(height) + big_endian(width) + static_cast<char>(channels);
    std::string scan(1, static_cast<char>(channels));
    for (char channel = 1; channel <= channels; ++channel) {
        frame += {channel, '\x11', '\0'};
        scan += {channel, '\0'};
    }
    std::string bits;
    for (int block = (width + 7) / 8 * ((height + 7) / 8); block > 0; --block)
        for (int channel = 0; channel < channels; ++channel)
            // A difference of 5 bits, those of negative ones being inverted, and the end of the block.
            bits += channel > 0 ? "000" : block % 2 ? "01111110" : "01000000";
    bits.append((8 - bits.size() % 8) % 8, '1');
    std::string data;
    for (std::size_t i = 0; i < bits.size(); i += 8) {
        data += static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2));
        if (data.back() == '\xff') data += '\0';
    }
    const std::string means("\0\0\2\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\5", 19);   // two codes of 2 bits: 0 and 5 bits follow
    const std::string others("\x10\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 18);  // one code of a bit: the end
    return "\xff\xd8" + segment('\xdb', '\0' + std::string(64, '\x10')) + segment('\xc0', frame) +
           segment('\xc4', means) + segment('\xc4', others) + segment('\xda', scan + std::string("\0\x3f\0", 3)) +
           data + "\xff\xd9";
}

/// Returns a .gif file of grey pixels, whose values are their numbers in the file modulo 256.
inline std::string gif(std::uint16_t width, std::uint16_t height) {
    std::string bytes = "GIF89a" + little_endian(width, height) + std::string("\xf7\0\0", 3);
    for (int grey = 0; grey < 256; ++grey) bytes.append(3, static_cast<char>(grey));
    bytes += ',' + little_endian(std::uint16_t(0), std::uint16_t(0), width, height) + std::string("\0\x08", 2);
    std::string data;
    unsigned bits = 0, count = 0;
    const auto put = [&](unsigned code) {  // of 9 bits, which suffice because the table is cleared before it is full
        for (bits |= code << count, count += 9; count >= 8; count -= 8, bits >>= 8) data += static_cast<char>(bits);
    };
    for (unsigned i = 0; i < unsigned(width) * height; ++i) {
        if (i % 250 == 0) put(256);
        put(i % 256);
    }
    put(257);
    data += static_cast<char>(bits);
    for (std::size_t i = 0; i < data.size(); i += 255) {
        const std::string block = data.substr(i, 255);
        bytes += static_cast<char>(block.size()) + block;
    }
    return bytes + std::string("\0;", 2);
}

/// Returns a .tga file of 4 pixels in a row, from the top row if `flags` has 32; `palette` holds colours of so many
/// bits.
inline std::string targa(char type, char bits, char flags, const std::string& data, const std::string& palette = "",
                         char palette_bits = 0) {
    const auto colors = static_cast<std::uint16_t>(palette_bits ? palette.size() / std::size_t(palette_bits / 8) : 0);
    return std::string{'\0', palette.empty() ? '\0' : '\1', type, '\0', '\0'} + little_endian(colors) + palette_bits +
           little_endian(std::uint16_t(0), std::uint16_t(0), std::uint16_t(4), std::uint16_t(1)) +
           std::string{bits, flags} + palette + data;
}

}  // namespace strahl

// Bytes of files in little-endian order, and of .exr files that Strahl does not write.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strahl {

template <class... Values>
std::string little_endian(Values... values) {
    std::string bytes;
    ((bytes += std::string(reinterpret_cast<const char*>(&values), sizeof values)), ...);
    return bytes;
}

/// A channel of an .exr file: its type is 0 for whole numbers, 1 for half floats and 2 for floats; its values are bits.
struct ExrChannel {
    const char* name;
    int type;
    std::vector<std::uint32_t> values;
};

/// Returns an .exr file of one row without compression. The format wants channels in the order of their names.
inline std::string exr_of_channels(const std::vector<ExrChannel>& channels) {
    const int width = static_cast<int>(channels.at(0).values.size());
    std::string bytes = little_endian(20000630, 2);
    const auto add = [&](const char* name, const char* type, const std::string& value) {
        bytes += std::string(name) + '\0' + type + '\0' + little_endian(int(value.size())) + value;
    };
    std::string names, row;
    for (const ExrChannel& channel : channels) {
        names += std::string(channel.name) + '\0' + little_endian(channel.type, 0, 1, 1);
        for (const std::uint32_t value : channel.values)
            row += channel.type == 1 ? little_endian(static_cast<std::uint16_t>(value)) : little_endian(value);
    }
    add("channels", "chlist", names + '\0');
    add("compression", "compression", std::string(1, '\0'));
    for (const char* window : {"dataWindow", "displayWindow"}) add(window, "box2i", little_endian(0, 0, width - 1, 0));
    add("lineOrder", "lineOrder", std::string(1, '\0'));
    add("pixelAspectRatio", "float", little_endian(1.f));
    add("screenWindowCenter", "v2f", little_endian(0.f, 0.f));
    add("screenWindowWidth", "float", little_endian(1.f));
    bytes += '\0';
    return bytes + little_endian(std::uint64_t(bytes.size() + 8)) + little_endian(0, int(row.size())) + row;
}

/// Returns a tiled .exr file of three float channels, which ends after the place of its first tile.
inline std::string tiled_exr(int width, int height, int tile, char compression) {
    std::string bytes = little_endian(20000630, 2 | 0x200);
    const auto add = [&](const char* name, const char* type, const std::string& value) {
        bytes += std::string(name) + '\0' + type + '\0' + little_endian(int(value.size())) + value;
    };
    std::string channels;
    for (const char* channel : {"B", "G", "R"}) channels += std::string(channel) + '\0' + little_endian(2, 0, 1, 1);
    add("channels", "chlist", channels + '\0');
    add("compression", "compression", std::string(1, compression));
    for (const char* window : {"dataWindow", "displayWindow"})
        add(window, "box2i", little_endian(0, 0, width - 1, height - 1));
    add("lineOrder", "lineOrder", std::string(1, '\0'));
    add("pixelAspectRatio", "float", little_endian(1.f));
    add("screenWindowCenter", "v2f", little_endian(0.f, 0.f));
    add("screenWindowWidth", "float", little_endian(1.f));
    add("tiles", "tiledesc", little_endian(tile, tile) + '\0');
    bytes += '\0';
    return bytes + little_endian(std::uint64_t(bytes.size() + 8));
}

}  // namespace strahl

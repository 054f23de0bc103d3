// Finds out which format a picture file has, whether its header can be true before a library opens it, and whether
// there is room for the picture.
#pragma once
#include <cstdint>
#include <string>

#include "files/os/memory.h"
#include "files/regular_file.h"
#include "image/picture.h"

namespace strahl {

struct PictureFormat {
    std::uint64_t most;                                                      // values that a file of this size can hold
    Picture (*read)(const RegularFile& file, std::uint64_t most) = nullptr;  // null: OpenImageIO reads it
    const char* library_name = nullptr;                                      // as OpenImageIO calls it
};

/// Recognises .bmp, .png, .exr, .jpg, .gif, .tga, .ppm, .pgm and .pfm files, whatever their names end in, and no
/// others: OpenImageIO has readers that forged files bring down. Throws FileError.
PictureFormat recognised(const RegularFile& file);

[[noreturn]] inline void fail_reading(const std::string& path, const std::string& why) {
    throw FileError("cannot read '" + path + "' as a picture: " + why);
}

struct DecodedSize {
    std::uint64_t width, height;  // below 2^32
    unsigned channels;
    std::size_t bytes;  // of a value as a library decodes it, before it becomes a double
};

/// Returns "" if a picture of this size has at most `most` values and fits into `memory`, in bytes, else what is wrong.
inline std::string size_fault(const DecodedSize& size, std::uint64_t most, double memory) {
    const std::string name = std::to_string(size.width) + "x" + std::to_string(size.height) + " pixels";
    if (size.width * size.height > most / size.channels)
        return "its " + name + " are more than are read or than fit into such a file";
    const double needed = double(size.width * size.height) * size.channels * double(sizeof(double) + size.bytes);
    return needed > memory ? "there is not enough memory for its " + name : "";
}

/// Throws FileError if the picture in a file is too large so.
inline void require_room(const std::string& path, const DecodedSize& size, std::uint64_t most) {
    if (const std::string fault = size_fault(size, most, os::available_memory()); !fault.empty())
        fail_reading(path, fault);
}

}  // namespace strahl

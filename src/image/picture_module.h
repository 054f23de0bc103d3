// What the plain part and the module that holds OpenImageIO say to each other.
#pragma once
#include <cstdint>
#include <string>

#include "image/picture.h"

namespace strahl {

/// A file to read, and what of it may be allocated.
struct Wanted {
    const std::string& path;
    const char* format;  // "bmp", "png" or "openexr"
    std::uint64_t most_values;
    double memory;  // in bytes
};

}  // namespace strahl

extern "C" {
/// The picture in a file, or false and the reason. Never throws.
[[gnu::visibility("default")]] bool strahl_decode_picture(const strahl::Wanted& wanted, strahl::Picture& picture,
                                                          std::string& reason);
}

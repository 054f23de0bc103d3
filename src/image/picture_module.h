// The interface of the module that holds OpenImageIO.
#pragma once
#include <cstdint>
#include <string>

#include "image/picture.h"

namespace strahl {

/// A file to read, and how much may be allocated for it.
struct Wanted {
    const std::string& path;
    const char* format;  // "bmp", "openexr" or "gif"
    std::uint64_t most_values;
    double memory;  // in bytes
};

}  // namespace strahl

extern "C" {
/// Reads the picture in a file, or returns false and the reason. Never throws.
[[gnu::visibility("default")]] bool strahl_decode_picture(const strahl::Wanted& wanted, strahl::Picture& picture,
                                                          std::string& reason);
/// Makes the picture of a text, see text_picture(), or returns false and the reason. Never throws.
[[gnu::visibility("default")]] bool strahl_draw_text(const std::string& text, int size, strahl::Picture& picture,
                                                     std::string& reason);
}

// Finds out which format a picture file has, and whether its header can be true, before a library opens it.
#pragma once
#include <cstdint>

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

}  // namespace strahl

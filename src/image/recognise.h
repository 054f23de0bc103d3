// What a picture file is, and whether its header can be believed, before a library opens it.
#pragma once
#include <cstdint>
#include <string>

#include "scene/error.h"

namespace strahl {

struct Recognised {
    const char* format;      // as OpenImageIO calls it, or "netpbm"
    std::uint64_t most = 0;  // values that a file of this many bytes can hold
};

/// Only .bmp, .png and .exr, and .ppm, .pgm and .pfm, whatever the ending says: OpenImageIO has readers that forged
/// files bring down. And no
/// devices or pipes, which need have no end. Throws FileError.
Recognised recognised(const std::string& path);

}  // namespace strahl

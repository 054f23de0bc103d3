// Reads .png files by libpng and .jpg files by libjpeg-turbo.
#pragma once
#include <cstdint>

#include "files/regular_file.h"
#include "image/picture.h"

namespace strahl {

/// Read a picture; throw FileError, also if it has more than `most` values.
Picture read_png(const RegularFile& file, std::uint64_t most);
Picture read_jpeg(const RegularFile& file, std::uint64_t most);

}  // namespace strahl

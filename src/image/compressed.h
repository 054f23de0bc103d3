// Reads .png files by libpng and .jpg files by libjpeg-turbo.
#pragma once
#include <cstdint>
#include <string>

#include "files/regular_file.h"
#include "image/picture.h"

namespace strahl {

/// Returns why a picture of this size is not read, or "": it has more than `most` values, or needs more memory than
/// there is. `bytes` are those of a value in the file's own type.
std::string size_fault(std::uint64_t width, std::uint64_t height, unsigned channels, std::uint64_t most,
                       std::size_t bytes);

/// Read a picture; throw FileError, also if it has more than `most` values.
Picture read_png(const RegularFile& file, std::uint64_t most);
Picture read_jpeg(const RegularFile& file, std::uint64_t most);

}  // namespace strahl

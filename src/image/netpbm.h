// Pictures without compression, which need no library: .ppm and .pgm with 8 or 16 bits, .pfm with floats
// (netpbm.sourceforge.net/doc).
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "image/picture.h"

namespace strahl {

/// Do they begin such a file?
bool is_netpbm(std::string_view bytes);

/// Throws FileError, also if the picture has more than `most` values.
Picture read_netpbm(const std::string& path, std::uint64_t most);

/// The file of a picture with 1 or 3 channels: of 8 or 16 bits, or of floats.
std::string netpbm_of(const Picture& picture);

}  // namespace strahl

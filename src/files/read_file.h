// Reads whole files.
#pragma once
#include <cstddef>
#include <string>

namespace strahl {

/// Reads a whole file, or standard input for "-". Throws FileError if it cannot be read or has more than `limit` bytes.
std::string read_text(const std::string& path, std::size_t limit = std::size_t(1) << 30);

}  // namespace strahl

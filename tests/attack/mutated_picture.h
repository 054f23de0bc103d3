// Picture files with something wrong, each determined by its number.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strahl {

/// Valid .bmp, .png and .exr files of several types: written by Strahl, and some that it does not write.
std::vector<std::string> valid_pictures();

/// Returns one of these files, changed in a few places.
std::string mutated_picture(const std::vector<std::string>& valid, std::uint64_t number);

}  // namespace strahl

// Mesh files that are wrong somewhere.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strahl {

/// Files of all forms that can be read.
std::vector<std::string> valid_meshes();

/// Returns one of these files with a few mutations; the same for the same number.
std::string mutated_mesh(const std::vector<std::string>& valid, std::uint64_t number);

}  // namespace strahl

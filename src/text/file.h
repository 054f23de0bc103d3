// Whole files out, never half of one: every file that the program writes goes through here.
#pragma once
#include <string>
#include <string_view>

#include "scene/error.h"

namespace strahl {

/// Makes `bytes` the content of the file `path`; "-" is standard output. A temporary file in the same folder is
/// renamed over `path` at the end, so that an older file stays as it was until then and if anything fails. Symbolic
/// links stay links, an existing file keeps its permissions, and devices and pipes are written to directly.
/// Throws OutputError.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace strahl

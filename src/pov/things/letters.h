// Letters of TrueType fonts as outlines.
#pragma once
#include <string>
#include <vector>

#include "pov/things/outlines.h"

namespace strahl::pov {

/// Returns the outlines of each letter of a line, in UTF-8. The first one begins at x = 0, all stand on y = 0, and the
/// font's em is 1. They follow each other as in POV-Ray: by their widths, and by the font's table `kern`. Throws
/// FileError if the font cannot be read.
std::vector<std::vector<Outline>> letters_of(const std::string& font, const std::string& line);

}  // namespace strahl::pov

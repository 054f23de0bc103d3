// Letters of TrueType fonts as plane figures.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "scene/kinds/contours.h"

namespace strahl::pov {

/// A letter, and by how much it is moved to the right. Equal letters share their contours.
struct Letter {
    std::shared_ptr<const ContourData> contours;
    double x;
};

/// Returns the letters of a line, in UTF-8 or else in ASCII. The first one begins at x = 0, all stand on y = 0, and the
/// font's em is 1. They follow each other as in POV-Ray: by their widths, and by the font's table `kern`. Throws
/// FileError if the font cannot be read.
std::vector<Letter> letters_of(const std::string& font, const std::string& line, bool utf8 = false);

}  // namespace strahl::pov

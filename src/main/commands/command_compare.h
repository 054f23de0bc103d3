// strahl compare: reports how much two pictures differ, and where.
#pragma once
#include <string>

namespace strahl {

struct CompareOptions {
    std::string a, b;      // files that read_picture() takes
    std::string heatmap;   // where to write the map of differences (.bmp .png .exr), or empty
    double tolerance = 0;  // 0 or more; the largest difference that counts as equal
};

/// Prints the figures to standard output. Returns 0 if all differences are within the tolerance, else 1. Throws
/// FileError.
int compare_command(const CompareOptions& options);

}  // namespace strahl

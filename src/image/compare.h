// Compares two pictures: figures, a heat map, and pictures side by side.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "image/picture.h"

namespace strahl {

/// Figures of |a - b| over all channels of all pixels. NaN equals NaN; NaN and a number differ infinitely.
struct PictureDifference {
    std::size_t pixels = 0;
    double max = 0, mean = 0, rms = 0;
    double psnr = 0;                // decibels below 1, the brightest a screen shows; infinite if equal
    double share_beyond_8bit = 0;   // of the pixels with a channel that differs by more than 1/255
    double share_beyond = 0;        // of the pixels with a channel that differs by more than the tolerance
    int x = 0, y = 0, channel = 0;  // of the first largest difference
    double value_a = 0, value_b = 0;
};

/// Compares two pictures. An alpha channel (the 2nd of 2, the 4th of 4) counts only if both have it. Throws FileError
/// if the sizes or the other channels do not match.
PictureDifference compare(const Picture& a, const Picture& b, double tolerance);

/// The figures as a few lines of text.
std::string report(const PictureDifference& difference, double tolerance);

/// Each pixel's largest difference as a colour: black where equal, then from blue through red and yellow to white on a
/// logarithmic scale from 1/65535 to 1. The values are not linear light but meant for the screen. Throws as compare
/// does.
Picture heatmap(const Picture& a, const Picture& b);

/// All pictures in a row with `gap` grey pixels between them, aligned at the top, as red, green and blue.
Picture beside(const std::vector<Picture>& pictures, int gap);

}  // namespace strahl

// Option values: sizes, crops, frame ranges, numbered files.
#pragma once
#include <string>
#include <string_view>

#include "trace/tracer.h"

namespace strahl {

struct Size {
    int width = 640, height = 480;
};
/// Part `part` of `parts`, counted from 1.
struct Share {
    int part = 1, parts = 1;
};
struct FrameRange {
    int first = 0, last = 0;
};

/// "640x480". Sides are 1 to 1000000. These functions throw UsageError with an example of a valid value.
Size parse_size(std::string_view text);
/// "X,Y,W,H": a part of the whole picture. `require_within` checks that it lies in the picture.
Lattice parse_crop(std::string_view text);
/// "1", one ray through each pixel's middle, "4x4", a grid of 16, or "4x4+1", that and one through the middle.
Sampling parse_samples(std::string_view text);
/// "3/16".
Share parse_share(std::string_view text);
/// "A-B", or "A" for one frame: 0 <= A <= B < 10^9.
FrameRange parse_frames(std::string_view text);

/// Throws UsageError unless all of `crop` lies in the picture.
void require_within(const Lattice& crop, Size picture);

/// The file of a frame: `path` with its "%d", "%4d" or "%04d" replaced by the number (padded with zeros), or, if it has
/// none, with "-0042" inserted before the ending.
std::string numbered(const std::string& path, int frame);

/// The file of a share of one picture: "a.png.part-3-of-16".
std::string part_path(const std::string& path, Share share);

/// `path` with `insertion` inserted before its ending.
std::string before_ending(const std::string& path, std::string_view insertion);

/// A number of bytes for messages: "1.5 GB".
std::string bytes_in_words(double bytes);

}  // namespace strahl

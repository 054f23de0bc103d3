// Option values: sizes, crops, frame ranges, numbered files.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "image/frame_rate.h"
#include "scene/layers.h"
#include "scene/picture_size.h"
#include "trace/cells/pixel_sampling.h"
#include "trace/world/view.h"

namespace strahl {

/// Part `part` of `parts`, counted from 1.
struct Share {
    int part = 1, parts = 1;
};
/// Every `step`-th frame from the first on, to the last at most.
struct FrameRange {
    int first = 0, last = 0, step = 1;
    bool has(int frame) const { return frame >= first && frame <= last && (frame - first) % step == 0; }
};
/// Frames in their order. A frame that is in several ranges counts in the first of them.
struct FrameList {
    std::vector<FrameRange> ranges;
    bool has(int frame) const;
    int first() const { return ranges[0].first; }
    int last() const { return ranges.back().last; }
    /// Calls visit(frame) until that returns false; returns whether it never did.
    bool each(const std::function<bool(int)>& visit) const;
};

/// "640x480". Sides are 1 to 1000000. These functions throw UsageError with an example of a valid value.
PictureSize parse_size(std::string_view text);
/// "X,Y,W,H": a part of the whole picture. `require_within` checks that it lies in the picture.
Lattice parse_crop(std::string_view text);
/// "1", one ray through each pixel's middle, "4x4", a grid of 16, or "4x4+1", that and one through the middle.
Sampling parse_samples(std::string_view text);
/// "3/16".
Share parse_share(std::string_view text);
/// "1-100", "1-3,5,7-20:2" (every second one) or "1-100x2" (the same): 0 <= A <= B < 10^9.
FrameList parse_frames(std::string_view text);

/// "depth,normal": the layers of these names.
Layers parse_layers(std::string_view text);

/// "25", "59.94", "24000/1001" or "24000:1001": frames in each second, from 0.001 to 1000000. Decimals that are a rate
/// of video rounded or cut off, 23.98 or 23.97, are that rate, 24000/1001.
FrameRate parse_rate(std::string_view text);

/// Throws UsageError unless all of `crop` lies in the picture.
void require_within(const Lattice& crop, PictureSize picture);

/// Returns the file of a frame: `path` with its "%d", "%4d" or "%04d" replaced by the number (padded with zeros), or,
/// if it has none, with "-0042" inserted before the ending.
std::string numbered(const std::string& path, int frame);

/// Returns the file of a share of one picture: "a.png.part-3-of-16".
std::string part_path(const std::string& path, Share share);

/// Returns `path` with `insertion` inserted before its ending.
std::string before_ending(const std::string& path, std::string_view insertion);

/// Returns "640x480".
std::string size_text(int width, int height);

/// Returns a number of bytes for messages: "1.5 GB".
std::string bytes_in_words(double bytes);

}  // namespace strahl

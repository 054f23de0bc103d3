// Sizes of pictures.
#pragma once

namespace strahl {

/// A size in pixels.
struct PictureSize {
    int width = 640, height = 480;
    bool operator==(const PictureSize&) const = default;
};

}  // namespace strahl

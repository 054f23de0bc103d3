// Prepares the pictures of a scene for kernels: as values of the scene's assumed_gamma, and at smaller sizes.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/image_pattern.h"
#include "trace/world/world.h"

namespace strahl {

/// A picture and smaller ones of it, each of about half the width and half the height of that before, down to a single
/// pixel (L. Williams, "Pyramidal Parametrics", 1983). A pixel is the mean of the rectangle that it covers of the level
/// before, so that all levels have one mean. All smaller ones together have a third of the picture's pixels, those of
/// pictures one pixel high or wide as many as these.
class MipMap {
  public:
    /// `values` has three values for each pixel; the map refers to them.
    MipMap(const float* values, std::int32_t width, std::int32_t height);
    MipMapKernel kernel() const { return {levels.data(), static_cast<std::int32_t>(levels.size())}; }

  private:
    std::vector<float> smaller;
    std::vector<MipLevel> levels;
};

/// The pictures of a scene, kept from moment to moment if it moves.
class Images {
  public:
    /// Pixels as they are if `gamma` is 0, else values v such that v^gamma is their light.
    struct Image {
        std::shared_ptr<const Pixels> given, own;
        double gamma;
        bool colors;
    };
    /// Adds an image unless it is there, and returns its number. Mip maps are made of images used for their colours.
    int add(const std::shared_ptr<const Pixels>& pixels, double gamma, bool colors);
    const Image& operator[](int number) const { return images[number]; }
    /// Returns mip maps by number, made when first asked for; null if no image is used for its colours.
    const MipMapKernel* mip_maps();

  private:
    std::vector<Image> images;
    std::vector<MipMap> maps;
    std::vector<MipMapKernel> kernels;
};

}  // namespace strahl

// The layers of a tile: averages over the samples of its pixels, with the weights that these have in the picture.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "scene/layers.h"

namespace strahl {

/// Lists what the numbers in a world stand for in the scene: the body of each surface, the material that each of its
/// materials was declared as, and the light that each of its lights is a point of.
struct LayerTables {
    std::vector<std::int32_t> bodies, materials, lights;
};

/// Averages the layers of a tile. The row of a sample is that of LayerRows, in the scene's units.
class LayerTile {
  public:
    LayerTile(const Layers& own_layers, std::shared_ptr<const LayerTables> own_tables);

    const Layers& layers() const { return wanted; }
    const LayerTables& tables() const { return *known; }
    /// The length of a row.
    int length() const { return row_length; }

    /// Returns how opaque the background is.
    double opacity() const { return wanted.alpha ? wanted.background : 1; }

    void begin(int pixels);
    /// Appends a sample, and returns its row to be written.
    float* add_sample();
    int samples() const { return static_cast<int>(rows.size()) / row_length; }
    void forget_samples() { rows.clear(); }
    /// Returns how opaque the last samples are: that many from the one with this number on.
    double alpha(int sample) const { return 1 - double(rows[std::size_t(sample) * row_length]); }
    /// Adds a sample to a pixel by its weight there. Channels of light may have other weights.
    void average(int pixel, int sample, double weight) { average(pixel, sample, weight, {weight, weight, weight}); }
    void average(int pixel, int sample, double weight, const std::array<double, 3>& light);

    /// Returns the values of all pixels, as many for each as channels_of() names; its light is given, or the sum of the
    /// layers of light in their order, in float.
    template <class T>
    std::vector<float> values(std::span<const T> rgb) const;

  private:
    using Shares = std::vector<std::pair<float, double>>;  // of ids
    struct LayerPixel {
        double weight = 0, covered = 0;
        Shares bodies, materials;
    };

    const Layers wanted;
    const std::shared_ptr<const LayerTables> known;
    const int row_length, lights;  // lights: as they were declared
    std::vector<float> rows;
    std::vector<LayerPixel> pixels;
    std::vector<double> sums;  // a row for each pixel, with the light of each declared light
};

}  // namespace strahl

// A view says which picture of a scene to trace, and a job which threads do it and where the values go.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "scene/camera.h"
#include "scene/layers.h"
#include "scene/motion/track.h"

namespace strahl {

class ThreadPool;

/// Pixels x + i * step_x, y + j * step_y for 0 <= i < columns, 0 <= j < rows of a picture. A crop has steps of 1, the
/// window's resolution levels have steps of 16 to 1.
struct Lattice {
    int x = 0, y = 0, columns = 0, rows = 0, step_x = 1, step_y = 1;
};

struct Pixel {
    int x, y;
};
/// The first column and the first row of the second eye's half of a picture; 0 if it has none.
struct EyeHalves {
    int column = 0, row = 0;
};
/// A place in the picture, in pixels. Pixels have their middles at whole numbers.
struct PicturePoint {
    double x, y;
};

/// Values of one tile: red, green, blue of each pixel of `lattice`, row by row, linear and unclamped. Float for
/// float32, double for the two others.
struct Tile {
    Lattice lattice;
    std::variant<std::span<const float>, std::span<const double>> rgb;
    /// With View::prove, of each pixel: no channel is further than this from what exact arithmetic would give.
    std::span<const double> bounds{};
    /// With View::layers, of each pixel: all that channels_of() names. Its light is that of `rgb`, in float, or the sum
    /// of the layers of light.
    std::span<const float> layers{};
};
/// Copies a tile to its place among the values of the lattice that is being traced, 3 for each pixel, row by row.
template <class T>
void place(const Tile& tile, const Lattice& whole, std::vector<T>& values) {
    const Lattice& part = tile.lattice;
    const std::ptrdiff_t column = (part.x - whole.x) / whole.step_x, first_row = (part.y - whole.y) / whole.step_y;
    const auto copy = [&](const auto& rgb) {
        for (std::ptrdiff_t row = 0; row < part.rows; ++row)
            std::copy_n(rgb.begin() + 3 * row * part.columns, 3 * part.columns,
                        values.begin() + 3 * ((first_row + row) * whole.columns + column));
    };
    std::visit(copy, tile.rgb);
}
/// Called from any thread, once per tile; tiles do not overlap.
using Sink = std::function<void(const Tile&)>;

/// The picture of a scene to trace. Sizes are in pixels of the whole picture, so that a crop or a pass has the same
/// pixels.
struct View {
    Camera camera;
    int width = 640, height = 480;
    int depth = 20;                   // generations of rays, the primary ray being the first; 1 to 256
    double shift_x = 0, shift_y = 0;  // of the sampling point from the pixel's centre, in pixels
    double error = 0;  // a pixel may lack this much light in a channel: weak rays are left out until they add up to it
    double time = 0;   // in seconds: where moving bodies and lights are
    /// Tiles come with bounds of their errors, with one ray in each pixel, in float64 or extended. The exact ray goes
    /// through the pixel's middle; what a shift changes is in the bound.
    bool prove = false;
    std::shared_ptr<const std::vector<Track>> tracks{};  // if any, these replace the scene's
    /// Says what tiles hold besides light. With alpha the background is black, as far as it is not opaque, but in
    /// mirrors; light is multiplied by alpha. Resolution levels and lists of places have no layers.
    Layers layers{};
    /// If any, averages over pixels are also averages over these (shutter.h). One ray in each pixel sees `time` alone.
    std::shared_ptr<const std::vector<Shot>> moments{};
    bool operator==(const View&) const = default;  // of tracks and moments: the same ones
};

inline EyeHalves halves_of(const View& view) {
    return {view.camera.stereo == Stereo::side_by_side ? view.width / 2 : 0,
            view.camera.stereo == Stereo::top_bottom ? view.height / 2 : 0};
}

/// Work for the threads of a pool: all of it is done when it returns, or `stop` became true. Tiles that were handed to
/// the sink are complete in both cases.
struct Job {
    View view;
    ThreadPool& pool;
    Sink sink;
    const std::atomic<bool>* stop = nullptr;
    /// Pixels whose rays of one generation are more are traced in smaller batches. The picture does not depend on it.
    int queue = std::numeric_limits<int>::max();
    bool stopped() const { return stop && *stop; }
};

}  // namespace strahl

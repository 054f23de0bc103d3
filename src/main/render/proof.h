// Finds the pixels of a picture that are proved: all values within their bounds are the same in the file.
#pragma once
#include <array>
#include <mutex>
#include <string>
#include <vector>

#include "image/picture_writer.h"
#include "main/render/stats.h"
#include "trace/world/view.h"

namespace strahl {

class Proof {
  public:
    /// Proves this part of a picture for files of this format.
    Proof(const Lattice& part, const FileFormat& format);

    enum class By : unsigned char { nothing, in_double, in_extended };

    /// Writes the pixels of a tile in double, except undecided ones, which stay open. May be called from any thread.
    void keep(const Tile& tile, PictureWriter& writer);
    std::vector<Pixel> open() const;
    /// Writes a pixel that was traced again, if that decides it. Returns whether it does. May be called from any
    /// thread.
    bool settle(const Tile& pixel, By by, PictureWriter& writer);
    /// Writes the pixels that are still open, as they are in double.
    void close(PictureWriter& writer);

    ProofCounts counts() const;
    /// Writes a map: green where double proves a pixel, blue where extended precision does, darker the larger the bound
    /// is, and red where it is undecided.
    void write(const std::string& path) const;

  private:
    struct Open {
        Pixel pixel;
        std::array<double, 3> rgb;
    };
    std::size_t place_of(int x, int y) const { return std::size_t(y - part.y) * part.columns + (x - part.x); }
    bool decided(const Tile& tile, int i) const;
    void put(const Pixel& pixel, const double* rgb, PictureWriter& writer) const;

    const Lattice part;
    const FileFormat format;
    std::vector<double> bounds;  // by pixel
    std::vector<By> proved;      // by pixel
    std::mutex mutex;            // guards `undecided`
    std::vector<Open> undecided;
};

}  // namespace strahl

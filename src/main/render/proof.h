// Which pixels of a picture are proved: whether all values within their bounds are the same in the file.
#pragma once
#include <array>
#include <mutex>
#include <string>
#include <vector>

#include "image/picture_writer.h"
#include "main/render/proof_counts.h"
#include "trace/tracer.h"

namespace strahl {

class Proof {
  public:
    /// Of this part of a picture, as files of this format hold it.
    Proof(const Lattice& part, const FileFormat& format);

    enum class By : unsigned char { nothing, in_double, in_extended };

    /// Puts a tile of double but for what is undecided, which stays open. From any thread.
    void keep(const Tile& tile, PictureWriter& writer);
    std::vector<Pixel> open() const;
    /// Puts a pixel that was traced again, if that decides it, which is the answer. From any thread.
    bool settle(const Tile& pixel, By by, PictureWriter& writer);
    /// Puts all that is still open, as it is in double.
    void close(PictureWriter& writer);

    ProofCounts counts() const;
    /// A map: green where double proves a pixel, blue where extended precision does, the darker the larger the bound;
    /// undecided ones red.
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
    std::vector<By> proved;      // likewise
    std::mutex mutex;            // of these:
    std::vector<Open> undecided;
};

}  // namespace strahl

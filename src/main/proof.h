// Which pixels of a picture are proved: whether all values within their bounds are the same in the file.
#pragma once
#include <string>
#include <vector>

#include "image/picture.h"
#include "main/proof_counts.h"
#include "trace/tracer.h"

namespace strahl {

class Proof {
  public:
    /// Of this part of a picture, as files of this format hold it.
    Proof(const Lattice& part, const FileFormat& format);
    /// Of any thread.
    void keep(const Tile& tile);
    ProofCounts counts() const;
    /// A map: green where a pixel is proved, red where it is undecided, the darker the larger the bound.
    void write(const std::string& path) const;

  private:
    const Lattice part;
    const FileFormat format;
    std::vector<double> bounds;         // by pixel
    std::vector<unsigned char> proved;  // likewise
};

}  // namespace strahl

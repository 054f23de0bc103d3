// A lattice of which the tracer traces some pixels and fills the others, as colours of a screen.
#pragma once
#include <cstdint>
#include <functional>

#include "trace/world/view.h"

namespace strahl {

/// Pixels of a lattice, with rays only where the picture is not smooth: what lies between is interpolated (see
/// lattice_cells.h). Filled pixels are off by at most half of `contrast`, in linear values, but for a few: this is no
/// bound. Worlds of more than 10,000 bodies, or 1,000 if something moves, get a ray in each pixel. A crop must begin at
/// multiples of 8 pixels of the lattice.
struct FilledLattice {
    Lattice lattice;
    double contrast = 0;
    /// Returns the colour of a pixel with these values: four channels of 8 bits.
    std::function<std::uint32_t(const double* rgb)> encode{};
    /// All pixels of the lattice, row by row. Those that were not reached when the job was stopped are as before.
    std::uint32_t* colors = nullptr;
    /// The side of squares, in pixels of the view, over which patterns are averaged roughly; 0 for colours of points.
    double side = 0;
};

}  // namespace strahl

// The transfer curve to 8 bits as a table, for the screen and for files of scenes with an assumed_gamma or with an
// exposure.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "image/transfer.h"

namespace strahl {

/// Gives exactly quantise(v, gamma, 255) for every v, or quantise(exposed(v, *exposure), gamma, 255), without the power
/// function.
class TransferTable {
  public:
    explicit TransferTable(double gamma, const Exposure& exposure = {});
    std::uint32_t operator()(double v) const {
        const double in = v > 0 ? std::min(v, white) : 0.;  // without branches: neighbours' values are far apart
        std::uint32_t code = start[static_cast<std::size_t>(static_cast<int>(in * bins_per_unit))];
        code += in >= least[code + 1];
        while (in >= least[code + 1]) ++code;  // only where bins hold several codes, which exposures can make
        return code;
    }
    /// Returns the pixel of a red, green and blue value: 8 bits each of blue, green, red and full opacity, from the low
    /// bits up, which is the order of most screens.
    template <class T>
    std::uint32_t pixel(const T* rgb) const {
        return (*this)(rgb[2]) | (*this)(rgb[1]) << 8 | (*this)(rgb[0]) << 16 | 0xff000000u;
    }

    /// Returns the middle of the values with this code; for the last code, its least value.
    double light(std::uint32_t code) const { return code < 255 ? (least[code] + least[code + 1]) / 2 : least[255]; }

  private:
    static constexpr int bins = 4096;
    double white = 1, bins_per_unit = bins;    // all light from `white` on has the last code
    std::array<double, 257> least;             // the least value with this code
    std::array<std::uint8_t, bins + 1> start;  // the code at the lower end of each bin
};

}  // namespace strahl

// The transfer curve to 8 bits as a table, for the screen and for files of linear light.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace strahl {

/// Gives exactly quantise(v, linear, 255) for every v, without the power function.
class TransferTable {
  public:
    explicit TransferTable(bool linear);
    std::uint32_t operator()(double v) const {
        if (!(v > 0)) return 0;
        if (v >= 1) return 255;
        std::uint32_t code = start[static_cast<std::size_t>(v * bins)];
        while (v >= least[code + 1]) ++code;
        return code;
    }
    /// Returns the pixel of a red, green and blue value.
    template <class T>
    std::uint32_t pixel(const T* rgb) const {
        return (*this)(rgb[0]) | (*this)(rgb[1]) << 8 | (*this)(rgb[2]) << 16 | 0xff000000u;
    }

  private:
    static constexpr int bins = 4096;
    std::array<double, 257> least;             // the least value with this code
    std::array<std::uint8_t, bins + 1> start;  // the code at the lower end of each bin
};

}  // namespace strahl

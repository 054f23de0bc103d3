#include "image/transfer_table.h"

#include <bit>
#include <cmath>
#include <limits>

namespace strahl {

TransferTable::TransferTable(double gamma, const Exposure& exposure) {
    const auto code_of = [&](double v) { return quantise(exposure ? exposed(v, *exposure) : v, gamma, 255); };
    least[0] = 0;
    for (int code = 1; code < 256; ++code) {
        // Positive numbers are ordered as their bits are.
        std::uint64_t low = std::bit_cast<std::uint64_t>(least[code - 1]);           // quantised below `code`
        std::uint64_t high = std::bit_cast<std::uint64_t>(exposure ? 0x1p+64 : 1.);  // and not below
        while (high - low > 1) {
            const std::uint64_t middle = low + (high - low) / 2;
            (code_of(std::bit_cast<double>(middle)) < code ? low : high) = middle;
        }
        least[code] = std::bit_cast<double>(high);
    }
    least[256] = std::numeric_limits<double>::infinity();  // never reached
    if (exposure) {
        // A power of two, so that bins begin where they are computed to begin.
        white = std::exp2(std::ceil(std::log2(least[255])));
        bins_per_unit = bins / white;
    }
    for (int i = 0, code = 0; i <= bins; ++i) {
        while (i / bins_per_unit >= least[code + 1]) ++code;
        start[i] = static_cast<std::uint8_t>(code);
    }
}

}  // namespace strahl

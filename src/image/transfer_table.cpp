#include "image/transfer_table.h"

#include <bit>

#include "image/transfer.h"

namespace strahl {

TransferTable::TransferTable(bool linear) {
    least[0] = 0;
    for (int code = 1; code < 256; ++code) {
        // Positive numbers are ordered as their bits are.
        std::uint64_t low = std::bit_cast<std::uint64_t>(least[code - 1]);  // quantised below `code`
        std::uint64_t high = std::bit_cast<std::uint64_t>(1.);              // and not below
        while (high - low > 1) {
            const std::uint64_t middle = low + (high - low) / 2;
            (quantise(std::bit_cast<double>(middle), linear, 255) < code ? low : high) = middle;
        }
        least[code] = std::bit_cast<double>(high);
    }
    least[256] = 2;  // never reached
    for (int i = 0, code = 0; i <= bins; ++i) {
        while (static_cast<double>(i) / bins >= least[code + 1]) ++code;
        start[i] = static_cast<std::uint8_t>(code);
    }
}

}  // namespace strahl

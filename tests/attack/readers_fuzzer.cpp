// Gives any bytes to the small readers, for libFuzzer.
#include <cstddef>
#include <cstdint>

#include "files/error.h"
#include "tests/attack/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    for (const strahl::AttackedReader& reader : strahl::attacked_readers) try {
            reader.read({reinterpret_cast<const char*>(data), size});
        } catch (const strahl::FileError&) {
        }
    return 0;
}

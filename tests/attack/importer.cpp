// Any bytes either give a FileError or a scene that survives being written and parsed.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "import/import.h"
#include "tests/attack/written_again.h"

std::vector<std::string> attacked_words() { return {}; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    strahl::ImportLimits limits;
    limits.primitives = 1000, limits.lights = 100;
    try {
        const strahl::Imported imported =
            strahl::import_scene({reinterpret_cast<const char*>(data), size}, "fuzz", limits);
        for (const std::string& warning : imported.warnings)
            if (!warning.starts_with("fuzz:")) strahl::attack::fail("a strange warning:", warning);
        strahl::attack::written_again(imported.scene);
    } catch (const strahl::FileError& error) {
        strahl::attack::check_message(error, 2000);
    }
    return 0;
}

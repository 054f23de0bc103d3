// Any bytes either give a FileError or a scene that survives being written and parsed.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "import/import.h"
#include "text/parse.h"
#include "text/write.h"

namespace {

[[noreturn]] void fail(const char* what, const std::string& detail) {
    std::fprintf(stderr, "%s\n%s\n", what, detail.c_str());
    std::abort();
}

void check(const strahl::Imported& imported) {
    for (const std::string& warning : imported.warnings)
        if (!warning.starts_with("fuzz:")) fail("a strange warning:", warning);
    const std::string text = strahl::write_scene(imported.scene);
    try {
        if (strahl::parse_scene(text, "written") != imported.scene) fail("parsed it is another scene:", text);
    } catch (const strahl::FileError& error) {
        fail("what was written does not parse:", std::string(error.what()) + "\n" + text);
    }
}

}  // namespace

std::vector<std::string> attacked_words() { return {}; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    strahl::ImportLimits limits;
    limits.primitives = 1000, limits.lights = 100;
    strahl::Imported imported;
    try {
        imported = strahl::import_scene({reinterpret_cast<const char*>(data), size}, "fuzz", limits);
    } catch (const strahl::FileError& error) {
        const std::string_view message = error.what();
        if (!message.starts_with("fuzz:") || message.size() > 2000) fail("a strange message:", error.what());
        return 0;
    }
    check(imported);
    return 0;
}

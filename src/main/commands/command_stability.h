// strahl stability: shows where a picture depends on the precision it is rendered in.
#pragma once
#include <optional>
#include <string>

#include "main/render/values.h"
#include "pov/open_scene.h"

namespace strahl {

struct StabilityOptions {
    std::string scene;  // a file, or "-" for standard input
    OpeningOptions opening{};
    std::string output;        // the map; empty: none
    std::optional<int> depth;  // 1 to 256; by default the scene's max_trace_level
    int threads = 0;           // 0: all processors
};

/// Prints the table and writes the map. Returns the exit status. Throws FileError, UsageError or OutputError.
int stability_command(const StabilityOptions& options);

}  // namespace strahl

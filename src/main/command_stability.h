// strahl stability: where a picture depends on the precision it is traced in.
#pragma once
#include <optional>
#include <string>

#include "main/values.h"

namespace strahl {

struct StabilityOptions {
    std::string scene;   // a file, or "-" for standard input
    std::string output;  // the map; none if empty
    Size size;
    std::optional<int> depth;  // 1 to 256; the scene's max_trace_level if not given
    int threads = 0;           // 0 takes all
};

/// Prints the table and writes the map. Returns the exit status. Throws FileError, UsageError or OutputError.
int stability_command(const StabilityOptions& options);

}  // namespace strahl

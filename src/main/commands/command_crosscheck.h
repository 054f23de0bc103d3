// strahl crosscheck: renders scenes with Strahl and POV-Ray and compares.
#pragma once
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "pov/open_scene.h"

namespace strahl {

struct CrosscheckOptions {
    std::vector<std::string> scenes;
    OpeningOptions opening{.size = {320, 240}};
    std::string sheet;           // a picture of both and their difference; with several scenes its name includes theirs
    std::optional<double> time;  // a moment of the flight, in seconds
    std::optional<int> depth;    // 1 to 256; by default the scene's max_trace_level
    int threads = 0;             // of each program; 0: all processors
};

/// Prints a table, in Markdown, to standard output. Returns the exit status: 0 if no scene has a pixel off the edges
/// that differs by more than 1/65535 and is one that POV-Ray is sure of, nor more than a thousandth of its pixels on
/// edges, nor more than a fiftieth of which POV-Ray is unsure; else 1; and 130 if `stop` became true. Throws FileError,
/// and std::runtime_error if POV-Ray is missing or fails.
int crosscheck_command(const CrosscheckOptions& options, const std::atomic<bool>* stop = nullptr);

}  // namespace strahl

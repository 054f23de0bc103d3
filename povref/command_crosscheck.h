// strahl crosscheck: scenes rendered by strahl and by POV-Ray, compared.
#pragma once
#include <atomic>
#include <optional>
#include <string>
#include <vector>

namespace strahl {

struct CrosscheckOptions {
    std::vector<std::string> scenes;
    std::string sheet;  // a picture of ours, theirs and the difference; with several scenes their names go in
    int width = 320, height = 240;
    std::optional<int> depth;  // 1 to 256; the scene's max_trace_level if not given
    int threads = 0;           // of each of both programs; 0 takes all
};

/// Prints a table, in Markdown, to standard output. Returns the exit status: 0 if no scene has a pixel off the edges
/// that differs by more than 1/65535, nor more than a thousandth of its pixels on edges; else 1; and 130 if `stop`
/// became true. Throws FileError, and std::runtime_error if POV-Ray is missing or fails.
int crosscheck_command(const CrosscheckOptions& options, const std::atomic<bool>* stop = nullptr);

}  // namespace strahl

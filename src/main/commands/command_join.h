// strahl join: puts the parts of a picture together.
#pragma once
#include <string>
#include <vector>

namespace strahl {

struct JoinOptions {
    std::vector<std::string> parts;  // files that `render --part` wrote
    std::string output;              // a file, or "-" for standard output
};

/// Returns the exit status. Throws FileError if a part is missing, damaged or of another picture, UsageError or
/// OutputError.
int join_command(const JoinOptions& options);

}  // namespace strahl

// strahl check: reads a scene and says what is in it, or prints it back.
#pragma once
#include <string>

namespace strahl {

struct CheckOptions {
    std::string scene;   // a file, or "-" for standard input
    bool print = false;  // the scene itself, as `strahl` writes it, instead of the summary
};

/// Returns the exit status. Throws FileError with the scene's faults, or OutputError.
int check_command(const CheckOptions& options);

}  // namespace strahl

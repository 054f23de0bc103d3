// strahl import: converts scenes of other programs to scene text.
#pragma once
#include <string>

#include "pov/open_scene.h"

namespace strahl {

struct ImportOptions {
    std::string file;  // a .pov, or NFF or a scene of Tachyon, or "-" for standard input
    OpeningOptions opening{};
    std::string output = "-";  // the .rt file; "-" is standard output
};

/// Returns the exit status. Throws FileError for errors in the file, OutputError, or UsageError.
int import_command(const ImportOptions& options);

}  // namespace strahl

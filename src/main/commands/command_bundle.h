// strahl bundle: makes a folder that plays a scene on another machine.
#pragma once
#include <string>

namespace strahl {

struct BundleOptions {
    std::string scene;    // a file
    std::string output;   // a folder: a new one, or an older bundle
    std::string version;  // of the program
};

/// Copies the program, the shared libraries that a desktop may lack, the scene with its files, and a script `play`. An
/// older bundle stays until the new one is complete. Returns the exit status. Throws FileError for the scene,
/// UsageError if the folder exists and is not a bundle, and OutputError.
int bundle_command(const BundleOptions& options);

}  // namespace strahl

// strahl bundle: a folder that plays a scene on another machine.
#pragma once
#include <string>

namespace strahl {

struct BundleOptions {
    std::string scene;    // a file
    std::string output;   // a folder: a new one, or an older bundle
    std::string version;  // of the program
};

/// The program, the shared libraries that it has and a desktop need not have, the scene with its files, and a script
/// `play`. An older bundle stays until the new one is whole. Returns the exit status. Throws FileError for the scene,
/// UsageError if the folder is none of its own, and OutputError.
int bundle_command(const BundleOptions& options);

}  // namespace strahl

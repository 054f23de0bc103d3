// Errors that a user can correct: in a command line, in a file, or in writing one.
#pragma once
#include <stdexcept>
#include <string>

namespace strahl {

/// An error in a scene or picture file; the message says where it is and what to do. main ends with exit status 3.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file that can't be written, or the part of the program that would; in main exit status 1.
struct OutputError : FileError {
    using FileError::FileError;
};

/// Writing to a pipe or a device was waited for when a signal came; exit status 130.
struct Interrupted : OutputError {
    using OutputError::OutputError;
};

/// A command line that makes no sense, or not on this machine; exit status 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace strahl

// Errors that a user can correct: in a command line, in a file, or in writing one.
#pragma once
#include <stdexcept>

namespace strahl {

/// An error in a scene or picture file; the message says where it is and what to do. Exit status 3.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file that cannot be written, or a part of the program that is missing; exit status 1.
struct OutputError : FileError {
    using FileError::FileError;
};

/// A signal came while the program waited for a pipe or a device to take bytes; exit status 130.
struct Interrupted : OutputError {
    using OutputError::OutputError;
};

/// A command line that makes no sense, or cannot be followed on this machine; exit status 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace strahl

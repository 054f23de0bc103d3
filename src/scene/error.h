// Errors that a person can mend: in a command line, in a file, or in writing one.
#pragma once
#include <stdexcept>
#include <string>

namespace strahl {

/// A fault in a scene or picture file, with a message that says where and what to do. Thrown in text and image, caught
/// in main, where it becomes exit status 3.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file that can't be written; in main exit status 1.
struct OutputError : FileError {
    using FileError::FileError;
};

/// A command or an option that makes no sense, or not on this machine; in main exit status 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace strahl

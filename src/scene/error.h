// Errors in a file that a person wrote, or wants written.
#pragma once
#include <stdexcept>
#include <string>

namespace strahl {

/// A fault in a scene or picture file, with a message that says where and what to do. Thrown in text and image, caught
/// in main, where it becomes exit status 3.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file that can't be written, or the part of the program that would; in main exit status 1.
struct OutputError : FileError {
    using FileError::FileError;
};

}  // namespace strahl

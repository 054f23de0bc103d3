// Errors in a file that a person wrote.
#pragma once
#include <stdexcept>
#include <string>

namespace strahl {

/// A fault in a scene or picture file, with a message that says where and what to do. Thrown in text and image, caught
/// in main, where it becomes exit status 3.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace strahl

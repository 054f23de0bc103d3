// Errors that a user can correct: in a command line, in a file, or in writing one.
#pragma once
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace strahl {

/// Tells the user of a place in a file. Line and column, in characters, are counted from 1, and 0 if not known.
struct Message {
    std::string text;
    std::string file{};  // empty if it is about none
    std::size_t line = 0, column = 0, length = 0;
    std::string excerpt{};   // the line of the file, with a caret under the place
    std::string calls{};     // lines that say from where the file or a macro was reached
    std::size_t caller = 0;  // line of the scene itself among these calls, or 0

    /// Returns it as people read it: "scene.rt:13:1: unknown word", and below it the excerpt and the calls.
    std::string told() const;
};

/// Errors in a scene or picture file; the messages say where they are and what to do. Exit status 3.
struct FileError : std::runtime_error {
    explicit FileError(const std::string& text) : FileError(std::vector{Message{text}}) {}
    explicit FileError(std::vector<Message> messages);

    std::shared_ptr<const std::vector<Message>> messages;
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

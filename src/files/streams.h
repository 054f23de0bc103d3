// Standard streams that throw. By default they swallow exceptions such as std::bad_alloc, so that a text would lack a
// part or a file would seem to be empty.
#pragma once
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "files/error.h"

namespace strahl {

/// Writes a text.
struct TextStream : std::ostringstream {
    TextStream() { exceptions(std::ios::badbit); }
};

/// Reads a text word by word or line by line.
struct WordStream : std::istringstream {
    explicit WordStream(const std::string& text) : std::istringstream(text) { exceptions(std::ios::badbit); }
};

/// Reads the bytes of a file. Throws FileError if it cannot be opened.
struct FileStream : std::ifstream {
    explicit FileStream(const std::string& path) : std::ifstream(path, std::ios::binary) {
        if (!is_open()) throw FileError("cannot read '" + path + "': " + std::generic_category().message(errno));
        exceptions(std::ios::badbit);
    }
};

}  // namespace strahl

// Standard streams that tell. By themselves they keep quiet about what is thrown while they work, such as
// std::bad_alloc: the text would lack a piece, or a file would seem to be empty.
#pragma once
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "scene/error.h"

namespace strahl {

struct TextStream : std::ostringstream {
    TextStream() { exceptions(std::ios::badbit); }
};

/// A text to be read word by word or line by line.
struct WordStream : std::istringstream {
    explicit WordStream(const std::string& text) : std::istringstream(text) { exceptions(std::ios::badbit); }
};

/// A file to be read, byte by byte as it is. Throws FileError if it can't be opened.
struct FileStream : std::ifstream {
    explicit FileStream(const std::string& path) : std::ifstream(path, std::ios::binary) {
        if (!is_open()) throw FileError("cannot read '" + path + "': " + std::generic_category().message(errno));
        exceptions(std::ios::badbit);
    }
};

}  // namespace strahl

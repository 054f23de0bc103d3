// The bytes of a mesh file, the words of its text, and the messages about both.
#pragma once
#include <string>
#include <string_view>

#include "mesh/read_mesh.h"

namespace strahl {

struct Source {
    std::string path;
    std::string_view bytes;
    MeshLimits limits;

    /// Throws FileError; `at` is a place in the bytes of a text, which is told as a line.
    [[noreturn]] void fail(const std::string& message, const char* at = nullptr) const;
    /// What is wrong with a point, or "".
    static std::string fault(const DVec3& point);
    /// Fail if there are too many.
    void check_triangles(std::uint64_t count) const;
    void check_points(std::uint64_t count) const;
};

MeshData read_ply(const Source& source);
MeshData read_obj(const Source& source);
MeshData read_stl(const Source& source);
/// Is it a binary STL file? That has nothing but its length to be told by.
bool is_binary_stl(std::string_view bytes);

/// The start of a word, for a message; whoever shows that replaces control characters.
std::string quoted_word(std::string_view word);

/// "1 face" or "2 faces".
std::string counted(std::uint64_t count, const char* noun);

/// The backslash too: OBJ joins lines by it, and no number or name that is read here contains it.
inline bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '\\'; }

/// The words of a text, one after the other.
class Words {
  public:
    Words(const Source& source, std::string_view text)
        : source(&source), begin(text.data()), place(begin), end(begin + text.size()) {}

    /// Empty at the end.
    std::string_view next() {
        while (place < end && is_blank(*place)) ++place;
        const char* const start = place;
        while (place < end && !is_blank(*place)) ++place;
        begin = start;
        return {start, static_cast<std::size_t>(place - start)};
    }
    /// Empty at the end of the line.
    std::string_view next_in_line() {
        while (place < end && is_blank(*place) && !ends_line()) ++place;
        if (place < end && !ends_line()) return next();
        begin = place;
        return {};
    }
    void skip_line() {
        while (place < end && !ends_line()) ++place;
    }
    /// The next word as a number, or a message that says it should be `what`.
    double number(const char* what);

    std::size_t left() const { return static_cast<std::size_t>(end - place); }
    /// Fails at the word that was read last.
    [[noreturn]] void fail(const std::string& message) const { source->fail(message, begin); }

  private:
    bool ends_line() const { return *place == '\n' || *place == '\r'; }

    const Source* source;
    const char *begin, *place, *end;
};

/// The word as a number; false if it is none. What is too large or too small for a double counts as none.
bool number_of(std::string_view word, double& number);

}  // namespace strahl

// A text that an editor has open, and its places as the Language Server Protocol counts them.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace strahl {

/// A place in a text: a line, and UTF-16 code units in it, both from 0.
struct EditorPosition {
    std::size_t line = 0, unit = 0;
};

class Document {
  public:
    Document() : Document("", "") {}
    /// `path` is where the text is on the disk; its folder is where the files are that it names.
    Document(std::string path, std::string text);

    /// Returns the position of a byte of the text.
    EditorPosition position(std::size_t at) const;
    /// Returns the byte at a position. One past the end of its line or of the text becomes that end.
    std::size_t offset(const EditorPosition& position) const;
    /// Returns the byte where a line, counted from 0, begins, or that after its last character.
    std::size_t line_start(std::size_t line) const;
    std::size_t line_end(std::size_t line) const;
    /// Returns the line that a byte of the text is in, without blanks before it.
    std::string_view line_at(std::size_t at) const;

    std::string path, text;

  private:
    std::vector<std::size_t> starts;  // of the lines, which end in a line feed, a carriage return or both
};

}  // namespace strahl

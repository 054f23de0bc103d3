// The texts that a scene consists of, cut into tokens once, however often loops and macros read them.
#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "pov/language/value.h"

namespace strahl::pov {

/// Gives every identifier a number, and tells reserved words from them.
class NamePool {
  public:
    NamePool();
    /// Returns the code of a reserved word, or end_code and the number of an identifier.
    std::uint16_t find(std::string_view text, std::uint32_t& name);
    const std::string& text(std::uint32_t name) const { return texts[name]; }
    std::size_t size() const { return texts.size(); }

  private:
    std::unordered_map<std::string_view, std::uint32_t> numbers;  // reserved words have their codes, names more
    std::deque<std::string> texts;
};

/// A token as it stands in a text.
struct RawToken {
    std::uint16_t code = 0;
    std::uint16_t directive = 0;  // for '#': the code of the word after it
    std::uint32_t at = 0;         // its position in the text
    union {
        double number = 0;  // of a number
        std::uint32_t
            index;  // of a name: its number; of a string: its length without the quotes; of a directive: the
                    // token number of the next one of its block (#else, #case, #end ...), or of the last token
    };
};

/// A character that is no part of the language; an error as soon as it is read.
inline constexpr std::uint16_t bad_code = 8;

/// One of the texts: the scene, an include file.
struct TextFile {
    /// Cuts a text into tokens. Links the directives of each block: #if to #else, #else to #end. The text must be
    /// smaller than 4 GB. Throws FileError if it is in UTF-16 or UTF-32.
    TextFile(std::string path, std::string text, NamePool& names);

    std::string path, text;
    std::vector<RawToken> tokens;  // the last one has end_code
};

/// A macro: its parameters, and where its text is.
struct MacroThing : Thing {
    std::uint32_t name = 0, file = 0, first = 0;  // the token after the parameters
    std::vector<std::uint32_t> parameters;
};

/// A file that #fopen opened. The tokens of one that is read are numbers, vectors and strings.
struct FileThing : Thing {
    std::string path;
    std::unique_ptr<TextFile> reading;
    mutable std::size_t next = 0;
    std::shared_ptr<std::ostream> writing;
};

}  // namespace strahl::pov

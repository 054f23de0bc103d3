// Describes the words of the language, from the lists that the parser reads by: for the manual and for editors.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace strahl {

/// A parameter or an argument of a block, in the manual's Markdown.
struct WordHelp {
    std::string name;       // "`pow`" of a parameter, perhaps with its value; "radius" of an argument
    std::string otherwise;  // its default in words; empty for the arguments of bodies
    std::string values, meaning;
};

/// Returns the rows of the manual about the block that this word opens, such as `camera`, `sphere` or `marble`; none if
/// it opens no block. Those of `motion` are about its keys, and those of `key` about a flythrough's.
std::vector<WordHelp> help_on_block(std::string_view block);

/// Returns the words that may stand in a block, or at the top level if it is empty. `outer` is the block around it. A
/// word that opens no block of the language counts as the name of a body.
std::vector<std::string> words_in(std::string_view block, std::string_view outer);
/// Returns the words that may follow this one as its value, such as the patterns for `rgb`; mostly none.
std::vector<std::string> words_after(std::string_view word);

/// Describes a word of a block in Markdown, with the rows about the block that it opens; empty for unknown words.
std::string help_on_word(std::string_view word, std::string_view block, std::string_view outer);

}  // namespace strahl

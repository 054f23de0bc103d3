// The words of a scene's text with what belongs to each, and where that stands: for changing numbers in place.
#pragma once
#include <map>
#include <string_view>
#include <vector>

namespace strahl {

/// A word of the language with what follows it, as slices of the text.
struct TextItem {
    std::string_view word;
    std::string_view name;                  // that follows `define` or a word for materials; empty if there is none
    std::vector<std::string_view> numbers;  // one after the other, also those of vectors; of a block those before words
    std::vector<TextItem> items;            // of its block; of `define` what it names
    std::string_view end;                   // the closing brace; empty if there is no block
    std::vector<std::string_view> tracks;   // the words `track "NAME"` before those numbers that follow tracks
    /// Returns the first item with this word, or null.
    const TextItem* item(std::string_view item_word) const;
};

/// Returns the slice of a block with its word, or of what `define` names, with that.
std::string_view whole_block(const TextItem& item);

/// The text of one body of the top level, and what applies to it.
struct BodyItems {
    TextItem body;  // without a word if there is no such body
    std::map<std::string_view, TextItem> definitions;
    std::vector<TextItem> defaults;  // `defaultmaterial`, in the order of the text
};
/// Finds the body with this number among those of the top level, counted from 0, in a text without errors; in others
/// perhaps none. The slices are of `text`.
BodyItems items_of_body(std::string_view text, int number);
/// Finds the light with this number, counted from 0, in a text without errors. Returns an item without a word if there
/// is none.
TextItem item_of_light(std::string_view text, int number);

/// Finds the first block of the top level with this word; an item without a word if there is none, or the text up to
/// its end has an error.
TextItem item_of_block(std::string_view text, std::string_view word);
/// Finds it in any text, and returns it whole, from the word to the closing brace; an empty slice if there is none.
std::string_view block_of(std::string_view text, std::string_view word);

/// Is this the word of a kind of body?
bool is_body_word(std::string_view word);

}  // namespace strahl

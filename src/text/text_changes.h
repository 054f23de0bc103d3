// Changes of a text in several places.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace strahl {

/// A part of a text, from a place on up to another one.
struct TextSlice {
    std::size_t begin = 0, end = 0;
};
/// Returns the place of a part in the text that it is a part of.
inline TextSlice slice_of(const std::string& text, std::string_view part) {
    const auto begin = std::size_t(part.data() - text.data());
    return {begin, begin + part.size()};
}
/// Returns the slice with the white space before it on its line, and with the end of the line before if nothing else
/// is on it.
TextSlice with_space(const std::string& text, TextSlice slice);

/// Another text in place of a slice; one of an empty slice is inserted there.
struct TextChange {
    TextSlice at;
    std::string text;
};
/// Returns the text with all changes. Changes at one place keep their order; where two overlap, the text is replaced
/// once.
std::string with_changes(const std::string& text, std::vector<TextChange> changes);

/// Returns the white space at the beginning of the line with this place.
std::string indentation(const std::string& text, std::size_t at);
/// Returns the end of the line if nothing but a comment stands on it from here on, else `at`.
std::size_t rest_of_line(const std::string& text, std::size_t at);

}  // namespace strahl

// Advice for habits from other languages: words of POV-Ray and other renderers, and signs that mean something there.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace strahl {

/// Returns what to write in place of a word of POV-Ray or other renderers where the words `known` may stand, such as
/// "use 'rgb'"; empty if there is nothing to say.
std::string advice_on_word(std::string_view word, std::span<const std::string_view> known);

/// Returns advice such as "decimals have a point, as in 2.5", for a text that cannot go on at `at`, where a token
/// begins; empty if there is none.
std::string advice_on_sign(std::string_view text, std::size_t at);

}  // namespace strahl

#include "pov/language/text_file.h"

#include <charconv>
#include <limits>

#include "files/utf8.h"
#include "files/words.h"
#include "pov/language/words.h"

namespace strahl::pov {
namespace {

bool is_blank(char c) { return is_space(c) || c == '\0' || c == 26; }

/// Cuts one text.
class Cutter {
  public:
    Cutter(TextFile& file, NamePool& names) : file(file), names(names), text(file.text) {}

    void run() {
        while (next < text.size() && static_cast<unsigned char>(text[next]) > 127) ++next;  // a byte order mark
        file.tokens.reserve(text.size() / 5);
        while (skip_space()) cut();
        add(end_code, text.size());
        for (const std::uint32_t opener : open) file.tokens[opener].index = last();
    }

  private:
    std::uint32_t last() const { return static_cast<std::uint32_t>(file.tokens.size() - 1); }
    RawToken& add(std::uint16_t code, std::size_t at) {
        RawToken& token = file.tokens.emplace_back();
        token.code = code;
        token.at = static_cast<std::uint32_t>(at);
        return token;
    }

    /// Skips white space and comments; false at the end of the text. Comments nest.
    bool skip_space() {
        while (next < text.size()) {
            if (is_blank(text[next])) {
                ++next;
            } else if (text.compare(next, 2, "//") == 0) {
                next = std::min(text.find_first_of("\r\n", next), text.size());
            } else if (text.compare(next, 2, "/*") == 0) {
                const std::size_t start = next;
                int depth = 0;
                do {
                    if (text.compare(next, 2, "/*") == 0)
                        ++depth, next += 2;
                    else if (text.compare(next, 2, "*/") == 0)
                        --depth, next += 2;
                    else
                        ++next;
                } while (depth > 0 && next < text.size());
                if (depth > 0) add(bad_code, start);
            } else {
                return true;
            }
        }
        return false;
    }

    void cut() {
        const char c = text[next];
        const std::size_t start = next;
        if (is_letter(c)) {
            std::uint32_t name = 0;
            const std::uint16_t code = names.find(take_word(), name);
            RawToken& token = add(code == end_code ? new_name_code : code, start);
            if (code == end_code) token.index = name;
        } else if (is_digit(c) || (c == '.' && next + 1 < text.size() && is_digit(text[next + 1]))) {
            cut_number();
        } else if (c == '"') {
            ++next;
            while (next < text.size() && text[next] != '"') next += text[next] == '\\' ? 2 : 1;
            if (next >= text.size()) {
                next = text.size();
                add(bad_code, start);
            } else {
                add(string_code, start).index = static_cast<std::uint32_t>(next++ - start - 1);
            }
        } else if (c == '#') {
            ++next;
            cut_directive(start);
        } else {
            ++next;
            const bool equal = next < text.size() && text[next] == '=';
            std::uint16_t code = static_cast<unsigned char>(c);
            if (code < 32 || code > 126) code = bad_code;
            if (equal && (c == '<' || c == '>' || c == '!')) {
                code = c == '<' ? less_equal_code : c == '>' ? greater_equal_code : not_equal_code;
                ++next;
            }
            add(code, start);
        }
    }
    std::string_view take_word() {
        const std::size_t start = next;
        while (next < text.size() && (is_letter(text[next]) || is_digit(text[next]))) ++next;
        return std::string_view(text).substr(start, next - start);
    }
    void skip_digits() {
        while (next < text.size() && is_digit(text[next])) ++next;
    }
    /// A number ends where it cannot go on: "2x" is 2 and x. The exponent may lack its digits, as for POV-Ray.
    void cut_number() {
        const std::size_t start = next;
        skip_digits();
        if (next < text.size() && text[next] == '.') ++next, skip_digits();
        if (next < text.size() && lower(text[next]) == 'e') {
            ++next;
            if (next < text.size() && (text[next] == '+' || text[next] == '-')) ++next;
            skip_digits();
        }
        double value = 0;
        const auto result = std::from_chars(text.data() + start, text.data() + next, value);
        if (result.ec == std::errc::result_out_of_range) {
            const std::string_view digits = std::string_view(text).substr(start, next - start);
            value = digits.find("e-") == digits.npos && digits.find("E-") == digits.npos
                        ? std::numeric_limits<double>::infinity()
                        : 0;
        }
        add(number_code, start).number = value;
    }
    /// Makes one token of '#' and a directive after it, and links it to the block that it opens, divides or closes.
    /// '#' before any other word is a token of its own.
    void cut_directive(std::size_t start) {
        while (next < text.size() && is_blank(text[next])) ++next;
        std::uint32_t name = 0;
        const std::size_t at_word = next;
        std::uint16_t code = end_code;
        if (next < text.size() && is_letter(text[next])) {
            const std::string_view after = take_word();
            if (is_directive(after)) code = names.find(after, name);
        }
        if (code == end_code) next = at_word;
        add('#', start).directive = code;
        switch (code) {
            case word("if"):
            case word("ifdef"):
            case word("ifndef"):
            case word("while"):
            case word("for"):
            case word("switch"):
            case word("macro"):
                open.push_back(last());
                break;
            case word("else"):
            case word("elseif"):
            case word("case"):
            case word("range"):
            case word("end"):
                if (open.empty()) break;
                file.tokens[open.back()].index = last();
                if (code == word("end"))
                    open.pop_back();
                else
                    open.back() = last();
                break;
            default:
                break;
        }
    }

    TextFile& file;
    NamePool& names;
    const std::string& text;
    std::size_t next = 0;
    std::vector<std::uint32_t> open;  // the last directive of each block that is not closed yet
};

}  // namespace

NamePool::NamePool() {
    for (const std::string_view word : reserved_words) numbers.emplace(word, find_word(word));
    for (const auto& [other, word] : {std::pair{"colour", "color"},
                                      {"colour_map", "color_map"},
                                      {"fade_colour", "fade_color"},
                                      {"quick_colour", "quick_color"},
                                      {"use_colour", "use_color"}})
        numbers.emplace(other, find_word(word));
}

std::uint16_t NamePool::find(std::string_view text, std::uint32_t& name) {
    static constexpr std::uint32_t first_name = 1 << 16;
    auto found = numbers.find(text);
    if (found == numbers.end()) {
        texts.emplace_back(text);
        found = numbers.emplace(texts.back(), first_name + static_cast<std::uint32_t>(texts.size() - 1)).first;
    }
    if (found->second < first_name) return static_cast<std::uint16_t>(found->second);
    name = found->second - first_name;
    return end_code;
}

TextFile::TextFile(std::string path, std::string text, NamePool& names) : path(std::move(path)), text(std::move(text)) {
    utf8_text(this->text, this->path);  // throws for UTF-16; what is in another encoding may stand in comments
    Cutter(*this, names).run();
}

}  // namespace strahl::pov

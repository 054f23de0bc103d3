#include "pov/literals.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "files/error.h"
#include "files/words.h"
#include "pov/language/text_file.h"
#include "pov/language/words.h"
#include "scene/scene.h"

namespace strahl::pov {
namespace {

constexpr int most_levels = 8;  // of declarations that name others
constexpr std::size_t most_values = 200, most_names = 100;

constexpr std::array body_codes{word("sphere"),       word("box"),         word("cylinder"), word("cone"),
                                word("torus"),        word("plane"),       word("disc"),     word("triangle"),
                                word("object"),       word("union"),       word("merge"),    word("difference"),
                                word("intersection"), word("light_source")};
/// Words that are values.
constexpr std::array value_codes{word("x"),   word("y"),    word("z"),     word("u"),  word("v"),
                                 word("t"),   word("pi"),   word("clock"), word("on"), word("off"),
                                 word("yes"), word("true"), word("false"), word("no")};
/// Returns whether a token before or after a number makes that an operand.
bool is_operator(std::uint16_t code) {
    return std::string_view("*/+-.?:&|!").find(static_cast<char>(code)) != std::string_view::npos && code >= 32 &&
           code < 127;
}
/// Returns whether a value can end with this token.
bool ends_value(const RawToken& token) {
    return token.code == number_code || token.code == new_name_code || token.code == ')' || token.code == '>' ||
           token.code == ']' || is_one_of(token.code, value_codes);
}

struct NamedArgument {
    std::string name;
    NumberRange range = anything;
};
/// Returns the arguments of a body or a light; none if POV-Ray's are others.
std::vector<NamedArgument> arguments_of(std::string_view body) {
    if (body == "light_source") return {{"location"}, {"color"}};
    std::vector<NamedArgument> arguments;
    const auto add = [&]<class Kind>(std::type_identity<Kind>) {
        if (Kind::name == body && body != Torus::name && body != Plane::name && body != Superellipsoid::name &&
            (has_contours<Kind> || !lists_crossings<Kind>))
            std::apply(
                [&](const auto&... field) {
                    (arguments.push_back({std::string(field.name), argument_range(field.range)}), ...);
                },
                Kind::fields);
    };
    [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        (add(std::type_identity<Kinds>()), ...);
    }(std::type_identity<Shape>());
    return arguments;
}

class BlockNumbers {
  public:
    explicit BlockNumbers(const std::string& text) : file("", text, names), tokens(file.tokens) {}

    std::vector<BodyValue> find(std::size_t at) {
        const auto first = std::ranges::lower_bound(tokens, at, {}, &RawToken::at);
        if (first == tokens.end() || first->at != at || !is_one_of(first->code, body_codes)) return {};
        read_block(static_cast<std::size_t>(first - tokens.begin()), "", 0, "");
        return std::move(values);
    }

  private:
    std::string word_at(std::size_t i) const {
        std::size_t end = tokens[i].at;
        while (end < file.text.size() && (is_letter(file.text[end]) || is_digit(file.text[end]))) ++end;
        return file.text.substr(tokens[i].at, end - tokens[i].at);
    }

    /// Returns the number of the bracket that closes the one at `i`, or of the last token.
    std::size_t closing(std::size_t i) const;
    /// Reads a number at `i`, which may have a sign. Returns the number of the token behind it.
    std::optional<std::size_t> read_number(std::size_t i, BodyValue& value) const;
    /// Reads a number or a vector at `i`. Returns the number of the token behind it.
    std::optional<std::size_t> read_value(std::size_t i, BodyValue& value) const;
    void read_block(std::size_t begin, const std::string& source, int level, const std::string& part);
    void read_name(std::size_t i, const std::string& name, int level);
    /// Returns the number of the token after '=' of the only declaration of a name; 0 if there is none.
    std::size_t declaration(std::uint32_t name) const;
    void add(BodyValue value, const std::string& name, const std::string& source) {
        value.name = name, value.source = source;
        value.color = value.numbers.size() == 3 && (name.ends_with("rgb") || name.ends_with("color"));
        if (values.size() < most_values) values.push_back(std::move(value));
    }

    NamePool names;
    TextFile file;
    std::vector<RawToken>& tokens;
    std::vector<BodyValue> values;
    std::size_t names_read = 0;
};

std::size_t BlockNumbers::closing(std::size_t i) const {
    const auto open = tokens[i].code;
    const std::uint16_t close = open == '{' ? '}' : open == '(' ? ')' : open == '[' ? ']' : '>';
    int depth = 0;
    for (; i + 1 < tokens.size(); ++i) {
        depth += (tokens[i].code == open) - (tokens[i].code == close);
        if (depth == 0) break;
    }
    return i;
}

std::optional<std::size_t> BlockNumbers::read_number(std::size_t i, BodyValue& value) const {
    const std::size_t begin = tokens[i].at;
    const bool minus = tokens[i].code == '-';
    if (minus) ++i;
    if (tokens[i].code != number_code) return std::nullopt;
    if (begin > 0 && (is_letter(file.text[begin - 1]) || is_digit(file.text[begin - 1]))) return std::nullopt;
    std::size_t end = tokens[i].at;
    const std::size_t next = tokens[i + 1].at;
    while (end < next &&
           (is_digit(file.text[end]) || std::string_view(".eE").find(file.text[end]) != std::string_view::npos ||
            ((file.text[end] == '-' || file.text[end] == '+') && (file.text[end - 1] | 32) == 'e')))
        ++end;
    value.numbers.push_back(minus ? -tokens[i].number : tokens[i].number);
    value.slices.push_back({begin, end});
    return i + 1;
}

std::optional<std::size_t> BlockNumbers::read_value(std::size_t i, BodyValue& value) const {
    if (ends_value(tokens[i - 1]) && tokens[i].code == '-') return std::nullopt;
    if (is_operator(tokens[i - 1].code)) return std::nullopt;
    std::optional<std::size_t> end = i;
    if (tokens[i].code != '<') {
        end = read_number(i, value);
    } else {
        while (end && value.numbers.size() < 5) {
            end = read_number(*end + 1, value);
            if (end && tokens[*end].code != ',') break;
        }
        if (!end || tokens[*end].code != '>') return std::nullopt;
        ++*end;
    }
    return end && !is_operator(tokens[*end].code) ? end : std::nullopt;
}

std::size_t BlockNumbers::declaration(std::uint32_t name) const {
    std::size_t found = 0;
    for (std::size_t i = 0; i + 3 < tokens.size(); ++i) {
        const bool declares =
            tokens[i].code == '#' && (tokens[i].directive == word("declare") || tokens[i].directive == word("local"));
        if (!declares || tokens[i + 1].code != new_name_code || tokens[i + 1].index != name) continue;
        if (found > 0 || tokens[i + 2].code != '=') return 0;
        found = i + 3;
    }
    return found;
}

/// Reads what a name at `i` stands for; `name` is what the panel calls a number of it.
void BlockNumbers::read_name(std::size_t i, const std::string& name, int level) {
    if (is_operator(tokens[i - 1].code) || is_operator(tokens[i + 1].code) || tokens[i + 1].code == '(') return;
    const std::size_t at = level < most_levels && ++names_read <= most_names ? declaration(tokens[i].index) : 0;
    if (at == 0) return;
    const std::string source =
        "declare " + word_at(i) + ", line " + std::to_string(line_number(file.text, tokens[at].at));
    BodyValue value;
    if (tokens[at].code >= first_word_code && tokens[at + 1].code == '{')
        read_block(at, source, level + 1, "");
    else if (const auto end = read_value(at, value); end && (tokens[*end].code == ';' || tokens[*end].code == '#'))
        add(std::move(value), name, source);
}

/// Reads the block of the word at `begin`, and those of its parts. `part` comes before the names of its numbers.
void BlockNumbers::read_block(std::size_t begin, const std::string& source, int level, const std::string& part) {
    if (tokens[begin + 1].code != '{') return;
    const std::size_t end = closing(begin + 1), known = values.size();
    const std::vector<NamedArgument> arguments = arguments_of(word_at(begin));
    const bool body = is_one_of(tokens[begin].code, body_codes);
    std::vector<std::string> blocks;  // from the outermost, without the body's
    if (!body) blocks.push_back(word_at(begin));
    std::string last;
    bool argument = body;   // before the first word, numbers are the body's arguments
    std::size_t count = 0;  // of the body's arguments
    int parts = 0;
    const auto name = [&] {
        if (argument)
            return part + (count <= arguments.size() && count > 0 ? arguments[count - 1].name
                                                                  : word_at(begin) + " " + std::to_string(count));
        return part + (blocks.empty() ? last : blocks.back() + (last.empty() ? "" : " " + last));
    };
    for (std::size_t i = begin + 2; i < end; ++i) {
        const RawToken& token = tokens[i];
        if (token.code == '#') return values.resize(known);
        if (token.code == '}') {
            if (!blocks.empty()) blocks.pop_back();
            last.clear();
        } else if (token.code == '(' || token.code == '[' || token.code == '{') {
            i = closing(i);
        } else if (token.code >= first_word_code && !is_one_of(token.code, value_codes)) {
            const bool opens = tokens[i + 1].code == '{';
            argument = false;
            if (opens && is_one_of(token.code, body_codes)) {
                // Names are short: of parts of parts they begin with the innermost one.
                if (level < most_levels)
                    read_block(i, source, level + 1, word_at(i) + " " + std::to_string(++parts) + ": ");
                i = closing(i + 1), last.clear();
            } else if (opens) {
                blocks.push_back(word_at(i)), last.clear(), ++i;
            } else {
                last = word_at(i);
            }
        } else if (token.code == number_code || token.code == '-' || token.code == '<') {
            // An expression counts as an argument at its end.
            BodyValue value;
            if (const auto behind = read_value(i, value)) {
                count += argument;
                if (argument && count <= arguments.size()) value.range = arguments[count - 1].range;
                add(std::move(value), name(), source), i = *behind - 1;
            } else if (token.code == '<') {
                i = closing(i);
                if (i < end) count += argument && !is_operator(tokens[i + 1].code);
            } else {
                count += argument && token.code == number_code && !is_operator(tokens[i + 1].code);
            }
        } else if (token.code == new_name_code || is_one_of(token.code, value_codes)) {
            count += argument && !is_operator(tokens[i + 1].code);
            if (token.code == new_name_code) read_name(i, name(), level);
        }
    }
}

}  // namespace

std::vector<BodyValue> literals_of(const std::string& text, std::size_t at) try {
    return BlockNumbers(text).find(at);
} catch (const FileError&) {
    return {};
}

}  // namespace strahl::pov

// Messages about mistakes: where they are, what was meant, and what to do.
#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

#include "files/error.h"
#include "files/read_file.h"
#include "files/utf8.h"
#include "files/words.h"
#include "pov/language/interpreter.h"
#include "text/reading/messages.h"

namespace strahl::pov {
namespace {

namespace fs = std::filesystem;

/// A word of other programs, or of daily life, and POV-Ray's word for it.
struct ForeignWord {
    std::string_view word, own;
};
constexpr std::array foreign{
    ForeignWord{"ball", "sphere"},
    ForeignWord{"cube", "box"},
    ForeignWord{"light", "light_source"},
    ForeignWord{"group", "union"},
    ForeignWord{"subtract", "difference"},
    ForeignWord{"substract", "difference"},
    ForeignWord{"extrude", "prism"},
    ForeignWord{"revolve", "lathe"},
    ForeignWord{"floor", "plane"},
    ForeignWord{"position", "location"},
    ForeignWord{"eye", "location"},
    ForeignWord{"target", "look_at"},
    ForeignWord{"fov", "angle"},
    ForeignWord{"opacity", "transmit"},
    ForeignWord{"transparency", "transmit"},
    ForeignWord{"shininess", "phong_size"},
    ForeignWord{"reflect", "reflection"},
    ForeignWord{"glow", "emission"},
    ForeignWord{"move", "translate"},
    ForeignWord{"turn", "rotate"},
    ForeignWord{"resize", "scale"},
    ForeignWord{"gamma", "assumed_gamma"},
};

/// A word that one kind of block has, and a form of that block.
struct Home {
    std::string_view block, form;
    std::array<std::string_view, 12> words;
};
constexpr std::array homes{
    Home{"pigment",
         "pigment { ... }",
         {"rgb", "rgbf", "rgbt", "rgbft", "color", "color_map", "pigment_map", "image_map", "checker", "marble", "wood",
          "bozo"}},
    Home{"finish",
         "finish { ... }",
         {"ambient", "diffuse", "specular", "phong", "phong_size", "roughness", "reflection", "metallic", "brilliance",
          "emission", "conserve_energy", "irid"}},
    Home{"interior", "interior { ... }", {"ior", "caustics", "dispersion", "fade_color"}},
    Home{"camera", "camera { ... }", {"location", "look_at", "angle", "right", "sky", "focal_point", "aperture"}},
    Home{"light_source", "light_source { ... }", {"point_at", "spotlight", "area_light", "shadowless", "falloff"}},
    Home{"global_settings", "global_settings { ... }", {"assumed_gamma", "max_trace_level", "ambient_light"}},
};

/// Words that stand in bodies only.
constexpr std::array<std::string_view, 10> parts_of_bodies{"translate", "rotate", "scale",  "matrix",    "texture",
                                                           "pigment",   "finish", "normal", "no_shadow", "hollow"};

/// The words of composites, whose parts come first.
constexpr std::array<std::string_view, 4> composites{"union", "merge", "intersection", "difference"};

/// Returns the text of the token at the start of a text.
std::string_view token_of(std::string_view text) {
    const auto in_word = [](char c) { return is_letter(c) || is_digit(c); };
    std::size_t size = 1;
    if (text.empty()) return text;
    if (in_word(text[0]) || text[0] == '.')
        while (size < text.size() && (in_word(text[size]) || text[size] == '.')) ++size;
    if (is_letter(text[0])) size = std::min(size, text.find('.'));
    if (text[0] == '"') size = std::min({text.find('"', 1), text.find_first_of("\r\n"), text.size() - 1}) + 1;
    return text.substr(0, std::min(size, text.size()));
}

/// Returns the digits, points and commas around a place.
std::string_view number_around(std::string_view text, std::size_t at) {
    const auto outside = [](char c) { return !is_digit(c) && c != '.' && c != ','; };
    const auto begin = std::find_if(std::make_reverse_iterator(text.begin() + at), text.rend(), outside).base();
    const auto end = std::find_if(text.begin() + at, text.end(), outside);
    return {begin, end};
}

/// Does a text end in a colour of one number, as in `color 1`?
bool follows_colour_number(std::string_view text) {
    text = text.substr(0, text.find_last_not_of("0123456789.") + 1);
    text = text.substr(0, text.find_last_not_of(" \t") + 1);
    const std::array<std::string_view, 4> words{"color", "colour", "rgb", "srgb"};
    return std::ranges::any_of(words, [&](std::string_view word) { return text.ends_with(word); });
}

/// Is this a number with a decimal comma, as in 0,5?
bool has_decimal_comma(std::string_view number) {
    const std::size_t comma = number.find(',');
    return comma > 0 && comma + 1 < number.size() && comma != number.npos && number.find(',', comma + 1) == number.npos;
}

/// Does a vector consist of numbers that blanks divide, some of them with a decimal comma, as in <0,5 1 2,5>?
bool has_decimal_commas(std::string_view vector) {
    vector = vector.substr(1, vector.find_first_of(">{}\r\n") - 1);
    int numbers = 0, commas = 0;
    for (std::size_t at = 0; at < vector.size();) {
        if (!is_digit(vector[at]) && vector[at] != '.') {
            ++at;
            continue;
        }
        std::string_view number = number_around(vector, at);
        at += number.size();
        if (number.ends_with(',')) number.remove_suffix(1);
        if (number.find(',') != number.npos && !has_decimal_comma(number)) return false;
        commas += has_decimal_comma(number), ++numbers;
    }
    return numbers > 1 && commas > 0;
}

/// Does a text declare this name, as an include file does: `#declare NAME` or `#macro NAME`?
bool declares(std::string_view text, std::string_view name) {
    for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) continue;
        const std::string_view before = text.substr(0, at);
        const std::size_t word = before.find_last_not_of(" \t");
        if (word == before.npos || word + 1 == at) continue;
        const std::string_view left = before.substr(0, word + 1);
        if (left.ends_with("declare") || left.ends_with("macro")) return true;
    }
    return false;
}

/// Returns the name of a library's file that declares a name: of several the first, and old ones last; or nothing.
std::string declaring_file(const std::vector<std::string>& library, std::string_view name) {
    constexpr std::size_t most_text = 4u << 20;
    std::vector<std::string> found;
    for (const std::string& folder : library) {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder, error)) {
            if (entry.path().extension() != ".inc" || !entry.is_regular_file(error)) continue;
            if (entry.file_size(error) > most_text || error) continue;
            try {
                if (declares(read_text(entry.path().string(), most_text), name))
                    found.push_back(entry.path().filename().string());
            } catch (const FileError&) {  // a file that cannot be read declares nothing
            }
        }
    }
    std::ranges::sort(found, {},
                      [](const std::string& file) { return std::pair(file.find("old") != file.npos, file); });
    return found.empty() ? "" : found[0];
}

}  // namespace

std::string_view Interpreter::text_at(TextPlace at) const {
    return std::string_view(texts[at.file]->text).substr(at.at);
}

Message Interpreter::message_at(TextPlace at, const std::string& text) const {
    const TextFile& file = *texts[at.file];
    return {.text = text, .file = file.path, .line = line_number(file.text, at.at)};
}

std::string Interpreter::where(TextPlace at) const {
    const Message place = message_at(at, "");
    return place.file + ":" + std::to_string(place.line);
}

void Interpreter::fail(TextPlace at, const std::string& text_of_message) {
    Message message = message_at(at, text_of_message);
    const std::string_view text = texts[at.file]->text;
    const std::size_t start = text.substr(0, at.at).find_last_of("\r\n") + 1;
    const Shown before = show(text.substr(start, std::min<std::size_t>(at.at - start, 90)));
    const std::string_view rest =
        text.substr(at.at, std::min<std::size_t>(text.find_first_of("\r\n", at.at), text.size()) - at.at);
    message.column = 1 + static_cast<std::size_t>(std::count_if(text.begin() + start, text.begin() + at.at,
                                                                [](char c) { return !continues(c); }));
    if (at.at - start <= 90) {
        const Shown behind = show(rest.substr(0, 110 - std::min<std::size_t>(before.width, 90)));
        message.length = std::max(1, std::min(show(token_of(rest)).width, behind.width));
        message.excerpt = "\n    " + before.text + behind.text + "\n    " + std::string(before.width, ' ') + "^" +
                          std::string(message.length - 1, '~');
    }
    std::size_t told = 0;
    for (std::size_t i = readings.size(); i-- > 1;) {
        const Reading& reading = readings[i];
        if (++told > 8) {
            message.calls += "\n  and so on, " + std::to_string(i) + " levels more";
            break;
        }
        message.calls += reading.macro
                             ? "\n  in the macro " + strahl::quoted(names.text(reading.macro->name)) + ", called from "
                             : "\n  included from ";
        message.calls += where(reading.called);
        if (reading.called.file == 0) message.caller = message_at(reading.called, "").line;
    }
    throw FileError(std::vector{std::move(message)});
}

std::string Interpreter::advice_on_name(const std::string& name, const std::string& what) {
    const std::string_view before = std::string_view(texts[next.place.file]->text).substr(0, next.place.at);
    if (before.ends_with('"')) return "; is a '\"' missing before it?";
    const auto meant = [](std::string_view similar) { return "; did you mean " + strahl::quoted(similar) + "?"; };
    if (before.ends_with('#')) {
        const std::string_view similar = nearest(name, directives);
        const bool digits = name.find_first_not_of("0123456789abcdefABCDEF") == name.npos;
        return !similar.empty() ? meant(similar)
               : digits         ? "; colours are written rgb <1, 0, 0>"
                                : "; there is no such directive; #end ends loops, conditions and macros";
    }
    const std::string_view line = before.substr(before.find_last_of("\r\n") + 1);
    if (what == "a string" && line.find("#include") != line.npos)
        return "; file names stand in quotes: #include \"" + name + ".inc\"";
    std::vector<std::string_view> declared;
    for (std::uint32_t i = 0; i < names.size(); ++i)
        if (i != next.raw->index && symbols.find(i)) declared.push_back(names.text(i));
    for (const std::string_view own : declared)
        if (same_word(own, name)) return meant(own);
    if (const std::string file = declaring_file(options.library, name); !file.empty())
        return "; " + file + " declares it: #include \"" + file + "\"";
    for (const ForeignWord& row : foreign)
        if (same_word(row.word, name)) return meant(row.own);
    if (const std::string_view similar = nearest(name, declared); !similar.empty()) return meant(similar);
    const auto exists = [](const std::string& folder) {
        std::error_code error;
        return fs::is_directory(folder, error);
    };
    if (name[0] >= 'A' && name[0] <= 'Z' && std::ranges::none_of(options.library, exists))
        return "; POV-Ray's include files, which declare many names, are not installed; on Debian: apt install "
               "povray-includes";
    const bool value = what.starts_with("a number") || what == "a value";
    const bool called = cursor->code == '(';
    if (const std::string_view similar = nearest(name, reserved_words); similar.size() > 2 && (!value || called))
        return meant(similar);
    return value && !called ? "; declare it first: #declare " + name + " = ...;" : "";
}

void Interpreter::expected(const std::string& what) {
    code();
    wrong_token(what);
}

void Interpreter::wrong_token(const std::string& what) {
    const std::uint16_t found = next.code;
    const std::string_view text = texts[next.place.file]->text;
    const bool at_end_of_block = what.empty() || what == "'}'";
    if (!blocks.empty() && (found == end_code || at_end_of_block)) tell_open_block(at_end_of_block);
    std::string message = at_end_of_block ? "" : what + " expected, but found ";
    std::string advice;
    if (found == new_name_code) {
        if (Symbol* symbol = symbols.find(next.raw->index); symbol && value_of(*symbol).kind == ValueKind::array)
            fail(next.place, "this element of the array has no value yet");
        const std::string& name = names.text(next.raw->index);
        message = "unknown name " + strahl::quoted(name);
        if (!at_end_of_block) message += "; " + what + " expected";
        fail(next.place, message + advice_on_name(name, what));
    }
    if (found == value_code)
        message += strahl::quoted(names.text(next.raw->index)) + ", which is " + strahl::pov::name_of(next.value->kind);
    else if (found == '#' && next.raw->directive != end_code)
        message += strahl::quoted("#" + std::string(reserved_words[next.raw->directive - first_word_code]));
    else
        message += name_of_code(found);
    const std::string_view before = text.substr(0, next.place.at);
    const bool after_axis = before.ends_with(" x ") || before.ends_with(" y ") || before.ends_with(" z ");
    const auto* const row =
        found < first_word_code
            ? foreign.end()
            : std::ranges::find(foreign, reserved_words[found - first_word_code], &ForeignWord::word);
    if ((found == ',' || found == number_code) && has_decimal_comma(number_around(text, next.place.at)))
        advice = "; decimals have a point, as in 0.5";
    else if (found == number_code && after_axis)
        advice = "; a rotation is one vector, as in rotate 45*y";
    else if (row != foreign.end())
        advice = "; did you mean " + strahl::quoted(row->own) + "?";
    else if (found == '=')
        advice = "; values follow their words without '=', as in ior 1.5";
    else if (found == '^')
        advice = "; powers are written pow(x, 2)";
    else if (found == ',' && follows_colour_number(before))
        advice = "; a colour is written rgb <1, 0, 0>";
    else if (found == ';' && what.starts_with("a body"))
        advice = "; ';' ends only declarations, such as #declare A = 1;";
    else if (found == '}' && blocks.empty() && closed)
        advice = "; the block before it, which line " + std::to_string(line_number(text, closed->at)) +
                 " begins, is closed already";
    else if (found >= first_word_code && blocks.empty() && closed &&
             std::ranges::find(parts_of_bodies, reserved_words[found - first_word_code]) != parts_of_bodies.end())
        advice = "; it belongs inside the braces of the block before it, which line " +
                 std::to_string(line_number(text, closed->at)) + " begins";
    else if (*form)
        advice = std::string("; the order is ") + form;
    fail(next.place, message + (at_end_of_block ? " does not belong here" : "") + advice);
}

void Interpreter::tell_open_block(bool at_end_of_block) {
    const OpenBlock& open = blocks.back();
    const std::string_view own = token_of(text_at(open.word));
    const std::string name = open.word.file == open.brace.file && is_letter(own[0]) ? std::string(own) + " {" : "{";
    const std::string line = open.brace.file == next.place.file
                                 ? "line " + std::to_string(line_number(texts[open.brace.file]->text, open.brace.at))
                                 : where(open.brace);
    if (next.code == end_code) fail(open.brace, "this '{' is not closed: '}' expected before the end of the scene");
    if (!at_end_of_block || next.code < first_word_code) return;
    const std::string_view found = reserved_words[next.code - first_word_code];
    for (const Home& home : homes)
        if (home.block != own && std::ranges::find(home.words, found) != home.words.end())
            fail(next.place, strahl::quoted(found) + " does not belong here; it belongs in " + std::string(home.form));
    if (cursor->code != '{') return;
    std::string message = strahl::quoted(name) + " of " + line + " is not closed before " + strahl::quoted(found);
    const bool may_be_part = std::ranges::find(homes, found, &Home::block) == homes.end();
    if (may_be_part && std::ranges::find(composites, own) != composites.end())
        message += "; or, if this is a part: parts come before textures and transformations";
    fail(next.place, message);
}

void Interpreter::wrong_size(TextPlace before, const std::string& message) {
    const std::string_view text = texts[before.file]->text;
    const std::size_t end = before.at + token_of(text_at(before)).size();
    const std::size_t value = text.find_first_not_of(" \t\r\n,", end);
    const TextPlace start{before.file, static_cast<std::uint32_t>(value == text.npos ? before.at : value)};
    std::string advice;
    if (has_decimal_commas(text_at(start)))
        advice = "; decimals have a point, as in 0.5";
    else if (*form)
        advice = std::string("; the order is ") + form;
    fail(start, message + advice);
}

void Interpreter::open_vector(TextPlace start) {
    if (has_decimal_commas(text_at(start))) fail(start, "decimals have a point, as in 0.5");
    if (code() >= first_word_code || code() == '}' || code() == end_code)
        fail(start, "this '<' is not closed: '>' expected before " + name_of_code(code()));
    expected("'>'");
}

}  // namespace strahl::pov

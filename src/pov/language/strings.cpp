// Strings and the functions that make them.
#include <algorithm>
#include <cstdio>
#include <ctime>

#include "files/words.h"
#include "pov/language/interpreter.h"

namespace strahl::pov {
namespace {

/// Adds a character as UTF-8.
void add_character(std::string& text, unsigned code) {
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0 | (code >> 6));
        text += static_cast<char>(0x80 | (code & 63));
    } else {
        text += static_cast<char>(0xE0 | (code >> 12));
        text += static_cast<char>(0x80 | ((code >> 6) & 63));
        text += static_cast<char>(0x80 | (code & 63));
    }
}

/// Writes a number as POV-Ray's str() does: by printf, with at most 100 characters.
std::string formatted(double value, int length, int digits) {
    char format[40], text[512];
    const int width = std::clamp(std::abs(length), 0, 100);
    if (digits < 0)
        std::snprintf(format, sizeof format, length < 0 ? "%%0%df" : "%%%df", width);
    else
        std::snprintf(format, sizeof format, length < 0 ? "%%0%d.%df" : "%%%d.%df", width, std::min(digits, 100));
    std::snprintf(text, sizeof text, format, value);
    return text;
}

}  // namespace

bool Interpreter::at_string() {
    switch (code()) {
        case string_code:
        case word("str"):
        case word("vstr"):
        case word("concat"):
        case word("chr"):
        case word("substr"):
        case word("strupr"):
        case word("strlwr"):
        case word("datetime"):
            return true;
        case value_code:
            return next.value->kind == ValueKind::string;
        default:
            return false;
    }
}

NamedValue Interpreter::named(std::string text) {
    auto thing = std::make_shared<StringThing>(std::move(text));
    return {ValueKind::string, {}, std::move(thing)};
}

std::string Interpreter::read_string() {
    const Depth guard(*this);
    if (!at_string()) expected("a string");
    const std::uint16_t function = next.code;
    if (function == value_code) {
        std::string text = static_cast<const StringThing&>(*next.value->thing).text;
        take();
        return text;
    }
    if (function == string_code) {
        const std::string_view slice =
            std::string_view(texts[next.place.file]->text).substr(next.place.at + 1, next.raw->index);
        take();
        std::string text;
        for (std::size_t i = 0; i < slice.size(); ++i) {
            if (slice[i] != '\\') {
                text += slice[i];
                continue;
            }
            static constexpr std::string_view letters = "abfnrtv'\"\\", meanings = "\a\b\f\n\r\t\v'\"\\";
            const char c = ++i < slice.size() ? slice[i] : '\0';
            if (c == 'u' && i + 4 < slice.size()) {
                add_character(text, static_cast<unsigned>(
                                        std::strtoul(std::string(slice.substr(i + 1, 4)).c_str(), nullptr, 16)));
                i += 4;
            } else if (const std::size_t meaning = letters.find(c); meaning != letters.npos) {
                text += meanings[meaning];
            } else {
                fail(last,
                     "'\\' must be followed by one of abfnrtv, u and four digits, a quote or '\\'; write '\\\\' for "
                     "itself");
            }
        }
        return text;
    }
    take();
    const TextPlace at = last;
    expect('(');
    std::string text;
    const auto integer = [&] { return static_cast<int>(std::clamp(read_number(), -2e9, 2e9)); };
    switch (function) {
        case word("str"): {
            const double value = read_number();
            accept(',');
            const int length = integer();
            accept(',');
            text = formatted(value, length, integer());
            break;
        }
        case word("vstr"): {
            const int count = std::clamp(integer(), 2, 5);
            accept(',');
            Components value;
            sum(value);
            accept(',');
            const std::string between = read_string();
            accept(',');
            const int length = integer();
            accept(',');
            const int digits = integer();
            for (int i = 0; i < count; ++i) {
                if (i > 0) text += between;
                text += formatted(value.count == 1  ? value.value[0]
                                  : i < value.count ? value.value[i]
                                                    : 0,
                                  length, digits);
            }
            break;
        }
        case word("concat"):
            while (code() != ')') {
                text += read_string();
                accept(',');
                if (text.size() > 1 << 20) fail(at, "this string is longer than a million characters");
            }
            break;
        case word("chr"): {
            const int character = integer();
            if (character < 0 || character > 0xFFFF) fail(at, "invalid chr: there is no such character");
            if (character > 0) add_character(text, static_cast<unsigned>(character));
            break;
        }
        case word("substr"): {
            const std::string from = read_string();
            accept(',');
            const int first = integer();
            accept(',');
            const int length = integer();
            if (first < 0 || length < 0 ||
                first - 1 + static_cast<long long>(length) > static_cast<long long>(from.size()))
                fail(at, "invalid substr: the string has " + std::to_string(from.size()) + " characters");
            // In POV-Ray there is a 0 before the text, which ends a string.
            if (first > 0) text = from.substr(static_cast<std::size_t>(first - 1), static_cast<std::size_t>(length));
            break;
        }
        case word("strupr"):
        case word("strlwr"): {
            text = read_string();
            const bool up = function == word("strupr");
            for (char& c : text) {
                if (up && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
                if (!up) c = lower(c);
            }
            break;
        }
        default: {  // datetime
            const std::time_t seconds =
                static_cast<std::time_t>(std::clamp(read_number(), -1e6, 1e6) * 86400 + 946684800);
            std::string format = "%Y-%m-%d %H:%M:%SZ";
            if (accept(',')) format = read_string();
            char buffer[256];
            const std::tm* parts = std::gmtime(&seconds);
            if (parts) text.assign(buffer, std::strftime(buffer, sizeof buffer, format.c_str(), parts));
        }
    }
    expect(')');
    return text;
}

}  // namespace strahl::pov

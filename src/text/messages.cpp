// Faults, and how they are told.
#include "text/messages.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

#include "scene/error.h"

namespace strahl {
namespace {

constexpr const char* replacement = "\xEF\xBF\xBD";  // U+FFFD
constexpr int line_width = 100, before_fault = 60;   // columns shown of a long line

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

struct Character {
    std::uint32_t code;
    int bytes;
    bool valid;
};

/// The character that starts at text[i]; strict as in the Unicode standard, table 3-7.
Character decode(std::string_view text, std::size_t i) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
        return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0;
    };
    const std::uint32_t first = byte(0);
    if (first < 0x80) return {first, 1, first != 0};
    const int bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    std::uint32_t code = first & (0xFF >> (bytes + 1));
    for (int k = 1; k < bytes; ++k) {
        if ((byte(k) & 0xC0) != 0x80) return {0, 1, false};
        code = code << 6 | (byte(k) & 0x3F);
    }
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    const bool valid = first >= 0xC2 && first <= 0xF4 && code >= least[bytes] && code <= 0x10FFFF &&
                       !(code >= 0xD800 && code <= 0xDFFF);
    return valid ? Character{code, bytes, true} : Character{0, 1, false};
}

/// Characters that would steer a terminal, or turn the direction of writing, instead of showing themselves.
bool steers(std::uint32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0x200E && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
           (c >= 0x2066 && c <= 0x2069);
}

/// Columns a character takes on a terminal: 0 for marks that combine, 2 for East Asian and pictorial ones.
int columns(std::uint32_t c) {
    const auto in = [c](std::uint32_t low, std::uint32_t high) { return c >= low && c <= high; };
    if (in(0x300, 0x36F) || in(0x200B, 0x200D) || in(0x20D0, 0x20FF) || in(0xFE00, 0xFE0F)) return 0;
    return in(0x1100, 0x115F) || in(0x2E80, 0xA4CF) || in(0xAC00, 0xD7A3) || in(0xF900, 0xFAFF) || in(0xFE30, 0xFE6F) ||
                   in(0xFF00, 0xFF60) || in(0xFFE0, 0xFFE6) || in(0x1F300, 0x1FAFF) || in(0x20000, 0x3FFFD)
               ? 2
               : 1;
}

/// A stretch of a line as it is shown, with the columns it takes.
struct Shown {
    std::string text;
    int width = 0;
};
Shown show(std::string_view slice) {
    Shown shown;
    for (std::size_t i = 0; i < slice.size();) {
        const Character c = decode(slice, i);
        if (slice[i] == '\t') {
            shown.text += "    ";
            shown.width += 4;
        } else if (!c.valid || steers(c.code)) {
            shown.text += replacement;
            shown.width += 1;
        } else {
            shown.text += slice.substr(i, c.bytes);
            shown.width += columns(c.code);
        }
        i += c.bytes;
    }
    return shown;
}

/// Moves `i` in text by `count` characters, but not past `end`.
std::size_t back(std::string_view text, std::size_t i, std::size_t end, int count) {
    while (count-- > 0 && i > end) do
            --i;
        while (i > end && continues(text[i]));
    return i;
}
std::size_t forth(std::string_view text, std::size_t i, std::size_t end, int count) {
    while (count-- > 0 && i < end) do
            ++i;
        while (i < end && continues(text[i]));
    return i;
}

/// Insertions, deletions, replacements and swaps of neighbours that lead from a to b; capitals count as small letters.
std::size_t distance(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before = std::exchange(above, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row[b.size()];
}

}  // namespace

void Faults::add(std::string_view at, std::string message) {
    for (const Fault& fault : faults)
        if (fault.at.data() == at.data()) return;
    faults.push_back({at, std::move(message)});
    if (faults.size() == most) check();
}

void Faults::check() const {
    if (faults.empty()) return;
    std::vector<Fault> sorted = faults;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Fault& a, const Fault& b) { return a.at.data() < b.at.data(); });
    std::string all;
    for (const Fault& fault : sorted) all += (all.empty() ? "" : "\n") + tell(fault);
    if (sorted.size() == most)
        all += "\n" + std::string(file) + ": there may be more; these are the first " + std::to_string(most);
    throw FileError(all);
}

std::string Faults::line(std::string_view at) const {
    return "line " + std::to_string(1 + std::count(text.data(), at.data(), '\n'));
}

std::string Faults::tell(const Fault& fault) const {
    std::size_t at = fault.at.data() - text.data();
    if (at == text.size()) at = text.find_last_not_of(" \t\r\n") + 1;  // where the text ends for a reader
    const std::size_t newline = at == 0 ? text.npos : text.rfind('\n', at - 1);
    const std::size_t start = newline == text.npos ? 0 : newline + 1;
    const std::size_t end = std::min({text.find('\n', at), text.find('\r', at), text.size()});

    const auto line_number = 1 + std::count(text.begin(), text.begin() + start, '\n');
    const auto column =
        1 + std::count_if(text.begin() + start, text.begin() + at, [](char c) { return !continues(c); });
    // Of a long line, what is around the fault; where one side is short the other gets its room.
    const std::size_t reach = forth(text, at, end, line_width - before_fault);
    const auto right_of_fault = static_cast<int>(reach < end ? line_width - before_fault : reach - at);
    const std::size_t from = back(text, at, start, line_width - right_of_fault);
    const std::size_t to = forth(text, from, end, line_width);
    const std::size_t fault_end = std::clamp(at + fault.at.size(), at, to);

    const Shown before = show(text.substr(from, at - from)), marked = show(text.substr(at, fault_end - at));
    const Shown after = show(text.substr(fault_end, to - fault_end));
    const std::string left = from > start ? "..." : "", right = to < end ? "..." : "";
    return std::string(file) + ":" + std::to_string(line_number) + ":" + std::to_string(column) + ": " + fault.message +
           "\n    " + left + before.text + marked.text + after.text + right + "\n    " +
           std::string(left.size() + before.width, ' ') + "^" + std::string(std::max(0, marked.width - 1), '~');
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> known) {
    if (word.size() > 40) return {};
    std::string_view best;
    std::size_t best_distance = 1 + std::max<std::size_t>(1, word.size() / 3);
    for (const std::string_view candidate : known)
        if (const std::size_t d = distance(word, candidate); d < best_distance) best_distance = d, best = candidate;
    if (!best.empty() || word.size() < 3) return best;
    for (const std::string_view candidate : known)  // cut short, or with an ending: "trans", "light_source"
        if (candidate.starts_with(word) || (candidate.size() >= 3 && word.starts_with(candidate))) return candidate;
    return {};
}

std::string unknown_word(std::string_view word, std::span<const std::string_view> known, const std::string& where) {
    const std::string message = "unknown word " + quoted(word) + where;
    if (const std::string_view near = nearest(word, known); !near.empty())
        return message + "; did you mean " + quoted(near) + "?";
    std::string list;
    for (const std::string_view candidate : known) list += (list.empty() ? "" : ", ") + std::string(candidate);
    return message + "; known here: " + list;
}

std::string quoted(std::string_view slice) {
    const std::size_t end = forth(slice, 0, slice.size(), 40);
    return "'" + show(slice.substr(0, end)).text + (end < slice.size() ? "..." : "") + "'";
}

std::size_t find_invalid(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        if (const char c = text[i]; c > 0) {
            ++i;
            continue;
        }
        const Character c = decode(text, i);
        if (!c.valid) return i;
        i += c.bytes;
    }
    return text.npos;
}

}  // namespace strahl

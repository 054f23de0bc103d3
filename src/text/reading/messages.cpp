// Collects errors and formats their messages.
#include "text/reading/messages.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "files/utf8.h"
#include "text/reading/advice.h"

namespace strahl {
namespace {

constexpr int line_width = 100, before_fault = 60;  // characters of a long line that are shown

/// The number of insertions, deletions, replacements and swaps of neighbours from a to b, regardless of case.
std::size_t distance(std::string_view a, std::string_view b) {
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

void Diagnostics::add(std::string_view at, std::string message) {
    for (const Fault& fault : faults)
        if (fault.at.data() == at.data()) return;
    faults.push_back({at, std::move(message)});
    if (faults.size() == most) check();
}

void Diagnostics::check() const {
    if (faults.empty()) return;
    std::vector<Fault> sorted = faults;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Fault& a, const Fault& b) { return a.at.data() < b.at.data(); });
    std::vector<Message> all;
    for (const Fault& fault : sorted) all.push_back(message_of(fault));
    if (sorted.size() == most)
        all.push_back({"there may be more; these are the first " + std::to_string(most), std::string(file)});
    throw FileError(std::move(all));
}

void Diagnostics::check_encoding() {
    const std::size_t i = find_invalid(text);
    if (i == text.npos) return;
    add(text.substr(i, 1),
        text[i] == '\0' ? "a byte 0 in the text; is this a text file?" : "not UTF-8; save the file in that encoding");
    check();
}

TextOrigin Diagnostics::origin(std::string_view at) const {
    const auto offset = static_cast<std::size_t>(at.data() - text.data());
    const auto behind = std::ranges::upper_bound(origins, offset, {}, &TextOrigin::at);
    if (behind == origins.begin()) return {offset, file, text, offset};
    TextOrigin own = behind[-1];
    own.source_at = std::min(own.source_at + (offset - own.at), own.source.size());
    return own;
}

std::string Diagnostics::line(std::string_view at) const {
    const TextOrigin own = origin(at);
    return "line " + std::to_string(line_number(own.source, own.source_at));
}

Message Diagnostics::message_of(const Fault& fault) const {
    const TextOrigin own = origin(fault.at);
    const std::string_view source = own.source;
    std::size_t at = own.source_at;
    if (at == source.size()) at = source.find_last_not_of(" \t\r\n") + 1;  // where the text visibly ends
    const std::size_t newline = at == 0 ? source.npos : source.find_last_of("\r\n", at - 1);
    const std::size_t start = newline == source.npos ? 0 : newline + 1;
    const std::size_t end = std::min({source.find('\n', at), source.find('\r', at), source.size()});

    const auto column =
        1 + std::count_if(source.begin() + start, source.begin() + at, [](char c) { return !continues(c); });
    // Shows only the part of a long line around the error; if one side is short the other gets its space.
    const std::size_t reach = forth(source, at, end, line_width - before_fault);
    const auto right_of_fault = static_cast<int>(reach < end ? line_width - before_fault : reach - at);
    const std::size_t from = back(source, at, start, line_width - right_of_fault);
    const std::size_t to = forth(source, from, end, line_width);
    const std::size_t fault_end = std::clamp(at + fault.at.size(), at, to);

    const Shown before = show(source.substr(from, at - from)), marked = show(source.substr(at, fault_end - at));
    const Shown after = show(source.substr(fault_end, to - fault_end));
    const std::string left = from > start ? "..." : "", right = to < end ? "..." : "";
    const std::size_t length = std::max(1, marked.width);
    return {.text = fault.message,
            .file = std::string(own.file),
            .line = line_number(source, start),
            .column = static_cast<std::size_t>(column),
            .length = length,
            .excerpt = "\n    " + left + before.text + marked.text + after.text + right + "\n    " +
                       std::string(left.size() + before.width, ' ') + "^" + std::string(length - 1, '~')};
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> known) {
    if (word.size() > 40) return {};
    std::string_view best;
    std::size_t best_distance = 1 + std::max<std::size_t>(1, word.size() / 3);
    for (const std::string_view candidate : known)
        if (const std::size_t d = distance(word, candidate); d < best_distance) best_distance = d, best = candidate;
    if (!best.empty() || word.size() < 3) return best;
    for (const std::string_view candidate : known)  // abbreviated or extended: "trans", "light_source"
        if (candidate.starts_with(word) || (candidate.size() >= 3 && word.starts_with(candidate))) return candidate;
    return {};
}

std::string unknown_word(std::string_view word, std::span<const std::string_view> known, const std::string& where) {
    const std::string message = "unknown word " + quoted(word) + where;
    if (const std::string advice = advice_on_word(word, known); !advice.empty()) return message + "; " + advice;
    if (const std::string_view near = nearest(word, known); !near.empty())
        return message + "; did you mean " + quoted(near) + "?";
    return message + "; known here: " + listed(known);
}

}  // namespace strahl

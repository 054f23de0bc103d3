#include "import/word_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "text/reading/messages.h"
#include "text/reading/parameter.h"

namespace strahl {
namespace {

/// Reads the whole word as a finite number.
bool read(std::string_view word, double& value) { return read_number(word, value) && std::isfinite(value); }

}  // namespace

void WordReader::skip() {
    if (!guard.moves(text.data() + next)) fail_at(text.substr(next, 0), "this text cannot be read further than here");
    while (next < text.size()) {
        const char c = text[next];
        if (c == '#') {
            next = std::min(text.find_first_of("\r\n", next), text.size());
        } else if (is_space(c)) {
            const bool pair = c == '\r' && next + 1 < text.size() && text[next + 1] == '\n';
            next_line += c == '\n' || (c == '\r' && !pair);
            ++next;
        } else {
            return;
        }
    }
}

std::string_view WordReader::peek() {
    skip();
    const auto* const start = text.begin() + static_cast<std::ptrdiff_t>(next);
    return {start, static_cast<std::size_t>(std::find_if(start, text.end(), is_space) - start)};
}

std::string_view WordReader::take(const char* what) {
    const std::string_view word = peek();
    if (word.empty()) fail_ahead(std::string(what) + " expected");
    next += word.size();
    taken_line = next_line;
    return taken = word;
}

bool WordReader::accept(std::string_view word) {
    if (!same_word(peek(), word)) return false;
    take("");
    return true;
}

std::string_view WordReader::choose(std::initializer_list<std::string_view> words) {
    for (const std::string_view word : words)
        if (accept(word)) return word;
    fail_ahead("'" + listed(words, "' or '") + "' expected");
}

double WordReader::number(const char* what) {
    const std::string_view word = peek();
    double value = 0;
    if (!read(word, value)) fail_ahead("a number expected for " + std::string(what));
    take(what);
    return value;
}

DVec3 WordReader::vector(const char* what) {
    DVec3 v;
    for (int i = 0; i < 3; ++i) v[i] = number(what);
    return v;
}

Color WordReader::color(const char* what) {
    Color color;
    for (int i = 0; i < 3; ++i) {
        color[i] = number(what);
        if (!not_negative.contains(color[i])) fail(std::string(what) + " must be three numbers " + not_negative.words);
    }
    return color;
}

long WordReader::whole(const char* what, long low, long high) {
    const double value = number(what);
    if (value != std::floor(value) || value < static_cast<double>(low) || value > static_cast<double>(high))
        fail(std::string(what) + " must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    return static_cast<long>(value);
}

bool WordReader::number_in_line() {
    double value = 0;
    return read(peek(), value) && next_line == taken_line;
}

void WordReader::fail(const std::string& message) { fail_at(taken, message); }

void WordReader::fail_ahead(const std::string& message) {
    const std::string_view here = peek();
    fail_at(here, message + (here.empty() ? ", but the file ends" : ", but found " + quoted(here)));
}

void WordReader::fail_at(std::string_view at, const std::string& message) const {
    Diagnostics diagnostics(text, file);
    diagnostics.add(at.data() ? at : text.substr(0, 0), message);
    diagnostics.check();
    std::abort();  // check() has thrown
}

}  // namespace strahl

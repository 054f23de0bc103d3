// Messages about mesh files, and numbers in their text.
#include "mesh/source.h"

#include <algorithm>
#include <charconv>

#include "num/decimal.h"

namespace strahl {
namespace {

/// Counted from 1. Lines end in a line feed, a carriage return, or both.
std::size_t line_number(std::string_view text, const char* at) {
    std::size_t line = 1;
    for (const char *c = text.data(), *end = c + text.size(); c < at; ++c)
        line += *c == '\n' || (*c == '\r' && (c + 1 == end || c[1] != '\n'));
    return line;
}

}  // namespace

void Source::fail(const std::string& message, const char* at) const {
    throw FileError(path + ":" + (at ? std::to_string(line_number(bytes, at)) + ":" : "") + " " + message);
}

std::string Source::fault(const DVec3& point) {
    const auto fine = [](double c) { return c >= -1e9 && c <= 1e9; };  // as in scenes; false for NaN
    if (fine(point.x) && fine(point.y) && fine(point.z)) return "";
    return "lies at " + text_of(point) + "; coordinates go from -1e9 to 1e9";
}

void Source::check_triangles(std::uint64_t count) const {
    if (count > limits.most_triangles)
        fail("this mesh has more than " + counted(limits.most_triangles, "triangle") +
             "; simplify it, or split it into several files");
}

void Source::check_points(std::uint64_t count) const {
    if (count > limits.most_points)
        fail("this mesh has more than " + counted(limits.most_points, "point") +
             "; simplify it, or split it into several files");
}

std::string quoted_word(std::string_view word) {
    constexpr std::size_t most = 40;
    return std::string("'") + std::string(word.substr(0, most)) + (word.size() > most ? "..." : "") + "'";
}

std::string counted(std::uint64_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

bool number_of(std::string_view word, double& number) {
    const char* start = word.data();
    const char* const end = start + word.size();
    if (word.size() > 1 && *start == '+' && start[1] != '-') ++start;
    const auto [stop, fault] = std::from_chars(start, end, number);
    return stop == end && fault == std::errc();
}

double Words::number(const char* what) {
    const std::string_view word = next();
    double value = 0;
    if (word.empty() && end == source->bytes.data() + source->bytes.size())
        fail(std::string("the file ends where ") + what + " should be; it was cut off, so get it anew");
    if (word.empty()) fail(std::string("this line ends where ") + what + " should be");
    if (!number_of(word, value)) fail(quoted_word(word) + " should be " + what);
    return value;
}

}  // namespace strahl

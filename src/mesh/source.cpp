#include "mesh/source.h"

#include <algorithm>

#include "num/decimal.h"

namespace strahl {

void Losses::add(const Loss& loss, std::uint64_t count, const Where& where) {
    auto known = std::ranges::find(list, loss, &Counted::loss);
    if (known == list.end()) known = list.insert(known, {loss, 0, 0, where()});
    known->count += count, ++known->times;
}

std::vector<std::string> Losses::warnings(const std::string& path) const {
    std::vector<std::string> warnings;
    for (const auto& [loss, count, times, first] : list)
        warnings.push_back(path + ": " + loss.did + counted(count, loss.noun) + loss.rest + " (" +
                           (times > 1 ? "first " : "") + first + ")");
    return warnings;
}

void Source::fail(const std::string& message, const char* at) const {
    const auto line = [&] { return std::to_string(line_number(bytes, static_cast<std::size_t>(at - bytes.data()))); };
    throw FileError(path + ":" + (at ? line() + ":" : "") + " " + message);
}

std::string Source::line_at(const char* at) const {
    return "in line " + std::to_string(line_number(bytes, static_cast<std::size_t>(at - bytes.data())));
}

std::string Source::fault(const DVec3& point) {
    return "lies at " + text_of(point) + "; coordinates are from -1e9 to 1e9";
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

std::string counted(std::uint64_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

bool begins_with(std::string_view text, std::string_view word) {
    const auto start = std::ranges::find_if_not(text, is_space);
    const std::string_view rest(start, text.end());
    return rest.size() >= word.size() && same_word(rest.substr(0, word.size()), word);
}

double Words::number(const char* what) {
    const std::string_view word = next();
    double value = 0;
    if (word.empty() && end == source->bytes.data() + source->bytes.size())
        fail(std::string("the file ends where ") + what + " should be; it was cut off, so get a new copy");
    if (word.empty()) fail(std::string("this line ends where ") + what + " should be");
    if (!read_number(word, value)) fail(quoted(word) + " should be " + what);
    return value;
}

}  // namespace strahl

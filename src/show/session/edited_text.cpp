#include "show/session/edited_text.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace strahl {
namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
    Lines lines;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

std::string text_of(const Lines& lines) {
    std::string text;
    for (const std::string& line : lines) text.append(&line == &lines.front() ? "" : "\n").append(line);
    return text;
}

/// Says where the lines of a text went in another one that was made from it: those before and behind all differences
/// are there, the others are not.
class MovedLines {
  public:
    MovedLines(const Lines& from, const Lines& to) : size(from.size()), moved(to.size()) {
        const std::size_t shorter = std::min(size, moved);
        same_before = std::size_t(std::ranges::mismatch(from, to).in1 - from.begin());
        while (same_behind < shorter - same_before && from[size - 1 - same_behind] == to[moved - 1 - same_behind])
            ++same_behind;
    }
    std::optional<std::size_t> operator()(std::size_t line) const {
        if (line < same_before) return line;
        if (line + same_behind >= size) return line + moved - size;
        return std::nullopt;
    }

  private:
    std::size_t size, moved, same_before = 0, same_behind = 0;
};

}  // namespace

std::string merged_lines(const std::string& base, const std::string& mine, const std::string& theirs, bool& lost) {
    const Lines from = lines_of(base), own = lines_of(mine);
    Lines to = lines_of(theirs);
    const MovedLines moved(from, to), written(own, to);
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (own[i] == from[i]) continue;
        const auto there = moved(i);
        if (there)
            to[*there] = own[i];
        else if (!written(i))
            lost = true;
    }
    return text_of(to);
}

std::vector<EditedText::ChangedLine> EditedText::differences(const std::string& before, const std::string& after) {
    const Lines old = lines_of(before), newer = lines_of(after);
    std::vector<ChangedLine> lines;
    for (std::size_t i = 0; i < old.size(); ++i)
        if (old[i] != newer[i]) lines.push_back({i, old[i], newer[i]});
    return lines;
}

void EditedText::apply(const Step& step, std::string ChangedLine::*to) {
    Lines lines = lines_of(present);
    for (const ChangedLine& line : step.lines) lines[line.number] = line.*to;
    present = text_of(lines);
}

std::vector<std::string> EditedText::unwritten() const {
    std::vector<std::string> lines;
    for (const ChangedLine& line : differences(saved, present))
        lines.push_back(std::to_string(line.number + 1) + ": " + line.after);
    return lines;
}

void EditedText::change(const std::string& newer, bool merged, std::size_t others) {
    constexpr std::size_t most_steps = 500;
    if (newer == present) return;
    std::string older = present;
    if (merged && !past.empty()) {
        apply(past.back(), &ChangedLine::before);
        older = present;
        past.pop_back();
    }
    past.push_back({differences(older, newer), others});
    if (past.size() > most_steps) past.erase(past.begin());
    future.clear();
    present = newer;
}

bool EditedText::undo(std::size_t others) { return move_step(past, future, &ChangedLine::before, others); }

bool EditedText::redo(std::size_t others) { return move_step(future, past, &ChangedLine::after, others); }

/// Applies the last step of `from` and moves it to the end of `into`. False if there is none with this many others.
bool EditedText::move_step(std::vector<Step>& from, std::vector<Step>& into, std::string ChangedLine::*to,
                           std::size_t others) {
    if (from.empty() || from.back().others != others) return false;
    apply(from.back(), to);
    into.push_back(std::move(from.back()));
    from.pop_back();
    return true;
}

bool EditedText::reload(const std::string& theirs) {
    if (theirs == saved) return false;
    if (past.empty() && future.empty()) return open(theirs), false;
    if (theirs == present) return saved = theirs, false;  // these changes were written
    bool lost = false;
    const Lines to = lines_of(theirs);
    const MovedLines moved(lines_of(saved), to), written(lines_of(present), to);
    // Steps before one that cannot be found again would not lead to it.
    const auto keep = [&](std::vector<Step>& steps) {
        std::size_t kept = steps.size();
        for (bool found = true; found && kept > 0;) {
            for (ChangedLine& line : steps[kept - 1].lines) {
                const auto there = moved(line.number), there_changed = written(line.number);
                found &= there || there_changed;
                line.number = there ? *there : there_changed.value_or(0);
            }
            if (found) --kept;
        }
        steps.erase(steps.begin(), steps.begin() + std::ptrdiff_t(kept));
    };
    keep(past), keep(future);
    present = merged_lines(saved, present, theirs, lost);
    saved = theirs;
    return lost;
}

}  // namespace strahl

#include "show/session/edited_text.h"

#include <algorithm>
#include <map>
#include <span>
#include <string_view>
#include <utility>

namespace strahl {
namespace {

using Lines = std::vector<std::string>;

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

/// Slots of one line each.
LineSlots slots_of(std::span<const std::string_view> lines) {
    LineSlots slots;
    for (const std::string_view line : lines) slots.push_back({std::string(line)});
    return slots;
}

/// The slots whose lines stand at the beginning and at the end of another text, all others being between them.
struct KeptSlots {
    KeptSlots(const LineSlots& slots, std::span<const std::string_view> to) {
        std::size_t left = to.size();
        const auto fits = [&](const Lines& slot, std::size_t at) {
            return slot.size() <= left && std::ranges::equal(slot, to.subspan(at, slot.size()));
        };
        for (std::size_t at = 0; front < slots.size() && fits(slots[front], at); ++front)
            at += slots[front].size(), left -= slots[front].size();
        for (std::size_t end = to.size(); front + back < slots.size(); ++back) {
            const Lines& slot = slots[slots.size() - 1 - back];
            if (slot.size() > left || !fits(slot, end - slot.size())) return;
            end -= slot.size(), left -= slot.size();
        }
    }

    std::size_t front = 0, back = 0;
};

}  // namespace

std::string text_of(const LineSlots& slots) {
    std::string text;
    bool first = true;
    for (const Lines& slot : slots)
        for (const std::string& line : slot) text.append(std::exchange(first, false) ? "" : "\n").append(line);
    return text;
}

std::size_t RebasedText::moved(std::size_t slot) const {
    return slot < front ? slot : slot + back >= size ? slot + text.changed.size() - size : text.changed.size();
}

RebasedText rebased(const ChangedText& text, const std::string& theirs) {
    const std::vector<std::string_view> to = lines_of(theirs);
    const std::size_t size = text.in_file.size();
    // Lines are found by what the file had, or by changes that were written; at each end by what reaches further.
    const KeptSlots same(text.in_file, to), written(text.changed, to);
    RebasedText result{.front = std::max(same.front, written.front), .size = size};
    result.back = std::min(std::max(same.back, written.back), size - result.front);
    const auto is_written = [&](std::size_t i) {
        return i < result.front ? written.front > same.front : written.back > same.back;
    };
    const auto in_theirs = [&](std::size_t i) { return is_written(i) ? text.changed[i] : text.in_file[i]; };
    LineSlots& in_file = result.text.in_file;
    std::size_t ahead = 0, behind = 0;  // lines
    for (std::size_t i = 0; i < result.front; ++i) ahead += in_file.emplace_back(in_theirs(i)).size();
    for (std::size_t i = size - result.back; i < size; ++i) behind += in_theirs(i).size();
    for (std::size_t i = ahead; i + behind < to.size(); ++i) in_file.push_back({std::string(to[i])});
    for (std::size_t i = size - result.back; i < size; ++i) in_file.push_back(in_theirs(i));
    if (text_of(in_file) != theirs)  // equal lines were found at several places
        return {.text = {slots_of(to), slots_of(to)}, .lost = text.in_file != text.changed, .size = size};
    result.text.changed = in_file;
    for (std::size_t i = 0; i < size; ++i) {
        if (text.changed[i] == text.in_file[i]) continue;
        if (i >= result.front && i + result.back < size)
            result.lost = true;
        else if (!is_written(i))
            result.text.changed[result.moved(i)] = text.changed[i];
    }
    return result;
}

void EditedText::open(const std::string& text) {
    *this = {};
    saved = present = text;
}

/// Makes this the present text. Returns the slots that have changed.
EditedText::Change EditedText::replace(const std::string& newer) {
    if (lines.in_file.empty()) lines.in_file = lines.changed = slots_of(lines_of(saved));
    const std::vector<std::string_view> old = lines_of(present), now = lines_of(newer);
    const std::size_t shorter = std::min(old.size(), now.size());
    const auto first = std::size_t(std::ranges::mismatch(old, now).in1 - old.begin());
    std::size_t behind = 0;
    while (behind < shorter - first && old[old.size() - 1 - behind] == now[now.size() - 1 - behind]) ++behind;
    const std::size_t removed = old.size() - behind - first, added = now.size() - behind - first;

    struct LinePlace {
        std::size_t slot, line;
    };
    std::vector<LinePlace> places;  // new places of the old lines
    for (std::size_t i = 0; i < lines.changed.size(); ++i)
        for (std::size_t k = 0; k < lines.changed[i].size(); ++k) places.push_back({i, k});
    std::map<std::size_t, Lines> before;
    const auto change_slot = [&](std::size_t slot) -> Lines& {
        before.emplace(slot, lines.changed[slot]);
        return lines.changed[slot];
    };
    if (removed == added) {
        for (std::size_t i = first; i < first + removed; ++i)
            if (old[i] != now[i]) change_slot(places[i].slot)[places[i].line] = now[i];
    } else {
        // All new lines take the place of the first one removed, or follow the one before.
        LinePlace to = removed > 0 || first == 0 ? places[first] : places[first - 1];
        if (removed == 0 && first > 0) ++to.line;
        for (std::size_t i = first + removed; i-- > first;) {
            Lines& slot = change_slot(places[i].slot);
            slot.erase(slot.begin() + std::ptrdiff_t(places[i].line));
        }
        Lines& slot = change_slot(to.slot);
        slot.insert(slot.begin() + std::ptrdiff_t(to.line), now.begin() + std::ptrdiff_t(first),
                    now.begin() + std::ptrdiff_t(first + added));
    }
    Change changes;
    for (auto& [slot, lines_before] : before) changes.push_back({slot, std::move(lines_before), lines.changed[slot]});
    present = newer;
    return changes;
}

void EditedText::apply(const Change& change, Lines ChangedSlot::*to) {
    for (const ChangedSlot& slot : change) lines.changed[slot.number] = slot.*to;
    present = text_of(lines.changed);
}

std::vector<std::string> EditedText::unwritten() const {
    std::vector<std::string> list;
    std::size_t number = 1;
    for (std::size_t i = 0; i < lines.changed.size(); ++i) {
        const Lines& now = lines.changed[i];
        Lines lost = lines.in_file[i];
        for (const std::string& line : now)
            if (const auto same = std::ranges::find(lost, line); same != lost.end())
                lost.erase(same);
            else
                list.push_back(std::to_string(number + std::size_t(&line - now.data())) + ": " + line);
        if (now.size() < lines.in_file[i].size())
            for (const std::string& line : lost) list.push_back(std::to_string(number) + ", removed: " + line);
        number += now.size();
    }
    return list;
}

bool EditedText::change(const std::string& newer, const Edit& edit) {
    if (newer == present) return false;
    if (edit.merged && !steps.past.empty()) {
        apply(steps.past.back().change, &ChangedSlot::before);
        steps.past.pop_back();
        if (newer == present) return true;
    }
    steps.add(replace(newer), edit);
    return true;
}

std::optional<std::string> EditedText::undo(bool back, EditOrder& order) {
    return steps.move(back, order,
                      [&](const Change& change) { apply(change, back ? &ChangedSlot::before : &ChangedSlot::after); });
}

bool EditedText::reload(const std::string& theirs) {
    if (theirs == saved) return false;
    if (steps.past.empty() && steps.future.empty()) return open(theirs), false;
    saved = theirs;
    if (theirs == present) return lines.in_file = lines.changed, false;  // these changes were written
    RebasedText rebased = strahl::rebased(lines, theirs);
    // Steps before one that cannot be found again would not lead to it.
    const auto keep = [&](auto& list) {
        std::size_t kept = list.size();
        for (bool found = true; found && kept > 0;) {
            for (ChangedSlot& slot : list[kept - 1].change) {
                slot.number = rebased.moved(slot.number);
                found &= slot.number < rebased.text.changed.size();
            }
            if (found) --kept;
        }
        list.erase(list.begin(), list.begin() + std::ptrdiff_t(kept));
    };
    keep(steps.past), keep(steps.future);
    lines = std::move(rebased.text), present = text_of(lines.changed);
    return rebased.lost;
}

}  // namespace strahl

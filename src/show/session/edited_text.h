// The text of the scene file while it is changed in the window, with undo and redo.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "show/session/edits.h"

namespace strahl {

/// A text as it was made of another one, the file's: for each line of that the lines in its place. That is one, or none
/// if the line was removed, or several if lines were added behind it.
using LineSlots = std::vector<std::vector<std::string>>;

/// The scene's text as it was read from the file, and with the changes that are not in the file yet.
struct ChangedText {
    LineSlots in_file, changed;  // both have the same size
};

/// A changed text after the file itself has become another one.
struct RebasedText {
    ChangedText text{};
    bool lost = false;  // a change lay between the first and the last line that differ in the file, which stay there
    std::size_t front = 0, back = 0, size = 0;  // how many slots stay at both ends, and how many there were
    /// Returns the new number of a slot; a number out of range for one that is no longer there.
    std::size_t moved(std::size_t slot) const;
};
RebasedText rebased(const ChangedText& text, const std::string& theirs);
/// Returns the text of slots.
std::string text_of(const LineSlots& slots);

class EditedText {
  public:
    /// Begins with another file's text, or none.
    void open(const std::string& text);
    /// The text with all changes.
    const std::string& text() const { return present; }
    bool changed() const { return present != saved; }
    /// Returns the changes, for writing them into the file.
    const ChangedText& changes() const { return lines; }
    /// Lines that would be lost now, with their numbers: "6: sphere { ... }", and those that were removed.
    std::vector<std::string> unwritten() const;

    /// Replaces the text. Returns whether it has changed.
    bool change(const std::string& newer, const Edit& edit);
    /// Takes the last change back, or makes it again. Returns what it was; nothing if there is none.
    std::optional<std::string> undo(bool back, EditOrder& order);
    /// See EditSteps::next.
    std::size_t next_step(bool back, const EditOrder& order) const { return steps.next(back, order); }

    /// To be called when the file was read, with its text. The changes stay as in `rebased`. Returns whether one was
    /// lost.
    bool reload(const std::string& theirs);

  private:
    struct ChangedSlot {
        std::size_t number;
        std::vector<std::string> before, after;
    };
    using Change = std::vector<ChangedSlot>;
    Change replace(const std::string& newer);
    void apply(const Change& change, std::vector<std::string> ChangedSlot::*to);

    ChangedText lines;           // empty until something is changed
    std::string saved, present;  // the same as texts
    EditSteps<Change> steps;
};

}  // namespace strahl

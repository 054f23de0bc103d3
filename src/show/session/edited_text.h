// The text of the scene file while it is changed in the window, with undo and redo.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace strahl {

/// A text as it was made of another one, the file's: for each line of that the lines in its place. That is one, or none
/// if the line was removed, or several if lines were added behind it.
using LineSlots = std::vector<std::vector<std::string>>;

/// The scene's text as it was read from the file, and with the changes that are not in the file yet.
struct ChangedText {
    LineSlots in_file, changed;  // of the same size
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

    /// Replaces the text. If `merged`, undo takes back this change and the one before together. `others` is how many
    /// changes of another kind there are, which the user undoes in turn with these.
    void change(const std::string& newer, bool merged, std::size_t others);
    /// Take the last change back, or make it again. False if there is none, or if one of the other kind, of which there
    /// are `others`, came after it or comes first.
    bool undo(std::size_t others);
    bool redo(std::size_t others);
    /// How many changes can be undone.
    std::size_t steps() const { return past.size(); }

    /// To be called when the file was read, with its text. The changes stay as in `rebased`. Returns whether one was
    /// lost.
    bool reload(const std::string& theirs);

  private:
    struct ChangedSlot {
        std::size_t number;
        std::vector<std::string> before, after;
    };
    struct Step {
        std::vector<ChangedSlot> slots;
        std::size_t others;
    };
    std::vector<ChangedSlot> replace(const std::string& newer);
    void apply(const Step& step, std::vector<std::string> ChangedSlot::*to);
    bool move_step(std::vector<Step>& from, std::vector<Step>& into, std::vector<std::string> ChangedSlot::*to,
                   std::size_t others);

    ChangedText lines;           // empty until something is changed
    std::string saved, present;  // the same as texts
    std::vector<Step> past, future;
};

}  // namespace strahl

// The text of the scene file while its numbers are changed in the window, with undo and redo. It is kept as lines, of
// which no change adds or removes any.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace strahl {

/// Returns `theirs`, a text that was made from `base`, with the lines in which `mine` differs from `base`. Sets `lost`
/// if some of these lie between the first and the last line that differ in `theirs`: there all stays as in `theirs`.
/// `mine` has as many lines as `base`.
std::string merged_lines(const std::string& base, const std::string& mine, const std::string& theirs, bool& lost);

class EditedText {
  public:
    /// Begins with another file's text, or none.
    void open(const std::string& text) { *this = {}, saved = present = text; }
    /// The text with all changes.
    const std::string& text() const { return present; }
    /// The text as it was read from the file.
    const std::string& in_file() const { return saved; }
    bool changed() const { return present != saved; }
    /// Lines that would be lost now, with their numbers: "6: sphere { ... }".
    std::vector<std::string> unwritten() const;

    /// Replaces the text. If `merged`, undo takes back this change and the one before together. `others` is how many
    /// changes of another kind there are, which the user undoes in turn with these.
    void change(const std::string& newer, bool merged, std::size_t others);
    /// Take the last change back, or make it again. False if there is none, or if one of the other kind, of which there
    /// are `others`, came after it or comes first.
    bool undo(std::size_t others);
    bool redo(std::size_t others);

    /// To be called when the file was read, with its text. The changes stay as in merged_lines. Returns whether one was
    /// lost.
    bool reload(const std::string& theirs);

  private:
    struct ChangedLine {
        std::size_t number;
        std::string before, after;
    };
    struct Step {
        std::vector<ChangedLine> lines;
        std::size_t others;
    };
    static std::vector<ChangedLine> differences(const std::string& before, const std::string& after);
    void apply(const Step& step, std::string ChangedLine::*to);
    bool move_step(std::vector<Step>& from, std::vector<Step>& into, std::string ChangedLine::*to, std::size_t others);

    std::string saved, present;
    std::vector<Step> past, future;
};

}  // namespace strahl

// Messages to the user: lines of the log, and notes in the window that disappear after some seconds.
#pragma once
#include <deque>
#include <string>
#include <utility>

#include "show/keys/key_map.h"
#include "show/session/session.h"
#include "show/work/pace.h"

namespace strahl {

/// Prints a line on standard output. It begins with "// ", so that it may be pasted into a scene together with the text
/// printed before or after it.
void log_line(const std::string& text);

struct Note {
    std::string text;
    bool failure = false;  // something that the user asked for was not done
    double until = 0;      // time at which the message disappears
};

class Notes {
  public:
    /// `keys` are those that messages name.
    Notes(Pace& pace, bool verbose, KeyMap keys = {}) : pace(pace), verbose(verbose), keys(std::move(keys)) {}

    /// Returns the key of a command, for messages.
    std::string key(Action action) const { return keys.name(action); }

    /// Logs a line that only --verbose asks for.
    void log(const std::string& text) const;
    /// Shows a note for 3 seconds. Nothing if it is empty.
    void note(const std::string& text);
    /// Shows a note for 6 seconds and logs it in any case.
    void announce(const std::string& text);
    /// Shows a note about something that failed, for 10 seconds.
    void fail(const std::string& text);
    /// Shows the note of an answer; its text goes to the clipboard and to standard output.
    void tell(const Answer& answer);

    /// The notes to show, the oldest first.
    const std::deque<Note>& shown() const { return notes; }
    /// The time at which the first of them expires; infinite if there are none.
    double next_change() const;
    /// Removes the notes that have expired. Returns whether these were the last ones.
    bool expire();

  private:
    void show(Note note, double seconds);

    Pace& pace;
    const bool verbose;
    const KeyMap keys;
    std::deque<Note> notes;
};

}  // namespace strahl

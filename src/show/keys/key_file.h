// The user's file of keys: reads it, and writes the keys as such a file.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "show/keys/key_map.h"

namespace strahl {

/// Returns $XDG_CONFIG_HOME/strahl/keys, by default ~/.config/strahl/keys, see user_file().
std::string keys_file();

struct KeysRead {
    KeyMap keys;
    std::string faults{};  // messages with lines and remedies; "" if there are none
};
/// Reads a text of lines such as "write = F2 Ctrl+S". What follows // is a comment. A line gives a command these keys
/// in place of its usual ones; commands without a line keep theirs, unless another one has got them. A line with an
/// error has no effect. `file` is for messages.
KeysRead keys_in(std::string_view text, const std::string& file);
/// Reads the user's file, if there is one.
KeysRead user_keys();

/// Returns all keys as such a file.
std::string write_keys(const KeyMap& keys);

/// A line of the help.
struct HelpRow {
    std::string keys, meaning;  // a heading has no meaning
};
/// Returns the help on those keys that have all these words in their names, meanings or commands, in any case.
std::vector<HelpRow> help_rows(const KeyMap& keys, std::string_view words);

}  // namespace strahl

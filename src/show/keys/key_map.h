// Which keys give which command.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "show/keys/commands.h"

namespace strahl {

/// A key with the modifiers that are held with it.
struct KeyPress {
    int code = 0;            // GLFW's number; digits for any of 1 to 9; or a character
    int modifiers = 0;       // GLFW's: Shift, Ctrl, Alt, Super
    bool character = false;  // `code` is one that keyboards have in different places, such as [ or +
    bool operator==(const KeyPress&) const = default;

    static constexpr int digits = '1';  // GLFW's number of the key 1
};

/// Reads "Ctrl+Shift+Z", "PageUp", "1-9" or "+". Nothing if there is no such key.
std::optional<KeyPress> key_press(std::string_view text);
std::string text_of(const KeyPress& key);

class KeyMap {
  public:
    /// The usual keys.
    KeyMap();

    /// Returns the command of a key press; numbers are GLFW's. Letters are identified by what is printed on the key,
    /// digits by their place. `third_level`: AltGr is down, and a character follows. With Shift a key gives the command
    /// that it gives without, unless it has one of its own.
    std::optional<Command> command_of_key(int key, int scancode, int modifiers, bool third_level) const;
    /// Returns the command of a character that keyboards have in different places.
    std::optional<Command> command_of_character(unsigned character) const;
    /// Returns the movement of a key, which is identified by its place.
    std::optional<Push> push_of_key(int key) const;

    /// Returns the first key of a command, for texts; "" if it has none.
    std::string first_key(Action action) const;
    /// Returns this key, or, if there is none, the command's word, for sentences. `digit` is that of a key for all of 1
    /// to 9.
    std::string name(Action action, int digit = 0) const;

    /// The keys of each of command_helps.
    std::array<std::vector<KeyPress>, command_helps.size()> keys;

  private:
    std::optional<Command> find(const KeyPress& key) const;
};

/// Returns the keys as in the user's file: "F2 Ctrl+S".
std::string text_of(const std::vector<KeyPress>& keys);

/// Returns the command of a gamepad's button; numbers are GLFW's.
std::optional<Command> command_of_button(int button);
/// Returns the number of a connected gamepad.
std::optional<int> gamepad();

}  // namespace strahl

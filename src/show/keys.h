// The keys and their commands.
#pragma once
#include <array>
#include <optional>

namespace strahl {

enum class Action {
    quit,
    still,
    play,
    pause,
    record,
    change_style,
    reset,
    full_screen,
    deeper,
    shallower,
    finer,
    coarser,
    recall,
    store,
    print_camera,
    help,
    info,
    stability,
};
struct Command {
    Action action;
    int number = 0;  // of the camera to recall or store, 1 to 9
    bool operator==(const Command&) const = default;
};

/// The command of a key press; numbers are GLFW's. Letters are identified by what is printed on the key, digits by
/// their place. `third_level`: AltGr is down, and a character follows.
std::optional<Command> command_of_key(int key, int scancode, int modifiers, bool third_level);
/// Brackets, comma and full stop, wherever the keyboard has them.
std::optional<Command> command_of_character(unsigned character);

/// The keys that move the camera, by their place.
enum class Push { forward, back, left, right, down, up };
std::optional<Push> push_of_key(int key);

struct KeyHelp {
    const char *keys, *meaning;  // an empty meaning makes it a heading
};
inline constexpr std::array key_help{
    KeyHelp{"Moving", ""},
    KeyHelp{"W A S D", "forward, left, back, right"},
    KeyHelp{"Q E", "down, up"},
    KeyHelp{"Shift", "faster"},
    KeyHelp{"mouse", "drag: look around; wheel: speed"},
    KeyHelp{"Tab", "switch between flying and orbiting"},
    KeyHelp{"R", "back to the scene's camera"},
    KeyHelp{"1-9", "recall a camera; Shift: store it"},
    KeyHelp{"Flight", ""},
    KeyHelp{"F", "fly along the scene's path, or around it"},
    KeyHelp{"Space", "pause, continue"},
    KeyHelp{"P", "add the camera to a path and print it"},
    KeyHelp{"C", "print the camera"},
    KeyHelp{"Picture", ""},
    KeyHelp{"S, Ctrl+S", "save a still (S: tap it)"},
    KeyHelp{"[ ]", "depth: fewer, more reflections"},
    KeyHelp{", .", "lower, higher resolution in motion"},
    KeyHelp{"F11", "full screen"},
    KeyHelp{"X", "mark pixels that rounding decides"},
    KeyHelp{"I  H", "information; this help"},
    KeyHelp{"Esc", "quit"},
};

}  // namespace strahl

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
    rewind,
    to_end,
    step,
    to_key,
    add_key,
    set_key,
    delete_key,
    clear_path,
    record,
    undo,
    redo,
    copy_path,
    write_path,
    timeline,
    change_style,
    reset,
    full_screen,
    fill,
    deeper,
    shallower,
    finer,
    coarser,
    recall,
    store,
    copy_camera,
    help,
    info,
    quiet,
    stability,
};
struct Command {
    Action action;
    int number = 0;  // of the camera to recall or store, 1 to 9; of 1/25 seconds or keys to step, back if negative
    bool operator==(const Command&) const = default;
};

/// The command of a key press; numbers are GLFW's. Letters are identified by what is printed on the key, digits by
/// their place. `third_level`: AltGr is down, and a character follows.
std::optional<Command> command_of_key(int key, int scancode, int modifiers, bool third_level);
/// Brackets, comma and full stop, wherever the keyboard has them.
std::optional<Command> command_of_character(unsigned character);

/// The command of a gamepad's button; numbers are GLFW's.
std::optional<Command> command_of_button(int button);
/// The number of a gamepad that is there.
std::optional<int> gamepad();

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
    KeyHelp{"C", "copy the camera and print it"},
    KeyHelp{"Flight", ""},
    KeyHelp{"F", "fly along the path, or around the scene"},
    KeyHelp{"Space", "pause, continue"},
    KeyHelp{"Left Right", "1/25 s back, on; Shift: 1 s"},
    KeyHelp{"PgUp PgDn", "to the key before, after"},
    KeyHelp{"Home End", "to the start, the end"},
    KeyHelp{"P", "add the camera as the path's next key"},
    KeyHelp{"K", "record a flight by hand; again: end it"},
    KeyHelp{"Ins Del", "set, delete the key of this moment"},
    KeyHelp{"Ctrl+Z, +Y", "undo, redo; Ctrl+N: a new path"},
    KeyHelp{"T", "the timeline, where keys are dragged and typed"},
    KeyHelp{"F2", "write the path into the scene file"},
    KeyHelp{"Shift+C", "copy the path and print it"},
    KeyHelp{"Picture", ""},
    KeyHelp{"F12, Ctrl+S", "save a still"},
    KeyHelp{"[ ]", "depth: fewer, more reflections"},
    KeyHelp{", .", "lower, higher resolution in motion"},
    KeyHelp{"F11  V", "full screen; fill it, or keep proportions"},
    KeyHelp{"X", "mark pixels that rounding decides, or that are not proved"},
    KeyHelp{"I  H  N", "information; this help; no text"},
    KeyHelp{"gamepad", "sticks, triggers: move; A: pause, X: key"},
    KeyHelp{"Esc", "quit"},
};

}  // namespace strahl

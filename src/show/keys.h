// What keys mean.
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
    int number = 0;  // of the camera that is recalled or stored, 1 to 9
    bool operator==(const Command&) const = default;
};

/// A key that was pressed, as GLFW numbers keys and modifiers. Letters go by what is printed on the key, digits by
/// their place. `third_level`: AltGr is down, and a character will follow.
std::optional<Command> command_of_key(int key, int scancode, int modifiers, bool third_level);
/// Brackets, comma and full stop, wherever a keyboard has them.
std::optional<Command> command_of_character(unsigned character);

/// The keys that push the camera, by their place.
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
    KeyHelp{"Tab", "fly, or orbit what you look at"},
    KeyHelp{"R", "back to the scene's camera"},
    KeyHelp{"1-9", "recall a camera; Shift: store it"},
    KeyHelp{"Flight", ""},
    KeyHelp{"F", "along the scene's path, or around it"},
    KeyHelp{"Space", "pause, and go on"},
    KeyHelp{"P", "add the camera to a path and print it"},
    KeyHelp{"C", "print the camera"},
    KeyHelp{"Picture", ""},
    KeyHelp{"S, Ctrl+S", "a still to a file (S: tap it)"},
    KeyHelp{"[ ]", "depth: reflections of reflections"},
    KeyHelp{", .", "resolution cap while moving"},
    KeyHelp{"F11", "full screen"},
    KeyHelp{"X", "mark pixels that rounding decides"},
    KeyHelp{"I  H", "information; this help"},
    KeyHelp{"Esc", "quit"},
};

}  // namespace strahl

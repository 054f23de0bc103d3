// The commands, the keys and buttons that give them, and the help on keys.
#pragma once
#include <array>
#include <optional>

namespace strahl {

enum class Action {
    quit,
    still,
    film,
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
    open_file,
    timeline,
    change_style,
    reset,
    full_screen,
    fill,
    expose,
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
    second,
    difference,
    open_text,
    approach,
    handles,
    lights,
    copy_body,
    add_block,
    outline,
    gallery,
};
struct Command {
    Action action;
    /// Says which camera, 1 to 9; how many 1/25 s or keys to step, backwards if negative; 1 if a still is a .png; or by
    /// how many half stops to expose more, 0 for no exposure.
    int number = 0;
    bool operator==(const Command&) const = default;
};

/// Returns the command of a key press; numbers are GLFW's. Letters are identified by what is printed on the key, digits
/// by their place. `third_level`: AltGr is down, and a character follows.
std::optional<Command> command_of_key(int key, int scancode, int modifiers, bool third_level);
/// Returns the command of a character that keyboards have in different places: brackets, comma, full stop, plus, minus.
std::optional<Command> command_of_character(unsigned character);

/// Returns the command of a gamepad's button; numbers are GLFW's.
std::optional<Command> command_of_button(int button);
/// Returns the number of a connected gamepad.
std::optional<int> gamepad();

/// The keys that move the camera, identified by their place.
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
    KeyHelp{"mouse drag", "look around"},
    KeyHelp{"mouse wheel", "speed"},
    KeyHelp{"Tab", "switch between flying and orbiting"},
    KeyHelp{"R", "back to the scene's camera"},
    KeyHelp{"1-9", "recall a camera"},
    KeyHelp{"Shift+1-9", "store the camera"},
    KeyHelp{"C", "copy the camera and print it"},
    KeyHelp{"Flight", ""},
    KeyHelp{"F", "fly along the path, or around the scene"},
    KeyHelp{"Space", "pause, continue"},
    KeyHelp{"Left Right", "1/25 s back, forward; with Shift 1 s"},
    KeyHelp{"PgUp PgDn", "previous, next key of the path"},
    KeyHelp{"Home End", "start, end of the flight"},
    KeyHelp{"P", "add the camera as the path's next key"},
    KeyHelp{"K", "start, end recording a flight by hand"},
    KeyHelp{"Ins Del", "set, delete the key at this moment"},
    KeyHelp{"Ctrl+Z +Y", "undo, redo changes of path and bodies"},
    KeyHelp{"Ctrl+N", "new path"},
    KeyHelp{"T", "timeline: drag keys, type their values"},
    KeyHelp{"F2 Ctrl+S", "write path and bodies into the file"},
    KeyHelp{"Shift+C", "copy the path and print it"},
    KeyHelp{"Ctrl+O", "open another scene; or drop a file here"},
    KeyHelp{"Backspace", "the gallery of scenes; and back"},
    KeyHelp{"Bodies", ""},
    KeyHelp{"click", "choose a body; again: the one behind"},
    KeyHelp{"O", "list what is in the scene: find, choose, hide"},
    KeyHelp{"Ctrl+A", "add a body or a light from a list"},
    KeyHelp{"M", "its handles move, turn, scale; Ctrl: in steps"},
    KeyHelp{"Ctrl+D Del", "copy, remove the body or light chosen"},
    KeyHelp{"L", "show lights: click and drag their marks"},
    KeyHelp{"B", "move the camera to the chosen body"},
    KeyHelp{"F4", "open the chosen body's line in $EDITOR"},
    KeyHelp{"Picture", ""},
    KeyHelp{"F12", "save a still; with Shift a .png"},
    KeyHelp{"Ctrl+F12", "make a film of the flight; again: end it"},
    KeyHelp{"[ ]", "fewer, more reflections"},
    KeyHelp{"+ - 0", "brighter, darker, light as it is"},
    KeyHelp{", .", "lower, higher quality in motion"},
    KeyHelp{"F11", "full screen"},
    KeyHelp{"V", "fill the window, or keep proportions"},
    KeyHelp{"G", "compare with POV-Ray, one ray, long double"},
    KeyHelp{"Shift+G", "show the difference instead, 16 times"},
    KeyHelp{"X", "check rounding of a picture at rest"},
    KeyHelp{"I", "information"},
    KeyHelp{"H", "this help"},
    KeyHelp{"N", "hide all text"},
    KeyHelp{"gamepad", "sticks, triggers: move; A: pause; X: add key"},
    KeyHelp{"Esc", "quit"},
};

}  // namespace strahl

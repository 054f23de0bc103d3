// Maps GLFW's keys to commands.
#include "show/session/keys.h"

#include <GLFW/glfw3.h>

#include <span>
#include <utility>

namespace strahl {
namespace {

/// Returns the letter printed on the key, as a capital; if the layout has no Latin letters, the US letter of that key.
char letter_of(int key, int scancode) {
    const char* const name = glfwGetKeyName(key, scancode);
    if (name && name[0] >= 'a' && name[0] <= 'z' && name[1] == 0) return static_cast<char>(name[0] - 'a' + 'A');
    const bool foreign = !name || static_cast<unsigned char>(name[0]) > 127;
    return foreign && key >= GLFW_KEY_A && key <= GLFW_KEY_Z ? static_cast<char>(key) : '\0';
}

struct Meaning {
    int key;
    Command command;
};
/// Keys by their letters, alone or with Shift, and with Ctrl.
constexpr Meaning letters[] = {
    {'F', {Action::play}},        {'P', {Action::add_key}},  {'R', {Action::reset}},  {'V', {Action::fill}},
    {'C', {Action::copy_camera}}, {'H', {Action::help}},     {'I', {Action::info}},   {'X', {Action::stability}},
    {'N', {Action::quiet}},       {'T', {Action::timeline}}, {'K', {Action::record}},
    {'B', {Action::approach}},    {'G', {Action::second}},   {'M', {Action::handles}},  {'L', {Action::lights}},
    {'O', {Action::outline}},
};
constexpr Meaning control_letters[] = {
    {'S', {Action::write_path}}, {'O', {Action::open_file}},  {'Z', {Action::undo}},
    {'Y', {Action::redo}},       {'N', {Action::clear_path}}, {'D', {Action::copy_body}},
    {'A', {Action::add_block}},
};
/// Keys that are the same in all layouts.
constexpr Meaning other_keys[] = {
    {GLFW_KEY_ESCAPE, {Action::quit}},         {GLFW_KEY_SPACE, {Action::pause}},
    {GLFW_KEY_F11, {Action::full_screen}},     {GLFW_KEY_F12, {Action::still}},
    {GLFW_KEY_F2, {Action::write_path}},       {GLFW_KEY_HOME, {Action::rewind}},
    {GLFW_KEY_F4, {Action::open_text}},        {GLFW_KEY_BACKSPACE, {Action::gallery}},
    {GLFW_KEY_END, {Action::to_end}},          {GLFW_KEY_LEFT, {Action::step, -1}},
    {GLFW_KEY_RIGHT, {Action::step, 1}},       {GLFW_KEY_PAGE_UP, {Action::to_key, -1}},
    {GLFW_KEY_PAGE_DOWN, {Action::to_key, 1}}, {GLFW_KEY_INSERT, {Action::set_key}},
    {GLFW_KEY_DELETE, {Action::delete_key}},
};

std::optional<Command> find(std::span<const Meaning> meanings, int key) {
    for (const Meaning& meaning : meanings)
        if (meaning.key == key) return meaning.command;
    return std::nullopt;
}

}  // namespace

std::optional<Command> command_of_key(int key, int scancode, int modifiers, bool third_level) {
    const bool shift = modifiers & GLFW_MOD_SHIFT, alone = !(modifiers & (GLFW_MOD_ALT | GLFW_MOD_SUPER));
    if (key == GLFW_KEY_TAB) return alone ? std::optional(Command{Action::change_style}) : std::nullopt;
    if (auto command = find(other_keys, key)) {
        if (shift && command->action == Action::step) command->number *= 25;
        if (shift && command->action == Action::still) command->number = 1;
        if (modifiers & GLFW_MOD_CONTROL && command->action == Action::still) return Command{Action::film};
        return command;
    }
    const char letter = letter_of(key, scancode);
    if (modifiers & GLFW_MOD_CONTROL && alone) {
        if (letter == 'Z' && shift) return Command{Action::redo};
        return find(control_letters, letter);
    }
    if (third_level || !alone) return std::nullopt;
    for (const int first : {GLFW_KEY_1, GLFW_KEY_KP_1})
        if (key >= first && key < first + 9) return Command{shift ? Action::store : Action::recall, key - first + 1};
    if (letter == 'C' && shift) return Command{Action::copy_path};
    if (letter == 'G' && shift) return Command{Action::difference};
    return find(letters, letter);
}

std::optional<Command> command_of_character(unsigned character) {
    constexpr Meaning characters[] = {
        {'[', {Action::shallower}}, {']', {Action::deeper}}, {',', {Action::coarser}}, {'.', {Action::finer}},
        {'+', {Action::expose, 1}}, {'-', {Action::expose, -1}}, {'0', {Action::expose, 0}}};
    return find(characters, static_cast<int>(character));
}

std::optional<Command> command_of_button(int button) {
    constexpr Meaning buttons[] = {
        {GLFW_GAMEPAD_BUTTON_A, {Action::pause}},
        {GLFW_GAMEPAD_BUTTON_B, {Action::reset}},
        {GLFW_GAMEPAD_BUTTON_X, {Action::add_key}},
        {GLFW_GAMEPAD_BUTTON_Y, {Action::still}},
        {GLFW_GAMEPAD_BUTTON_BACK, {Action::help}},
        {GLFW_GAMEPAD_BUTTON_START, {Action::play}},
        {GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, {Action::to_key, -1}},
        {GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, {Action::to_key, 1}},
    };
    return find(buttons, button);
}

std::optional<int> gamepad() {
    for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id)
        if (glfwJoystickIsGamepad(id)) return id;
    return std::nullopt;
}

std::optional<Push> push_of_key(int key) {
    constexpr std::pair<int, Push> pushes[] = {{GLFW_KEY_W, Push::forward}, {GLFW_KEY_S, Push::back},
                                               {GLFW_KEY_D, Push::right},   {GLFW_KEY_A, Push::left},
                                               {GLFW_KEY_E, Push::up},      {GLFW_KEY_Q, Push::down}};
    for (const auto& [own_key, push] : pushes)
        if (own_key == key) return push;
    return std::nullopt;
}

}  // namespace strahl

// Maps GLFW's keys to commands.
#include "show/keys/key_map.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "files/words.h"

namespace strahl {
namespace {

/// Returns the letter printed on the key, as a capital; if the layout has no Latin letters, the US letter of that key.
char letter_of(int key, int scancode) {
    const char* const name = glfwGetKeyName(key, scancode);
    if (name && name[0] >= 'a' && name[0] <= 'z' && name[1] == 0) return static_cast<char>(name[0] - 'a' + 'A');
    const bool foreign = !name || static_cast<unsigned char>(name[0]) > 127;
    return foreign && key >= GLFW_KEY_A && key <= GLFW_KEY_Z ? static_cast<char>(key) : '\0';
}

constexpr std::pair<const char*, int> modifier_names[] = {
    {"Ctrl", GLFW_MOD_CONTROL}, {"Alt", GLFW_MOD_ALT}, {"Super", GLFW_MOD_SUPER}, {"Shift", GLFW_MOD_SHIFT}};
constexpr std::pair<const char*, int> key_names[] = {{"Esc", GLFW_KEY_ESCAPE},
                                                     {"Space", GLFW_KEY_SPACE},
                                                     {"Tab", GLFW_KEY_TAB},
                                                     {"Enter", GLFW_KEY_ENTER},
                                                     {"Insert", GLFW_KEY_INSERT},
                                                     {"Delete", GLFW_KEY_DELETE},
                                                     {"Home", GLFW_KEY_HOME},
                                                     {"End", GLFW_KEY_END},
                                                     {"PageUp", GLFW_KEY_PAGE_UP},
                                                     {"PageDown", GLFW_KEY_PAGE_DOWN},
                                                     {"Left", GLFW_KEY_LEFT},
                                                     {"Right", GLFW_KEY_RIGHT},
                                                     {"Up", GLFW_KEY_UP},
                                                     {"Down", GLFW_KEY_DOWN},
                                                     {"Backspace", GLFW_KEY_BACKSPACE},
                                                     {"Num1", GLFW_KEY_KP_1},
                                                     {"Num3", GLFW_KEY_KP_3},
                                                     {"Num7", GLFW_KEY_KP_7},
                                                     {"Num9", GLFW_KEY_KP_9},
                                                     {"1-9", KeyPress::digits}};
constexpr int last_function_key = 25;

}  // namespace

std::optional<KeyPress> key_press(std::string_view text) {
    KeyPress key;
    for (bool found = true; std::exchange(found, false);)
        for (const auto& [name, modifier] : modifier_names)
            if (const std::string_view word = name; text.size() > word.size() + 1 && text[word.size()] == '+' &&
                                                    same_word(text.substr(0, word.size()), word)) {
                key.modifiers |= modifier, text.remove_prefix(word.size() + 1);
                found = true;
            }
    for (const auto& [name, code] : key_names)
        if (same_word(text, name)) return key.code = code, key;
    if (text.size() == 1) {
        const char c = text[0];
        const char capital = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        key.code = capital, key.character = capital < 'A' || capital > 'Z';
        const bool digit = c >= '1' && c <= '9', sound = c > ' ' && c < 127 && !digit;
        return sound && !(key.character && key.modifiers) ? std::optional(key) : std::nullopt;
    }
    for (int i = 1; i <= last_function_key; ++i)
        if (same_word(text, "F" + std::to_string(i))) return key.code = GLFW_KEY_F1 + i - 1, key;
    return std::nullopt;
}

std::string text_of(const KeyPress& key) {
    std::string text;
    for (const auto& [name, modifier] : modifier_names)
        if (key.modifiers & modifier) (text += name) += '+';
    if (!key.character)
        for (const auto& [name, code] : key_names)
            if (key.code == code) return text + name;
    if (!key.character && key.code >= GLFW_KEY_F1) return text + "F" + std::to_string(key.code - GLFW_KEY_F1 + 1);
    return text + static_cast<char>(key.code);
}

std::string text_of(const std::vector<KeyPress>& keys) {
    std::string text;
    for (const KeyPress& key : keys) text += (text.empty() ? "" : " ") + text_of(key);
    return text;
}

KeyMap::KeyMap() {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        std::string_view text = *command_helps[i].word ? command_helps[i].keys : "";
        while (!text.empty()) {
            const std::string_view word = text.substr(0, text.find(' '));
            keys[i].push_back(*key_press(word));
            text.remove_prefix(std::min(word.size() + 1, text.size()));
        }
    }
}

std::optional<Command> KeyMap::find(const KeyPress& key) const {
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (command_helps[i].command.action != Action::move && std::ranges::find(keys[i], key) != keys[i].end())
            return command_helps[i].command;
    return std::nullopt;
}

std::optional<Command> KeyMap::command_of_key(int key, int scancode, int modifiers, bool third_level) const {
    const int held = modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER | GLFW_MOD_SHIFT);
    int code = key, number = 0;
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9)  // the others are digits
        if (auto command = find({key, held})) return command;
    for (const int first : {GLFW_KEY_1, GLFW_KEY_KP_1})
        if (key >= first && key < first + 9) code = KeyPress::digits, number = key - first + 1;
    const char letter = letter_of(key, scancode);
    if (letter != 0) code = letter;
    const bool printed = letter != 0 || number > 0 || (key > GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2);
    if (printed && letter == 0 && number == 0) return std::nullopt;  // known by its character
    if (printed && third_level && !(held & GLFW_MOD_CONTROL)) return std::nullopt;
    for (const int with : {held, held & ~GLFW_MOD_SHIFT})
        if (auto command = find({code, with})) {
            if (number > 0) command->number = number;
            return command;
        }
    return std::nullopt;
}

std::optional<Command> KeyMap::command_of_character(unsigned character) const {
    return find({static_cast<int>(character), 0, true});
}

std::optional<Push> KeyMap::push_of_key(int key) const {
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (command_helps[i].command.action == Action::move &&
            std::ranges::find(keys[i], KeyPress{key}) != keys[i].end())
            return static_cast<Push>(command_helps[i].command.number);
    return std::nullopt;
}

std::string KeyMap::first_key(Action action) const {
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (*command_helps[i].word && command_helps[i].command == Command{action} && !keys[i].empty())
            return text_of(keys[i].front());
    return "";
}

std::string KeyMap::name(Action action, int digit) const {
    std::string key = first_key(action);
    if (digit > 0 && key.ends_with("1-9")) key.replace(key.size() - 3, 3, std::to_string(digit));
    const auto help = std::ranges::find(command_helps, action, [](const CommandHelp& h) { return h.command.action; });
    return !key.empty() || help == command_helps.end() ? key : std::string("'") + help->word + "'";
}

std::optional<Command> command_of_button(int button) {
    constexpr std::pair<int, Command> buttons[] = {
        {GLFW_GAMEPAD_BUTTON_A, {Action::pause}},
        {GLFW_GAMEPAD_BUTTON_B, {Action::reset}},
        {GLFW_GAMEPAD_BUTTON_X, {Action::add_key}},
        {GLFW_GAMEPAD_BUTTON_Y, {Action::still}},
        {GLFW_GAMEPAD_BUTTON_BACK, {Action::help}},
        {GLFW_GAMEPAD_BUTTON_START, {Action::play}},
        {GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, {Action::to_key, -1}},
        {GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, {Action::to_key, 1}},
    };
    for (const auto& [own, command] : buttons)
        if (own == button) return command;
    return std::nullopt;
}

std::optional<int> gamepad() {
    for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id)
        if (glfwJoystickIsGamepad(id)) return id;
    return std::nullopt;
}

}  // namespace strahl

// Maps GLFW's keys to commands.
#include "show/keys.h"

#include <GLFW/glfw3.h>

namespace strahl {
namespace {

/// The letter that is printed on the key, as a capital; if the layout has no Latin letters, the US letter at its place.
char letter_of(int key, int scancode) {
    const char* const name = glfwGetKeyName(key, scancode);
    if (name && name[0] >= 'a' && name[0] <= 'z' && name[1] == 0) return static_cast<char>(name[0] - 'a' + 'A');
    const bool foreign = !name || static_cast<unsigned char>(name[0]) > 127;
    return foreign && key >= GLFW_KEY_A && key <= GLFW_KEY_Z ? static_cast<char>(key) : '\0';
}

std::optional<Command> command_of_letter(char letter) {
    switch (letter) {
        case 'F':
            return Command{Action::play};
        case 'P':
            return Command{Action::record};
        case 'R':
            return Command{Action::reset};
        case 'C':
            return Command{Action::print_camera};
        case 'H':
            return Command{Action::help};
        case 'I':
            return Command{Action::info};
        case 'X':
            return Command{Action::stability};
        default:
            return std::nullopt;
    }
}

}  // namespace

std::optional<Command> command_of_key(int key, int scancode, int modifiers, bool third_level) {
    switch (key) {
        case GLFW_KEY_ESCAPE:
            return Command{Action::quit};
        case GLFW_KEY_SPACE:
            return Command{Action::pause};
        case GLFW_KEY_TAB:
            return modifiers & GLFW_MOD_ALT ? std::nullopt : std::optional(Command{Action::change_style});
        case GLFW_KEY_F11:
            return Command{Action::full_screen};
        default:
            break;
    }
    if (modifiers & GLFW_MOD_CONTROL && letter_of(key, scancode) == 'S') return Command{Action::still};
    if (third_level || modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) return std::nullopt;
    for (const int first : {GLFW_KEY_1, GLFW_KEY_KP_1})
        if (key >= first && key < first + 9)
            return Command{modifiers & GLFW_MOD_SHIFT ? Action::store : Action::recall, key - first + 1};
    return command_of_letter(letter_of(key, scancode));
}

std::optional<Command> command_of_character(unsigned character) {
    switch (character) {
        case '[':
            return Command{Action::shallower};
        case ']':
            return Command{Action::deeper};
        case ',':
            return Command{Action::coarser};
        case '.':
            return Command{Action::finer};
        default:
            return std::nullopt;
    }
}

std::optional<Push> push_of_key(int key) {
    switch (key) {
        case GLFW_KEY_W:
            return Push::forward;
        case GLFW_KEY_S:
            return Push::back;
        case GLFW_KEY_D:
            return Push::right;
        case GLFW_KEY_A:
            return Push::left;
        case GLFW_KEY_E:
            return Push::up;
        case GLFW_KEY_Q:
            return Push::down;
        default:
            return std::nullopt;
    }
}

}  // namespace strahl

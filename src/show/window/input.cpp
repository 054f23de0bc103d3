#include "show/window/input.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

namespace strahl {
namespace {

constexpr int to_settle = 3;    // drawings until a field that was clicked takes letters, or one that was left no more
constexpr int after_input = 5;  // drawings until a panel has reacted to input, also by a field that takes letters

Input& input_of(GLFWwindow* window) { return *static_cast<Input*>(glfwGetWindowUserPointer(window)); }

}  // namespace

Input::Input(Screen& screen, const Session& session, Panels& panels, Pace& pace, const KeyMap& keys, bool fixed,
             InputReceiver& receiver)
    : screen(screen), session(session), panels(panels), pace(pace), keys(keys), fixed(fixed), receiver(receiver) {
    GLFWwindow* const window = screen.window();
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int modifiers) {
        input_of(w).on_key(key, scancode, action, modifiers);
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) { input_of(w).on_character(character); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { input_of(w).on_cursor(x, y); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
        input_of(w).on_button(button, action, modifiers);
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { input_of(w).on_wheel(y); });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        if (count > 0) input_of(w).receiver.drop(paths[0]);
    });
    glfwSetWindowCloseCallback(window, [](GLFWwindow* w) {
        glfwSetWindowShouldClose(w, GLFW_FALSE);
        input_of(w).receiver.perform({Action::quit});
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { input_of(w).pace.redraw(); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { input_of(w).pace.redraw(); });
}

/// Draws until panels have reacted to what came before. They look at the pointer and at keys only while they are drawn:
/// if drawing is slow, what is typed right after a click would be commands, or a click would meet another place.
void Input::settle() {
    screen.pointer = pointer.place(), screen.left_down = left_down;
    const int before = ImGui::GetFrameCount();
    for (int i = 0; i < to_settle && ImGui::GetFrameCount() < settled; ++i) receiver.draw();
    if (ImGui::GetFrameCount() != before) pace.redraw(1);  // the panels still show what was known before the command
    show_events();
}

/// Makes the next event wait for so many drawings.
void Input::unsettle(int drawings) {
    settled = std::max(settled, ImGui::GetFrameCount() + drawings);
    show_events();
}

/// Until panels have reacted they see the pointer where it was at the last event, wherever it is by now.
void Input::show_events() {
    const bool reacting = ImGui::GetFrameCount() < settled;
    screen.pointer = reacting ? pointer.place() : std::nullopt;
    screen.left_down = reacting ? std::optional(left_down) : std::nullopt;
}

/// Takes a key for the help, if that is shown. Returns false if it is none for that.
bool Input::for_help(int key, int scancode, int modifiers) {
    if (!panels.help_shown()) return false;
    const bool combined = modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER);
    if (key == GLFW_KEY_ESCAPE) return panels.toggle(Action::help), true;
    if (key == GLFW_KEY_BACKSPACE) return panels.search(0), true;
    const auto command = keys.command_of_key(key, scancode, modifiers, false);
    if (panels.sought().empty() && command && command->action == Action::help)
        return used = true, panels.toggle(Action::help), true;
    return !combined && (key <= GLFW_KEY_WORLD_2 || (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_EQUAL));
}

void Input::on_key(int key, int scancode, int action, int modifiers) {
    settle();
    GLFWwindow* const window = screen.window();
    const bool typing = ImGui::GetIO().WantTextInput;
    const bool control = key == GLFW_KEY_LEFT_CONTROL || key == GLFW_KEY_RIGHT_CONTROL;
    if (panels.take_input() && (typing || control || action == GLFW_RELEASE)) {
        const int picture = ImGui::GetFrameCount();
        if (action == GLFW_PRESS) for_panels.pressed[key] = picture;
        const auto press = for_panels.pressed.find(key);
        if (action == GLFW_RELEASE && press != for_panels.pressed.end() && press->second == picture)
            for_panels.released.push_back({key, scancode, modifiers});
        else
            ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, modifiers);
        pace.redraw(after_input);
    }
    if (typing && action != GLFW_RELEASE) {
        const bool ends = key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER || key == GLFW_KEY_ESCAPE;
        if (ends) unsettle(to_settle);
        return;
    }
    used = false;
    if (action != GLFW_RELEASE && for_help(key, scancode, modifiers)) return;
    if ((panels.gallery || panels.asking) && action != GLFW_RELEASE && receiver.browse(key))
        return used = true, pace.redraw(after_input);
    const auto push = keys.push_of_key(key);
    used = push.has_value();
    const bool third_level = glfwGetKey(window, GLFW_KEY_RIGHT_ALT);
    if (action == GLFW_REPEAT) {
        const auto command = push ? std::nullopt : keys.command_of_key(key, scancode, modifiers, third_level);
        if (command && command->action == Action::step) receiver.perform(*command);
        return;
    }
    controls.faster = with_shift();
    if (action == GLFW_RELEASE) {
        if (push) controls.release(*push);
        return;
    }
    const bool combined = modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER);
    if (push && !combined && !fixed && !panels.gallery && !panels.asking)
        controls.press(*push);
    else if (const auto command = keys.command_of_key(key, scancode, modifiers, third_level))
        used = true, unsettle(fixed ? 0 : to_settle), receiver.perform(*command);
}

void Input::release_keys() {
    show_events();
    for (const auto& [key, scancode, modifiers] : std::exchange(for_panels.released, {}))
        ImGui_ImplGlfw_KeyCallback(screen.window(), key, scancode, GLFW_RELEASE, modifiers);
}

void Input::on_character(unsigned character) {
    settle();
    if (ImGui::GetIO().WantTextInput) {
        pace.redraw(after_input);
        return ImGui_ImplGlfw_CharCallback(screen.window(), character);
    }
    // On some layouts a key that moves the camera has a character printed on it that is a command, too.
    if (used) return;
    if (panels.help_shown()) return panels.search(character);
    if (const auto command = keys.command_of_character(character)) receiver.perform(*command);
}

void Input::on_button(int button, int action, int modifiers) {
    // Only a drawing finds out on what panel the pointer is, and how far it has dragged something there.
    if (panels.take_input()) unsettle(1);
    settle();
    if (button == GLFW_MOUSE_BUTTON_LEFT) left_down = action == GLFW_PRESS;
    ImGui_ImplGlfw_MouseButtonCallback(screen.window(), button, action, modifiers);
    if (panels.take_input()) pace.redraw(after_input), unsettle(to_settle);
    double x = 0, y = 0;
    glfwGetCursorPos(screen.window(), &x, &y);
    if (button == GLFW_MOUSE_BUTTON_MIDDLE && held == Hold::nothing) {
        if (action == GLFW_PRESS && !on_panel())
            pointer.press({x, y}, modifiers & GLFW_MOD_SHIFT ? Pointer::pan : Pointer::turn);
        if (action == GLFW_RELEASE && pointer.middle_held()) pointer.release();
    }
    if (button != GLFW_MOUSE_BUTTON_LEFT || pointer.middle_held()) return;
    if (action == GLFW_PRESS && panels.help_shown()) return void(panels.toggle(Action::help));
    if (action == GLFW_PRESS && !on_panel()) {
        held = fixed ? Hold::nothing : receiver.points_at(pointed());
        if (held == Hold::handle) receiver.hold(pointed());
        if (held != Hold::divider) pointer.press({x, y});
    } else {
        let_go();
        // A handle that was not dragged does not keep the user from choosing what is behind it.
        if (pointer.release() && !fixed) unsettle(to_settle), receiver.click(pointed(), modifiers & GLFW_MOD_SHIFT);
    }
}

/// Lets go of what is held.
void Input::let_go() {
    if (std::exchange(held, Hold::nothing) == Hold::handle) receiver.let_go();
}

bool Input::with_control() const {
    return glfwGetKey(screen.window(), GLFW_KEY_LEFT_CONTROL) || glfwGetKey(screen.window(), GLFW_KEY_RIGHT_CONTROL);
}
bool Input::with_shift() const {
    return glfwGetKey(screen.window(), GLFW_KEY_LEFT_SHIFT) || glfwGetKey(screen.window(), GLFW_KEY_RIGHT_SHIFT);
}

glm::dvec2 Input::pointed() const {
    double x = 0, y = 0;
    int width = 1, height = 1;
    glfwGetCursorPos(screen.window(), &x, &y);
    if (const auto& place = pointer.place()) x = place->x, y = place->y;
    glfwGetWindowSize(screen.window(), &width, &height);
    return {x / std::max(width, 1) * screen.width(), y / std::max(height, 1) * screen.height()};
}

/// Is the pointer on a panel that takes input?
bool Input::on_panel() const {
    const glm::dvec2 at = pointed();
    const bool on_list = panels.take_input() && ImGui::GetIO().WantCaptureMouse;  // one that a panel has opened
    return at.y > screen.height() - panels.reserved() || panels.cover(at.x, at.y) || on_list;
}

/// Gives the pointer another shape where it can take hold of something.
void Input::show_hold() {
    const Hold hold = held != Hold::nothing ? held
                      : on_panel() || fixed ? Hold::nothing
                                            : receiver.points_at(pointed());
    look.show(screen.window(), hold);
}

void Input::on_cursor(double x, double y) {
    settle();
    look.move(pace.now());
    const auto way = pointer.move(x, y);
    show_events();
    if (panels.take_input()) pace.redraw();
    show_hold();
    if (held == Hold::divider || (held == Hold::handle && way))
        return receiver.pull(held, pointed(), with_control() ? Snap::grid : with_shift() ? Snap::surface : Snap::none);
    if (!way || fixed || held != Hold::nothing) return;
    int width = 1;
    glfwGetWindowSize(screen.window(), &width, nullptr);
    if (pointer.drag() == Pointer::pan) return controls.pan(*way / double(std::max(width, 1)), pace.now());
    // The view turns by the angle that the pointer crosses in the picture.
    const double angle = 2 * session.camera.fov * std::numbers::pi / 180 / std::max(width, 1);
    controls.drag(way->x * angle, -way->y * angle, pointer.middle_held(), pace.now());
}

void Input::on_wheel(double notches) {
    if (ImGui::GetFrameCount() + 1 < settled) settle();  // notches add up until the next drawing
    if (panels.take_input())
        ImGui_ImplGlfw_ScrollCallback(screen.window(), 0, notches), pace.redraw(after_input), unsettle(1);
    if (!fixed && !on_panel()) receiver.turn_wheel(notches, with_control());
}

void Input::read_gamepad() {
    const auto id = gamepad();
    GLFWgamepadstate pad;
    if (!id || !glfwGetGamepadState(*id, &pad)) return controls.tilt({}, 0, 0);
    const float* const axis = pad.axes;
    const double triggers = (axis[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] - axis[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER]) / 2;
    controls.tilt({axis[GLFW_GAMEPAD_AXIS_LEFT_X], triggers, -axis[GLFW_GAMEPAD_AXIS_LEFT_Y]},
                  axis[GLFW_GAMEPAD_AXIS_RIGHT_X], -axis[GLFW_GAMEPAD_AXIS_RIGHT_Y]);
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        const bool down = pad.buttons[i] == GLFW_PRESS;
        if (std::exchange(buttons[i], down) || !down) continue;
        if (const auto command = command_of_button(static_cast<int>(i))) receiver.perform(*command);
    }
}

void Input::hide_pointer() { look.hide(screen.window(), screen.full_screen() && (fixed || look.rests(pace.now()))); }

}  // namespace strahl

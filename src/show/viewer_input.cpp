// What keys, the mouse and the window's own buttons do.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "show/viewer.h"

namespace strahl {
namespace {

Viewer& viewer_of(GLFWwindow* window) { return *static_cast<Viewer*>(glfwGetWindowUserPointer(window)); }

}  // namespace

void Viewer::connect() {
    GLFWwindow* const window = screen.window();
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int modifiers) {
        viewer_of(w).on_key(key, scancode, action, modifiers);
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
        if (ImGui::GetIO().WantTextInput) return viewer_of(w).draws_due = 3, ImGui_ImplGlfw_CharCallback(w, character);
        // On some layouts a key that moves the camera has one of these characters printed on it.
        if (viewer_of(w).pushing) return;
        if (const auto command = command_of_character(character)) viewer_of(w).perform(*command);
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { viewer_of(w).on_cursor(x, y); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
        ImGui_ImplGlfw_MouseButtonCallback(w, button, action, modifiers);
        if (viewer_of(w).with_timeline) viewer_of(w).draws_due = 3;
        if (button == GLFW_MOUSE_BUTTON_LEFT) viewer_of(w).on_button(action == GLFW_PRESS);
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) {
        Viewer& viewer = viewer_of(w);
        if (viewer.options.play || viewer.on_timeline()) return;
        viewer.tell(viewer.session.change_speed(std::pow(1.25, y), viewer.now()));
    });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        if (count > 0) viewer_of(w).reload.open(paths[0]);
    });
    glfwSetWindowCloseCallback(window, [](GLFWwindow* w) {
        glfwSetWindowShouldClose(w, GLFW_FALSE);
        viewer_of(w).quit();
    });
    const auto redraw = [](GLFWwindow* w) { viewer_of(w).draws_due = 2; };
    glfwSetWindowRefreshCallback(window, redraw);
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { viewer_of(w).draws_due = 2; });
}

void Viewer::on_key(int key, int scancode, int action, int modifiers) {
    const bool typing = ImGui::GetIO().WantTextInput;
    if (with_timeline && (typing || action == GLFW_RELEASE))
        ImGui_ImplGlfw_KeyCallback(screen.window(), key, scancode, action, modifiers), draws_due = 3;
    if (typing && action != GLFW_RELEASE) return;
    const auto push = push_of_key(key);
    pushing = push.has_value();
    GLFWwindow* const window = screen.window();
    const bool third_level = glfwGetKey(window, GLFW_KEY_RIGHT_ALT);
    if (action == GLFW_REPEAT) {
        const auto command = push ? std::nullopt : command_of_key(key, scancode, modifiers, third_level);
        if (command && command->action == Action::step) perform(*command);
        return;
    }
    const auto down = [&](int a, int b) { return glfwGetKey(window, a) || glfwGetKey(window, b); };
    controls.faster = down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    if (action == GLFW_RELEASE) {
        if (push) controls.release(*push);
        return;
    }
    const bool combined = modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER);
    if (push && !combined && !options.play)
        controls.press(*push);
    else if (const auto command = command_of_key(key, scancode, modifiers, third_level))
        perform(*command);
}

void Viewer::on_button(bool pressed) {
    double x = 0, y = 0;
    glfwGetCursorPos(screen.window(), &x, &y);
    pressed && !on_timeline() ? pointer.press(x, y) : pointer.release();
}

bool Viewer::on_timeline() const {
    if (!with_timeline || quiet) return false;
    double x = 0, y = 0;
    int height = 1;
    glfwGetCursorPos(screen.window(), &x, &y);
    glfwGetWindowSize(screen.window(), nullptr, &height);
    return y / height * screen.height() > screen.height() - timeline.height();
}

void Viewer::on_cursor(double x, double y) {
    pointer_moved = now();
    if (with_timeline) draws_due = std::max(draws_due, 2);
    const auto way = pointer.move(x, y);
    if (!way || options.play) return;
    // The view turns by the angle that the pointer crosses in the picture.
    int width = 1;
    glfwGetWindowSize(screen.window(), &width, nullptr);
    const double angle = 2 * session.camera.fov * std::numbers::pi / 180 / std::max(width, 1);
    controls.drag(way->x * angle, -way->y * angle, now());
}

void Viewer::perform(Command command) {
    const bool playing = command.action == Action::quit || command.action == Action::full_screen ||
                         (command.action == Action::pause && !options.benchmark);
    if (options.play && !playing) return;
    switch (command.action) {
        case Action::quit:
            return quit();
        case Action::still:
            return add_still();
        case Action::write_path:
            return write_path();
        case Action::stability:
            return toggle_stability();
        case Action::help:
        case Action::info:
        case Action::quiet:
        case Action::timeline:
        case Action::fill:
        case Action::full_screen:
            return perform_here(command.action);
        default:
            tell(session.perform(command, now()));
    }
}

/// Commands that concern only the window.
void Viewer::perform_here(Action action) {
    draws_due = 2;
    if (action == Action::help) help = !help;
    if (action == Action::info) with_info = !with_info;
    if (action == Action::quiet) quiet = !quiet;
    if (action == Action::timeline) with_timeline = !with_timeline;
    if (action == Action::help || action == Action::info || action == Action::timeline) quiet = false;
    if (action == Action::full_screen) pointer.release(), screen.toggle_full_screen();
    if (action != Action::fill) return;
    fill = !fill;
    note(!session.camera.aspectratio ? "this camera has no aspectratio and always fills the window"
         : fill                      ? "the view is widened to fill the window"
                                     : "the camera's own proportions");
}

/// What a hand did on the timeline.
void Viewer::apply(const TimelineInput& input) {
    if (input.command) perform(*input.command);
    if (input.go_to) session.go_to(*input.go_to, now());
    if (const auto& change = input.change) tell(session.change_key(change->number, change->key, change->merged, now()));
    if (input.command || input.go_to || input.change) draws_due = 3;
}

/// The left stick moves, the right one turns, the triggers go down and up; buttons: see key_help.
void Viewer::read_gamepad() {
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
        if (const auto command = command_of_button(static_cast<int>(i))) perform(*command);
    }
}

void Viewer::quit() {
    if (!quitting && stills.pending() > 0) {
        quitting = true;
        log_line("waiting for " + std::to_string(stills.pending()) + " still(s); Esc or a signal drops them");
        draws_due = 2;
        return;
    }
    for (const std::string& name : stills.drop()) log_line("still dropped: " + name);
    closed = true;
}

}  // namespace strahl

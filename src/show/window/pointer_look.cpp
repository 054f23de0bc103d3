#include "show/window/pointer_look.h"

#include <GLFW/glfw3.h>

#include <cstddef>
#include <utility>

namespace strahl {

void PointerLook::show(GLFWwindow* window, Hold hold) {
    if (hold == std::exchange(shown, hold)) return;
    GLFWcursor*& shape = shapes[static_cast<std::size_t>(hold)];
    if (!shape && hold != Hold::nothing)
        shape = glfwCreateStandardCursor(hold == Hold::divider ? GLFW_HRESIZE_CURSOR : GLFW_HAND_CURSOR);
    glfwSetCursor(window, shape);
}

void PointerLook::hide(GLFWwindow* window, bool hide) {
    if (hide == std::exchange(hidden, hide)) return;
    glfwSetInputMode(window, GLFW_CURSOR, hide ? GLFW_CURSOR_HIDDEN : GLFW_CURSOR_NORMAL);
}

}  // namespace strahl

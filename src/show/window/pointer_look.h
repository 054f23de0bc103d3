// Sets how the pointer looks in the window: its shape, and whether it is seen.
#pragma once
#include <array>

struct GLFWcursor;
struct GLFWwindow;

namespace strahl {

/// Names what the pointer has hold of in the picture.
enum class Hold { nothing, divider, handle };

class PointerLook {
  public:
    /// Gives it the shape for what it can take hold of.
    void show(GLFWwindow* window, Hold hold);
    void hide(GLFWwindow* window, bool hide);

    /// To be called when it moves, at a time in seconds.
    void move(double now) { moved = now; }
    bool rests(double now) const { return now > moved + 2; }

  private:
    Hold shown = Hold::nothing;
    std::array<GLFWcursor*, 3> shapes{};  // glfwTerminate destroys them
    bool hidden = false;
    double moved = 0;
};

}  // namespace strahl

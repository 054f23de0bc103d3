// The window as a surface: one picture and an overlay on it. All of GLFW's, OpenGL's and ImGui's start and end is here.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "show/trace_thread.h"

struct GLFWwindow;

namespace strahl {

class Screen {
  public:
    /// Size in pixels; a default size grows with the monitor's scale. Throws std::runtime_error with advice if there is
    /// no display or no fit OpenGL. One at a time.
    Screen(const std::string& title, int width, int height, bool default_size, bool full);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    GLFWwindow* window() const { return glfw; }
    /// In pixels; 0x0 while the window is an icon.
    int width() const;
    int height() const;

    void upload(const Fresh& fresh);
    /// Shows the picture that was uploaded, with what `overlay` draws (in ImGui's words) on it.
    void draw(const std::function<void()>& overlay);
    void toggle_full_screen();

  private:
    struct Functions;
    void make_window(const std::string& title, int width, int height, bool default_size, bool full);
    void start_drawing();

    GLFWwindow* glfw = nullptr;
    std::unique_ptr<Functions> gl;
    unsigned texture = 0;
    int texture_width = 0, texture_height = 0;
    float left = 0, top = 0, right = 1, bottom = 1;           // of the part of the texture that is shown
    float scale = 0;                                          // of the overlay: 1 on a monitor of the usual fineness
    int old_x = 0, old_y = 0, old_width = 0, old_height = 0;  // before full screen
};

}  // namespace strahl

// The window as a surface for one picture and an overlay. GLFW, OpenGL and ImGui are initialised and ended here.
#pragma once
#include <algorithm>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "show/session/framing.h"
#include "show/session/view_options.h"
#include "show/window/window_state.h"
#include "show/work/trace_thread.h"

struct GLFWwindow;

namespace strahl {

/// Thrown if there is no display or no suitable OpenGL; the message says what to do instead.
struct WindowError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Screen {
  public:
    /// Opens the window; there can be one at a time. `size` is in pixels; a default size grows with the monitor's
    /// scale, but where a size is remembered that applies. Unless `framed` the window manager is asked for no frame, so
    /// that it leaves the size as it is. Throws WindowError.
    Screen(const std::string& title, PictureSize size, bool default_size, bool full, bool framed);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    GLFWwindow* window() const { return glfw; }
    /// In pixels; 0x0 while the window is an icon.
    int width() const;
    int height() const;

    /// Takes new rows of the picture.
    void upload(const Fresh& fresh);
    /// From now on shows this picture over that part of the first one, as much of it as is there or, if `whole`, all of
    /// it; null for none.
    void show_second(std::shared_ptr<const ScreenImage> image, const ScreenArea& part, bool whole);
    /// Makes a texture for ImGui of a picture. It stays until the end.
    unsigned make_texture(const ScreenImage& image) const;
    /// Draws the window: the uploaded picture, and on it what `overlay` draws with ImGui.
    void draw(const std::function<void()>& overlay);
    /// Draws the uploaded picture alone. What ImGui needs, a font and shaders, is made by the first draw().
    void draw_picture() const;
    void toggle_full_screen();
    /// Removes the window from the screen.
    void hide();
    bool full_screen() const;
    /// Stores the place for the next start, and the size if it is no longer the default one.
    void remember() const;
    /// Returns how far from a thin line the pointer may be to take hold of it, in pixels.
    double pixels_to_reach() const { return 6 * std::max(scale, 1.f); }
    /// The area of the picture in the window.
    ScreenArea area() const;
    /// Tells panels where the pointer is, in units of the screen; without a value they see it where it is now.
    std::optional<glm::dvec2> pointer;
    /// Tells panels whether the left button is down; without a value they see it as it is now.
    std::optional<bool> left_down;

  private:
    struct Functions;
    struct Surface;
    void make_window(const std::string& title, PictureSize size, bool default_size, bool full);
    void start_drawing();
    void copy_pictures() const;
    void restore();
    WindowState window_state() const;

    GLFWwindow* glfw = nullptr;
    std::unique_ptr<Functions> gl;
    std::unique_ptr<Surface> picture, second_picture;  // the second one only where it has been needed
    std::shared_ptr<const ScreenImage> second;
    ScreenArea second_part;
    bool second_whole = false;
    float scale = 0;                 // of the overlay: 1 at a usual pixel density
    double drawn = 0, interval = 0;  // when it was drawn last, and the seconds from the time before to that one
    WindowState before;              // size and place before full screen
    WindowState opened;              // size and place at the start
};

}  // namespace strahl

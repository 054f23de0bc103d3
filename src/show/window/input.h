// Turns keys, the mouse and a gamepad into commands and into movements of the camera.
#pragma once
#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "show/keys/key_map.h"
#include "show/panels/panels.h"
#include "show/session/handles.h"
#include "show/session/session.h"
#include "show/window/controls.h"
#include "show/window/pointer_look.h"
#include "show/window/screen.h"
#include "show/work/pace.h"

namespace strahl {

/// Functions that are called, while events are processed, for what the user does besides moving the camera.
struct InputHandlers {
    std::function<void(Command)> perform;
    std::function<void()> draw;                       // draws the window at once
    std::function<bool(int)> browse;                  // takes a key for the gallery or a question, or returns false
    std::function<void(double, bool)> turn_wheel;     // notches, up is positive; true with Ctrl
    std::function<void(std::string)> drop;            // the path of a file that is dropped onto the window
    std::function<void(double, double, bool)> click;  // x and y in pixels of the window; true with Shift
    std::function<Hold(double, double)> points_at;    // what is there to be held
    std::function<void(double, double)> hold;         // takes hold of the handle there
    std::function<void(Hold, double, double, Snap)> pull;  // moves what is held
    std::function<void()> let_go;                          // called when the handle is let go
};

class Input {
  public:
    /// Receives the events of the screen's window from now on. If `fixed` the user cannot move the camera.
    Input(Screen& screen, const Session& session, Panels& panels, Pace& pace, const KeyMap& keys, bool fixed,
          InputHandlers handlers);
    Input(const Input&) = delete;

    /// Looks at the gamepad, which has no events: the left stick moves, the right one turns, the triggers go down and
    /// up; buttons are commands.
    void read_gamepad();
    /// Will there be more input for the camera soon?
    bool active() const { return controls.active(pace.now()); }
    /// The input for the camera since the last call, `seconds` ago.
    CameraInput take(double seconds) { return controls.take(seconds); }
    /// Ends a drag, because the window changes under the pointer.
    void release_pointer() { pointer.leave(), let_go(); }
    /// To be called after each drawing. Panels look at keys only then, so a key that was pressed since the last one is
    /// released for them now.
    void release_keys();
    /// Has the pointer not moved for 2 seconds?
    bool pointer_rests() const { return look.rests(pace.now()); }
    /// Hides the pointer in full screen, if it has not moved for 2 seconds or is not needed.
    void hide_pointer();

  private:
    void settle();
    void unsettle(int drawings);
    void show_events();
    void on_key(int key, int scancode, int action, int modifiers);
    void on_character(unsigned character);
    void on_button(int button, int action, int modifiers);
    void on_cursor(double x, double y);
    void on_wheel(double notches);
    /// The place of the pointer in pixels. It may be elsewhere by now: events wait for their turn.
    glm::dvec2 pointed() const;
    bool on_panel() const;
    void show_hold();
    void let_go();
    bool with_control() const;
    bool with_shift() const;
    bool for_help(int key, int scancode, int modifiers);

    Screen& screen;
    const Session& session;
    Panels& panels;
    Pace& pace;
    const KeyMap& keys;
    const bool fixed;
    const InputHandlers handlers;
    Controls controls;
    Pointer pointer;
    PointerLook look;
    Hold held = Hold::nothing;
    struct ReleasedKey {
        int key, scancode, modifiers;
    };
    struct PanelKeys {
        std::map<int, int> pressed;         // key, and the number of the last picture drawn before it
        std::vector<ReleasedKey> released;  // keys let go before panels saw them pressed
    };
    PanelKeys for_panels;
    bool left_down = false;          // by the events that were processed
    bool used = false;               // the key whose character follows
    int settled = 0;                 // the number of the drawing by which panels have reacted to the last event
    std::array<bool, 15> buttons{};  // of the gamepad, which are down
};

}  // namespace strahl

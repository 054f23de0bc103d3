// Turns keys, the mouse and a gamepad into commands and into movements of the camera.
#pragma once
#include <array>
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

/// Does what the user asks for besides moving the camera; called while events are processed. Points are in pixels of
/// the window.
struct InputReceiver {
    virtual void perform(Command command) = 0;
    virtual void draw() = 0;  // draws the window at once
    /// Takes a key for the gallery or a question, or returns false.
    virtual bool browse(int key) = 0;
    /// Takes turns of the wheel, upwards positive.
    virtual void turn_wheel(double notches, bool with_control) = 0;
    /// Takes a file that is dropped onto the window.
    virtual void drop(const std::string& path) = 0;
    virtual void click(glm::dvec2 point, bool with_shift) = 0;
    /// Returns what the pointer can take hold of at a point.
    virtual Hold points_at(glm::dvec2 point) = 0;
    /// Takes hold of the handle at a point.
    virtual void hold(glm::dvec2 point) = 0;
    /// Moves what is held to a point.
    virtual void pull(Hold what, glm::dvec2 point, Snap snap) = 0;
    /// Lets go of the handle.
    virtual void let_go() = 0;

  protected:
    ~InputReceiver() = default;
};

class Input {
  public:
    /// Receives the events of the screen's window from now on. If `fixed` the user cannot move the camera.
    Input(Screen& screen, const Session& session, Panels& panels, Pace& pace, const KeyMap& keys, bool fixed,
          InputReceiver& receiver);
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
    InputReceiver& receiver;
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

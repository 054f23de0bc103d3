// Two pictures beside each other: connects the divider, the second picture, and what the window says about them.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "show/keys/commands.h"
#include "show/second/second_pictures.h"
#include "show/session/divider.h"
#include "show/session/session.h"
#include "show/window/overlay.h"
#include "show/work/notes.h"
#include "show/work/pace.h"
#include "show/work/reload.h"
#include "show/work/trace_thread.h"

namespace strahl {

class SideBySide {
  public:
    /// `notify` is called from another thread when there is something to take.
    SideBySide(int threads, Notes& notes, Pace& pace, std::function<void()> notify)
        : notes(notes), pace(pace), pictures(threads, std::move(notify)) {}

    /// To be called when the session has taken over a scene that was read from the file.
    void loaded(const Loaded& scene) { path = scene.path, mirrored = scene.mirrored; }
    /// Chooses the next second picture, or with a number this kind, or none if it is there; or whether its difference
    /// is seen.
    void toggle(Command command);
    /// To be called with all that is new of the first picture.
    void keep(const Fresh& fresh);
    /// Asks for the second picture of a view, if its first picture is finished; else there is none. What the camera of
    /// the flight sees is also there in motion, with half of the rows and columns.
    void follow(const Session& session, const View& view, bool finished);
    /// Takes the place of the pointer as shares of the picture's width and height: beside it a layer tells its values.
    void point(double x, double y);
    void pull(const ScreenArea& picture, double x) { line.pull(picture, x), pace.redraw(1); }

    const Divider& divider() const { return line; }
    /// The picture to be seen to the right of the divider, or null.
    std::shared_ptr<const ScreenImage> image() const;
    /// The words beside the divider.
    Overlay::Sides sides(const ScreenArea& picture) const;
    /// Is the second picture being made?
    bool under_way() const { return pictures.under_way(); }

  private:
    void log_second(const SecondPicture& picture);
    std::string values_at_pointer(const SecondPicture& picture) const;

    Notes& notes;
    Pace& pace;
    SecondPictures pictures;
    Divider line;
    std::string path;
    bool mirrored = false;
    double pointed_x = -1, pointed_y = -1;           // the place of the pointer
    double began = 0;                                // when the picture under way was asked for
    std::shared_ptr<const SecondPicture> of_flight;  // the last one
    std::shared_ptr<SecondPicture> first;            // the first picture as it was shown first
    std::uint64_t first_number = 0;                  // number of the order of the first picture
    int first_level = 0;
};

}  // namespace strahl

// The body that the user has clicked, and changes of its numbers in the scene's text.
#pragma once
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "num/bounding_box.h"
#include "num/ray.h"
#include "pov/open_pov.h"
#include "scene/camera.h"
#include "scene/ray_hits.h"
#include "scene/scene.h"
#include "show/session/edited_text.h"
#include "text/body_text.h"
#include "trace/world/view.h"

namespace strahl {

/// Returns the ray through the point (x, y) of a view's picture, in pixels from its top left corner.
Ray<double> ray_at(const View& view, double x, double y);

/// Returns the camera moved to where a box fills most of a picture of these proportions (width / height). The direction
/// of view stays.
Camera approached(const Camera& camera, const Box& box, double aspect);

class BodyEditor {
  public:
    /// The body that was clicked, and where.
    struct Chosen {
        BodyHit at;
        int behind = 0;  // how many bodies are before it
        DVec3 point{0};
    };

    /// Takes the text of a scene that was just opened; it is empty if its numbers cannot be changed.
    void open(const std::string& text) { *this = {}, edited.open(text); }
    /// Takes the lines of the bodies of a scene without such a text.
    void take_lines(pov::SourceLines newer) { lines = std::move(newer); }

    /// Chooses the body that is seen at a point of the view's picture, in pixels, or none. The same point clicked again
    /// chooses the body behind the one chosen, and after the last one none. `now` is the scene at the moment seen, and
    /// `scene` that of the text.
    void click(const Scene& now, const Scene& scene, const View& view, double x, double y);
    void close() { chosen.reset(); }
    const std::optional<Chosen>& choice() const { return chosen; }
    /// The words and values of the body chosen.
    const BodyText& body() const { return description; }
    /// The file in which it stands, if that is not the scene's own; else "".
    const std::string& file() const { return other_file; }
    /// Are there no numbers to change, because there is no text of the scene?
    bool read_only() const { return edited.text().empty(); }
    /// Looks at the text again, because the scene is another one. Chooses nothing if the body is no longer there.
    void look(const Scene& scene);

    /// May the user change this value? Not before saying what is meant, if it comes from elsewhere.
    bool open_to_change(const BodyValue& value) const;
    /// From now on values that come from this block are changed there.
    void allow(const std::string& source) { allowed.insert(source); }
    /// Changes a value where it stands, or else gives the body a value of its own. Numbers out of range become the
    /// nearest ones within. Returns whether the text has changed.
    bool change(const BodyValue& value, std::span<const double> numbers, bool merged, std::size_t others);
    /// Gives the body a value of its own, equal to the one that comes from elsewhere.
    bool make_own(const BodyValue& value, std::size_t others);

    EditedText edited;

  private:
    std::optional<Chosen> chosen;
    std::optional<Ray<double>> clicked;
    BodyText description;
    std::string other_file;
    pov::SourceLines lines;
    std::set<std::string> allowed;
};

}  // namespace strahl

// The bodies or the light that the user has clicked, or the camera or the background, and changes of their numbers in
// the scene's text.
#pragma once
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "num/bounding_box.h"
#include "num/ray.h"
#include "pov/open_pov.h"
#include "scene/camera.h"
#include "scene/ray_hits.h"
#include "scene/scene.h"
#include "show/session/edited_text.h"
#include "show/session/light_marks.h"
#include "text/body_text.h"
#include "text/place_body.h"
#include "trace/world/view.h"

namespace strahl {

/// Returns the ray through the point (x, y) of a view's picture, in pixels from its top left corner.
Ray<double> ray_at(const View& view, double x, double y);

/// Returns the camera moved to where a box fills most of a picture of these proportions (width / height). The direction
/// of view stays.
Camera approached(const Camera& camera, const Box& box, double aspect);

/// A place where a new body can stand.
struct StandingPlace {
    DVec3 point{0}, normal{0, 0, 1};  // on the surface that is seen; the normal points to the eye
    double size = 1;                  // a round length, about a twelfth of the picture's height there
    int decimals = 2;                 // of coordinates, as many as can be seen there
};
/// Returns the place at the point (x, y) of a view's picture. Where no body is seen, it is as far away as the point
/// that the camera looks at, and the normal points up the picture. Bodies that are hidden are not seen.
StandingPlace standing_place(const Scene& scene, const View& view, double x, double y,
                             const std::set<int>& hidden = {});

class BodyEditor {
  public:
    /// The body that was clicked, and where.
    struct Chosen {
        BodyHit at;
        int behind = 0;  // how many bodies are before it
        DVec3 point{0};
    };

    /// Takes the text of a scene that was just opened; it is empty if its numbers cannot be changed. Of one for POV-Ray
    /// nothing else can, and of a model nothing.
    enum class TextKind { scene, povray, model };
    void open(const std::string& text, TextKind kind = TextKind::scene) {
        *this = {}, edited.open(text), povray = kind == TextKind::povray, model = kind == TextKind::model;
    }
    /// Takes the places of the bodies and lights of a scene for POV-Ray in a text.
    void take_lines(pov::SourceLines newer, const std::string& of) { lines = std::move(newer), lines_text = of; }

    /// Chooses the body that is seen at a point of the view's picture, in pixels, or none. The same point clicked again
    /// chooses the body behind the one chosen, and after the last one none. `now` is the scene at the moment seen, and
    /// `scene` that of the text. Bodies that are hidden are not seen. With `adds` the other bodies stay chosen, and one
    /// that is chosen already no longer is.
    void click(const Scene& now, const Scene& scene, const View& view, double x, double y,
               const std::set<int>& hidden = {}, bool adds = false);
    /// Chooses a light in place of a body.
    void choose(const LightPoint& point, const Scene& scene);
    /// Chooses a body, or a leaf of it, that was not clicked; `point` is the middle of one without end.
    void choose(int body, const DVec3& point, const Scene& scene, int leaf = 0);
    /// Chooses it besides those that are chosen; or no longer, if it is one of them.
    void add(int body, const DVec3& point, const Scene& scene);
    /// Chooses the camera or the background.
    void choose(TopBlock block, const Scene& scene);
    /// Chooses the bodies with these numbers, or the light, if one of these is chosen.
    void choose_next(std::vector<int> numbers, const Scene& scene);
    void close() { chosen.reset(), others.clear(), chosen_light.reset(), chosen_block.reset(); }
    /// Returns the body chosen last, the light, the camera or the background; one of them at most.
    const std::optional<Chosen>& choice() const { return chosen; }
    const std::optional<LightPoint>& light() const { return chosen_light; }
    const std::optional<TopBlock>& block() const { return chosen_block; }
    bool any() const { return chosen || chosen_light || chosen_block; }
    /// Returns the numbers of all bodies chosen, in ascending order.
    std::vector<int> bodies() const;
    /// Returns its number among the bodies or the lights of the scene; -1 if none of these is chosen.
    int number() const { return chosen ? chosen->at.body : chosen_light ? chosen_light->light : -1; }
    /// To be called when the body chosen was moved: the point that was clicked moves with it.
    void move_point(const DVec3& to) { chosen->point = to; }
    /// Looks for that point again along the line of the click, where the body may be back.
    void find_point(const Scene& scene);
    /// Returns the words and values of the body or the light chosen.
    const BodyText& body() const { return description; }
    /// The file in which it stands, if that is not the scene's own; else "".
    const std::string& file() const { return other_file; }
    /// Can the text not be changed here, but for numbers of a scene for POV-Ray?
    bool read_only() const { return povray || model || edited.text().empty(); }
    /// Says why, and what the user can do.
    const char* why_read_only() const;

    /// Looks at the text again, because the scene is another one. Chooses nothing if what was chosen is no longer
    /// there.
    void look(const Scene& scene);

    /// May the user change this value? Not before saying what is meant, if it comes from elsewhere.
    bool open_to_change(const BodyValue& value) const;
    /// Allows values that come from this block to be changed there.
    void allow(const std::string& source) { allowed.insert(source); }
    /// Changes a value where it stands, or else gives the body a value of its own. Numbers out of range become the
    /// nearest ones within. Returns whether the text has changed.
    bool change(const BodyValue& value, std::span<const double> numbers, EditOrder& order, bool merged = false);
    /// Gives the body a value of its own, equal to the one that comes from elsewhere.
    bool make_own(const BodyValue& value, EditOrder& order);
    /// Returns the name of what is chosen, for the user: "sphere 1". names() is that of all bodies: "3 bodies".
    std::string name() const;
    std::string names() const;

    EditedText edited;

  private:
    std::optional<Chosen> chosen;
    std::vector<int> others;  // bodies chosen before that one
    std::optional<LightPoint> chosen_light;
    std::optional<TopBlock> chosen_block;
    std::optional<Ray<double>> clicked;
    BodyText description;
    std::string other_file;
    void look_at_literals(const std::vector<pov::SourceLines::BlockLine>& places, int number);

    bool povray = false, model = false;
    pov::SourceLines lines;
    std::string lines_text;  // text that contains these lines
    std::set<std::string> allowed;
};

}  // namespace strahl

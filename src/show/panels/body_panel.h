// The panel of what is chosen: what it is, where it stands in the file, and its numbers, which the user changes there.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "show/keys/commands.h"
#include "show/panels/covered_area.h"
#include "show/session/body_editor.h"
#include "show/timeline/number_fields.h"
#include "text/new_block.h"
#include "text/place_body.h"

namespace strahl {

/// The user's actions on the panel since the last picture. Values are those of BodyEditor::body(), by number.
struct BodyInput {
    std::optional<Command> command{};
    bool close = false;
    struct NewNumbers {
        std::size_t value;
        std::vector<double> numbers;
        bool merged;  // belongs to the same drag as the change before
    };
    std::optional<NewNumbers> change{};
    struct NewTrack {
        std::size_t value;
        int component;  // -1: each
        std::string name;
    };
    std::optional<NewTrack> track{};  // which a number follows from now on
    struct NewPlace {
        Placing placing;  // about the middle of what is chosen
        bool merged;      // belongs to the same drag as the one before, and takes its place
    };
    std::optional<NewPlace> place{};         // is moved, turned or scaled
    std::optional<std::size_t> free{};       // follows no tracks from now on
    std::optional<std::size_t> own{};        // gets a value of the body's own
    std::optional<std::string> allow{};      // changes values in this block
    const MaterialPreset* preset = nullptr;  // gets this material
    std::string refused{};                   // why a number that was typed is not taken, or ""
};

class BodyPanel {
  public:
    /// To be called while ImGui makes a frame. `left`: it stands there, else at the right. Sets what it covers.
    BodyInput draw(const BodyEditor& editor, const std::string& file, const Margins& margins, bool left,
                   CoveredArea& covered);

  private:
    void draw_placing(const BodyEditor& editor, BodyInput& input);
    void draw_value(const BodyEditor& editor, std::size_t number, std::string& source, BodyInput& input);
    void draw_track(const BodyEditor& editor, std::size_t number, BodyInput& input);

    float labels = 0;  // width of the names of values, in pixels
    NumberFields fields;
    bool held = false;                                        // a value has been changed since the mouse button is down
    std::array<double, 3> moves{}, turns{}, scales{1, 1, 1};  // by which it is placed while a field is used
    double scales_all = 1;
    std::array<char, 64> track_name{};  // that is being typed
};

}  // namespace strahl

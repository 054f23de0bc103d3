// The list of what is in the scene: camera, background, lights, bodies and the parts of composites, to be found, chosen
// and hidden.
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "show/keys/commands.h"
#include "show/panels/covered_area.h"
#include "show/session/body_editor.h"
#include "text/place_body.h"

namespace strahl {

/// A line of the outline: the camera, the background, a light, a body, or a part of a composite.
struct OutlineRow {
    TopBlock what = TopBlock::body;
    int number = 0;      // of the light or the body
    int leaf = 0;        // first leaf of the body that belongs to the part
    int depth = 0;       // 0 for blocks of the top level, 1 for the parts of a composite, 2 for their parts
    std::string name{};  // "sphere 3"
};
/// Returns the outline of a scene: its camera, its background, its lights, and its bodies with their parts.
std::vector<OutlineRow> outline_of(const Scene& scene);
/// Returns the numbers of the rows to be shown: those whose names have these words in them, in capitals or not, and the
/// bodies around them. Without words, all lights and bodies, and the parts of the bodies that are open.
std::vector<std::size_t> rows_shown(const std::vector<OutlineRow>& rows, std::string_view words,
                                    const std::set<int>& open);

/// The user's actions on the outline since the last picture.
struct OutlinerInput {
    /// A row to choose; a body to hide, or to show again; a body to show alone, or to end that.
    std::optional<OutlineRow> choose{}, hide{}, alone{};
    bool adds = false;  // to what is chosen
    bool show_all = false;
    std::optional<Message> message{};  // a message of `check` whose line is to be opened
};

class Outliner {
  public:
    /// To be called while ImGui makes a frame. `hidden` are the bodies that the picture lacks, and `notes` what was
    /// said when the scene was opened. Sets what it covers.
    OutlinerInput draw(const std::shared_ptr<const Scene>& scene, const BodyEditor& editor, const std::set<int>& hidden,
                       const std::vector<Message>& notes, const Margins& margins, CoveredArea& covered);

  private:
    void draw_row(const OutlineRow& row, const BodyEditor& editor, const std::set<int>& hidden, OutlinerInput& input);

    std::shared_ptr<const Scene> known;  // the scene of these
    std::vector<OutlineRow> rows;
    std::vector<std::string> warnings;
    std::set<int> open;             // composites whose parts are shown
    std::array<char, 64> sought{};  // what the user has typed
};

}  // namespace strahl

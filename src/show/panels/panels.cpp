#include "show/panels/panels.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <utility>

namespace strahl {

bool Panels::toggle(Action action) {
    bool* const seen = action == Action::help      ? &help
                       : action == Action::toolbar ? &toolbar_open
                       : action == Action::gallery ? &gallery
                       : action == Action::quiet   ? &quiet
                                                   : nullptr;
    const auto named = std::ranges::find(panel_actions, action);
    if (seen) {
        *seen = !*seen;
    } else if (named != panel_actions.end()) {
        const Panel panel{static_cast<int>(named - panel_actions.begin())};
        room.shown(panel) ? room.close(panel) : room.open(panel);
    } else {
        return false;
    }
    pace.redraw(3);
    if (action == Action::help) typed.clear();
    if (action != Action::quiet) quiet = false;
    if (action == Action::toolbar) hide_toolbar(!toolbar_open);
    return true;
}

void Panels::arrange(const BodyEditor& editor) {
    const std::tuple chosen(editor.number(), editor.light().has_value(), editor.block());
    if (!editor.any())
        room.close(Panel::body);
    else if (chosen != chosen_before)
        room.open(Panel::body);
    chosen_before = chosen;
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    constexpr float least = 12, info = 23;      // in heights of a line
    room.area(Panel::info).wide = info * font;  // it is drawn by the overlay
    room.arrange({.width = all.x - .8f * font,
                  .height = all.y - reserved_top(),
                  .least = least * font,
                  .timeline = timeline.height()});
}

bool Panels::step_back_from_popup() {
    if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return false;
    ImGui::ClosePopupToLevel(0, true);
    pace.redraw(3);
    return true;
}

bool Panels::step_back() {
    const std::vector<Panel>& opened = room.opened();
    const auto seen = std::find_if(opened.rbegin(), opened.rend(),
                                   [&](Panel panel) { return panel != Panel::body && room.shown(panel); });
    if (seen == opened.rend()) return false;
    room.close(*seen);
    pace.redraw(3);
    return true;
}

void Panels::search(unsigned character) {
    if (character >= ' ' && character < 127 && typed.size() < 40)
        typed += static_cast<char>(character);
    else if (character == 0 && !typed.empty())
        typed.pop_back();
    pace.redraw();
}

TimelineInput Panels::draw_timeline(const Session& session, const std::vector<float>& peaks, bool text_open,
                                    bool both) {
    if (!timeline_shown()) return {};
    const auto flight = session.path_to_fly();
    return timeline.draw({.editor = session.editor,
                          .scene_camera = session.scene->camera,
                          .time = session.flight.time(pace.now()),
                          .duration = flight ? flight->duration : session.editor.path().duration,
                          .running = session.flight.under_way(),
                          .outside = session.outside,
                          .both = both,
                          .scene = session.scene,
                          .tracks = session.tracks ? *session.tracks : session.track_keys.tracks(),
                          .peaks = peaks,
                          .text_open = text_open,
                          .keys_open = text_open && !session.keys_elsewhere,
                          .keys_changed = session.track_keys.changed()});
}

bool Panels::delete_clicked_key() {
    if (!timeline_shown() || !timeline.key_clicked()) return false;
    timeline.delete_clicked();
    pace.redraw(3);
    return true;
}

const NewBlock* Panels::draw_add() {
    if (!shown(Panel::add)) return nullptr;
    const NewBlock* const chosen = draw_add_panel({beside_add(), reserved_top(), reserved()}, room.area(Panel::add));
    if (chosen) room.close(Panel::add);
    return chosen;
}

OutlinerInput Panels::draw_outline(const Session& session, const BodyEditor& editor, const std::set<int>& hidden,
                                   const std::vector<Message>& notes) {
    if (!shown(Panel::outline)) return {};
    return outliner.draw(session.scene, editor, hidden, notes, margins(), room.area(Panel::outline));
}

BodyInput Panels::draw_body(const BodyEditor& editor, const std::string& file) {
    if (const auto x = std::exchange(clicked_x, std::nullopt))
        clicked_at_right = *x > .6 * ImGui::GetIO().DisplaySize.x;
    return body_shown() ? body.draw(editor, file, margins(), body_left(), room.area(Panel::body)) : BodyInput{};
}

std::optional<Command> Panels::draw_toolbar(const KeyMap& keys, ToolbarView view) {
    if (!toolbar_shown()) return std::nullopt;
    view.adding = room.is_open(Panel::add);
    return toolbar.draw(keys, view);
}

}  // namespace strahl

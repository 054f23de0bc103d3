#include "show/panels/panels.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <utility>

namespace strahl {

void Panels::toggle(Action action) {
    pace.redraw();
    bool& panel = shown(action);
    panel = !panel;
    if (action == Action::help) typed.clear();
    if (action != Action::quiet) quiet = false;
    if (action == Action::toolbar) hide_toolbar(!toolbar_open);
}

/// Is the panel shown that the action names?
bool& Panels::shown(Action action) {
    return action == Action::help        ? help
           : action == Action::info      ? info
           : action == Action::timeline  ? timeline_open
           : action == Action::add_block ? add_open
           : action == Action::outline   ? outline_open
           : action == Action::toolbar   ? toolbar_open
           : action == Action::gallery   ? gallery
                                         : quiet;
}

bool Panels::step_back_from_popup() {
    if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return false;
    ImGui::ClosePopupToLevel(0, true);
    pace.redraw(3);
    return true;
}

bool Panels::step_back() {
    for (const Action panel : {Action::add_block, Action::info, Action::outline, Action::timeline})
        if (shown(panel)) return toggle(panel), true;
    return false;
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
    const NewBlock* const chosen = add_shown() ? add.draw({reserved_left(), reserved_top(), reserved()}) : nullptr;
    if (chosen) add_open = false;
    return chosen;
}

OutlinerInput Panels::draw_outline(const Session& session, const BodyEditor& editor, const std::set<int>& hidden,
                                   const std::vector<Message>& notes) {
    return outline_shown() ? outliner.draw(session.scene, editor, hidden, notes, margins()) : OutlinerInput{};
}

BodyInput Panels::draw_body(const BodyEditor& editor, const std::string& file) {
    body_shown = editor.any() && !quiet && !help;  // the help needs the room
    if (const auto x = std::exchange(clicked_x, std::nullopt))
        clicked_at_right = *x > .6 * ImGui::GetIO().DisplaySize.x;
    return body_shown ? body.draw(editor, file, margins(), body_left()) : BodyInput{};
}

std::optional<Command> Panels::draw_toolbar(const KeyMap& keys, ToolbarView view) {
    if (!toolbar_shown()) return std::nullopt;
    view.adding = add_open;
    return toolbar.draw(keys, view);
}

}  // namespace strahl

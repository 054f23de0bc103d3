#include "show/panels/outliner.h"

#include <imgui.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "files/words.h"
#include "scene/leaves.h"
#include "text/scene_warnings.h"

namespace strahl {
namespace {

const char* name_of(const Shape& shape) {
    return std::visit([]<class Kind>(const Kind&) { return Kind::name; }, shape);
}

void add_parts(const Primitive& body, int number, int depth, int& leaf, std::vector<OutlineRow>& rows) {
    bool any = false;
    each_part(body, [&](const Primitive& part) {
        any = true;
        rows.push_back({TopBlock::body, number, leaf, depth, name_of(part.shape)});
        add_parts(part, number, depth + 1, leaf, rows);
    });
    if (!any) ++leaf;
}

std::string in_small_letters(std::string_view text) {
    std::string small(text);
    for (char& c : small) c = lower(c);
    return small;
}

/// Is this row chosen?
bool chosen(const OutlineRow& row, const BodyEditor& editor) {
    if (row.what == TopBlock::light) return editor.light() && editor.light()->light == row.number;
    if (row.what != TopBlock::body) return editor.block() == row.what;
    const auto& last = editor.choice();
    if (row.depth > 0) return last && last->at.body == row.number && last->at.hit.leaf == row.leaf;
    return std::ranges::count(editor.bodies(), row.number) > 0;
}

/// Draws a small button of a fixed width. Returns whether it was pressed.
bool small_button(const char* label, const char* help) {
    const bool pressed = ImGui::SmallButton(label);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    ImGui::SameLine();
    return pressed;
}

}  // namespace

std::vector<OutlineRow> outline_of(const Scene& scene) {
    std::vector<OutlineRow> rows{{.what = TopBlock::camera, .name = "camera"},
                                 {.what = TopBlock::background, .name = "background"}};
    for (int i = 0; i < std::ssize(scene.lights); ++i) {
        const Light& light = scene.lights[std::size_t(i)];
        const char* const name = light.direction ? "parallel light"
                                 : light.area    ? "rectangular light"
                                 : light.spot    ? "spotlight"
                                                 : "light";
        rows.push_back({.what = TopBlock::light, .number = i, .name = name + (" " + std::to_string(i + 1))});
    }
    for (int i = 0; i < std::ssize(scene.primitives); ++i) {
        const Primitive& body = scene.primitives[std::size_t(i)];
        rows.push_back({.number = i, .name = name_of(body.shape) + (" " + std::to_string(i + 1))});
        int leaf = 0;
        add_parts(body, i, 1, leaf, rows);
    }
    return rows;
}

std::vector<std::size_t> rows_shown(const std::vector<OutlineRow>& rows, std::string_view words,
                                    const std::set<int>& open) {
    const std::string sought = in_small_letters(words);
    std::vector<std::size_t> shown;
    std::size_t body = 0;  // the row of the body around a part
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].depth == 0) body = i;
        if (sought.empty()) {
            if (rows[i].depth == 0 || open.contains(rows[i].number)) shown.push_back(i);
        } else if (in_small_letters(rows[i].name).find(sought) != std::string::npos) {
            if (i != body && (shown.empty() || shown.back() < body)) shown.push_back(body);
            shown.push_back(i);
        }
    }
    return shown;
}

OutlinerInput Outliner::draw(const std::shared_ptr<const Scene>& scene, const BodyEditor& editor,
                             const std::set<int>& hidden, const std::vector<Message>& notes, const Margins& margins,
                             CoveredArea& covered) {
    OutlinerInput input;
    if (known != scene) rows = outline_of(*scene), warnings = scene_warnings(*scene), known = scene;
    const float font = ImGui::GetFontSize(), width = 17 * font;
    begin_panel("outline", 0, 0, margins);
    ImGui::SetNextItemWidth(width - 4.5f * font);
    ImGui::InputTextWithHint("##sought", "search", sought.data(), sought.size());
    ImGui::SameLine();
    if (ImGui::SmallButton("show all")) input.show_all = true;

    const std::vector<std::size_t> shown = rows_shown(rows, sought.data(), open);
    const std::size_t messages = warnings.size() + notes.size();
    const float line = ImGui::GetTextLineHeightWithSpacing(),
                all = ImGui::GetIO().DisplaySize.y - margins.top - margins.bottom;
    const float told = messages == 0 ? 1 : std::min(.2f * all, float(messages) * 3 * line);
    // The rows scroll, so that all other parts have room.
    const float room = std::max(all - told - 6 * line, 3 * line);
    const float height = std::min({float(shown.size()) * line + font, std::max(.55f * all, 4 * line), room});
    ImGui::BeginChild("rows", {width, height});
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(shown.size()), line);
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            ImGui::PushID(i);
            draw_row(rows[shown[std::size_t(i)]], editor, hidden, input);
            ImGui::PopID();
        }
    ImGui::EndChild();

    ImGui::Separator();
    ImGui::TextDisabled(messages == 0 ? "check: no warnings" : "check:");
    ImGui::BeginChild("messages", {width, told});
    ImGui::PushTextWrapPos(0);
    for (const std::string& warning : warnings) ImGui::TextUnformatted(warning.c_str());
    for (const Message& note : notes) {
        ImGui::TextUnformatted(note.told().c_str());
        if (ImGui::IsItemClicked()) input.message = note;
    }
    ImGui::PopTextWrapPos();
    ImGui::EndChild();
    covered = end_panel();
    return input;
}

void Outliner::draw_row(const OutlineRow& row, const BodyEditor& editor, const std::set<int>& hidden,
                        OutlinerInput& input) {
    const bool body = row.what == TopBlock::body, top = row.depth == 0, shows = !body || !hidden.contains(row.number);
    const float font = ImGui::GetFontSize();
    if (top && body) {
        if (small_button(shows ? "hide" : "show", "hides it in the picture, or shows it again")) input.hide = row;
        if (small_button("only", "shows nothing else in the picture, or all again")) input.alone = row;
        const auto next = &row + 1;
        const bool composite = next < rows.data() + rows.size() && next->depth > 0;
        if (composite && small_button(open.contains(row.number) ? "v" : ">", "shows its parts") &&
            !open.erase(row.number))
            open.insert(row.number);
    }
    ImGui::SetCursorPosX(float(row.depth + (body ? 9 : 0)) * font);
    ImGui::PushStyleColor(ImGuiCol_Text, {1, 1, 1, shows ? 1 : .45f});
    if (ImGui::Selectable(row.name.c_str(), chosen(row, editor)))
        input.choose = row, input.adds = ImGui::GetIO().KeyShift;
    ImGui::PopStyleColor();
}

}  // namespace strahl

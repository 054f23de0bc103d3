// Draws the panels of the overlay with ImGui.
#include "show/window/overlay.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace strahl {
namespace {

const ImVec4 accent{0.55f, 0.80f, 1, 1}, quiet{1, 1, 1, 0.60f}, alarm{1, 0.45f, 0.38f, 1};
constexpr ImGuiWindowFlags plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                   ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;

/// The part of the window that no panel covers yet, in pixels.
struct FreeArea {
    float left, top, right, bottom;
    float width() const { return std::max(right - left, 1.f); }
    float height() const { return std::max(bottom - top, 1.f); }
};

/// The distance between panels, and to the edge of the window.
float gap() { return ImGui::GetFontSize() * 0.8f; }

/// Draws a panel at (x, y) of the free area: 0 is left or top, 1 right or bottom. Returns its size with a gap beside
/// it.
template <class Content>
ImVec2 panel(const char* name, const FreeArea& free, float x, float y, Content content) {
    ImGui::SetNextWindowPos({free.left + free.width() * x, free.top + free.height() * y}, ImGuiCond_Always, {x, y});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {free.width(), free.height()});
    ImGui::Begin(name, nullptr, plain);
    content();
    const ImVec2 size = ImGui::GetWindowSize();
    ImGui::End();
    return {size.x + gap(), size.y + gap()};
}

void cell(const ImVec4& color, const char* text) {
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

ImVec2 draw_info(const Overlay& overlay, const FreeArea& free) {
    return panel("info", free, 0, 0, [&] {
        if (!ImGui::BeginTable("values", 2, ImGuiTableFlags_SizingFixedFit)) return;
        for (const auto& [name, value] : overlay.info) {
            ImGui::TableNextRow();
            cell(quiet, name.c_str());
            cell(ImGui::GetStyleColorVec4(ImGuiCol_Text), value.c_str());
        }
        ImGui::EndTable();
        ImGui::ProgressBar(static_cast<float>(overlay.share), {-1, ImGui::GetFontSize() * 0.3f}, "");
    });
}

/// Draws the error on at most half of the window; the log has the rest.
void draw_fault(const Overlay& overlay, const FreeArea& free) {
    panel("fault", free, 0.5f, 1, [&] {
        const float font = ImGui::GetFontSize(), wide = free.width() - 2 * font;
        const float lowest = std::min(ImGui::GetIO().DisplaySize.y / 2, free.height());
        ImGui::PushTextWrapPos(wide);
        ImGui::PushStyleColor(ImGuiCol_Text, alarm);
        ImGui::TextUnformatted(overlay.fault_title.c_str());
        ImGui::PopStyleColor();
        ImGui::Spacing();
        std::istringstream lines(overlay.fault);
        for (std::string line; std::getline(lines, line);) {
            const float height = ImGui::CalcTextSize(line.c_str(), nullptr, false, wide).y;
            if (ImGui::GetCursorPosY() + height + 3 * font > lowest) {
                ImGui::Text("... and more on standard output (%s hides this)", overlay.quiet_key.c_str());
                break;
            }
            ImGui::TextUnformatted(line.c_str());
        }
        ImGui::PopTextWrapPos();
    });
}

ImVec2 draw_notes(const Overlay& overlay, FreeArea free, float x) {
    // Where panels leave no room beside each other, notes lie over their lower ends.
    const bool narrow = free.width() < 14 * ImGui::GetFontSize();
    if (narrow) free.left = gap(), free.right = ImGui::GetIO().DisplaySize.x - gap();
    return panel("notes", free, x, overlay.notes_below || narrow ? 1 : 0, [&] {
        if (narrow) ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
        ImGui::PushTextWrapPos(free.width() - 2 * ImGui::GetFontSize());
        for (const Note& note : overlay.notes) {
            ImGui::PushStyleColor(ImGuiCol_Text, note.failure ? alarm : ImGui::GetStyleColorVec4(ImGuiCol_Text));
            ImGui::TextUnformatted(note.text.c_str());
            ImGui::PopStyleColor();
        }
        for (const Overlay::Bar& bar : overlay.bars) {
            ImGui::TextUnformatted(bar.text.c_str());
            ImGui::ProgressBar(static_cast<float>(bar.share), {ImGui::GetFontSize() * 18, ImGui::GetFontSize() * 0.4f},
                               "");
        }
        ImGui::PopTextWrapPos();
    });
}

/// Draws a line of two colours around the body that is chosen, to be seen on any picture.
void draw_silhouette(const Overlay& overlay) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto place = [&](int x, int y) {
        const auto along = [](int begin, int size, int at, int pixels) {
            return static_cast<float>(begin + double(size) * at / pixels);
        };
        return ImVec2{along(overlay.area.x, overlay.area.width, x, overlay.width),
                      along(overlay.area.y, overlay.area.height, y, overlay.height)};
    };
    for (const auto& [color, width] : {std::pair(IM_COL32(0, 0, 0, 160), 3.f), {IM_COL32(255, 190, 90, 255), 1.f}})
        for (const auto& [x0, y0, x1, y1] : overlay.silhouette)
            list.AddRectFilled({place(x0, y0).x - width / 2, place(x0, y0).y - width / 2},
                               {place(x1, y1).x + width / 2, place(x1, y1).y + width / 2}, color);
}

/// Draws the marks of lights, in their colours, with the cones of spots.
void draw_lights(const Overlay& overlay) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float size = ImGui::GetFontSize() * .4f;
    const auto place = [&](const glm::dvec2& at) {
        return ImVec2{static_cast<float>(overlay.area.x + at.x), static_cast<float>(overlay.area.y + at.y)};
    };
    for (const std::vector<glm::dvec2>& line : overlay.tools.marks.lines)
        for (const auto& [color, width] : {std::pair(IM_COL32(0, 0, 0, 120), 3.f), {IM_COL32(255, 240, 200, 220), 1.f}})
            for (std::size_t i = 0; i + 1 < line.size(); ++i)
                list.AddLine(place(line[i]), place(line[i + 1]), color, width);
    for (const LightMark& mark : overlay.tools.marks.marks) {
        const ImVec2 at = place(mark.place);
        const auto part = [](double share) { return static_cast<int>(255 * std::clamp(share, 0., 1.)); };
        const ImU32 color = IM_COL32(part(mark.color.x), part(mark.color.y), part(mark.color.z), 255);
        const bool chosen = overlay.tools.chosen == mark.at;
        const ImU32 edge = chosen ? IM_COL32(255, 190, 90, 255) : IM_COL32(0, 0, 0, 200);
        if (mark.at.target) {
            list.AddRectFilled({at.x - size, at.y - size}, {at.x + size, at.y + size}, color);
            list.AddRect({at.x - size, at.y - size}, {at.x + size, at.y + size}, edge, 0, 0, 2);
            continue;
        }
        for (int i = 0; i < 8; ++i) {
            const float angle = static_cast<float>(i) * .7854f, x = std::cos(angle), y = std::sin(angle);
            list.AddLine({at.x + 1.3f * size * x, at.y + 1.3f * size * y},
                         {at.x + 2.1f * size * x, at.y + 2.1f * size * y}, edge, 2);
        }
        list.AddCircleFilled(at, size, color);
        list.AddCircle(at, size, edge, 0, 2);
    }
}

/// Draws the path of the camera with its keys, in the colours of the timeline.
void draw_path(const Overlay& overlay) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float r = ImGui::GetFontSize() * .35f;
    const auto place = [&](const glm::dvec2& at) {
        return ImVec2{static_cast<float>(overlay.area.x + at.x), static_cast<float>(overlay.area.y + at.y)};
    };
    const ImU32 color = IM_COL32(140, 204, 255, 255), here = IM_COL32(255, 190, 90, 255);
    for (const auto* const lines : {&overlay.path.looks, &overlay.path.lines})
        for (const std::vector<glm::dvec2>& line : *lines)
            for (std::size_t i = 0; i + 1 < line.size(); ++i)
                list.AddLine(place(line[i]), place(line[i + 1]), color, lines == &overlay.path.lines ? 2.f : 1.f);
    const auto diamond = [&](const glm::dvec2& key, ImU32 filled) {
        const ImVec2 at = place(key);
        list.AddQuadFilled({at.x - r, at.y}, {at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, filled);
    };
    for (const glm::dvec2& key : overlay.path.keys) diamond(key, color);
    if (overlay.path.now) diamond(*overlay.path.now, here);
}

/// Draws handles in the usual colours of the axes: x red, y green, z blue. The one that can be dragged is yellow.
void draw_handles(const Overlay& overlay) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const Handles::HandleLine& line : overlay.tools.handles) {
        constexpr ImU32 colors[] = {IM_COL32(255, 80, 80, 255), IM_COL32(110, 220, 80, 255),
                                    IM_COL32(90, 140, 255, 255), IM_COL32(255, 255, 255, 255)};
        const ImU32 color =
            line.handle == overlay.tools.pointed ? IM_COL32(255, 230, 60, 255) : colors[static_cast<int>(line.handle)];
        std::vector<ImVec2> points;
        for (const glm::dvec2& at : line.points)
            points.push_back({static_cast<float>(overlay.area.x + at.x), static_cast<float>(overlay.area.y + at.y)});
        const int count = static_cast<int>(points.size());
        if (line.filled) list.AddConvexPolyFilled(points.data(), count - 1, color);
        list.AddPolyline(points.data(), count, IM_COL32(0, 0, 0, 160), 0, line.filled ? 1.f : 4.f);
        if (!line.filled) list.AddPolyline(points.data(), count, color, 0, 2);
    }
}

/// Draws pixels that are not proved in blue, and small crosses, because single pixels are hard to see: orange where
/// only float differs, red where double does too.
void draw_marks(const Overlay& overlay) {
    const float reach = ImGui::GetFontSize() / 5;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto place = [&](double x, double y) {
        return ImVec2{static_cast<float>(overlay.area.x + overlay.area.width * x / overlay.width),
                      static_cast<float>(overlay.area.y + overlay.area.height * y / overlay.height)};
    };
    for (const auto& [x, y, columns] : overlay.marks.undecided)
        list.AddRectFilled(place(x, y), place(x + columns, y + 1), IM_COL32(60, 100, 255, 160));
    for (const Mark& mark : overlay.marks.marks) {
        const ImVec2 at = place(mark.x + .5, mark.y + .5);
        const ImU32 color = mark.in_double ? IM_COL32(255, 0, 25, 255) : IM_COL32(255, 153, 0, 255);
        list.AddLine({at.x - reach, at.y}, {at.x + reach, at.y}, color, 1.5f);
        list.AddLine({at.x, at.y - reach}, {at.x, at.y + reach}, color, 1.5f);
    }
}

/// Draws the line between the two pictures with a handle, and on both sides what is seen there.
void draw_divider(const Overlay::Sides& sides, const ScreenArea& area, float lowest) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float font = ImGui::GetFontSize(), x = static_cast<float>(sides.column), top = static_cast<float>(area.y);
    const float bottom = top + static_cast<float>(area.height), middle = (top + bottom) / 2, grip = font * .35f;
    for (const auto& [color, wide] : {std::pair(IM_COL32(0, 0, 0, 160), 2.f), {IM_COL32(255, 255, 255, 255), 1.f}}) {
        list.AddRectFilled({x - wide, top}, {x + wide - 1, bottom}, color);
        list.AddRectFilled({x - grip - wide, middle - font - wide}, {x + grip + wide - 1, middle + font + wide}, color,
                           grip);
    }
    const auto label = [&](const std::string& text, bool to_the_right) {
        if (text.empty()) return;
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const float right_end = static_cast<float>(area.x + area.width) - font - size.x;
        const float left = to_the_right ? std::min(x + font, right_end) : x - font - size.x;
        const float high = std::min(bottom, lowest) - 1.8f * font;
        const float edge = font * .4f;
        list.AddRectFilled({left - edge, high - edge / 2}, {left + size.x + edge, high + size.y + edge / 2},
                           ImGui::GetColorU32(ImGuiCol_WindowBg), edge);
        list.AddText({left, high}, IM_COL32(255, 255, 255, 255), text.c_str());
    };
    label(sides.left, false), label(sides.right, true);
}

}  // namespace

void draw_overlay(const Overlay& overlay) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto other_view = overlay.sides ? overlay.sides->other_view : std::nullopt;
    if (other_view) {  // marks are on the picture at the left only
        const auto bar = [&](int top, int bottom) {
            list.AddRectFilled({float(other_view->x), float(top)},
                               {float(other_view->x + other_view->width), float(bottom)}, IM_COL32(20, 20, 20, 255));
        };
        bar(overlay.area.y, other_view->y);
        bar(other_view->y + other_view->height, overlay.area.y + overlay.area.height);
        list.PushClipRect({0, 0}, {float(overlay.sides->column), ImGui::GetIO().DisplaySize.y});
    }
    draw_marks(overlay);
    draw_silhouette(overlay);
    draw_path(overlay);
    draw_lights(overlay);
    draw_handles(overlay);
    if (other_view) list.PopClipRect();
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    FreeArea free{gap() + overlay.reserved_left, gap() + overlay.reserved_top, all.x - overlay.reserved_right - gap(),
                  all.y - overlay.reserved - gap()};
    if (overlay.sides) draw_divider(*overlay.sides, overlay.area, free.bottom + gap());
    const bool info = !overlay.info.empty();
    if (info) free.top += draw_info(overlay, free).y;
    if (!overlay.notes.empty() || !overlay.bars.empty()) free.top += draw_notes(overlay, free, info ? 0 : 1).y;
    if (!overlay.fault.empty()) draw_fault(overlay, free);
}

}  // namespace strahl

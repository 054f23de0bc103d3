#include "show/timeline/time_scale.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strahl {
namespace {

constexpr ImU32 sound_color = IM_COL32(120, 160, 120, 120);

}  // namespace

void TimeScale::show(const TimelineView& view, float names) {
    const float font = ImGui::GetFontSize();
    left = ImGui::GetCursorScreenPos().x + font + names;
    length = std::max(ImGui::GetContentRegionAvail().x - 2 * font - names, 1.f);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    const double all = std::max({1.15 * view.duration, double(view.peaks.size()) / 100, 10.});
    range = all / zoomed;
    const bool moved = view.time != std::exchange(shown_time, view.time);
    if (moved && (view.time < from || view.time > from + range)) from = view.time - .1 * range;
    from = std::clamp(from, 0., all - range);
}

void TimeScale::zoom() {
    const float notches = ImGui::GetIO().MouseWheel;
    if (notches == 0 || !ImGui::IsItemHovered()) return;
    const double at = time_at(ImGui::GetIO().MousePos.x), before = zoomed;
    zoomed = std::clamp(zoomed * std::pow(1.25, double(notches)), 1., 1000.);
    from = at - (at - from) * before / zoomed;
}

void TimeScale::draw_sound(const TimelineView& view, float top, float bottom) const {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = (top + bottom) / 2;
    const auto count = double(view.peaks.size());
    for (float x = left; x < left + length; ++x) {
        const double begin = 100 * time_at(x), end = std::max(100 * time_at(x + 1), begin + 1);
        if (begin < 0 || begin >= count) continue;
        const auto first = view.peaks.begin() + std::ptrdiff_t(begin);
        const float peak = *std::max_element(first, view.peaks.begin() + std::ptrdiff_t(std::min(end, count - 1)) + 1);
        const float half = peak * (bottom - top) / 2;
        list.AddLine({x, middle - half}, {x, middle + half}, sound_color);
    }
}

void TimeScale::draw_grid(const Music& music, float top, float bottom) const {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto draw = [&](double seconds, float least, ImU32 color) {
        const double pixels = double(length) * seconds / range;
        if (!(pixels >= double(least))) return;
        const double first = std::max(std::ceil((from - music.offset) / seconds), 0.);
        for (double time = 0, i = first; (time = music.offset + i * seconds) <= from + range; ++i)
            list.AddLine({x_of(time), top}, {x_of(time), bottom}, color);
    };
    const double row = music.time_of(1) - music.offset;
    draw(row, 7, beat_color), draw(music.rows * row, 4, beat_color), draw(4 * music.rows * row, 4, line_color);
}

void TimeScale::draw_moment(const TimelineView& view, float top, float bottom) const {
    const float x = x_of(view.time);
    if (x >= left && x <= left + length) ImGui::GetWindowDrawList()->AddLine({x, top}, {x, bottom}, here_color, 2);
}

}  // namespace strahl

// Decides which seconds the timeline shows, and where.
#pragma once
#include <imgui.h>

#include "show/timeline/timeline_view.h"

namespace strahl {

inline constexpr ImU32 line_color = IM_COL32(255, 255, 255, 70), text_color = IM_COL32(255, 255, 255, 150),
                       key_color = IM_COL32(140, 204, 255, 255), here_color = IM_COL32(255, 190, 90, 255),
                       beat_color = IM_COL32(255, 255, 255, 26);

class TimeScale {
  public:
    /// Finds what part of the flight and of the sound is shown, and takes the width that is left in the panel behind a
    /// column of names, of this width in pixels.
    void show(const TimelineView& view, float names);
    /// Follows the wheel over what was drawn last, around the pointer.
    void zoom();

    float x_of(double time) const { return left + length * static_cast<float>((time - from) / range); }
    double time_at(float x) const { return from + static_cast<double>((x - left) / length) * range; }
    /// Returns the seconds that so many pixels stand for.
    double seconds_of(float pixels) const { return double(pixels / length) * range; }
    float first_x() const { return left; }
    float last_x() const { return left + length; }
    double first() const { return from; }
    double last() const { return from + range; }

    /// Draw between these heights the sound as far as it is shown; beats, every fourth one brighter, and rows, as far
    /// as there is room for them; and the moment of the flight.
    void draw_sound(const TimelineView& view, float top, float bottom) const;
    void draw_grid(const Music& music, float top, float bottom) const;
    void draw_moment(const TimelineView& view, float top, float bottom) const;

  private:
    double from = 0, range = 10, zoomed = 1;  // in seconds; constant during a drag
    double shown_time = 0;
    float left = 0, length = 1;  // in pixels
};

}  // namespace strahl

// The part of the window that a panel covers, where clicks are meant for it.
#pragma once

namespace strahl {

/// In pixels of the window; nothing by default. `wide` is its width with the space beside it.
struct CoveredArea {
    float left = 0, top = 0, right = 0, bottom = 0, wide = 0;
    bool has(double x, double y) const { return x >= left && y >= top && x < right && y < bottom; }
};

/// Says what other panels take at the edges of the window, in pixels.
struct Margins {
    float left = 0, top = 0, bottom = 0;
};

/// Begins a panel of ImGui that takes input, with its corner at (x, y), where (0, 0) is the top left corner of the
/// window within the margins and (1, 1) the bottom right one.
/// Without `scrolls` its content has to fit.
void begin_panel(const char* name, float x, float y, const Margins& margins, bool scrolls = true);
/// Ends it. Returns what it covers.
CoveredArea end_panel();

}  // namespace strahl

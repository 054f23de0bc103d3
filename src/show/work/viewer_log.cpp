// The log of the window.
#include "show/work/viewer_log.h"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "files/utf8.h"
#include "show/session/session.h"

namespace strahl {

void log_line(const std::string& text) { std::cout << "// " << printable(text) << std::endl; }

void MotionLog::begin(double now) { *this = {}, start = now; }

void MotionLog::drawn(double seconds) { drawing += seconds, ++draws; }

double MotionLog::rate(double now) const {
    const double window = std::min(1.0, now - start);
    const auto from = std::ranges::lower_bound(shown, now - window, {}, &ShownPicture::time);
    return window > 0 ? static_cast<double>(shown.end() - from) / window : 0;
}

std::string MotionLog::report(double now) const {
    std::vector<int> sorted;
    for (const ShownPicture& picture : shown) sorted.push_back(picture.level);
    std::ranges::sort(sorted);
    char text[200];
    const double seconds = now - start;
    std::snprintf(text, sizeof text,
                  "%zu pictures in %.2f s (%.1f/s; the first after %.0f ms), %s, %.1f ms to draw each", shown.size(),
                  seconds, seconds > 0 ? static_cast<double>(shown.size()) / seconds : 0,
                  shown.empty() ? 0 : 1000 * (shown[0].time - start),
                  sorted.empty() ? "none" : resolution_text(sorted[sorted.size() / 2]).c_str(),
                  1000 * draw_seconds());
    return text;
}

}  // namespace strahl

// The log of the window.
#include "show/viewer_log.h"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "show/session.h"
#include "text/utf8.h"

namespace strahl {

void log_line(const std::string& text) { std::cout << "// " << printable(text) << std::endl; }

void MotionLog::begin(double now) { *this = {}, start = now; }

void MotionLog::picture(double now, int level) { times.push_back(now), levels.push_back(level); }

void MotionLog::drawn(double seconds) { drawing += seconds, ++draws; }

double MotionLog::rate(double now) const {
    const double window = std::min(1.0, now - start);
    const auto from = std::ranges::lower_bound(times, now - window);
    return window > 0 ? static_cast<double>(times.end() - from) / window : 0;
}

std::string MotionLog::report(double now) const {
    std::vector<int> sorted = levels;
    std::ranges::sort(sorted);
    char text[200];
    const double seconds = now - start;
    std::snprintf(text, sizeof text,
                  "%zu pictures in %.2f s (%.1f/s; the first after %.0f ms), %s, %.1f ms to draw each", times.size(),
                  seconds, seconds > 0 ? static_cast<double>(times.size()) / seconds : 0,
                  times.empty() ? 0 : 1000 * (times[0] - start),
                  sorted.empty() ? "none" : resolution_text(sorted[sorted.size() / 2]).c_str(),
                  draws ? 1000 * drawing / draws : 0);
    return text;
}

}  // namespace strahl

// The progress line.
#include "main/process/progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "files/os/system.h"

namespace strahl {

std::string progress_text(double share, double seconds) {
    share = std::clamp(share, 0., 1.);
    std::array<char, 64> text;
    // 100 % is shown only when all is done.
    int length = std::snprintf(text.data(), text.size(), "%3d %%", static_cast<int>(share * 100));
    const double left = share > 0 ? std::ceil(seconds * (1 - share) / share) : INFINITY;
    if (seconds < .5 || left > 359999 || share == 1) return {text.data(), static_cast<std::size_t>(length)};
    const int s = static_cast<int>(left), h = s / 3600, m = s / 60 % 60;
    char* const end = text.data() + length;
    const std::size_t space = text.size() - static_cast<std::size_t>(length);
    length += h ? std::snprintf(end, space, ", %d:%02d:%02d left", h, m, s % 60)
                : std::snprintf(end, space, ", %d:%02d left", m, s % 60);
    return {text.data(), static_cast<std::size_t>(length)};
}

ProgressLine::ProgressLine(bool quiet, std::string label)
    : shown(!quiet && os::is_terminal(stderr)), label(std::move(label)) {}

ProgressLine::~ProgressLine() {
    if (written) std::fputs("\r\033[K", stderr);
}

void ProgressLine::advance(std::uint64_t done, std::uint64_t total) {
    if (!shown) return;
    // Workers never wait for the terminal: while one writes, the others skip it.
    const std::unique_lock lock(mutex, std::try_to_lock);
    if (!lock.owns_lock()) return;
    const auto now = Clock::now();
    // Threads may overtake each other on the way here; progress must not go backwards.
    furthest = std::max(furthest, done);
    if (now - last < std::chrono::milliseconds(100)) return;
    last = now;
    const double share = static_cast<double>(furthest) / static_cast<double>(total);
    const std::string text = progress_text(share, std::chrono::duration<double>(now - start).count());
    std::fprintf(stderr, "\r%s%s\033[K", label.c_str(), text.c_str());
    std::fflush(stderr);
    written = true;
}

}  // namespace strahl

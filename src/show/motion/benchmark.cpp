// Computes figures of a flight, and reports them as text and as JSON.
#include "show/motion/benchmark.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "files/utf8.h"
#include "show/session/session.h"

namespace strahl {
namespace {

/// Returns the least of the sorted values that at least this share of them does not exceed.
double percentile(const std::vector<double>& sorted, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

[[gnu::format(printf, 1, 2)]] std::string format(const char* form, ...) {
    char text[400];
    std::va_list values;
    va_start(values, form);
    std::vsnprintf(text, sizeof text, form, values);
    va_end(values);
    return text;
}

double rate(const Benchmark& b) { return b.seconds > 0 ? (b.pictures - 1) / b.seconds : 0; }

}  // namespace

ShownPicture shown_picture(double time, int level, int width, int height) {
    level = std::min(level, finest_level);
    return {time, level, count(pixels_of(level, width, height))};
}

void MotionLog::begin(double now) {
    const bool all = keeps_all;
    *this = {}, start = now, keeps_all = all;
}

void MotionLog::picture(const ShownPicture& picture) {
    constexpr std::ptrdiff_t most = 10000;
    if (!keeps_all && std::ssize(shown) == most) shown.erase(shown.begin(), shown.begin() + most / 2);
    if (count++ == 0) first = picture.time;
    shown.push_back(picture);
}

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
                  "%zu pictures in %.2f s (%.1f/s; the first after %.0f ms), %s, %.1f ms to draw each", count, seconds,
                  seconds > 0 ? static_cast<double>(count) / seconds : 0, count == 0 ? 0 : 1000 * (first - start),
                  sorted.empty() ? "none" : resolution_text(sorted[sorted.size() / 2]).c_str(), 1000 * draw_seconds());
    return text;
}

Benchmark benchmark_of(const std::vector<ShownPicture>& shown) {
    Benchmark b;
    b.pictures = static_cast<int>(shown.size());
    if (shown.size() < 2) return b;
    b.seconds = shown.back().time - shown.front().time;
    std::vector<double> intervals;
    double pixels = 0;
    for (std::size_t i = 1; i < shown.size(); ++i) {
        intervals.push_back(shown[i].time - shown[i - 1].time);
        pixels += shown[i].pixels;
    }
    std::ranges::sort(intervals);
    b.median = percentile(intervals, 0.5), b.p99 = percentile(intervals, 0.99), b.worst = intervals.back();
    for (const ShownPicture& picture : shown) b.levels[picture.level] += 1. / b.pictures;
    if (b.seconds > 0) b.pixels_per_second = pixels / b.seconds;
    return b;
}

std::string report_of(const Benchmark& b, const BenchmarkSetting& s) {
    std::string text =
        printable(s.scene) + format(", %dx%d, depth %d, %d threads, %s (%s), at most %g pictures/s\n", s.width,
                                    s.height, s.depth, s.threads, s.precision.c_str(), s.simd.c_str(), s.fps);
    if (s.wanted && *s.wanted != s.window)
        text += format("the window manager made the window %dx%d instead of %dx%d: compare with figures of that size\n",
                       s.window.width, s.window.height, s.wanted->width, s.wanted->height);
    text += format("%d pictures in %.2f s, %.1f/s\n", b.pictures, b.seconds, rate(b));
    text += format("from one to the next: median %.2f ms, 99th percentile %.2f ms, worst %.2f ms\n", 1000 * b.median,
                   1000 * b.p99, 1000 * b.worst);
    text += "resolution:";
    for (auto at = b.levels.rbegin(); at != b.levels.rend(); ++at)
        text += (at == b.levels.rbegin() ? " " : ", ") + resolution_text(at->first) +
                format(" in %.1f %%", 100 * at->second);
    text += format("\n%.2f million pixels/s; %.2f ms to draw a picture\n", b.pixels_per_second / 1e6,
                   1000 * s.draw_seconds);
    if (const auto& q = b.quality)
        text += format(
            "%d pictures beside the finished ones, in steps of 1/255: RMS %.2f, 99 %% off by at most %g, SSIM "
            "%.4f, %.2f %% off by more than 8, flicker %.2f\n",
            q->pictures, q->rms, q->p99, q->ssim, 100 * q->visible, q->flicker);
    return text;
}

std::string json_of(const Benchmark& b, const BenchmarkSetting& s) {
    using Json = nlohmann::ordered_json;
    Json resolutions = Json::object();
    for (auto at = b.levels.rbegin(); at != b.levels.rend(); ++at)
        resolutions["1/" + std::to_string(steps_of(at->first).area())] = at->second;
    Json json{{"scene", s.scene},
              {"width", s.width},
              {"height", s.height},
              {"depth", s.depth},
              {"threads", s.threads},
              {"precision", s.precision},
              {"simd", s.simd},
              {"fps", s.fps},
              {"pictures", b.pictures},
              {"seconds", b.seconds},
              {"pictures_per_second", rate(b)},
              {"frame_seconds", {{"median", b.median}, {"p99", b.p99}, {"worst", b.worst}}},
              {"resolutions", resolutions},
              {"pixels_per_second", b.pixels_per_second},
              {"draw_seconds", s.draw_seconds}};
    if (const auto& q = b.quality)
        json["quality"] = {{"pictures", q->pictures}, {"rms", q->rms},         {"p99", q->p99},
                           {"ssim", q->ssim},         {"visible", q->visible}, {"flicker", q->flicker}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace strahl

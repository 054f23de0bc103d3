#include "pov/animation.h"

#include <algorithm>
#include <cmath>

namespace strahl::pov {
namespace {

constexpr double frames_per_second = 25;

}  // namespace

Animation Animation::of(const std::optional<IniFile>& ini, std::optional<double> flight) {
    Animation all;
    if (flight) all.seconds = *flight;
    if (!ini) return all;
    all.first = ini->initial_frame.value_or(1);
    all.last = std::max(ini->final_frame.value_or(all.first), all.first);
    all.initial_clock = ini->initial_clock.value_or(0), all.final_clock = ini->final_clock.value_or(1);
    all.first_shown = all.last_shown = all.first;
    all.counted = ini->initial_frame || ini->final_frame;
    if (!all.counted) return all;
    // POV-Ray computes 0 / 0 for the clock of a single frame.
    if (all.last == all.first && ini->clock) all.initial_clock = *ini->clock;
    all.cyclic = ini->cyclic;
    all.seconds = (double(all.last) - all.first + 1) / frames_per_second;
    const double count = double(all.last) - all.first + 1;
    const auto number = [&](const std::optional<double>& given, int otherwise) {
        const double whole = given.value_or(otherwise);
        return std::floor(whole > 0 && whole < 1 ? whole * count : whole);
    };
    all.first_shown = std::clamp(number(ini->subset_start, all.first), double(all.first), double(all.last));
    all.last_shown = std::clamp(number(ini->subset_end, all.last), all.first_shown, double(all.last));
    return all;
}

double Animation::steps() const { return std::max(double(last) - first + (cyclic ? 1 : 0), 1.); }

int Animation::frame_at(double time) const {
    return static_cast<int>(std::clamp(first + std::round(time * frames_per_second), double(first), double(last)));
}

double Animation::clock_at(double time) const {
    const double share = counted ? time * frames_per_second / steps() : time / seconds;
    return initial_clock + (final_clock - initial_clock) * std::clamp(share, 0., 1.);
}

std::vector<std::pair<std::string, double>> Animation::declared_at(double time) const {
    return {{"clock_delta", counted ? (final_clock - initial_clock) / steps() : 1},
            {"initial_clock", initial_clock},
            {"final_clock", final_clock},
            {"initial_frame", first},
            {"final_frame", last + (counted && cyclic ? 1 : 0)},  // as POV-Ray 3.7 has it
            {"frame_number", frame_at(time)}};
}

std::pair<int, int> Animation::frames() const {
    return {static_cast<int>(first_shown) - first, static_cast<int>(last_shown) - first};
}

}  // namespace strahl::pov

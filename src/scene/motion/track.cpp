#include "scene/motion/track.h"

#include <algorithm>
#include <tuple>

namespace strahl {

double value_at(const Track& track, double row) {
    const auto& keys = track.keys;
    const auto after =
        std::ranges::upper_bound(keys, row, {}, [](const TrackKey& key) { return static_cast<double>(key.row); });
    if (after == keys.begin()) return keys.front().value;
    const TrackKey& from = *(after - 1);
    if (after == keys.end()) return from.value;
    double t = (row - from.row) / (static_cast<double>(after->row) - from.row);
    switch (from.way) {
        case Interpolation::step:
            return from.value;
        case Interpolation::linear:
            break;
        case Interpolation::smooth:
            t = t * t * (3 - 2 * t);
            break;
        case Interpolation::ramp:
            t = t * t;
            break;
    }
    return from.value + (after->value - from.value) * t;
}

void set_key(Track& track, const TrackKey& key) {
    const auto at = std::ranges::lower_bound(track.keys, key.row, {}, &TrackKey::row);
    if (at != track.keys.end() && at->row == key.row)
        *at = key;
    else
        track.keys.insert(at, key);
}
void delete_key(Track& track, int row) {
    std::erase_if(track.keys, [row](const TrackKey& key) { return key.row == row; });
}

void sort(std::vector<Follow>& follows) {
    std::ranges::stable_sort(follows, {}, [](const Follow& f) { return std::tie(f.parameter, f.component); });
}
bool any_follows(const std::vector<Follow>& follows, std::string_view parameter) {
    return std::ranges::any_of(follows, [=](const Follow& f) { return f.parameter == parameter; });
}

TrackValues::TrackValues(const std::vector<Track>& tracks, double row) {
    for (const Track& track : tracks)
        if (!track.keys.empty()) values.emplace_back(track.name, value_at(track, row));
    std::ranges::sort(values);
}
const double* TrackValues::find(std::string_view track) const {
    const auto at =
        std::ranges::lower_bound(values, track, {}, [](const auto& pair) -> std::string_view { return pair.first; });
    return at != values.end() && at->first == track ? &at->second : nullptr;
}

}  // namespace strahl

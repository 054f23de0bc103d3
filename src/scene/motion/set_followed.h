// Sets the parameters of a struct to the values of the tracks that they follow.
#pragma once
#include <algorithm>
#include <vector>

#include "num/vec.h"
#include "scene/motion/track.h"

namespace strahl {

/// A parameter of a struct that may follow a track: a number, a vector, or neither if there is none of that name.
struct FollowTarget {
    double* number = nullptr;
    DVec3* vector = nullptr;
};
inline FollowTarget target(double& number) { return {&number, nullptr}; }
inline FollowTarget target(DVec3& vector) { return {nullptr, &vector}; }

/// Sets the numbers that follow tracks with values; find(name) returns the FollowTarget of that name.
template <class Find>
void set_followed(const std::vector<Follow>& follows, const TrackValues& values, const Find& find) {
    for (const Follow& f : follows) {
        const double* const value = values.find(f.track);
        if (!value) continue;
        const FollowTarget at = find(f.parameter);
        double* const number = at.vector ? &(*at.vector)[f.component] : at.number;
        if (number) *number = std::clamp(f.factor * *value, f.low, f.high);
    }
}

}  // namespace strahl

// Checks a picture in every precision against the referee.
#pragma once
#include <array>

#include "scene/scene.h"
#include "trace/tracer.h"

namespace strahl {

inline constexpr int body_columns = 16, body_rows = 12, body_depth = 4;

/// The pixels that the referee does not explain in float, double and extended.
struct BodyFaults {
    std::array<int, 3> pixels{};
    std::array<double, 3> worst{};  // the largest difference among them
    std::array<bool, 3> checked{};
};

/// Traces the scene in all precisions. A pixel is right if it is the referee's, or that of a neighbouring point so near
/// that rounding accounts for it. Precisions are left out in which the smallest length is lost in that of coordinates:
/// `condition` is the largest coordinate over it.
BodyFaults faults_of(const Scene& scene, double condition);

}  // namespace strahl

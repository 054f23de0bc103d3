// Computes tangents that are the same on every machine.
#pragma once

namespace strahl {

/// The tangent of 0 to 90 degrees; that of 45 is exactly 1.
double tangent(double degrees);

}  // namespace strahl

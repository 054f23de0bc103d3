// The tangent of an angle.
#pragma once

namespace strahl {

/// Of 0 to 90 degrees, the same on every machine; that of 45 is 1.
double tangent(double degrees);

}  // namespace strahl

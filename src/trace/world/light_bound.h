// Bounds the light that a ray can still bring, so that weak rays need not be traced.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// The most light that any ray of the scene can bring, in any channel.
struct Bound {
    int depth;                      // the most generations of rays that count
    std::vector<double> brightest;  // [n]: with n generations to come, its own hit the first
    double limit;                   // with any number of them; infinite where no bound exists
    double gain;                    // by which bodies on its way can multiply a light; at least 1
};
/// Computes bounds for up to `depth` generations. Values may be infinite.
Bound bound_for(const Scene& scene, int depth);

/// Returns for each material the most light of all light sources together that a surface sends on other than by
/// reflection and refraction; of plain ones without highlights unless these are fainter than what it scatters.
std::vector<double> scattered_light(const Scene& scene);

/// Returns for each material the most light of its own that a surface sends out.
std::vector<double> own_glow(const Scene& scene);

}  // namespace strahl

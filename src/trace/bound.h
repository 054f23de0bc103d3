// How much light a ray can still bring, and so which rays need not be traced.
#pragma once
#include "scene/scene.h"

namespace strahl {

/// What a picture without some rays is still good for.
struct Bound {
    double cutoff = 0;       // for View::cutoff
    double brightest = 0;    // no ray's value, with `depth` generations to come, exceeds this in any channel
    double dropped = 0;      // most that all rays below the cutoff could have added to a pixel's channel
    double truncated = 0;    // most that generations past `depth` could have added; infinite if no bound exists
};

/// By how much a ray's `path` changes when it splits and goes on as the branch with this coefficient (Kr, say).
///
/// Each ray has a share of the error allowed, the primary ray all of it, and hands it on to the branches it splits into,
/// in parts that add up to 1. `path` is its weight over its share. If rays are dropped only where path * brightest <=
/// error, then all of a pixel's dropped rays together lack no more than `error`, however often paths split. Parts in
/// proportion to the roots of the coefficients let weak branches, the many reflections inside a glass, end early.
double path_factor(double coefficient, double other);

/// The largest cutoff for which rays not traced add no more than `error` to any channel of any pixel.
Bound bound_for(const Scene& scene, int depth, double error);

}  // namespace strahl

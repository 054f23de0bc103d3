// How much light a ray can still bring, and so which rays need not be traced.
#pragma once
#include "scene/scene.h"

namespace strahl {

/// What need not be traced if a picture may lack `error` light in any channel of any pixel.
struct Bound {
    double cutoff = 0;     // rays of a path (see path_factor) up to this
    double faint = 0;      // shadow rays for light times path up to this
    double brightest = 0;  // no ray's value, with `depth` generations to come, exceeds this in any channel
    double truncated = 0;  // most that generations past `depth` could have added; infinite if no bound exists
};

/// By how much a ray's `path` changes when it splits and goes on as the branch with this coefficient (Kr, say).
///
/// Each ray has a share of the error allowed, the primary ray all of it, and hands it on to the branches it splits
/// into, in parts that add up to 1. `path` is its weight over its share. If rays are dropped only where path *
/// brightest <= error, then all of a pixel's dropped rays together lack no more than `error`, however often paths
/// split. Parts in proportion to the roots of the coefficients let weak branches, the many reflections inside a glass,
/// end early.
double path_factor(double coefficient, double other);

/// Three quarters of the error are for rays, one for shadow rays: all shares of a generation add up to 1 at most, so it
/// is divided by the number of generations and lights. Error 0 is kept exactly: only what adds nothing is left out.
Bound bound_for(const Scene& scene, int depth, double error);

/// Generations after which all further ones together add at most `error`, 1 to 256. Infinitely many can't be had: where
/// no number is enough, or 256 are not, it is 256.
int depth_for(const Scene& scene, double error);

}  // namespace strahl

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

/// The largest cutoff for which rays not traced add no more than `error` to any channel of any pixel.
///
/// A ray of path product P (the product of Kr + Kt over its bounces) has P times its share of the pixel's rays as weight,
/// and the shares of all rays at which paths end add up to 1 at most. So if every dropped ray has P * brightest <= error,
/// then together they lack no more than `error`, however often paths split.
Bound bound_for(const Scene& scene, int depth, double error);

}  // namespace strahl

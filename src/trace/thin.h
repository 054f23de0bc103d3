// Bodies so thin in the picture that samples may miss them. POV-Ray's adaptive anti-aliasing loses three quarters of the
// light of wires .2 pixels thick, because nothing tells it that they are there.
#pragma once
#include <array>
#include <vector>

#include "scene/scene.h"
#include "trace/tracer.h"

namespace strahl {

/// A body as the picture shows it, in pixels: no further than `reach` from the way between two points.
struct Strip {
    double x0, y0, x1, y1, reach;
    double nearest;  // distance from the eye, in the scene's units
};

/// Strips around the bodies that are thinner than `widest` pixels somewhere; there only.
std::vector<Strip> thin_strips(const Scene& scene, const View& view, double widest);

/// May a strip have points in common with a square? In pixels.
bool meets(const Strip& strip, double x, double y, double size);

/// The strips that meet a square, of `size` pixels, that samples at its corners may miss, and that cover enough of it.
/// Those behind `furthest` can't be seen.
bool hides_in(const std::vector<Strip>& strips, double x, double y, double size, double furthest, double least_area);

}  // namespace strahl

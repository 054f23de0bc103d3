// Finds out by which rule of POV-Ray a pixel of it differs.
#pragma once
#include <map>
#include <string>

#include "image/picture.h"
#include "povref/compare/verdict.h"
#include "scene/scene.h"
#include "trace/tracer.h"

namespace strahl {

struct Reasons {
    std::map<std::string, int> pixels;  // how many have this reason
    int unexplained = 0;                // how many have none
    int worst = 0;                      // the largest difference of these, in steps of 16 bits
};

/// Computes pixels off the edges that differ from POV-Ray's picture, at most 40 of them from all over the picture, by
/// the referee with POV-Ray's rules, which stand in povref/README.md. The rule with which its value is POV-Ray's, to
/// one step, is the reason.
Reasons reasons_of(const Scene& scene, const View& view, const Verdict& verdict, const Picture& theirs);

}  // namespace strahl

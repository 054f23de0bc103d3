// Converts the bodies of a scene to POV-Ray objects.
#pragma once
#include <string>
#include <vector>

#include "povref/convert/materials.h"
#include "povref/convert/motions.h"
#include "scene/scene.h"

namespace strahl {

struct PovBodies {
    const std::vector<PovMaterial>& materials;  // in the order of the scene's
    bool shadow_copies;                         // some body has a copy that casts its shadow
    bool scaled;                                // Unit is declared
    bool hollow;                                // opaque bodies have fog in them as well
    PovMotions& motions;
};

/// Returns the name of a macro with the lights of a group.
std::string group_name(double number);

/// Returns whether parts of a transparent body send different shares of the light on, where some of it may be reflected
/// totally: POV-Ray has one share for all.
bool weighs_unevenly(const Scene& scene, const Primitive& primitive);

/// Returns all bodies. Opaque ones come first: POV-Ray lists the bodies around the camera in this order, and rays start
/// in the last one listed.
std::string body_sections(const Scene& scene, const PovBodies& how);

}  // namespace strahl

// Settles which of two faces in one place is seen, as it is in POV-Ray; elsewhere rounding would decide.
#pragma once
#include <cstddef>
#include <vector>

#include "scene/scene.h"

namespace strahl::pov {

/// Grows the first parts of differences by a hair where a part that is taken away has a face in the same place: POV-Ray
/// keeps that face, since by its rounding a point on it is inside both parts or neither, or since in a cylinder or a
/// cone no point of its surface is inside. Grows boxes and planes of
/// intersections by a hair where they only touch, which POV-Ray shows as a face.
void keep_faces(Primitive& body);

/// Moves faces of bodies by a hair away from the eye where a plane is seen in their place, which POV-Ray shows, or may
/// be seen through a clear body.
void settle_faces(Scene& scene);

/// The numbers of two bodies with faces in one place, the first of which is seen.
struct SettledPair {
    std::size_t seen, hidden;
};
/// Moves slanting faces of boxes and discs by a hair towards the eye that are seen before others in their plane:
/// POV-Ray shows the one that it finds first, which is that of the body whose box along the axes a ray enters first.
/// Decides for each pair of bodies as most rays do, and returns these pairs.
std::vector<SettledPair> settle_slanted_faces(Scene& scene);
/// Does POV-Ray, too, see the first body of such a pair at a point of both faces?
bool is_seen_first(const Scene& scene, const SettledPair& pair, const DVec3& p);

}  // namespace strahl::pov

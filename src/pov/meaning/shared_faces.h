// Finds faces in one place, of which POV-Ray's rounding decides which are seen.
#pragma once
#include <cstddef>
#include <set>
#include <vector>

#include "pov/meaning/coincident.h"
#include "pov/meaning/sight.h"
#include "scene/scene.h"

namespace strahl::pov {

// What covers less than a four-hundredth of the picture, or is seen neither by the camera nor in mirrors, does not
// count. Faces are flat, or of spheres, cylinders and cones.

/// Returns the numbers of composites of whose parts several have a face in one place, so that it is there or not as
/// POV-Ray rounds the place where a ray meets it, or one of two that look different. In a merge through which light
/// goes that is also so if parts only touch.
std::vector<std::size_t> shared_by_parts(const Scene& scene, SeenPlaces& sight);

/// Returns places where two bodies have a face, and do not look the same.
std::vector<SeenPlaces::Place> places_of_two_bodies(const Scene& scene, SeenPlaces& sight);
/// Returns the numbers of the clear bodies, other than boxes, that have a face in a plane there.
std::set<std::size_t> clear_bodies_on_planes(const Scene& scene, SeenPlaces& sight,
                                             const std::vector<SeenPlaces::Place>& places);
/// Returns, once faces have been moved, the numbers of those bodies that still have one where one before them has one,
/// or of which POV-Ray shows that of the other one of a settled pair.
std::set<std::size_t> bodies_in_one_place(const Scene& scene, SeenPlaces& sight,
                                          const std::vector<SeenPlaces::Place>& places,
                                          const std::vector<SettledPair>& settled);

}  // namespace strahl::pov

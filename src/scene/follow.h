// Sets the numbers of a scene that follow tracks.
#pragma once
#include "scene/scene.h"

namespace strahl {

/// Each function sets the numbers of one struct that follow tracks with values, and leaves the rest. The result is
/// always valid: a camera or light that would become degenerate stays as declared, and a spot's falloff is at least its
/// radius.
void follow(Camera& camera, const std::vector<Follow>& follows, const TrackValues& values);
void follow(Light& light, const TrackValues& values);
void follow(Material& material, const TrackValues& values);
void follow(Fog& fog, const TrackValues& values);
void follow(Pigment& color, const std::vector<Follow>& follows, const TrackValues& values);

}  // namespace strahl

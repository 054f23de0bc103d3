// Numbers of a scene set to what the tracks that they follow are at a moment.
#pragma once
#include "scene/scene.h"

namespace strahl {

/// Each sets the numbers of one struct that follow tracks which have values, and leaves the rest. What would make no
/// sense is put right: a camera or light that would see or light nothing stays as declared, and a spot's falloff is its
/// radius at least.
void follow(Camera& camera, const std::vector<Follow>& follows, const TrackValues& values);
void follow(Light& light, const TrackValues& values);
void follow(Material& material, const TrackValues& values);
void follow(Fog& fog, const TrackValues& values);
void follow(Pigment& color, const std::vector<Follow>& follows, const TrackValues& values);

}  // namespace strahl

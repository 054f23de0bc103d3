// Values of POV-Ray's patterns that scene text has no words for.
#pragma once
#include <map>
#include <memory>

#include "pov/language/user_function.h"
#include "pov/things/textures.h"
#include "scene/solid/solid.h"

namespace strahl::pov {

/// Returns how many colours a pattern has that takes them as a list, such as `hexagon`; 0 for all others.
int listed_colors(std::uint16_t pattern);

/// Returns the values of a pattern that has some of its own: functions, fractals, lists, pigments; null for others.
/// A list has the value 0 for its first entry, 1 for its last one, and evenly spaced values in between.
std::shared_ptr<const SolidFunction> own_values_of(const Blend& blend, int generator);
/// Returns the values of another pattern at points that are moved before.
std::shared_ptr<const SolidFunction> moved_values(Moves moves, const SolidPattern& values);

/// Returns the powers of a pattern's values.
std::shared_ptr<const SolidFunction> powers_of(const SolidPattern& values, double exponent);

/// Returns the heights of a slope_map at the values of a pattern.
std::shared_ptr<const SolidFunction> slope_values(const SolidPattern& values, const std::vector<MapEntry>& entries);

/// Returns what a normal { ... } adds to normals, in the space behind all warps; null if it is not known.
std::shared_ptr<const SolidFunction> bends_of(const NormalThing& normal, int generator);
/// Returns what `bends` adds to normals where the space is turned: turns normals by a matrix, and what is added back.
std::shared_ptr<const SolidFunction> turned_bends(const glm::dmat4& turn, std::shared_ptr<const SolidFunction> bends);

/// Returns the moves from the space around a pattern to where its values are found. With `last` its transformations
/// behind all warps are among them. Turbulence that moves points is the last move.
Moves moves_of(const Blend& blend, bool last);
/// Does turbulence move the points of this pattern?
bool moves_points(const Blend& blend);

/// Keeps the colours of pigments in maps as functions, by pigment.
using MadeColors = std::map<std::shared_ptr<const Thing>, std::shared_ptr<const FunctionThing>>;
/// Returns the colour of a pigment as a function of a point with five results; null where there are pictures or
/// patterns of which the values are not known. Takes those of the pigments in its maps from `known`, if given, and adds
/// them there.
std::shared_ptr<const FunctionThing> colors_of(const PigmentThing& pigment, int generator, MadeColors* known = nullptr);

/// Returns entries with ascending places by which values show the same as by those of a map of colours or pigments.
/// POV-Ray takes the last entry for all values from its place on, and for others the first that is not below them. Of
/// pigments none lies between entries of which one is beyond 0 or 1.
std::vector<MapEntry> in_order(const std::vector<MapEntry>& entries);

/// Returns the entries that POV-Ray takes for a pattern without a map.
const std::vector<MapEntry>& usual_entries(const Blend& blend);

}  // namespace strahl::pov

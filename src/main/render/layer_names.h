// The names in layers of bodies and materials, as Cryptomatte has them (J. Friedman and A. Jones, "Cryptomatte
// Specification", version 1.2): a name is a float made of its hash, and the file's manifest lists them.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "image/encoder.h"
#include "pov/open_scene.h"
#include "scene/layers.h"

namespace strahl {

/// Returns MurmurHash3 of a text, for x86 with 32 bits and the seed 0 (A. Appleby, "SMHasher").
std::uint32_t murmur_hash(std::string_view text);
/// Returns the float whose bits are those of a hash, but for one that keeps it a normal number.
float id_of(std::uint32_t hash);

/// Returns a name for each body: that of a model's body, or its kind and its number, counted from 1 in the order
/// declared, as in "sphere 3".
std::vector<std::string> names_of_bodies(const OpenedScene& opened);
/// Returns a name for each material: its number, in the order of first use, as in "material 1".
std::vector<std::string> names_of_materials(const Scene& scene);

/// The layers of pictures of a scene, with the names of their channels and what their files say of them.
struct NamedLayers {
    Layers layers;
    ChannelNames channels;
};
NamedLayers named(Layers layers, const OpenedScene& opened);

}  // namespace strahl

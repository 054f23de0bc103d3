// Finds where the nodes of a glTF file are, and how they move.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "import/models/gltf_file.h"
#include "scene/motion/transformation.h"

namespace strahl {

/// The transformation of a node: scaled, then turned, then moved.
struct GltfPlace {
    DVec3 translation{0}, scale{1};
    glm::dquat rotation{1, 0, 0, 0};

    glm::dmat4 matrix() const;
    std::vector<Transformation> steps() const;
    /// Returns it as a key of a motion.
    MotionKey key(double time) const;
};
/// Reads the place of a node. A matrix with shear is that without it; `sheared` becomes true.
GltfPlace place_of(const GltfValue& node, bool& sheared);

/// The motions of nodes by the first animation of a file.
class GltfMotions {
  public:
    /// Reads the animation; `warnings` tells what is left out.
    GltfMotions(GltfFile& file, std::vector<std::string>& warnings);

    /// Returns the keys of a node whose place without motion is this; none if it does not move.
    std::vector<MotionKey> keys(std::size_t node, const GltfPlace& rest) const;
    /// Returns the place of a node at a time.
    GltfPlace place(std::size_t node, const GltfPlace& rest, double time) const;
    /// Returns the weights of a node's morph targets at a time; nothing if the animation does not change them.
    std::optional<std::vector<double>> weights(std::size_t node, double time) const;
    double seconds = 0;  // until the last key

  private:
    enum class Path { translation, rotation, scale, weights };
    struct NodeChannel {
        Path path;
        bool steps = false, cubic = false;
        std::vector<double> times;
        GltfNumbers values;
        std::vector<double> at(double time) const;
    };
    std::map<std::size_t, std::vector<NodeChannel>> channels;  // by the numbers of nodes
};

}  // namespace strahl

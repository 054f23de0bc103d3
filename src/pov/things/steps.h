// Transformations of POV-Ray's things, in the order written, and their translation into those of a scene.
#pragma once
#include <glm/mat4x4.hpp>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "scene/motion/transformation.h"

namespace strahl::pov {

/// An affine transformation of column vectors: p' = m * (p, 1). Copies share the matrix, which keeps all steps small.
class MatrixStep {
  public:
    explicit MatrixStep(const glm::dmat4& m) : shared(std::make_shared<const glm::dmat4>(m)) {}
    const glm::dmat4& m() const { return *shared; }
    bool operator==(const MatrixStep& other) const { return m() == other.m(); }

  private:
    std::shared_ptr<const glm::dmat4> shared;
};
using Step = std::variant<Rotate, Translate, Scale, MatrixStep>;
using Steps = std::vector<Step>;

/// The product of all steps.
glm::dmat4 matrix_of(std::span<const Step> steps);
/// Returns steps that undo these. A matrix without an inverse is left out.
Steps inverse(std::span<const Step> steps);
/// Adds steps behind others.
void append(Steps& steps, std::span<const Step> more);

/// Returns a direction of a left-handed scene in its mirror image, if `mirrored`.
inline DVec3 mirror(const DVec3& v, bool mirrored) { return mirrored ? DVec3(v.x, v.y, -v.z) : v; }

/// Returns the transformations of a scene that do the same. With `mirrored` both their argument and their result are
/// mirrored in z, which changes signs only. A matrix becomes a rotation, a scaling and a rotation by its singular value
/// decomposition, and a translation.
std::vector<Transformation> transformations_of(std::span<const Step> steps, bool mirrored);

}  // namespace strahl::pov

// Answers what a scene asks about its bodies while it is read.
#pragma once
#include <utility>

#include "pov/reading/reader.h"
#include "scene/ray_hits.h"

namespace strahl::pov {

class PovLayer final : public PovReader {
  public:
    explicit PovLayer(ReadPixels read_pixels) : PovReader(std::move(read_pixels)) {}

    bool trace(Interpreter& in, const Thing& object, const DVec3& from, const DVec3& direction, DVec3& hit,
               DVec3& normal) override;
    bool inside(Interpreter& in, const Thing& object, const DVec3& point) override;
    std::pair<DVec3, DVec3> extent(Interpreter& in, const Thing& object) override;

  private:
    std::shared_ptr<const FunctionThing> inside_of(Interpreter& in, const ObjectThing& object,
                                                   const glm::dmat4& inverse) override;

    MeshTrees trees;
};

}  // namespace strahl::pov

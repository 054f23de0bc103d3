// Materials as the language allows them.
#pragma once
#include "scene/material.h"
#include "tests/attack/renderer/wild_values.h"

namespace strahl {

class WildMaterials : public WildValues {
  public:
    using WildValues::WildValues;
    Pattern pattern();
    Material material();
    Transformation step();
};

}  // namespace strahl

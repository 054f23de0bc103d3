// Blends the textures of a blob's lumps.
#pragma once
#include <memory>
#include <vector>

#include "pov/language/user_function.h"
#include "scene/kinds/blob/lump.h"

namespace strahl::pov {

/// The shares of textures in a blob: each lump's texture is weighted by the lump's field.
class BlobBlend {
  public:
    /// `textures` has the number of each lump's texture. As in POV-Ray one of a share below `least` is left out.
    BlobBlend(const std::vector<Lump>& lumps, std::vector<std::size_t> textures, double least);
    /// Returns a function of a point with five results: the mean colour of the textures that have one here, by their
    /// numbers.
    std::shared_ptr<const FunctionThing> colors(std::vector<std::shared_ptr<const FunctionThing>> colors) const;
    /// Returns a function of a point with five results: thrice the share that these textures have together, and twice
    /// 0.
    std::shared_ptr<const FunctionThing> share(std::vector<char> counted) const;

  private:
    struct Fields;
    struct Colors;
    struct Share;
    std::shared_ptr<const Fields> fields;
};

}  // namespace strahl::pov

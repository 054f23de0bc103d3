// Pictures that say how opaque a surface is.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scene/pattern.h"
#include "text/reading/scene_files.h"

namespace strahl {

/// How opaque a surface is at (u, v) of a picture: value * factor or, with a limit above 0, wholly where that is at
/// least the limit and not at all elsewhere. Between the middles of four pixels values change bilinearly.
struct Opacity : SolidFunction {
    std::string file{};  // of the picture, as the scene names it; "" if it is the one that shows the colours
    double factor = 1, limit = 0;
    bool once = false;                // beyond it the value is 1; else
    std::array<ImageWrap, 2> wrap{};  // tells what is there along u and v

    /// The values are the alpha channel; without one they are the brightness of the colours if `grey`, else 1.
    Opacity(const FilePixels& pixels, bool grey);
    double value_at(const DVec3& point) const override;
    /// The values before the factor and the limit, row by row from the top.
    const std::vector<float>& channel() const { return values; }
    /// Returns a grey picture of the values times the factor.
    ImagePattern picture() const;

  private:
    std::int32_t width, height;
    std::vector<float> values;
};

/// Returns a pigment that is `opaque` where `opacity` is 1 and lets light through elsewhere. By (u, v) of a mesh each
/// of the two has its own transformations; else `opaque` is in the space of the opacity.
Pigment partly_clear(const Pigment& opaque, std::shared_ptr<const Opacity> opacity, std::vector<Transformation> steps,
                     bool by_uv);
/// Returns the opacity of a pigment of partly_clear(), or of its pattern; null for others.
const Opacity* opacity_of(const SolidPattern& pattern);
const Opacity* opacity_of(const Pattern& pattern);
const Opacity* opacity_of(const Pigment& pigment);
/// Returns what the pigment of partly_clear() shows where it is opaque.
Pigment opaque_part(const Pigment& pigment);
/// Can scene text say a pigment of partly_clear()? It can if that shows a picture which lies as its opacity does.
bool has_text(const Pigment& pigment);

}  // namespace strahl

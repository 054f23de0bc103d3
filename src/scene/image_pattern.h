// The pattern whose colours are those of a picture.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "num/vec.h"

namespace strahl {

/// The pixels of a picture row by row from the top, three values each: red, green and blue. None is negative or NaN.
struct Pixels {
    std::int32_t width = 0, height = 0;
    bool linear = false;  // linear light, as float files hold; else sRGB-encoded, where a scene declares linear light
    std::vector<float> values;
    Color largest{0};  // of each channel
    bool operator==(const Pixels&) const = default;
};

/// Where a point of the pattern's space is in the picture: across by u, from 0 at the left to 1 at the right, and up by
/// v, from 0 to 1 likewise. Around the z axis u begins at x and grows towards y, so that pictures are not mirrored as
/// seen from outside.
enum class ImageMap : std::int32_t {
    planar,       // x and y
    spherical,    // around the z axis, and the latitude: from the pole at -z to that at z
    cylindrical,  // around the z axis, and z
};
inline constexpr std::array<std::string_view, 3> image_maps{"planar", "spherical", "cylindrical"};

/// How bright a colour is, which is what a picture that bends normals has in place of colours: its height (POV-Ray's
/// weights of red, green and blue).
inline constexpr std::array<double, 3> brightness{.297, .589, .114};

/// Between the middles of four pixels colours change bilinearly. All this is as in POV-Ray, but for the poles, which
/// are at y and -y there.
struct ImagePattern {
    std::string file;  // as the scene names it
    std::shared_ptr<const Pixels> pixels;
    ImageMap map = ImageMap::planar;
    /// Where neither u nor v is outside of 0 to 1 the picture; elsewhere this colour. Without it the picture repeats,
    /// its edges joining. At the poles as well: half a pixel from there, its top and its bottom mix.
    std::optional<Color> once;

    static constexpr const char* name = "image";
    static constexpr const char* help = "the colours of a .png, .bmp or .exr file";
    static constexpr auto fields = std::make_tuple();
    bool operator==(const ImagePattern& other) const {
        return file == other.file && map == other.map && once == other.once &&
               (pixels == other.pixels || (pixels && other.pixels && *pixels == *other.pixels));
    }
};

}  // namespace strahl

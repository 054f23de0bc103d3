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

/// How points of the pattern's space become places (u, v) in the picture: u goes from 0 at its left edge to 1 at its
/// right edge, v from 0 at its lower edge to 1 at its upper edge. Around the z axis u begins at x and grows towards y,
/// so that pictures are not mirrored as seen from outside.
enum class ImageMap : std::int32_t {
    planar,       // x and y
    spherical,    // around the z axis, and the latitude: from the pole at -z to that at z
    cylindrical,  // around the z axis, and z
};
inline constexpr std::array<std::string_view, 3> image_maps{"planar", "spherical", "cylindrical"};

/// Says what is beyond the edges of a picture along u or v.
enum class ImageWrap : std::int32_t {
    repeat,  // the picture again; its edges join
    clamp,   // the colours of the edge
    mirror,  // the picture mirrored, and then the picture again
};
inline constexpr std::array<std::string_view, 3> image_wraps{"repeat", "clamp", "mirror"};

/// POV-Ray's weights of red, green and blue in the brightness of a colour. It is the height where a picture bends
/// normals.
inline constexpr std::array<double, 3> brightness{.297, .589, .114};

/// A picture as a pattern. Between the middles of four pixels colours change bilinearly, unless it is `sharp`. It is as
/// in POV-Ray, except that its poles are at y and -y there.
struct ImagePattern {
    std::string file;  // as the scene names it
    std::shared_ptr<const Pixels> pixels;
    ImageMap map = ImageMap::planar;
    /// The colour outside of the picture, where u or v is not from 0 to 1. Without it `wrap` tells what is there. Where
    /// the picture repeats its edges join also at the poles: within half a pixel of a pole its top and its bottom mix.
    std::optional<Color> once{};
    bool sharp = false;               // each pixel is a rectangle of its colour
    std::array<ImageWrap, 2> wrap{};  // along u and v

    static constexpr const char* name = "image";
    static constexpr const char* help = "the colours of a .png, .jpg, .bmp or .exr file";
    static constexpr auto fields = std::make_tuple();
    bool operator==(const ImagePattern& other) const {
        return file == other.file && map == other.map && once == other.once && sharp == other.sharp &&
               wrap == other.wrap && (pixels == other.pixels || (pixels && other.pixels && *pixels == *other.pixels));
    }
};

}  // namespace strahl

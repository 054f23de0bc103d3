// Patterns: colours that vary through space. Each kind has a value from 0 to 1 at every point; a map makes it a colour.
#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "scene/image_pattern.h"
#include "scene/kinds/field.h"
#include "scene/motion/transformation.h"
#include "scene/solid/solid.h"

namespace strahl {

struct Pattern;

/// The colour at a value of the pattern, and the light that a surface lets through there, see Pigment. Between stops
/// all change linearly.
struct ColorStop {
    double at = 0;
    Color color{0};
    double filter = 0, transmit = 0;
    std::shared_ptr<const Pattern> pattern{};  // replaces the colour, in the space of the outer pattern
    bool operator==(const ColorStop& other) const;
};

/// Cubes with sides of 1, in alternating colours. This, `Brick` and `Gradient` have their borders 1e-10 before whole
/// numbers (as in POV-Ray), so that a face that lies there has one colour.
struct Checker {
    static constexpr const char* name = "checker";
    static constexpr const char* help = "cubes with sides of 1 in two alternating colours";
    static constexpr std::array<const char*, 2> colors{"first colour", "second colour"};
    static constexpr auto fields = std::make_tuple();
    bool operator==(const Checker&) const = default;
};

/// Bricks in layers along y, every second layer shifted by half a brick.
struct Brick {
    DVec3 size{8, 3, 4.5};
    double mortar = .5;
    static constexpr const char* name = "brick";
    static constexpr const char* help = "bricks in layers along y, every second layer shifted by half a brick";
    static constexpr std::array<const char*, 2> colors{"mortar's colour", "bricks' colour"};
    static constexpr auto fields =
        std::make_tuple(Field{"brick_size", &Brick::size, "size of a brick with its mortar", Range::positive},
                        Field{"mortar", &Brick::mortar, "thickness of the mortar", Range::length_or_zero});
    bool operator==(const Brick&) const = default;
};

/// A ramp from 0 to 1 along an axis, which repeats every 1.
struct Gradient {
    DVec3 axis{1, 0, 0};
    static constexpr const char* name = "gradient";
    static constexpr const char* help = "a ramp along an axis that repeats every 1";
    static constexpr auto fields =
        std::make_tuple(Field{"axis", &Gradient::axis, "the direction of the ramp, of any length", Range::direction});
    bool operator==(const Gradient&) const = default;
};

/// A sum of noise n, coarse at first and finer in each octave: n(p) + omega n(lambda p) + omega^2 n(lambda^2 p) + ...
///
/// n is gradient noise (K. Perlin, "An image synthesizer", 1985, and "Improving noise", 2002) over the cells of whole
/// coordinates, mostly between -.5 and .5. The corner (i, j, k) of a cell has the hash h = P(P(P(i) + j) + k), with the
/// permutation polynomial P(x) = (34 x + 1) x mod 289 (I. McEwan, D. Sheets, M. Richardson, S. Gustavson, "Efficient
/// computational noise in GLSL", 2012), so n repeats every 289. The digits a, b, c of h in base 7, the last one first,
/// make the corner's gradient ((a - 3) / 3, (b - 3) / 3, (c - 2.5) / 2.5); with f the way from the corner to the point,
/// gradient . f is interpolated by 6 t^5 - 15 t^4 + 10 t^3 along each axis, and the result halved.
struct Octaves {
    double octaves, omega = .5, lambda = 2;
    bool operator==(const Octaves&) const = default;
    static constexpr auto common = std::make_tuple(
        Field{"octaves", &Octaves::octaves, "how many sizes of detail are summed", Range::octaves},
        Field{"omega", &Octaves::omega, "strength of each octave relative to the one before", Range::zero_to_one},
        Field{"lambda", &Octaves::lambda, "how many times finer each octave is than the one before", Range::positive});
};

/// Noise and nothing else.
struct Noise : Octaves {
    Noise() : Octaves{1} {}
    static constexpr const char* name = "noise";
    static constexpr const char* help = "clouds: noise around .5";
    static constexpr auto fields = common;
    bool operator==(const Noise&) const = default;
};

/// Layers across x, whose value rises from 0 to 1 and falls again within a length of 1, moved by noise.
struct Marble : Octaves {
    double turbulence = 0;
    Marble() : Octaves{6} {}
    static constexpr const char* name = "marble";
    static constexpr const char* help = "layers across x, 1 apart, that noise bends";
    static constexpr auto fields = std::tuple_cat(
        std::make_tuple(Field{"turbulence", &Marble::turbulence, "how far noise moves them", Range::zero_or_more}),
        common);
    bool operator==(const Marble&) const = default;
};

/// Rings around the z axis, with the values of marble's layers.
struct Wood : Octaves {
    double turbulence = 0;
    Wood() : Octaves{6} {}
    static constexpr const char* name = "wood";
    static constexpr const char* help = "rings around the z axis, 1 apart, that noise bends";
    static constexpr auto fields = std::tuple_cat(
        std::make_tuple(Field{"turbulence", &Wood::turbulence, "how far noise moves them", Range::zero_or_more}),
        common);
    bool operator==(const Wood&) const = default;
};

using PatternKind = std::variant<Checker, Gradient, Brick, Noise, Marble, Wood, ImagePattern, SolidPattern>;

/// Does a kind have two colours of its own in place of a map?
template <class Kind>
inline constexpr bool two_colored = requires {
    Kind::colors;
};
/// Does a kind have a map of colours? Images have neither.
template <class Kind>
inline constexpr bool has_map = !two_colored<Kind> && !std::is_same_v<Kind, ImagePattern>;
/// Can the values of a kind bend normals?
template <class Kind>
inline constexpr bool can_bend = !two_colored<Kind>;

/// The word, after `map`, for patterns by uv.
inline constexpr std::string_view uv_map = "uv";

struct Pattern {
    PatternKind kind;
    std::vector<ColorStop> colors;  // ascending; two-coloured kinds have two, at 0 and 1; images have none
    std::vector<Transformation> transformations;
    /// The pattern is evaluated at (u, v, 0) in place of a point of the body; u and v are given at the corners of a
    /// mesh's triangles and linear between these. Images are planar then.
    bool by_uv = false;
    bool operator==(const Pattern&) const = default;
    /// Does it have patterns among its colours?
    bool nests() const {
        bool any = false;
        for (const ColorStop& stop : colors) any = any || stop.pattern;
        return any;
    }
};

/// Calls visit(pattern) for a pattern and for those among its colours.
template <class Visit>
void each_nested(const Pattern& pattern, const Visit& visit) {
    visit(pattern);
    for (const ColorStop& stop : pattern.colors)
        if (stop.pattern) each_nested(*stop.pattern, visit);
}

/// A colour, the same everywhere or by a pattern. With a pattern, `color` is the largest of its colours, channel by
/// channel, from which bounds on light are computed, and so are the next two.
///
/// As in POV-Ray a surface lets the share filter * color + transmit of light through, and scatters the share
/// 1 - filter - transmit of what its finish says.
struct Pigment {
    Color color{0};
    double filter = 0, transmit = 0;
    std::shared_ptr<const Pattern> pattern;

    Pigment(const Color& color) : color(color) {}
    Pigment(double red, double green, double blue) : color(red, green, blue) {}
    explicit Pigment(Pattern own);
    /// Does light come through anywhere?
    bool clear() const { return filter > 0 || transmit > 0; }
    bool operator==(const Pigment& other) const;
};

/// A pattern that bends normals, and how much. Where a surface is seen from behind, its normal is turned round before
/// it is bent. Pixels of images are used as they are, whatever the scene declares about linear light.
struct Relief {
    std::shared_ptr<const Pattern> pattern;  // without colours; null if there is none
    double height = 0;
    bool operator==(const Relief& other) const;
};

/// Bends normals as if a pattern of values raised the surface: n - height G, where G is the pattern's gradient. Both
/// are in the pattern's own space, so that bumps that are scaled keep their slopes (K. Perlin, "An image synthesizer",
/// 1985, adds gradients to normals). G is the difference quotient over the corners of a tetrahedron, all `step` away,
/// which is how POV-Ray has it: the sum of value(p + step v) v over its four directions v, times 3 / (4 step). The
/// value of an image is its brightness, see `brightness`.
///
/// A bump by uv is in the space of u, v and the normal. The axes are the directions along the surface in which u and v
/// grow, and u x v, whose length is the square root of the area that the other two span.
struct Bump : Relief {
    /// The step: .02, or the size of a pixel for an image.
    double step() const {
        const ImagePattern* const image = std::get_if<ImagePattern>(&pattern->kind);
        return image ? 1. / std::max(image->pixels->width, image->pixels->height) : .02;
    }
    /// Directions of length 1.
    static constexpr std::array<DVec3, 4> corners{
        DVec3(0.942809041582063366, -1. / 3, 0), DVec3(-0.471404520791031683, -1. / 3, 0.816496580927726033),
        DVec3(-0.471404520791031683, -1. / 3, -0.816496580927726033), DVec3(0, 1, 0)};
    bool operator==(const Bump&) const = default;
};

/// Bends normals by the colours (r, g, b) of an image: to (height (2 r - 1), height (2 g - 1), max(2 b - 1, 0)) along
/// three axes of length 1. x is the direction along the surface in which u grows, without what it has of the normal; y
/// is across it, on the side where v grows; z is the normal (J. Cohen, M. Olano, D. Manocha, "Appearance-Preserving
/// Simplification", 1998). The axes are of length 1 in the scene, so that slopes stay as they are in whatever way the
/// image is scaled. Where u grows in no direction, as at the poles, the normal stays as it is.
struct NormalMap : Relief {
    static constexpr double least_sine = 1e-5;  // of angles from the normal; smaller ones are rounding errors
    NormalMap() { height = 1; }
    bool operator==(const NormalMap&) const = default;
};

}  // namespace strahl

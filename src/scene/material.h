// The material of a body: the coefficients of the article's illumination equation.
#pragma once
#include <tuple>

#include "scene/pattern.h"

namespace strahl {

/// The default values are those of the article's `defaultmaterial` listing.
struct Material {
    Pigment rgb{.5, .5, .5};  // Of
    double reflection = .5;  // Kr
    double refraction = 0;   // Kt; above 0 the body is transparent
    double diffuse = .5;     // Kd
    double ambient = 0;      // Ka
    double specular = 1;     // Ks, the highlight
    double pow = 50;         // p, the highlight's exponent
    double ior = 1;          // index of refraction of the body
    Bump bump{};
    std::vector<Follow> follows{};  // its numbers that follow tracks

    bool operator==(const Material&) const = default;
    /// Is the body transparent, or could a track make it so?
    bool may_transmit() const { return refraction > 0 || any_follows(follows, "refraction"); }
    /// Does it depend on the place?
    bool patterned() const { return rgb.pattern || bump.pattern; }

    static constexpr auto fields = std::make_tuple(
        Field{"rgb", &Material::rgb, "colour of the body", Range::zero_or_more},
        Field{"reflection", &Material::reflection, "share of the light that is reflected, Kr", Range::zero_to_one},
        Field{"refraction", &Material::refraction,
              "share of the light that is transmitted, Kt; above 0 the body is transparent", Range::zero_to_one},
        Field{"diffuse", &Material::diffuse, "share of the light that is scattered diffusely, Kd", Range::zero_or_more},
        Field{"ambient", &Material::ambient, "share of the ambient light, Ka", Range::zero_or_more},
        Field{"specular", &Material::specular, "strength of the highlight, Ks; it has the colour of the light",
              Range::zero_or_more},
        Field{"pow", &Material::pow, "exponent of the highlight: the larger, the smaller the highlight",
              Range::zero_or_more},
        Field{"ior", &Material::ior, "index of refraction", Range::positive},
        Field{"bump", &Material::bump, "a pattern that bends normals, see below", Range::zero_or_more});
};

}  // namespace strahl

// The material of a body: the coefficients of the article's illumination equation.
#pragma once
#include <array>
#include <tuple>

#include "scene/pattern.h"

namespace strahl {

/// The default values are those of the article's `defaultmaterial` listing.
struct Material {
    Pigment rgb{.5, .5, .5};  // Of
    double reflection = .5;   // Kr
    double refraction = 0;    // Kt; above 0 the body is transparent
    double diffuse = .5;      // Kd
    double ambient = 0;       // Ka
    double specular = 1;      // Ks, the highlight
    double pow = 50;          // p, the highlight's exponent
    double ior = 1;           // index of refraction of the body
    NormalMap normal{};
    Bump bump{};                    // bends the normals that `normal` has bent
    std::vector<Follow> follows{};  // numbers of it that follow tracks

    bool operator==(const Material&) const = default;
    /// Is the body transparent, or could a track make it so?
    bool may_transmit() const { return refraction > 0 || any_follows(follows, "refraction"); }
    bool bends() const { return normal.pattern || bump.pattern; }
    /// Does it vary across the body?
    bool patterned() const { return rgb.pattern || bends(); }
    /// Has it a pattern that is mapped by uv?
    bool by_uv() const {
        bool any = false;
        each_pattern([&](const Pattern& own) { any |= own.by_uv; });
        return any;
    }
    std::array<Relief*, 2> reliefs() { return {&normal, &bump}; }
    /// Calls visit(pattern) for each of its patterns.
    template <class Visit>
    void each_pattern(const Visit& visit) const {
        for (const Pattern* const own : {rgb.pattern.get(), normal.pattern.get(), bump.pattern.get()})
            if (own) visit(*own);
    }

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
        Field{"normal", &Material::normal, "an image of normals, see below", Range::zero_or_more},
        Field{"bump", &Material::bump, "a pattern that bends normals, see below", Range::zero_or_more});
};

}  // namespace strahl

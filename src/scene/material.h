// The material of a body: the coefficients of the article's illumination equation, and what POV-Ray has besides.
#pragma once
#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

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

    // Terms of POV-Ray's finish. Scenes that leave them as they are do not pay for them.
    double blinn = 0, roughness = .05;  // a second highlight, blinn (n.h)^(1 / roughness), h between eye and light
    double metallic = 0;                // of both highlights: 1 gives them the colour of the body
    double brilliance = 1;              // diffuse light is Kd (n.l)^brilliance
    Color glow{1};                      // factors of the ambient light
    // Light is reflected as Kr mirror (facing + (1 - facing) x), where x is (1 - the cosine of the angle of
    // incidence)^falloff, or with fresnel the reflectance by `ior`. `gilding` is what `metallic` is for highlights.
    Color mirror{1};
    double facing = 1, falloff = 1, fresnel = 0, gilding = 0;
    double shadow = 1;      // 0: the body casts none
    double behind = 0;      // diffuse light of lights behind the surface
    double both_sides = 0;  // 1: lights behind the surface light it as those before it do
    double clarity = 1;     // factor of what is seen through the body and reflected totally, not of shadows
    // The light of each light is multiplied by 1 + irid cos(2 pi film (n.l + n.e) / w), e towards the eye, w the
    // wavelengths .7, .52 and .48 of red, green and blue.
    double irid = 0, film = 0;
    double conserve = 0;             // 1: what comes through is multiplied by 1 less what is reflected
    double old_opacity = 0;          // 1: filter counts the less against what is scattered the darker the colour is
    double seen = 1, mirrored = 1;   // 0: rays go through it that come from the eye, or from mirrors
    double outside = 1, inside = 1;  // factors of the stack's light, seen from outside the body and from inside
    double group = 0;                // lights of this group shine on the body as well, unless it is 0
    double common = 1;               // 0: no others do
    // With fade_distance > 0 light is multiplied by c + (1 - c) / (1 + (d / fade_distance)^fade_power), of the colour
    // c, after a way d inside the body; with powers from 1000 on by exp(-(1 - c) d / fade_distance).
    double fade_distance = 0, fade_power = 1;
    Color fade_color{0};
    // Scenes of POV-Ray set these, scene text has no words for them. Clear surfaces of one `interior` above 0 bound one
    // space, whichever bodies they are of: each ends what the one before began. In a hollow body there is fog.
    int interior = 0;
    bool hollow = false;

    NormalMap normal{};
    Bump bump{};                    // bends the normals that `normal` has bent
    std::vector<Follow> follows{};  // numbers of it that follow tracks
    /// Layers above this one, the lowest first: each lights, mirrors and lets through light by its own colour and
    /// finish. Their refraction, ior and normal do not count, nor what is said of the body as a whole; those without a
    /// bump have that of the material. A coat with a share other than 1, or that looks different from outside and from
    /// inside, begins another stack of layers, with its own share: the light of all stacks is added.
    std::vector<Material> coats{};
    Pigment share{Color(1)};

    bool operator==(const Material&) const = default;
    /// Is the body transparent?
    bool transmits() const {
        bool any = false, all = refraction > 0 || rgb.clear();
        for (const Material& coat : coats) {
            if (coat.shares()) any |= std::exchange(all, true);
            all = all && coat.rgb.clear();
        }
        return any || all;
    }
    /// Does it begin a stack of layers whose light is multiplied by its share?
    bool shares() const { return has_side() || !(share == Pigment(Color(1))); }
    /// Does its stack look different from outside and from inside?
    bool has_side() const { return outside != 1 || inside != 1; }
    /// Do the two sides of the body look different?
    bool has_sides() const { return has_side() || std::ranges::any_of(coats, &Material::has_side); }
    /// Returns the largest of its shares, and at least 1.
    double most_share() const {
        const auto most = [](const Color& c) { return std::max({1., c.x, c.y, c.z}); };
        double all = most(share.color);
        for (const Material& coat : coats) all = std::max(all, most(coat.share.color));
        return all;
    }
    /// Returns the light that comes through all layers, or the most of it: by the colours, and so much besides by
    /// `refraction`.
    Color passed(const Color& refracted) const {
        Color sum(0), own = rgb.color * rgb.filter + Color(rgb.transmit) + refracted, factor = share.color;
        for (const Material& coat : coats) {
            if (coat.shares()) sum = sum + std::exchange(factor, coat.share.color) * std::exchange(own, Color(1));
            own = own * (coat.rgb.color * coat.rgb.filter + Color(coat.rgb.transmit));
        }
        return sum + factor * own;
    }
    /// Is it, or could a track make it so?
    bool may_transmit() const { return transmits() || any_follows(follows, "refraction"); }
    /// Does it use only what the article's equation has?
    bool plain() const {
        return blinn == 0 && metallic == 0 && brilliance == 1 && glow == Color(1) && mirror == Color(1) &&
               facing == 1 && fresnel == 0 && gilding == 0 && shadow == 1 && conserve == 0 && old_opacity == 0 &&
               seen == 1 && mirrored == 1 && behind == 0 && both_sides == 0 && clarity == 1 && irid == 0 &&
               fade_distance == 0 && coats.empty() && !rgb.clear() && !shares() && group == 0 && common == 1 &&
               pow >= 0;
    }
    /// Does light fade inside the body?
    bool fades() const { return fade_distance > 0 && transmits(); }
    bool bends() const { return normal.pattern || bump.pattern || std::ranges::any_of(coats, &Material::bends); }
    /// Does a coat have other normals than the material?
    bool bends_apart(const Material& coat) const { return coat.bump.pattern && coat.bump != bump; }
    /// Does it vary across the body?
    bool patterned() const {
        bool any = false;
        each_pattern([&](const Pattern&) { any = true; });
        return any;
    }
    /// Does it have a pattern that is mapped by uv?
    bool by_uv() const {
        bool any = false;
        each_pattern([&](const Pattern& own) { any |= own.by_uv; });
        return any;
    }
    std::array<Relief*, 2> reliefs() { return {&normal, &bump}; }
    /// Calls visit(pattern) for each of its patterns.
    template <class Visit>
    void each_pattern(const Visit& visit) const {
        const auto look = [&](const std::shared_ptr<const Pattern>& own) {
            if (own) visit(*own);
        };
        look(rgb.pattern), look(share.pattern), look(normal.pattern), look(bump.pattern);
        for (const Material& coat : coats) look(coat.rgb.pattern), look(coat.share.pattern), look(coat.bump.pattern);
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
        Field{"blinn", &Material::blinn, "strength of a highlight as wide as `roughness` says, POV-Ray's `specular`",
              Range::zero_or_more},
        Field{"roughness", &Material::roughness, "how wide that highlight is", Range::positive},
        Field{"metallic", &Material::metallic, "how much highlights have the colour of the body", Range::zero_or_more},
        Field{"brilliance", &Material::brilliance, "exponent of diffuse light: above 1 it falls off faster",
              Range::zero_or_more},
        Field{"glow", &Material::glow, "factors of ambient light", Range::zero_or_more},
        Field{"mirror", &Material::mirror, "colour of what is reflected", Range::zero_or_more},
        Field{"facing", &Material::facing, "share of `reflection` where the surface faces the eye", Range::zero_to_one},
        Field{"falloff", &Material::falloff, "how late reflection grows from that to `reflection`, with the angle",
              Range::zero_or_more},
        Field{"fresnel", &Material::fresnel, "1: reflection grows with the angle by Fresnel's law, and `ior`",
              Range::zero_to_one},
        Field{"gilding", &Material::gilding, "how much mirror images have the colour of the body", Range::zero_or_more},
        Field{"shadow", &Material::shadow, "0: the body casts no shadow", Range::zero_to_one},
        Field{"behind", &Material::behind, "share of the light from behind that is scattered diffusely",
              Range::zero_or_more},
        Field{"both_sides", &Material::both_sides, "1: lights behind the surface light it as those before it do",
              Range::zero_to_one},
        Field{"share", &Material::share,
              "factors of its light; a coat with `share` starts a second material, and the light of both is added: a "
              "pattern and its reverse mix them",
              Range::zero_or_more},
        Field{"clarity", &Material::clarity,
              "factor of the light that is seen through the body; shadows stay as they are", Range::zero_or_more},
        Field{"irid", &Material::irid,
              "strength of colours as of a thin film; they vary with the angles of eye and light", Range::zero_or_more},
        Field{"film", &Material::film, "thickness of that film, in thousandths of a millimetre", Range::zero_or_more},
        Field{"conserve", &Material::conserve, "1: light that comes through is dimmed by the share that is reflected",
              Range::zero_to_one},
        Field{"old_opacity", &Material::old_opacity,
              "1: a colour that filters scatters 1 - its largest component `filter` - `transmit` of its light, as in "
              "POV-Ray before version 3.7",
              Range::zero_to_one},
        Field{"seen", &Material::seen, "0: the eye looks through the body, and only mirrors show it",
              Range::zero_to_one},
        Field{"mirrored", &Material::mirrored, "0: mirrors do not show the body", Range::zero_to_one},
        Field{"outside", &Material::outside,
              "factor of its light where rays come from outside the body; it starts a second material as `share` does, "
              "so that each side can have its own",
              Range::zero_to_one},
        Field{"inside", &Material::inside, "factor of its light where rays come from inside the body",
              Range::zero_to_one},
        Field{"group", &Material::group, "lights whose `group` is this number shine on the body as well; 0: none do",
              Range::zero_or_more},
        Field{"common", &Material::common, "0: only lights of its `group` shine on the body", Range::zero_to_one},
        Field{"fade_distance", &Material::fade_distance,
              "the way inside the body after which light has faded by half; 0: it does not fade", Range::zero_or_more},
        Field{"fade_power", &Material::fade_power,
              "light is multiplied by c + (1 - c) / (1 + (way / `fade_distance`)^`fade_power`), c being `fade_color`; "
              "from 1000 on by exp((c - 1) way / `fade_distance`)",
              Range::zero_or_more},
        Field{"fade_color", &Material::fade_color, "the colour that is left of light after a long way inside the body",
              Range::zero_to_one},
        Field{"normal", &Material::normal, "an image of normals, see below", Range::zero_or_more},
        Field{"bump", &Material::bump, "a pattern that bends normals, see below", Range::zero_or_more});
};

}  // namespace strahl

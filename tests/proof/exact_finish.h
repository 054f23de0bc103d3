// What a surface does with light, in exact arithmetic: the article's equation, and POV-Ray's finishes of one layer.
#pragma once
#include <algorithm>
#include <numbers>

#include "tests/proof/exact_bodies.h"

namespace strahl::exact {

/// Shares of light that goes on, and how strong POV-Ray takes the ray for; 0 if it is not followed.
template <class R>
struct Sent {
    referee::Vector<R> color;
    R strength = 0;
};

template <class R>
class Finish {
    using Vector = referee::Vector<R>;

  public:
    Finish(const Material& material, const Vector& color) : m(material), color(color), filter(m.rgb.filter) {
        const R most = std::max({color.x, color.y, color.z});
        opacity = 1 - (m.old_opacity > 0 ? most : R(1)) * filter - R(m.rgb.transmit);
    }
    Vector ambient() const { return opacity * R(m.ambient) * (color * Vector(m.glow)); }

    /// Returns what light along -l becomes along -e.
    Vector scattered(const Vector& e, const Vector& n, const Vector& l, bool highlights) const {
        const R facing = dot(n, l), glance = dot(e - 2 * dot(e, n) * n, l), half = dot(unit(l - e), n);
        const R diffuse = R(m.diffuse) * opacity * (m.brilliance == 1 ? facing : power(facing, R(m.brilliance)));
        R highlight = highlights && glance > 0 ? R(m.specular) * power(glance, R(m.pow)) : R(0);
        if (highlights && m.blinn > 0 && half > 0) highlight += R(m.blinn) * power(half, 1 / R(m.roughness));
        return film(facing + size(dot(e, n))) * (diffuse * color + highlight * tint(m.metallic, facing));
    }
    Sent<R> reflected(R facing, bool enters, R least) const {
        R x = 1;
        if (m.fresnel > 0)
            x = fresnel(enters ? R(m.ior) : 1 / R(m.ior), facing);
        else if (m.facing != 1)
            x = power(1 - facing, R(m.falloff));
        const R share = R(m.facing) + (1 - R(m.facing)) * x,
                most = R(m.reflection * std::max({m.mirror.x, m.mirror.y, m.mirror.z}));
        const R strength = most * (m.fresnel > 0 ? share : R(1));
        const Vector color_of_mirror = R(m.reflection) * Vector(m.mirror) * tint(m.gilding, facing) * film(2 * facing);
        return {share * color_of_mirror, strength >= least ? strength : R(0)};
    }
    /// What is reflected dims what comes through, if the finish conserves light.
    Sent<R> refracted(const Sent<R>& away, R least) const {
        if (!m.transmits()) return {};
        if (m.plain()) return {R(m.refraction) * white(), R(m.refraction) > least ? R(m.refraction) : R(0)};
        Vector through = filter * color + R(m.rgb.transmit + m.refraction) * white();
        const auto left = [](R share) { return share < 1 ? 1 - share : R(0); };
        if (m.conserve > 0) through = through * Vector{left(away.color.x), left(away.color.y), left(away.color.z)};
        const R gray = R(.297) * through.x + R(.589) * through.y + R(.114) * through.z;
        if (least > 0 && !(gray > least)) return {};
        through = R(m.clarity) * through;
        return {through, std::max({through.x, through.y, through.z})};
    }
    Sent<R> total(const Sent<R>& through) const {
        const R all = !m.plain() && m.rgb.clear() ? R(m.clarity) : R(m.reflection) + R(m.refraction);
        return {all * white(), through.strength};
    }
    /// The share of light that a shadow ray keeps.
    Vector shadow() const { return (filter + R(m.refraction)) * color + R(m.rgb.transmit) * white(); }

  private:
    static R size(R x) { return x < 0 ? -x : x; }
    static Vector white() { return {1, 1, 1}; }
    Vector tint(double metallic, R cosine) const {
        if (metallic == 0) return white();
        const R a = angle_of(cosine, root(std::max(R(0), 1 - cosine * cosine))) * 2 / radians<R>(180);
        const R f = R(.014567225) / ((a - R(1.12)) * (a - R(1.12))) - R(.011612903);
        return white() + R(metallic) * (1 - std::clamp(f, R(0), R(1))) * (color - white());
    }
    Vector film(R cosines) const {
        const auto wave = [&](R length) {
            return 1 + R(m.irid) * cosine_of(2 * radians<R>(180) * R(m.film) * cosines / length);
        };
        return m.irid > 0 ? Vector{wave(R(.7)), wave(R(.52)), wave(R(.48))} : white();
    }
    static R fresnel(R n, R c) {
        const R squared = n * n + c * c - 1;
        if (!(squared > 0)) return 1;
        const R g = root(squared), a = (g - c) / (g + c), b = (c * (g + c) - 1) / (c * (g - c) + 1);
        return a * a * (b * b + 1) / 2;
    }
    const Material& m;
    Vector color;
    R filter, opacity;
};

}  // namespace strahl::exact

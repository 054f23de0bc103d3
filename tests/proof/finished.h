// POV-Ray's finishes and lights in random worlds for proofs.
#pragma once
#include <cmath>

#include "scene/scene.h"
#include "tests/referee/dice.h"

namespace strahl::proof {

/// Decides about finishes: worlds stay what they are without.
inline Dice dice_of_finishes(std::uint64_t seed) { return Dice(seed ^ 0x61c8864680b583ebull); }

/// Gives a material some words of POV-Ray's finishes.
inline void finish(Dice& dice, Material& m) {
    if (dice.chance(.4)) m.blinn = dice.in(0, 1), m.roughness = std::pow(10, dice.in(-3, .3));
    if (dice.chance(.4)) m.metallic = dice.in(0, 1.5);
    if (dice.chance(.3)) m.brilliance = dice.in(.3, 4);
    if (dice.chance(.3)) m.glow = dice.vector(0, 2);
    if (dice.chance(.3)) m.mirror = dice.vector(0, 1);
    if (dice.chance(.3)) m.gilding = dice.in(0, 1);
    if (dice.chance(.3))
        m.fresnel = 1;
    else if (dice.chance(.3))
        m.facing = dice.in(0, 1), m.falloff = dice.in(.3, 4);
    if (m.fresnel > 0 && m.ior == 1) m.ior = dice.in(1.1, 2.4);
    if (dice.chance(.3)) m.conserve = 1;
    if (dice.chance(.2)) m.clarity = dice.in(.3, 1);
    if (dice.chance(.1)) m.shadow = 0;
    if (dice.chance(.1)) m.irid = dice.in(0, .5), m.film = dice.in(.1, 1);
    if (m.refraction > 0 && !m.rgb.pattern && dice.chance(.6)) {
        m.rgb.filter = dice.chance(.7) ? dice.in(0, .9) : 0, m.rgb.transmit = dice.in(0, 1 - m.rgb.filter);
        m.refraction = 0, m.old_opacity = dice.chance(.3);
        if (dice.chance(.4)) m.ior = 1;
    }
}

/// Gives half of a world's materials finishes, and lights words that only POV-Ray's have.
inline void finish_world(Dice& dice, double size, Scene& scene) {
    for (Material& material : scene.materials)
        if (dice.chance(.5)) finish(dice, material);
    for (Light& light : scene.lights) {
        if (dice.chance(.2)) light.shadowless = true;
        if (!light.direction && dice.chance(.3))
            light.fade_distance = size * dice.in(1, 20), light.fade_power = dice.chance(.5) ? 2 : dice.in(.5, 4);
    }
    if (dice.chance(.2)) {
        scene.lights.back().group = 1;
        for (Material& material : scene.materials)
            if (dice.chance(.5)) material.group = 1, material.common = dice.chance(.7);
    }
    if (dice.chance(.5)) scene.settings.adc_bailout = dice.chance(.5) ? 1. / 255 : dice.in(.001, .1);
}

}  // namespace strahl::proof

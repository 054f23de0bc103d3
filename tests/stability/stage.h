// Scenes for the stability suite, and measures of their pictures.
#pragma once
#include <random>
#include <vector>

#include "scene/scene.h"
#include "trace/tracer.h"

namespace strahl::stability {

Material paint(const Color& rgb);              // matt
Material glow(const Color& rgb);               // always has the colour `rgb`
Material mirror(double share);                 // only reflects
Material glass(double ior, double share = 1);  // only transmits, without colour

/// A scene under construction: eye at (0, -6, 0) looking along +y, z up, no lights, black background.
struct Stage {
    Scene scene;
    Stage();
    Stage& put(const Shape& shape, const Material& material, std::vector<Transformation> steps = {});
    Stage& light(const DVec3& position, const Color& color = Color(1));
    Stage& look(const DVec3& from, const DVec3& at, double fov, const DVec3& up = {0, 0, -1});
    Stage& background(const Color& color);
};

struct Still {
    int width = 64, height = 48, depth = 4, threads = 2;
    Simd simd = Simd::automatic;
};
Frame shoot(const Scene& scene, Precision precision, const Still& shot = {});

inline constexpr Precision precisions[]{Precision::float32, Precision::float64, Precision::extended};

Color pixel(const Frame& frame, int x, int y);
/// Counts the pixels of exactly this colour.
int count(const Frame& frame, const Color& color);
/// Counts the channels that are NaN or infinite. There must be none.
int not_finite(const Frame& frame);
/// Share of pixels with a channel that differs by more than `tolerance`.
double share_apart(const Frame& a, const Frame& b, double tolerance);
double largest_difference(const Frame& a, const Frame& b);

/// A scene with all lengths and positions multiplied by `factor`, then moved.
Scene placed(Scene scene, double factor, const DVec3& by = DVec3(0));

/// Many kinds of bodies, materials and lights, at positions that are exact in few bits.
Scene still_life();

/// Random numbers that are the same on every machine.
struct Dice {
    std::mt19937_64 engine{1999};
    double operator()(double low, double high) { return low + (high - low) * double(engine() >> 11) * 0x1p-53; }
    DVec3 direction();
};

}  // namespace strahl::stability

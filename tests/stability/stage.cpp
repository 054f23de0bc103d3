#include "tests/stability/stage.h"

#include <algorithm>
#include <cmath>

namespace strahl::stability {
namespace {

/// Among a body's parameters vectors are points, and numbers are lengths.
template <class Kind>
void scale_and_move(Kind& body, double factor, const DVec3& by) {
    const auto change = [&](auto& value) {
        value *= factor;
        if constexpr (std::is_same_v<decltype(value), DVec3&>) value += by;
    };
    std::apply([&](const auto&... field) { (change(body.*field.member), ...); }, Kind::fields);
}

}  // namespace

Material paint(const Color& rgb) {
    return {
        .rgb = rgb, .reflection = 0, .refraction = 0, .diffuse = 1, .ambient = 0, .specular = 0, .pow = 1, .ior = 1};
}
Material glow(const Color& rgb) {
    Material m = paint(rgb);
    m.diffuse = 0, m.ambient = 1;
    return m;
}
Material mirror(double share) {
    Material m = paint(Color(0));
    m.reflection = share, m.diffuse = 0;
    return m;
}
Material glass(double ior, double share) {
    Material m = paint(Color(1));
    m.refraction = share, m.diffuse = 0, m.ior = ior;
    return m;
}

Stage::Stage() { look({0, -6, 0}, {0, 0, 0}, 20); }
Stage& Stage::put(const Shape& shape, const Material& material, std::vector<Transformation> steps) {
    auto& list = scene.materials;
    const auto at = std::find(list.begin(), list.end(), material);
    const int number = static_cast<int>(at - list.begin());
    if (at == list.end()) list.push_back(material);
    scene.primitives.push_back({shape, number, std::move(steps)});
    return *this;
}
Stage& Stage::light(const DVec3& position, const Color& color) {
    scene.lights.push_back({position, color});
    return *this;
}
Stage& Stage::look(const DVec3& from, const DVec3& at, double fov, const DVec3& up) {
    scene.camera = {from, at, up, fov, {}};
    return *this;
}
Stage& Stage::background(const Color& color) {
    scene.background = color;
    return *this;
}

Frame shoot(const Scene& scene, Precision precision, const Still& shot) {
    const View view{.camera = scene.camera, .width = shot.width, .height = shot.height, .depth = shot.depth};
    return render(scene, view, precision, shot.threads, shot.simd);
}

Color pixel(const Frame& frame, int x, int y) {
    const double* rgb = &frame.rgb[3 * (std::size_t(y) * frame.width + x)];
    return {rgb[0], rgb[1], rgb[2]};
}
int count(const Frame& frame, const Color& color) {
    int n = 0;
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) n += pixel(frame, x, y) == color;
    return n;
}
int not_finite(const Frame& frame) {
    return static_cast<int>(std::ranges::count_if(frame.rgb, [](double v) { return !std::isfinite(v); }));
}
double share_apart(const Frame& a, const Frame& b, double tolerance) {
    int n = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
        bool apart = false;
        for (std::size_t c = i; c < i + 3; ++c) apart |= !(std::abs(a.rgb[c] - b.rgb[c]) <= tolerance);
        n += apart;
    }
    return 3. * n / static_cast<double>(a.rgb.size());
}
double largest_difference(const Frame& a, const Frame& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) most = std::max(most, std::abs(a.rgb[i] - b.rgb[i]));
    return most;
}

Scene placed(Scene scene, double factor, const DVec3& by) {
    const auto place = [&](const DVec3& p) { return p * factor + by; };
    scene.camera.position = place(scene.camera.position), scene.camera.look_at = place(scene.camera.look_at);
    for (Light& light : scene.lights) light.position = place(light.position);
    for (Primitive& primitive : scene.primitives) {
        if (primitive.transformations.empty()) {
            std::visit([&](auto& shape) { scale_and_move(shape, factor, by); }, primitive.shape);
        } else {
            primitive.transformations.push_back(Scale{DVec3(factor)});
            primitive.transformations.push_back(Translate{by});
        }
    }
    return scene;
}

Scene still_life() {
    Material shiny = paint({.75, .5, .25});
    shiny.reflection = .25, shiny.specular = .5, shiny.pow = 20;
    Material clear = glass(1.5, .75);
    clear.reflection = .125, clear.specular = .5, clear.pow = 50;
    Stage stage;
    stage.look({.5, -6, 2.5}, {0, 0, 0}, 22).background({.125, .25, .375});
    stage.light({-4, -5, 6}, {.75, .75, .75}).light({5, -3, 3}, {.25, .25, .375});
    stage.put(Plane{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, paint({.5, .625, .5}));
    stage.put(Sphere{{-.75, 0, 0}, 1}, shiny);
    stage.put(Sphere{{.875, -1, -.25}, .625}, clear);
    stage.put(Cylinder{{1.5, .5, -1}, {1.25, .75, .75}, .5}, shiny);
    stage.put(Sphere{{0, 0, 0}, 1}, paint({.25, .5, .75}), {Scale{{.5, .75, .25}}, Translate{{0, -2, -.75}}});
    for (int i = 0; i < 20; ++i)  // enough for a hierarchy
        stage.put(Sphere{{-2.5 + i * .25, 2 - (i % 3) * .125, -.875 + (i % 4) * .25}, .125},
                  i % 2 ? shiny : paint({.75, .25, .125}));
    return stage.scene;
}

DVec3 Dice::direction() {
    while (true) {
        const DVec3 v{(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)};
        const double square = v.x * v.x + v.y * v.y + v.z * v.z;
        if (square > .01 && square < 1) return v / std::sqrt(square);
    }
}

}  // namespace strahl::stability

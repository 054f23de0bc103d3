// Shrinks greedily: keeps each change that keeps the fault, until none does.
#include "tests/attack/renderer/shrink.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>

#include "tests/referee/random_pattern.h"
#include "text/parse.h"
#include "text/write.h"

namespace strahl {
namespace {

class Shrinking {
  public:
    Shrinking(WildScene& wild, const std::function<bool(const WildScene&)>& faulty) : wild(wild), faulty(faulty) {}

    /// Did anything go?
    bool pass();

  private:
    template <class Change>
    void attempt(Change change);
    template <class GetList>
    void thin(GetList list);
    template <class Get>
    void plain(Get get, double usual);
    void plain_bodies();
    void plain_materials();

    WildScene& wild;
    const std::function<bool(const WildScene&)>& faulty;
    bool changed = false;
};

bool valid(const WildScene& wild) {
    try {
        parse_scene(write_scene(wild.scene), "shrunk", {}, made_up_pixels);
        return true;
    } catch (const FileError&) {
        return false;
    }
}

template <class Change>
void Shrinking::attempt(Change change) {
    WildScene tried = wild;
    change(tried);
    tried.view.camera = tried.scene.camera;
    if (tried.scene == wild.scene && tried.view.width == wild.view.width && tried.view.height == wild.view.height &&
        tried.view.depth == wild.view.depth && tried.view.error == wild.view.error)
        return;
    if (!valid(tried) || !faulty(tried)) return;
    wild = std::move(tried);
    changed = true;
}

/// First halves of the list, then ever smaller parts.
template <class GetList>
void Shrinking::thin(GetList list) {
    for (std::size_t part = list(wild).size(); part > 0; part /= 2)
        for (std::size_t at = 0; at < list(wild).size();) {
            const std::size_t before = list(wild).size();
            attempt([&](WildScene& w) {
                auto& all = list(w);
                all.erase(all.begin() + at, all.begin() + std::min(all.size(), at + part));
            });
            if (list(wild).size() == before) at += part;
        }
}

/// A number becomes the usual one, or one of fewer digits.
template <class Get>
void Shrinking::plain(Get get, double usual) {
    for (const double value : {usual, 0., 1.}) {
        attempt([&](WildScene& w) { get(w) = value; });
        if (get(wild) == value) return;
    }
    // Rounded as decimals, so that rounding a number again changes nothing and shrinking ends.
    for (int digits = 0; digits < 3; ++digits) {
        char decimal[40];
        std::snprintf(decimal, sizeof decimal, "%.*e", digits, get(wild));
        attempt([&](WildScene& w) { get(w) = std::strtod(decimal, nullptr); });
    }
}

void Shrinking::plain_bodies() {
    for (std::size_t i = 0; i < wild.scene.primitives.size(); ++i) {
        thin([i](WildScene & w) -> auto& { return w.scene.primitives[i].transformations; });
        std::visit(
            [&](const auto& shape) {
                using Kind = std::remove_cvref_t<decltype(shape)>;
                const auto field = [&](const auto& entry) {
                    const auto value = [&](WildScene & w) -> auto& {
                        return std::get<Kind>(w.scene.primitives[i].shape).*entry.member;
                    };
                    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value(wild))>, double>)
                        plain([&](WildScene& w) -> double& { return value(w); }, 1);
                    else
                        for (int k = 0; k < 3; ++k) plain([&](WildScene& w) -> double& { return value(w)[k]; }, 0);
                };
                std::apply([&](const auto&... entry) { (field(entry), ...); }, Kind::fields);
            },
            Shape(wild.scene.primitives[i].shape));
    }
}

void Shrinking::plain_materials() {
    for (std::size_t i = 0; i < wild.scene.materials.size(); ++i) {
        attempt([&](WildScene& w) { w.scene.materials[i] = Material{}; });
        const auto field = [&](const auto& entry) {
            const auto usual = Material{}.*entry.member;
            attempt([&](WildScene& w) { w.scene.materials[i].*entry.member = usual; });
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(usual)>, double>)
                plain([&](WildScene& w) -> double& { return w.scene.materials[i].*entry.member; }, usual);
        };
        std::apply([&](const auto&... entry) { (field(entry), ...); }, Material::fields);
    }
}

bool Shrinking::pass() {
    changed = false;
    thin([](WildScene & w) -> auto& { return w.scene.primitives; });
    thin([](WildScene & w) -> auto& { return w.scene.lights; });
    attempt([](WildScene& w) { w.view.error = 0; });
    attempt([](WildScene& w) { w.scene.background = Color(0); });
    attempt([](WildScene& w) { w.scene.fog.reset(); });
    attempt([](WildScene& w) { w.scene.settings.assumed_gamma = 0; });
    attempt([](WildScene& w) { w.scene.settings.ambient_light = Color(1); });
    attempt([](WildScene& w) { w.scene.camera.aspectratio.reset(); });
    attempt([](WildScene& w) { w.view.shift_x = w.view.shift_y = 0; });
    attempt([](WildScene& w) { w.view.depth = w.scene.settings.max_trace_level = std::max(1, w.view.depth / 2); });
    attempt([](WildScene& w) { w.view.depth = w.scene.settings.max_trace_level = std::max(1, w.view.depth - 1); });
    plain([](WildScene& w) -> double& { return w.scene.camera.fov; }, 45);
    for (int k = 0; k < 3; ++k) {
        plain([k](WildScene& w) -> double& { return w.scene.camera.position[k]; }, 0);
        plain([k](WildScene& w) -> double& { return w.scene.camera.look_at[k]; }, 0);
        plain([k](WildScene& w) -> double& { return w.scene.camera.up[k]; }, 0);
    }
    for (std::size_t i = 0; i < wild.scene.lights.size(); ++i) {
        attempt([&](WildScene& w) { w.scene.lights[i].color = Color(1); });
        for (int k = 0; k < 3; ++k) plain([&](WildScene& w) -> double& { return w.scene.lights[i].position[k]; }, 0);
    }
    plain_bodies();
    plain_materials();
    return changed;
}

}  // namespace

WildScene shrunk(WildScene wild, const std::function<bool(const WildScene&)>& faulty) {
    Shrinking shrinking(wild, faulty);
    while (shrinking.pass()) {
    }
    return wild;
}

}  // namespace strahl

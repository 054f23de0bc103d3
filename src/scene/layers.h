// The layers that a picture can hold besides red, green and blue.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace strahl {

/// The numbers that stand for names in layers of bodies and of materials, by the bodies and materials of a scene.
struct LayerIds {
    std::vector<float> bodies, materials;
};

/// The layers of a picture, and what they depend on.
struct Layers {
    bool alpha = false, depth = false, normal = false, position = false, body = false, material = false, light = false;
    double background = 0;  // with alpha: how opaque the background is, from 0 to 1
    std::shared_ptr<const LayerIds> ids{};

    bool geometry() const { return depth || normal || position || body || material; }
    bool any() const { return alpha || geometry() || light; }
    bool operator==(const Layers&) const = default;  // of ids: the same ones
};

/// A layer: its name, what it holds, and its channels. What is by light has three channels for each.
struct LayerKind {
    std::string_view name;
    bool Layers::*wanted;
    const char* help;
    std::vector<std::string> channels(int lights) const {
        if (wanted == &Layers::alpha) return {"A"};
        if (wanted == &Layers::depth) return {"depth.Z"};
        std::vector<std::string> all;
        const auto add = [&](const std::string& layer, std::string_view letters) {
            for (const char letter : letters) all.push_back(layer + "." + letter);
        };
        if (wanted == &Layers::normal) add("normal", "XYZ");
        if (wanted == &Layers::position) add("position", "XYZ");
        if (wanted == &Layers::body || wanted == &Layers::material)
            for (const char* const ranks : {"00", "01", "02"}) add(id_layer() + ranks, "RGBA");
        if (wanted == &Layers::light) {
            add("own", "RGB");
            for (int i = 1; i <= lights; ++i) add("light" + std::to_string(i), "RGB");
            add("reflected", "RGB"), add("refracted", "RGB");
        }
        return all;
    }
    /// Returns the name of a layer of ids (J. Friedman and A. Jones, "Cryptomatte Specification", version 1.2).
    std::string id_layer() const { return wanted == &Layers::body ? "CryptoBody" : "CryptoMaterial"; }
};

/// All layers, in the order of their channels in a pixel, which begins with red, green and blue.
inline constexpr std::array layer_kinds{
    LayerKind{"alpha", &Layers::alpha, "how opaque the picture is"},
    LayerKind{"depth", &Layers::depth, "the distance from the eye"},
    LayerKind{"normal", &Layers::normal, "the normal of the surface"},
    LayerKind{"position", &Layers::position, "the point of the surface"},
    LayerKind{"body", &Layers::body, "the body, as Cryptomatte says it"},
    LayerKind{"material", &Layers::material, "its material, as Cryptomatte says it"},
    LayerKind{"light", &Layers::light, "light apart: of each light, reflected, refracted, and all other"}};

/// The names and their shares that a pixel keeps of a layer of ids.
inline constexpr int id_ranks = 6;

/// Returns the names of all channels of a pixel, in their order.
inline std::vector<std::string> channels_of(const Layers& layers, int lights) {
    std::vector<std::string> all{"R", "G", "B"};
    for (const LayerKind& kind : layer_kinds)
        if (layers.*kind.wanted)
            for (std::string& name : kind.channels(lights)) all.push_back(std::move(name));
    return all;
}

}  // namespace strahl

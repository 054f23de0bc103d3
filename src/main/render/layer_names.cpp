#include "main/render/layer_names.h"

#include <bit>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

namespace strahl {
namespace {

std::string hex_of(std::uint32_t hash) {
    char digits[9];
    std::snprintf(digits, sizeof digits, "%08x", hash);
    return digits;
}

/// Returns the names with their hashes, in JSON.
std::string manifest_of(const std::vector<std::string>& names) {
    nlohmann::json all = nlohmann::json::object();
    for (const std::string& name : names) all[name] = hex_of(std::bit_cast<std::uint32_t>(id_of(murmur_hash(name))));
    return all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);  // of what is no UTF-8
}

std::vector<float> ids(const std::vector<std::string>& names) {
    std::vector<float> all;
    for (const std::string& name : names) all.push_back(id_of(murmur_hash(name)));
    return all;
}

}  // namespace

std::uint32_t murmur_hash(std::string_view text) {
    std::uint32_t hash = 0;
    const auto byte = [&](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(text[i])); };
    const auto scrambled = [](std::uint32_t word) { return std::rotl(word * 0xcc9e2d51u, 15) * 0x1b873593u; };
    std::size_t at = 0;
    for (; at + 4 <= text.size(); at += 4) {
        const std::uint32_t word = byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16 | byte(at + 3) << 24;
        hash = std::rotl(hash ^ scrambled(word), 13) * 5 + 0xe6546b64u;
    }
    std::uint32_t rest = 0;
    for (std::size_t i = text.size(); i-- > at;) rest = rest << 8 | byte(i);
    hash ^= scrambled(rest) ^ static_cast<std::uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

float id_of(std::uint32_t hash) {
    const std::uint32_t exponent = hash >> 23 & 255;
    return std::bit_cast<float>(exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash);
}

std::vector<std::string> names_of_bodies(const OpenedScene& opened) {
    std::vector<std::string> names = opened.lines.names;
    const std::vector<Primitive>& bodies = opened.scene.primitives;
    for (std::size_t i = names.size(); i < bodies.size(); ++i) {
        const auto kind = std::visit([](const auto& shape) { return std::string(shape.name); }, bodies[i].shape);
        names.push_back(kind + " " + std::to_string(i + 1));
    }
    return names;
}

std::vector<std::string> names_of_materials(const Scene& scene) {
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= scene.materials.size(); ++i) names.push_back("material " + std::to_string(i));
    return names;
}

NamedLayers named(Layers layers, const OpenedScene& opened) {
    ChannelNames channels{channels_of(layers, static_cast<int>(opened.scene.lights.size())), {}};
    LayerIds all;
    const auto name_with = [&](const LayerKind& kind, const std::vector<std::string>& names, std::vector<float>& own) {
        const std::string layer = kind.id_layer(), hash = hex_of(murmur_hash(layer)).substr(0, 7);
        for (const auto& [key, value] : {std::pair<const char*, std::string>{"name", layer},
                                         {"hash", "MurmurHash3_32"},
                                         {"conversion", "uint32_to_float32"},
                                         {"manifest", manifest_of(names)}})
            channels.attributes.emplace_back("cryptomatte/" + hash + "/" + key, value);
        own = ids(names);
    };
    for (const LayerKind& kind : layer_kinds) {
        if (kind.wanted == &Layers::body && layers.body) name_with(kind, names_of_bodies(opened), all.bodies);
        if (kind.wanted == &Layers::material && layers.material)
            name_with(kind, names_of_materials(opened.scene), all.materials);
    }
    layers.ids = std::make_shared<const LayerIds>(std::move(all));
    return {std::move(layers), std::move(channels)};
}

}  // namespace strahl

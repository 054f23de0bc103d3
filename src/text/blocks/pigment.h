// The words of patterns, which may stand in place of a material's colour or bend normals.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <type_traits>

#include "scene/pattern.h"

namespace strahl {

template <class... Kinds>
constexpr auto names_of(std::type_identity<std::variant<Kinds...>>) {
    return std::array<std::string_view, sizeof...(Kinds)>{Kinds::name...};
}
inline constexpr auto pattern_words = names_of(std::type_identity<PatternKind>{});

template <class... Kinds>
constexpr auto names_that_bend(std::type_identity<std::variant<Kinds...>>) {
    std::array<std::string_view, (0 + ... + can_bend<Kinds>)> names;
    std::size_t i = 0;
    ((can_bend<Kinds> ? void(names[i++] = Kinds::name) : void()), ...);
    return names;
}
/// The patterns that can bend normals.
inline constexpr auto bump_words = names_that_bend(std::type_identity<PatternKind>{});

/// The words that may follow `map` in a pattern.
template <class Kind>
constexpr auto maps_of(const Kind&) {
    if constexpr (std::is_same_v<Kind, ImagePattern>)
        return std::array<std::string_view, 4>{image_maps[0], image_maps[1], image_maps[2], uv_map};
    else
        return std::array<std::string_view, 1>{uv_map};
}

/// The words of an image that lets light through where it is not opaque.
inline constexpr std::array<std::string_view, 3> opacity_words{"opacity", "mask", "opacity_of"};

/// Most stops of a colour map, as in POV-Ray.
inline constexpr std::size_t most_stops = 256;

/// The text of a scene for it: a vector, or the block of a pattern.
std::string text_of(const Pigment& pigment);
/// The text of a scene for it: "none", or the block of a pattern.
std::string text_of(const Bump& bump);
std::string text_of(const NormalMap& map);

}  // namespace strahl

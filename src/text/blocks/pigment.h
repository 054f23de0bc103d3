// The words of patterns, which may stand in place of a material's colour.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <type_traits>

#include "scene/pattern.h"
#include "text/reading/parameter.h"

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
/// Those that can bend normals.
inline constexpr auto bump_words = names_that_bend(std::type_identity<PatternKind>{});

/// What may follow `map` in a pattern.
template <class Kind>
constexpr auto maps_of(const Kind&) {
    if constexpr (std::is_same_v<Kind, ImagePattern>)
        return std::array<std::string_view, 4>{image_maps[0], image_maps[1], image_maps[2], uv_map};
    else
        return std::array<std::string_view, 1>{uv_map};
}

/// Most stops of a colour map, which are as many as POV-Ray's have.
inline constexpr std::size_t most_stops = 256;

/// The parameters of a kind.
template <class Kind>
auto pattern_parameters(Kind& kind) {
    return std::apply(
        [&](const auto&... field) {
            return std::array<Parameter, sizeof...(field)>{
                Parameter{field.name, &(kind.*field.member), bounds_of(field.range), field.help}...};
        },
        Kind::fields);
}

/// As a scene says it: a vector, or the block of a pattern.
std::string text_of(const Pigment& pigment);
/// Likewise: "none", or the block of a pattern.
std::string text_of(const Bump& bump);
std::string text_of(const NormalMap& map);

}  // namespace strahl

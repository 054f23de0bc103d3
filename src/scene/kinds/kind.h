// Checks the definition of a kind of body, and lists the forms in which the tracer keeps bodies. See src/README.md,
// "How to add a kind".
#pragma once
#include <concepts>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

#include "scene/kinds/world_transform.h"

namespace strahl {

/// Kernel 0 of a kind, or kernel 1, which is for transformations that the first cannot take. All items of a form are
/// stored side by side, so that nothing is dispatched item by item.
template <class OwnKind, std::size_t own_number>
struct Form {
    using Kind = OwnKind;
    static constexpr std::size_t number = own_number;
    template <class T>
    using Kernel = std::tuple_element_t<number, typename Kind::template Kernels<T>>;
    /// Loops of small worlds contain the code of these forms; all others are called.
    static constexpr bool hot = Kind::hot && number == 0;
    /// Their code is so short that the loops over their items contain it too.
    static constexpr bool compact = hot || requires { requires Kind::compact; };
    static constexpr bool plane_faces = requires { requires Kind::plane_faces; };
};
template <class... Forms>
struct FormList {
    static constexpr int size = sizeof...(Forms);
};

/// Takes any kernel, for the check below.
struct AnyEmitter {
    template <class K>
    void operator()(const K&) const {}
};

/// Compiles if `Kind` is complete; else the compiler says what is missing.
template <class Kind>
consteval bool check_kind() {
    static_assert(std::equality_comparable<Kind>, "a kind is a value: default its operator==");
    static_assert(
        requires { std::string_view(Kind::name); }, "a kind has a `name`, its word in the scene language");
    static_assert(
        requires { std::tuple_size<decltype(Kind::fields)>::value; }, "a kind has a table `fields`");
    static_assert(
        requires { std::integral_constant<int, Kind::faces>::value; },
        "a kind says how many `faces` its items have, which are numbered from 0");
    static_assert(
        requires { std::bool_constant<Kind::bounded>(); },
        "a kind says whether it is `bounded`; if not, it is a half-space");
    static_assert(
        requires { std::bool_constant<Kind::convex>(); },
        "a kind says whether it is `convex`: a body that is not may shadow and meet itself");
    static_assert(
        requires { std::bool_constant<Kind::closed>(); },
        "a kind says whether it is `closed`: whether its surface bounds a space, its inside");
    static_assert(
        requires { std::integral_constant<int, Kind::max_crossings>::value; },
        "a kind says how often a line crosses its surface at most: `max_crossings`");
    static_assert(
        requires { std::bool_constant<Kind::hot>(); },
        "a kind says whether it is `hot`: so common that small worlds' loops contain its code");
    static_assert(
        Kind::max_crossings >= 1 && Kind::max_crossings <= (Kind::convex ? 2 : 4),
        "kernels of convex kinds answer with a Span, which has room for two crossings, others with Crossings");
    static_assert(Kind::convex || Kind::faces <= 1, "Crossings tell no faces");
    static_assert(
        requires(const Kind k) { static_cast<const char*>(k.fault()); },
        "a kind has a `fault()`: why its values make no body, or nullptr");
    static_assert(
        requires(const Kind k, DVec3 p) { static_cast<bool>(k.contains(p)); }, "a kind has `contains(p)`");
    static_assert(
        requires(const Kind k) { static_cast<Box>(k.bounds()); },
        "a kind has `bounds()`, the box around it in its own space");
    static_assert(
        Kind::bounded || requires(const Kind k, glm::dmat4 m) { static_cast<HalfSpace>(k.half_space(m)); },
        "a kind that is not bounded has a `half_space(matrix)`");
    static_assert(
        requires { std::tuple_size<typename Kind::template Kernels<float>>::value; }, "a kind lists its `Kernels<T>`");
    static_assert(std::tuple_size_v<typename Kind::template Kernels<float>> <= 2, "a kind has at most two kernels");
    static_assert(
        requires(const Kind k, WorldTransform to) { k.template emit<float>(to, AnyEmitter{}); },
        "a kind emits its items: `emit<T>(to_world, emit)`");
    static_assert(
        std::tuple_size_v<std::remove_cvref_t<decltype(Kind::fields)>> == 0 ||
            requires(const Kind k) { std::tuple_size<decltype(k.pov())>::value; } ||
            requires(const Kind k) { k.data; } || requires(const Kind k) { k.face_count(); },
        "a kind has its POV-Ray words: `pov()`, a tuple of keyword and arguments; `pov_more()`, if it has that, "
        "follows");
    return true;
}

template <class Form, class... Forms>
consteval int place_of(FormList<Forms...>) {
    int place = 0, found = -1;
    ((std::is_same_v<Form, Forms> ? found = place++ : ++place), ...);
    return found;
}

template <std::size_t number, class Forms>
struct FormAtPlace;
template <std::size_t number, class... Forms>
struct FormAtPlace<number, FormList<Forms...>> {
    using Type = std::tuple_element_t<number, std::tuple<Forms...>>;
};
template <std::size_t number, class Forms>
using FormAt = typename FormAtPlace<number, Forms>::Type;

template <class... Lists>
struct JoinForms;
template <class... A>
struct JoinForms<FormList<A...>> {
    using Type = FormList<A...>;
};
template <class... A, class... B, class... More>
struct JoinForms<FormList<A...>, FormList<B...>, More...> : JoinForms<FormList<A..., B...>, More...> {};

/// A list of form `number` of a kind; empty if it has none.
template <class Kind, std::size_t number>
using FormOfKind = std::conditional_t<(number < std::tuple_size_v<typename Kind::template Kernels<float>>),
                                      FormList<Form<Kind, number>>, FormList<>>;
template <class Kind>
using FormsOfKind = typename JoinForms<FormOfKind<Kind, 0>, FormOfKind<Kind, 1>>::Type;

/// All first forms in the order of the kinds, then all second ones. Bodies are shaded, and the transmissions of small
/// worlds multiplied, in this order.
template <class Kinds>
struct FormsOf;
template <class... Kinds>
struct FormsOf<std::variant<Kinds...>> {
    static_assert((check_kind<Kinds>() && ...));
    using Type = typename JoinForms<FormOfKind<Kinds, 0>..., FormOfKind<Kinds, 1>...>::Type;
};

}  // namespace strahl

// Reads single values: those after commas, and those that words give to members of a thing.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "pov/language/interpreter.h"

namespace strahl::pov {

inline double next_number(Interpreter& in) {
    in.skip_comma();
    return in.read_number();
}
inline DVec3 next_vector(Interpreter& in) {
    in.skip_comma();
    return in.read_vector();
}

inline void read_into(Interpreter& in, double& value) { value = in.read_number(); }
inline void read_into(Interpreter& in, int& value) { value = in.read_integer(); }
inline void read_into(Interpreter& in, bool& value) { value = in.read_flag(); }
inline void read_into(Interpreter& in, DVec3& value) { value = in.read_vector(); }
template <class Value>
void read_into(Interpreter& in, std::optional<Value>& value) {
    read_into(in, value.emplace());
}

/// A word, and the function that reads the value after it into a thing.
template <class T>
struct ValueWord {
    std::uint16_t code;
    void (*read)(Interpreter& in, T& thing);
};
/// Makes one of a word and a member, such as &Blend::phase, or a member of a member: &Blend::crackle, &Form::metric.
template <class T, auto... members>
consteval ValueWord<T> value_word(std::string_view name) {
    return {word(name), [](Interpreter& in, T& thing) { read_into(in, (thing.*....*members)); }};
}
/// Takes a word of this list with its value, if one comes; else returns false.
template <class T, std::size_t size>
bool accept_value(Interpreter& in, const std::array<ValueWord<T>, size>& words, T& thing) {
    const auto known = std::ranges::find(words, in.code(), &ValueWord<T>::code);
    if (known == words.end()) return false;
    in.take();
    known->read(in, thing);
    return true;
}

}  // namespace strahl::pov

// The functions of the language that take numbers alone, for expressions and for what functions are compiled to.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "pov/language/words.h"

namespace strahl::pov {

inline double truncated(double value) {
    return value > -2147483649. && value < 2147483648. ? std::trunc(value) : -2147483648.;
}

/// Calls `use` with the function of one number that has this word; false if none has.
template <class Use>
constexpr bool with_unary(std::uint16_t code, const Use& use) {
    switch (code) {
        case word("abs"):
            return use([](double v) { return std::abs(v); }), true;
        case word("acos"):
            return use([](double v) { return std::acos(v); }), true;
        case word("acosh"):
            return use([](double v) { return std::acosh(v); }), true;
        case word("asin"):
            return use([](double v) { return std::asin(v); }), true;
        case word("asinh"):
            return use([](double v) { return std::asinh(v); }), true;
        case word("atan"):
            return use([](double v) { return std::atan(v); }), true;
        case word("atanh"):
            return use([](double v) { return std::atanh(v); }), true;
        case word("ceil"):
            return use([](double v) { return std::ceil(v); }), true;
        case word("cos"):
            return use([](double v) { return std::cos(v); }), true;
        case word("cosh"):
            return use([](double v) { return std::cosh(v); }), true;
        case word("degrees"):
            return use([](double v) { return v * (180 / std::numbers::pi); }), true;
        case word("exp"):
            return use([](double v) { return std::exp(v); }), true;
        case word("floor"):
            return use([](double v) { return std::floor(v); }), true;
        case word("int"):
            return use(truncated), true;
        case word("ln"):
            return use([](double v) { return std::log(v); }), true;
        case word("log"):
            return use([](double v) { return std::log10(v); }), true;
        case word("radians"):
            return use([](double v) { return v * (std::numbers::pi / 180); }), true;
        case word("sin"):
            return use([](double v) { return std::sin(v); }), true;
        case word("sinh"):
            return use([](double v) { return std::sinh(v); }), true;
        case word("sqrt"):
            return use([](double v) { return std::sqrt(v); }), true;
        case word("tan"):
            return use([](double v) { return std::tan(v); }), true;
        case word("tanh"):
            return use([](double v) { return std::tanh(v); }), true;
        default:
            return false;
    }
}

/// Does the same for functions of two numbers.
template <class Use>
constexpr bool with_binary(std::uint16_t code, const Use& use) {
    switch (code) {
        case word("atan2"):
            return use([](double a, double b) { return std::atan2(a, b); }), true;
        case word("div"):
            return use([](double a, double b) { return truncated(a / b); }), true;
        case word("mod"):
            return use([](double a, double b) { return std::fmod(a, b); }), true;
        case word("pow"):
            return use([](double a, double b) { return b == 2 ? a * a : std::pow(a, b); }), true;
        default:
            return false;
    }
}

/// Does the same for functions that take any count of numbers: each next number is the second one of the function, and
/// the value so far the first one.
template <class Use>
constexpr bool with_any_count(std::uint16_t code, const Use& use) {
    switch (code) {
        case word("min"):
            return use([](double a, double b) { return std::min(a, b); }), true;
        case word("max"):
            return use([](double a, double b) { return std::max(a, b); }), true;
        default:
            return false;
    }
}

constexpr bool is_maths_word(std::uint16_t code) {
    const auto nothing = [](const auto&) {};
    return with_unary(code, nothing) || with_binary(code, nothing) || with_any_count(code, nothing);
}

}  // namespace strahl::pov

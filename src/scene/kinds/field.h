// The field table of a kind of body, of a material, a light or fog: names, meanings and ranges of its parameters. The
// parser, the writer, the tables of the manual, tracks and the random scenes of the tests use it.
#pragma once

namespace strahl {

/// Ranges of numbers. text/reading/parameter.h has their limits.
enum class Range {
    any,
    coordinate,
    direction,
    positive,
    length,
    length_or_zero,
    zero_or_more,
    zero_to_one,
    octaves,
    quarter_turn,
    steps,
    levels
};

/// May the parameter be left out, so that its default applies? Only the last ones of a list may.
enum class Given : bool { always, optional };

/// One parameter of type V (double, DVec3, ...) in a struct C. `name` is its name in messages and in the manual.
template <class C, class V>
struct Field {
    const char* name;
    V C::*member;
    const char* help;
    Range range = Range::any;
    Given given = Given::always;
    const char* otherwise = "";  // its default in words; empty: the value that the struct has
};
template <class C, class V>
Field(const char*, V C::*, const char*, Range, Given, const char*) -> Field<C, V>;
template <class C, class V>
Field(const char*, V C::*, const char*, Range, Given) -> Field<C, V>;
template <class C, class V>
Field(const char*, V C::*, const char*, Range) -> Field<C, V>;
template <class C, class V>
Field(const char*, V C::*, const char*) -> Field<C, V>;

}  // namespace strahl

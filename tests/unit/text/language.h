// Shared by the tests of the scene language: scenes from texts, and the errors of wrong ones.
#pragma once
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/unit/faults.h"
#include "text/parse.h"

template <>
struct doctest::StringMaker<std::vector<std::string>> {
    static String convert(const std::vector<std::string>& lines) {
        std::string all;
        for (const std::string& line : lines) all += "\n" + line;
        return all.c_str();
    }
};

namespace strahl::language {

inline const std::string eye = "camera { position <0,-9,0> look_at <0,0,0> up <0,0,-1> fov 25 }\n";

inline Scene parse(const std::string& text) { return parse_scene(text, "x.rt"); }
/// A scene with the camera in its first line, so that `text` starts in line 2.
inline Scene with_eye(const std::string& text) { return parse(eye + text); }

inline std::string message(const std::string& text, const TextLimits& limits = {}) {
    return fault_of([&] { parse_scene(text, "x.rt", limits); }, "no error");
}
inline std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> result(1);
    for (const char c : text)
        if (c == '\n')
            result.emplace_back();
        else
            result.back() += c;
    return result;
}
/// "unknown word 'x'; known here: ..." on the top level.
inline std::string unknown(const std::string& word) {
    const auto kinds = []<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        return (... + (std::string(", ") + Kinds::name));
    };
    return "unknown word '" + word + "'; known here: camera, light" + kinds(std::type_identity<Shape>{}) +
           ", defaultmaterial, background, fog, global_settings, flythrough, define, music";
}
/// The lines of a message that name a place, without quoted lines and carets.
inline std::vector<std::string> faults(const std::string& text) {
    std::vector<std::string> result;
    for (const std::string& line : lines(message(text)))
        if (!line.starts_with("    ")) result.push_back(line);
    return result;
}
using Faults = std::vector<std::string>;

/// Checks the only error of `text`, which follows a valid camera of one line.
inline void check_fault(const std::string& text, const std::string& fault) {
    CAPTURE(text);
    CHECK(faults(eye + text) == Faults{"x.rt:" + fault});
}

}  // namespace strahl::language

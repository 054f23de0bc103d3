// Runs texts in the language of POV-Ray's scenes, with a layer above it that reads over all bodies and textures.
#pragma once
#include <doctest/doctest.h>

#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "files/error.h"
#include "pov/language/interpreter.h"

namespace strahl::pov {

/// Reads over blocks. An object is a unit ball to trace().
struct BlankLayer : SceneLayer {
    struct Blank : Thing {};

    NamedValue read_thing(Interpreter& in) override {
        const ValueKind kind = in.at("texture") ? ValueKind::texture : ValueKind::object;
        if (!in.at("sphere") && !in.at("texture")) return {};
        in.take();
        in.skip_block();
        while (kind == ValueKind::texture && in.accept_here("texture")) in.skip_block();
        return {kind, {}, std::make_shared<Blank>()};
    }
    void read_default(Interpreter& in) override { in.skip_block(); }
    std::shared_ptr<const FunctionThing> read_function(Interpreter& in) override { in.expected("an expression"); }
    bool trace(Interpreter&, const Thing&, const DVec3&, const DVec3&, DVec3& hit, DVec3& normal) override {
        hit = normal = DVec3(0, 1, 0);
        return true;
    }
    bool inside(Interpreter&, const Thing&, const DVec3& point) override { return point.x < 1; }
    std::pair<DVec3, DVec3> extent(Interpreter&, const Thing&) override { return {DVec3(-1), DVec3(1)}; }
};

/// What a text brings: its output of #debug, or the message about its error; and its remarks.
struct ScriptResult {
    std::string printed, error, remarks;
};

inline ScriptResult run_script(const std::string& text, InterpreterOptions options = {}) {
    ScriptResult result;
    options.print = [&](const std::string& part) { result.printed += part; };
    if (options.file.empty()) options.file = "scene.pov";
    BlankLayer layer;
    try {
        Interpreter in(text, options, layer);
        while (!in.at_end())
            if (layer.read_thing(in).kind == ValueKind::none) in.expected("a body");
        for (const Remark& remark : in.remarks())
            result.remarks += in.message_at(remark.place, remark.text).told() + "\n";
    } catch (const FileError& error) {
        result.error = error.what();
    }
    return result;
}

/// Splits a text into its words.
inline std::string words_of(const std::string& text) {
    std::istringstream in(text);
    std::string all;
    for (std::string word; in >> word;) all += word + " ";
    return all;
}

/// Checks that a text prints these words.
inline void check_prints(const std::string& text, const std::string& expected) {
    CAPTURE(text);
    const ScriptResult result = run_script(text);
    CHECK(result.error == "");
    CHECK(words_of(result.printed) == words_of(expected));
}

/// Checks that a text has an error whose message contains `expected`.
inline void check_fails(const std::string& text, const std::string& expected, const InterpreterOptions& options = {}) {
    CAPTURE(text);
    const ScriptResult result = run_script(text, options);
    CAPTURE(result.error);
    CHECK(result.error.find(expected) != std::string::npos);
}

}  // namespace strahl::pov

// Any bytes, read as the language of POV-Ray's scenes, either end with a FileError or are read to their end, within the
// limits of steps and memory; and so they do as a whole scene, as scene text with directives, as an .ini file, and as
// a flight.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pov/animation.h"
#include "pov/expand.h"
#include "pov/flight_file.h"
#include "pov/ini_file.h"
#include "pov/language/interpreter.h"
#include "pov/open_pov.h"
#include "tests/attack/written_again.h"

namespace {

using namespace strahl::pov;
using strahl::DVec3;
using strahl::attack::fail;

/// Takes any token for a body, and any block for a texture.
struct AnyLayer : SceneLayer {
    struct Blank : Thing {};

    NamedValue read_thing(Interpreter& in) override {
        if (in.code() < first_word_code) return {};
        in.take();
        in.skip_block();
        return {ValueKind::object, {}, std::make_shared<Blank>()};
    }
    void read_default(Interpreter& in) override { in.skip_block(); }
    std::shared_ptr<const FunctionThing> read_function(Interpreter& in) override { in.expected("an expression"); }
    bool trace(Interpreter&, const Thing&, const DVec3&, const DVec3&, DVec3&, DVec3&) override { return false; }
    bool inside(Interpreter&, const Thing&, const DVec3&) override { return true; }
    std::pair<DVec3, DVec3> extent(Interpreter&, const Thing&) override { return {DVec3(-1), DVec3(1)}; }
};

InterpreterOptions few_steps() {
    InterpreterOptions options;
    options.file = "fuzz";
    options.limits.steps = 20'000;
    options.limits.bytes = 8 << 20;
    return options;
}

/// Makes the bodies, materials and lights of a scene.
void open_whole(const std::string& text) { open_pov(text, few_steps(), strahl::made_up_pixels); }

/// Scene text without its directives gives a scene that survives being written.
void expand_text(const std::string& text) {
    const ExpandedText expanded = expand(text, few_steps());
    strahl::TextLimits limits;
    limits.primitives = 1000;
    const auto scene =
        strahl::parse_scene(expanded.text, "fuzz", limits, strahl::made_up_pixels, nullptr, expanded.origins);
    strahl::attack::written_again(scene);
}

/// Checks that the clock of any .ini file is finite and that its frames follow each other.
void read_ini_file(const std::string& text) {
    const Animation all = Animation::of(parse_ini(text, "fuzz"), 4.);
    for (const double time : {0., .04, 3.7, 1e9})
        if (!std::isfinite(all.clock_at(time))) fail("the clock is no number:", text);
    if (all.frames().first < 0 || all.frames().second < all.frames().first || !(all.seconds > 0))
        fail("the frames do not follow each other:", text);
}

/// Checks that a flight is the same after it was written and read again, and keeps the comments of its text.
void read_flight(const std::string& text) {
    const auto flight = parse_flight(text, "fuzz");
    if (!flight) return;
    if (parse_flight(with_flight("", flight, false), "fuzz") != flight) fail("a flight is another one:", text);
    const std::string written = with_flight(text, flight, false);
    if (parse_flight(written, "fuzz") != flight) fail("a flight is written as another one:", written);
}

}  // namespace

std::vector<std::string> attacked_words() { return {reserved_words.begin(), reserved_words.end()}; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    AnyLayer layer;
    try {
        Interpreter in(text, few_steps(), layer);
        while (!in.at_end()) {
            if (in.at_color())
                in.read_color();
            else if (in.at_string())
                in.read_string();
            else if (in.at_expression())
                in.read_components();
            else
                in.take();
        }
    } catch (const strahl::FileError& error) {
        strahl::attack::check_message(error, 6000);
    }
    for (const auto read : {open_whole, expand_text, read_ini_file, read_flight}) try {
            read(text);
        } catch (const strahl::FileError& error) {
            strahl::attack::check_message(error, 20000);
        }
    return 0;
}

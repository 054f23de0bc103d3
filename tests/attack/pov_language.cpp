// Any bytes, read as the language of POV-Ray's scenes, either end with a FileError or are read to their end, within the
// limits of steps and memory.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pov/language/interpreter.h"
#include "tests/attack/written_again.h"

namespace {

using namespace strahl::pov;
using strahl::DVec3;

/// Takes any token for a body, and any block for a texture.
struct AnyLayer : SceneLayer {
    struct Blank : Thing {};

    NamedValue read_thing(Interpreter& in) override {
        if (in.code() < first_word_code) return {};
        in.skip();
        in.skip_block();
        return {ValueKind::object, {}, std::make_shared<Blank>()};
    }
    void read_default(Interpreter& in) override { in.skip_block(); }
    std::shared_ptr<const FunctionThing> read_function(Interpreter& in) override { in.expected("an expression"); }
    bool trace(Interpreter&, const Thing&, const DVec3&, const DVec3&, DVec3&, DVec3&) override { return false; }
    bool inside(Interpreter&, const Thing&, const DVec3&) override { return true; }
    std::pair<DVec3, DVec3> extent(Interpreter&, const Thing&) override { return {DVec3(-1), DVec3(1)}; }
};

}  // namespace

std::vector<std::string> attacked_words() { return {reserved_words.begin(), reserved_words.end()}; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    InterpreterOptions options;
    options.file = "fuzz";
    options.limits.steps = 20'000;
    options.limits.bytes = 8 << 20;
    AnyLayer layer;
    try {
        Interpreter in({reinterpret_cast<const char*>(data), size}, options, layer);
        while (!in.at_end()) {
            if (in.at_color())
                in.read_color();
            else if (in.at_string())
                in.read_string();
            else if (in.at_expression())
                in.read_components();
            else
                in.skip();
        }
    } catch (const strahl::FileError& error) {
        strahl::attack::check_message(error, 6000);
    }
    return 0;
}

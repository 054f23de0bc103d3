// Scene files that are none: not text, made to take long, too large, not there.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "files/read_file.h"
#include "tests/unit/text/language.h"
#include "text/reading/lexer.h"
#include "text/reading/tracks_file.h"

using namespace strahl;
using namespace strahl::language;

TEST_CASE("files that are not text") {
    CHECK(faults("// \xE4\n") == Faults{"x.rt:1:4: not UTF-8; save the file in that encoding"});
    CHECK(faults(std::string("camera \0{", 9)) == Faults{"x.rt:1:8: a byte 0 in the text; is this a text file?"});
    for (const char* const bytes : {"\xFF\xFE", "\x80", "\xC0\x80", "\xC3", "\xE0\x80\x80", "\xED\xA0\x80",
                                    "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "\xE2\x82"})
        CHECK(faults(std::string("\n// ") + bytes).at(0).starts_with("x.rt:2:4: not UTF-8"));
    CHECK(parse(eye + "// \xC2\x80 \xE2\x82\xAC \xEF\xBF\xBF \xF0\x9F\x98\x80 \xF4\x8F\xBF\xBF").lights.empty());
}

TEST_CASE("a byte order mark is skipped, and UTF-16 and UTF-32 are called so") {
    const std::string bom = "\xEF\xBB\xBF", tracks = "track \"a\" { 0 1 step }\n";
    CHECK(parse(bom + eye) == parse(eye));
    CHECK(parse(bom + bom + eye) == parse(eye));
    CHECK(parse(eye + bom) == parse(eye));
    CHECK(faults(eye + "\nsphere {\u00A0<0, 0, 0>, 1 }").at(0).find("found a no-break space") != std::string::npos);
    CHECK(faults(bom + eye + "x") == faults(eye + "x"));
    CHECK(parse_tracks(bom + tracks, "x.tracks") == parse_tracks(tracks, "x.tracks"));
    const auto wide = [](const std::string& text, std::size_t before, std::size_t after) {
        std::string result;
        for (const char c : text) result.append(before, '\0').append(1, c).append(after, '\0');
        return result;
    };
    for (const std::string& text : {eye, tracks}) {
        const std::string zeros(2, '\0');
        for (const auto& [bytes, encoding] : {std::pair{wide(text, 0, 1), "16"},
                                              {wide(text, 1, 0), "16"},
                                              {"\xFF\xFE" + wide(text, 0, 1), "16"},
                                              {"\xFE\xFF" + wide(text, 1, 0), "16"},
                                              {wide(text, 0, 3), "32"},
                                              {wide(text, 3, 0), "32"},
                                              {"\xFF\xFE" + zeros + wide(text, 0, 3), "32"},
                                              {zeros + "\xFE\xFF" + wide(text, 3, 0), "32"}}) {
            const std::string said = std::string(": this text is in UTF-") + encoding + "; save the file as UTF-8";
            CHECK(message(bytes) == "x.rt" + said);
            CHECK(fault_of([&] { parse_tracks(bytes, "x.tracks"); }) == "x.tracks" + said);
        }
    }
}

TEST_CASE("files of tracks with braces and words where none belong are refused, and reading them ends") {
    const std::string good = "track \"a\" { 0 1 step }\n";
    for (const char* const text : {"}",
                                   "}}",
                                   "{",
                                   "{}",
                                   "}{",
                                   "]",
                                   "track",
                                   "track \"a\"",
                                   "track \"a\" {",
                                   "track {",
                                   "track \"a\" }",
                                   "track \"a\" {{",
                                   "track \"a\" { 0",
                                   "track \"a\" { track {",
                                   "/",
                                   "/*",
                                   "x {",
                                   "x { }",
                                   "} track",
                                   "\"",
                                   "0 1 step",
                                   "track track \"a\" {}"}) {
        CAPTURE(text);
        for (const std::string& all : {std::string(text), good + text, text + good})
            CHECK(fault_of([&] { parse_tracks(all, "x.tracks"); }).starts_with("x.tracks:"));
    }
    const auto fault = fault_of([&] { parse_tracks(good + "}\n", "x.tracks"); });
    CHECK(lines(fault).at(0) == "x.tracks:2:1: a block expected, such as 'track \"fade\" { 0 1 step }', but found '}'");
}

TEST_CASE("a reader that does not come further is stopped") {
    const std::string text = "a b";
    Diagnostics diagnostics(text, "x.rt");
    Lexer lexer(text, diagnostics);
    CHECK(lexer.word() == "a");
    const std::string fault = fault_of([&] {
        while (!lexer.at_end()) lexer.peek();
    });
    CHECK(lines(fault).at(0) == "x.rt:1:3: this text cannot be read further than here");
}

TEST_CASE("hostile text is rejected quickly") {
    // Nesting, repetition, and long words or numbers take no longer than reading them.
    for (const std::string piece :
         {"{", "}", "<", "sphere {", "/*/", "//", "camera", "a", "9", "-", ".", ",", "material {", "key {"}) {
        std::string text = "sphere { <0,0,0>, 1 ";
        for (int i = 0; i < 100000; ++i) text += piece;
        CHECK(message(text).starts_with("x.rt:1:"));
        CHECK(message(text.substr(20)).starts_with("x.rt:1:"));
        CHECK(message(text).size() < 5000);
    }
    TextLimits limits;
    limits.primitives = 2, limits.lights = 1, limits.transformations = 3, limits.keys = 2;
    const std::string ball = "sphere { <0,0,0>, 1 }\n", lamp = "light { position <0,0,0> color <1,1,1> }\n";
    CHECK(message(eye + ball + ball, limits) == "no error");
    CHECK(message(eye + ball + ball + ball, limits).starts_with("x.rt:4:1: more than 2 primitives"));
    CHECK(message(eye + lamp + lamp, limits).starts_with("x.rt:3:1: more than 1 lights"));
    CHECK(message(eye + "sphere { <0,0,0>, 1 scale 1 scale 1 scale 1 scale 1 }", limits)
              .starts_with("x.rt:2:45: more than 3 transformations of one primitive"));
    std::string keys;
    for (const char* const time : {"0", "1", "2"})
        keys += "\nkey { position <0,0,0> look_at <0,1,0> time " + std::string(time) + " }";
    CHECK(message(eye + "flythrough { duration 9" + keys + "}", limits).starts_with("x.rt:5:1: more than 2 keys"));
}

TEST_CASE("files") {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("strahl-language-test-" + std::to_string(getpid()) + ".rt");
    std::ofstream(path) << eye;
    CHECK(read_text(path.string()) == eye);
    CHECK_THROWS_WITH_AS(read_text(path.string(), 10),
                         ("'" + path.string() + "' is larger than 10 bytes; is it a scene file?").c_str(), FileError);
    std::filesystem::remove(path);
    CHECK_THROWS_WITH_AS(read_text(path.string()),
                         ("cannot read '" + path.string() + "': No such file or directory").c_str(), FileError);
    CHECK_THROWS_WITH_AS(read_text("/"), "cannot read '/': Is a directory", FileError);
    CHECK_THROWS_AS(read_text("/dev/zero", 1 << 22), FileError);
}

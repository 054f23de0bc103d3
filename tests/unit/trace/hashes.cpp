// Pictures are the same on every machine: small ones of all scenes against hashes stored in hashes.txt.
//
// If a change of the engine is meant to change pictures, write the file anew, from this machine's best
// instruction set:
//
//     build/release/tests/test_trace --no-skip --test-case="hashes.txt is written anew"
#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <string>

#include "tests/unit/levels.h"
#include "tests/unit/sanitized.h"
#include "tests/unit/scenes.h"

using namespace strahl;

namespace {

const std::string file = std::string(STRAHL_SOURCE) + "/tests/unit/trace/hashes.txt";

/// FNV-1a over the bytes of all values, least significant first (G. Fowler, L. C. Noll, P. Vo).
std::uint64_t hash(const Frame& frame) {
    std::uint64_t result = 0xcbf29ce484222325;
    for (const double value : frame.rgb)
        for (int shift = 0; shift < 64; shift += 8)
            result = (result ^ (std::bit_cast<std::uint64_t>(value) >> shift & 0xff)) * 0x100000001b3;
    return result;
}

/// "article float 0123456789abcdef double fedcba9876543210"
std::string line(const std::string& scene_name, std::initializer_list<Precision> precisions, Simd simd) {
    const Scene scene = read_scene(scene_name);
    const View view{.camera = scene.camera, .width = 64, .height = 48, .depth = scene.settings.max_trace_level};
    std::string text = scene_name;
    for (const Precision precision : precisions) {
        char digits[17];
        std::snprintf(digits, sizeof digits, "%016llx",
                      static_cast<unsigned long long>(hash(render(scene, view, precision, 0, simd))));
        text += std::string(" ") + name(precision) + " " + digits;
    }
    return text;
}

}  // namespace

TEST_CASE("pictures have the stored hashes") {
    std::ifstream in(file);
    int number = 0;
    for (const std::string& scene : scene_names()) {
        std::string stored;
        std::getline(in, stored);
        if (sanitized() && ++number % 3) continue;
        if (sanitized()) line(scene, {Precision::extended}, Simd::automatic);  // only these have sanitizers
        for (const Simd simd : sanitized() ? std::vector{Simd::automatic} : fused_levels()) {
            CAPTURE(std::string(name(simd)));
            CHECK(line(scene, {Precision::float32, Precision::float64}, simd) == stored);
        }
    }
    std::string more;
    CHECK(!std::getline(in, more));
}

TEST_CASE("hashes.txt is written anew" * doctest::skip()) {
    std::ofstream out(file);
    for (const std::string& scene : scene_names())
        out << line(scene, {Precision::float32, Precision::float64}, Simd::automatic) << '\n';
    CHECK(out.flush());
}

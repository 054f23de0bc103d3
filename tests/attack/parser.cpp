// Any bytes either give a FileError or a scene that survives being written and parsed again.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "scene/moving_scene.h"
#include "tests/referee/random_pattern.h"
#include "text/manual/syntax.h"
#include "text/parse.h"
#include "text/write.h"

namespace {

[[noreturn]] void fail(const char* what, const std::string& detail) {
    std::fprintf(stderr, "%s\n%s\n", what, detail.c_str());
    std::abort();
}

bool finite(const glm::dmat4& m) {
    bool all = true;
    for (int i = 0; i < 16; ++i) all &= std::isfinite(m[i / 4][i % 4]);
    return all;
}

void check(const strahl::Scene& scene) {
    const std::string text = strahl::write_scene(scene);
    try {
        if (strahl::parse_scene(text, "written", {}, strahl::made_up_pixels) != scene)
            fail("written and parsed again it is another scene:", text);
    } catch (const strahl::FileError& error) {
        fail("what was written does not parse:", std::string(error.what()) + "\n" + text);
    }
    for (const double time : {0., .1, 1.7, 1e9}) {
        const strahl::Scene now = at(scene, time);
        if (strahl::Movers(now).any()) fail("at a moment something moves:", text);
        for (const strahl::Primitive& primitive : now.primitives)
            for (const strahl::Transformation& step : primitive.transformations)
                if (!finite(strahl::matrix({&step, 1}))) fail("a motion leaves the range of numbers:", text);
    }
    if (!scene.flythrough) return;
    for (const double share : {-.1, 0., .3, .5, .99, 1., 1.7}) {
        const strahl::Camera camera = camera_at(*scene.flythrough, scene.camera, share * scene.flythrough->duration);
        if (!(camera.fov > 0 && camera.fov < 90)) fail("the flythrough leaves the range of fov:", text);
        if (degenerate(camera)) fail("the flythrough has a moment without a picture:", text);
    }
}

}  // namespace

std::vector<std::string> attacked_words() {
    const strahl::LanguageWords language = strahl::words_of_language();
    std::vector<std::string> words;
    for (const auto* some : {&language.blocks, &language.patterns, &language.others})
        words.insert(words.end(), some->begin(), some->end());
    return words;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    strahl::TextLimits limits;
    limits.primitives = 1000;
    strahl::Scene scene;
    try {
        scene = strahl::parse_scene(text, "fuzz", limits, strahl::made_up_pixels);
    } catch (const strahl::FileError& error) {
        const std::string_view message = error.what();
        if (!message.starts_with("fuzz:") || message.size() > 20000) fail("a strange message:", error.what());
        return 0;
    }
    check(scene);
    return 0;
}

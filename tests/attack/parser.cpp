// Any bytes either give a FileError or a scene that survives being written and parsed again.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/moving_scene.h"
#include "tests/attack/written_again.h"
#include "text/manual/syntax.h"

namespace {

using strahl::attack::fail;

bool finite(const glm::dmat4& m) {
    bool all = true;
    for (int i = 0; i < 16; ++i) all &= std::isfinite(m[i / 4][i % 4]);
    return all;
}

void check(const strahl::Scene& scene) {
    const std::string text = strahl::attack::written_again(scene);
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
        strahl::attack::check_message(error, 20000);
        return 0;
    }
    check(scene);
    return 0;
}

// How much better pictures in motion become where they are sharpened.
#include <cmath>

#include "tests/unit/show/sharpened_pictures.h"

namespace strahl::sharpening {

TEST_CASE("the more rays sharpen a picture, the better it is, and it soon beats one ray in each pixel") {
    for (const std::string name : {"article", "flythrough", "mirror_ball"}) {
        CAPTURE(name);
        Pictures pictures(name);
        double last = pictures.rms(pictures.sharpened(ninth_level, 0));
        const double one = pictures.rms(pictures.sharpened(finest_level, 0));
        for (const double share : {.04, .12, .36}) {
            CAPTURE(share);
            const double rays = share * width * height, off = pictures.rms(pictures.sharpened(ninth_level, rays));
            CHECK(static_cast<double>(pictures.taken.camera) <= 1.02 * rays);
            CHECK(off < last);
            last = off;
        }
        CHECK(pictures.rms(pictures.sharpened(finest_level, .2 * width * height)) < .9 * one);
        // With less than half of its rays; nearly all pixels of mirror_ball differ from their neighbours.
        CHECK(last < (name == "mirror_ball" ? 1 : .8) * one);
    }
}

TEST_CASE("the steps of the next picture suit the last one: a floor is seen better with as many pixels") {
    Pictures pictures("mirror_ball");
    QuickPictures quick;
    const auto off = [&] {
        ScreenImage image;
        const Job job{pictures.view, pictures.pool, {}};
        quick.trace(
            pictures.tracer, job, pictures.table, {}, ninth_level, [] { return 0.; }, true, image);
        return pictures.rms(image);
    };
    const double square = off(), suited = off();
    CHECK(suited < .9 * square);
    CHECK(off() == suited);
}

}  // namespace strahl::sharpening

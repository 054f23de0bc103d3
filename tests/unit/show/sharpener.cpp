// Pictures in motion, sharpened where they change most.
#include <atomic>

#include "tests/unit/sanitized.h"
#include "tests/unit/show/sharpened_pictures.h"

namespace strahl::sharpening {

TEST_CASE("sharpened pictures do not depend on threads, and all levels can be sharpened") {
    Pictures one("article", 1), three("article", 3);
    for (int level = 0; level <= finest_level; level += sanitized() ? 2 : 1) {
        CAPTURE(level);
        const ScreenImage plain = one.sharpened(level, 0), sharp = one.sharpened(level, 9000);
        CHECK(sharp.pixels == three.sharpened(level, 9000).pixels);
        CHECK(one.rms(sharp) < one.rms(plain));
    }
}

TEST_CASE("a smooth picture needs no sharpening, and a stopped job changes nothing") {
    Pictures pictures("article");
    const std::atomic<bool> stop = true;
    const ScreenImage plain = pictures.sharpened(ninth_level, 0);
    CHECK(pictures.sharpened(ninth_level, 9000, &stop).pixels == plain.pixels);
    pictures.view.camera.fov = 1e-3;
    CHECK(pictures.sharpened(ninth_level, 9000).pixels == pictures.sharpened(ninth_level, 0).pixels);
    CHECK(pictures.taken.camera == 0);
}

}  // namespace strahl::sharpening

// Sound without a device: OpenAL's null driver, which plays as fast as a device does.
#include "show/window/sound.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <vector>

#include "tests/unit/scratch.h"

namespace strahl {
namespace {

using Clock = std::chrono::steady_clock;

// Six seconds, in which a tone begins every half second.
const std::string clicks = STRAHL_SOURCE "/tests/window/clicks.ogg";

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }
void rest(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

void load(const Sound& sound) {
    for (const double end = now() + 10; sound.loading() && now() < end;) rest(.001);
    REQUIRE(!sound.loading());
}

/// Returns by how many seconds the moment heard is ahead of a clock that started with it, every 2 ms.
std::vector<double> leads(const Sound& sound, double from, double begin, double seconds) {
    std::vector<double> all;
    for (; now() < begin + seconds; rest(.002))
        if (const auto heard = sound.heard()) all.push_back(*heard - from - (now() - begin));
    return all;
}
/// Their median, since a busy machine delays some of them.
double middle(std::vector<double> values) {
    const auto at = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

TEST_CASE("the moment heard follows the clock, from where playing starts") {
    ::setenv("ALSOFT_DRIVERS", "null", 1);
    Sound sound(clicks, [] {});
    load(sound);
    REQUIRE(sound.fault() == "");
    CHECK(!sound.heard());
    for (const double from : {0., 2.5}) {
        sound.play(from);
        const double begin = now();
        // Mixed sound goes to the device in pieces of about 20 ms.
        const std::vector<double> first = leads(sound, from, begin, .5), second = leads(sound, from, begin, 1);
        REQUIRE(first.size() > 50);
        REQUIRE(second.size() > 50);
        CHECK(std::abs(middle(second) - middle(first)) < .01);
        CHECK(std::abs(middle(second)) < .1);  // the latency of the device
    }
    sound.pause();
    CHECK(!sound.heard());
    sound.play(5.8);
    CHECK(sound.heard());
    rest(.5);
    CHECK(!sound.heard());
    for (const double beyond : {6., 1e9, -1., double(NAN)}) {
        sound.play(beyond);
        CHECK(!sound.heard());
    }
}

TEST_CASE("a file that is not a sound, or only begins as one, is reported and makes no noise") {
    const Scratch folder;
    const std::string whole = bytes_of(clicks);
    const auto fault_of = [&](const std::string& bytes) {
        std::ofstream(folder / "a.ogg", std::ios::binary) << bytes;
        Sound sound(folder / "a.ogg", [] {});
        load(sound);
        sound.play(0);
        CHECK(bool(sound.heard()) == sound.fault().empty());
        return sound.fault();
    };
    CHECK(fault_of("no sound") == "'" + folder / "a.ogg" + "' is not an Ogg Vorbis file");
    CHECK(fault_of("") != "");
    CHECK(fault_of(whole.substr(0, 100)) != "");
    CHECK(fault_of(whole.substr(0, 4000)) != "");                  // headers alone
    CHECK(fault_of(whole.substr(0, whole.size() * 3 / 4)) == "");  // as far as it goes
    std::string torn = whole;
    for (std::size_t i = whole.size() * 3 / 4; i < whole.size(); i += 7) torn[i] = static_cast<char>(torn[i] + 1);
    fault_of(torn);
    // Destroyed while it is decoded.
    for (int i = 0; i < 5; ++i) Sound(clicks, [] {});
}

}  // namespace
}  // namespace strahl

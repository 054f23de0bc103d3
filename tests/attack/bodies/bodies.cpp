// Renders bodies with degenerate values, one after the other, and reports pixels that the referee does not explain.
//
// attack_bodies [--seconds S] [--first N]   the seeds from N on, for 5 s by default
// attack_bodies --seed N                    this one alone
// attack_bodies --seed N --write            its scene as text
#include <cstdio>

#include "tests/attack/bodies/body_check.h"
#include "tests/attack/bodies/degenerate_scene.h"
#include "tests/attack/options.h"
#include "text/write.h"

using namespace strahl;

int main(int count, char** arguments) {
    attack::Options options(count, arguments);
    const bool write = options.take("--write");
    refuse(options, "attack_bodies");
    if (write) return std::fputs(write_scene(degenerate_scene(options.number).scene).c_str(), stdout), 0;

    attack::Progress progress("attack-bodies-seed");
    std::uint64_t done = 0, faulty = 0, checked[3] = {};
    const double end = attack::now() + options.seconds;
    do {
        const std::uint64_t seed = options.number + done++;
        progress.note(seed);
        const DegenerateScene made = degenerate_scene(seed);
        const BodyFaults faults = faults_of(made.scene, made.condition);
        for (std::size_t p = 0; p < 3; ++p) checked[p] += faults.checked[p];
        const auto& [of_float, of_double, of_extended] = faults.pixels;
        if (of_float + of_double + of_extended == 0) continue;
        ++faulty;
        std::fprintf(stderr, "seed %llu: in float, double and extended %d, %d, %d pixels, by %.3g, %.3g, %.3g: %s\n",
                     static_cast<unsigned long long>(seed), of_float, of_double, of_extended, faults.worst[0],
                     faults.worst[1], faults.worst[2], made.words.c_str());
    } while (attack::now() < end && !options.alone);
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::printf("%llu scenes, %llu faults; in float %llu, in double %llu, in extended precision %llu\n", number(done),
                number(faulty), number(checked[0]), number(checked[1]), number(checked[2]));
    return faulty > 0;
}

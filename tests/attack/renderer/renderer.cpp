// Renders wild scenes, one after the other, and reports the faults that picture_check.h finds.
//
// attack_renderer [--seconds S] [--first N]   the seeds from N on, for 5 s by default
// attack_renderer --seed N                    this one alone
// attack_renderer --seed N --write            its scene as text
// attack_renderer --seed N --shrink           a scene as small as possible with the same kind of fault, as text
// While it runs, and after a crash, the file attack-renderer-seed in the working directory holds the seed.
#include <malloc.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "tests/attack/options.h"
#include "tests/attack/renderer/picture_check.h"
#include "tests/attack/renderer/shrink.h"
#include "text/write.h"

using namespace strahl;

namespace {

std::string words_of(const WildScene& wild) {
    char view[200];
    std::snprintf(view, sizeof view, "// --size %dx%d --depth %d, error %.17g, shift %.17g %.17g\n", wild.view.width,
                  wild.view.height, wild.view.depth, wild.view.error, wild.view.shift_x, wild.view.shift_y);
    return view + write_scene(wild.scene);
}

/// Reports what is wrong with the scene of a seed, and writes the scene to a file. Is anything wrong?
bool is_faulty(PictureCheck& check, std::uint64_t seed) {
    const WildScene wild = affordable(wild_scene(seed));
    const std::vector<std::string> faults = check.faults(wild);
    if (faults.empty()) return false;
    const std::string file = "seed-" + std::to_string(seed) + ".rt";
    for (const std::string& fault : faults) std::fprintf(stderr, "%s: %s\n", file.c_str(), fault.c_str());
    std::ofstream(file) << words_of(wild);
    return true;
}

/// The first fault tells the kind: the setting, and whether values differ or are not finite.
void shrink(std::uint64_t seed) {
    PictureCheck check;
    const auto kind = [&](const WildScene& wild) {
        const std::vector<std::string> faults = check.faults(wild);
        return faults.empty() ? "" : faults[0].substr(0, faults[0].find(':'));
    };
    WildScene wild = affordable(wild_scene(seed));
    const std::string first = kind(wild);
    if (first.empty()) return;
    if (first.starts_with(name(Precision::float64))) check.precisions = {Precision::float64};
    wild = shrunk(wild, [&](const WildScene& w) { return kind(w) == first; });
    std::printf("// %s\n%s", first.c_str(), words_of(wild).c_str());
}

}  // namespace

int main(int count, char** arguments) {
    attack::Options options(count, arguments);
    const bool write = options.take("--write"), smaller = options.take("--shrink");
    refuse(options, "attack_renderer");
    const std::uint64_t seed = options.number;
    if (write) return std::fputs(words_of(affordable(wild_scene(seed))).c_str(), stdout), 0;

    // Each tracer's workspaces come from what the last one left, which is faster, and shows who reads before writing.
    ::mallopt(M_MMAP_THRESHOLD, 1 << 30), ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
    if (smaller) return shrink(seed), 0;

    attack::Progress progress("attack-renderer-seed");
    PictureCheck check;
    std::uint64_t done = 0, faults = 0, slowest_seed = 0;
    double slowest = 0, now = attack::now();
    const double end = now + options.seconds;
    do {
        progress.note(seed + done);
        faults += is_faulty(check, seed + done++);
        const double before = now;
        now = attack::now();
        if (now - before > slowest) slowest = now - before, slowest_seed = seed + done - 1;
    } while (now < end && !options.alone);
    std::printf("%llu scenes, %llu faults, %.2f s the slowest, seed %llu\n", static_cast<unsigned long long>(done),
                static_cast<unsigned long long>(faults), slowest, static_cast<unsigned long long>(slowest_seed));
    return faults > 0;
}

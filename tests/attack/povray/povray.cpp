// Renders random scenes with POV-Ray as well, and reports pictures that disagree, with the reasons.
//
// attack_povray [--seconds S] [--first N]   the seeds from N on, for 5 s by default
// attack_povray --seed N                    this one alone
// attack_povray --seed N --write            its scene as text
// attack_povray --seed N --shrink           a scene as small as possible that disagrees without a reason, as text
#include <atomic>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "povref/compare/run_povray.h"
#include "povref/compare/verdict.h"
#include "tests/attack/options.h"
#include "tests/attack/povray/povray_scene.h"
#include "tests/attack/povray/reasons.h"
#include "tests/attack/renderer/shrink.h"
#include "text/write.h"

using namespace strahl;

namespace {

constexpr int width = 32, height = 24;

struct Outcome {
    Verdict verdict;
    Reasons reasons;
};
Outcome outcome_of(const Scene& scene) {
    const View view{.camera = scene.camera, .width = width, .height = height, .depth = scene.settings.max_trace_level};
    const PovRun theirs =
        run_povray(scene, {.cameras = {view.camera}, .width = width, .height = height, .depth = view.depth}, 1);
    Tracer tracer(scene, Precision::float64);
    const Verdict verdict = judge(tracer, view, render(scene, view, Precision::float64, 1), theirs.picture);
    return {verdict, verdict.beyond_off_edges ? reasons_of(scene, view, verdict, theirs.picture) : Reasons{}};
}

/// Shrinks the scene as long as the largest difference without a reason stays above a quarter of what it was.
Scene shrunk(const Scene& scene) {
    const int least = outcome_of(scene).reasons.worst / 4;
    const auto disagrees = [&](const WildScene& wild) {
        try {
            return outcome_of(wild.scene).reasons.worst > least;
        } catch (const std::exception&) {
            return false;
        }
    };
    return strahl::shrunk({scene, {.camera = scene.camera, .width = width, .height = height}}, disagrees).scene;
}

}  // namespace

int main(int count, char** arguments) {
    attack::Options options(count, arguments);
    const bool write = options.take("--write"), smaller = options.take("--shrink");
    refuse(options, "attack_povray");
    const Scene first = scene_for_povray(options.number);
    if (write || smaller) return std::fputs(write_scene(smaller ? shrunk(first) : first).c_str(), stdout), 0;

    std::mutex mutex;
    std::map<std::string, int> scenes_of;  // how many scenes have a pixel of this reason
    std::atomic<std::uint64_t> done = 0, disagree = 0, unexplained = 0;
    std::size_t pixels = 0, off = 0, on_edges = 0;
    const double end = attack::now() + options.seconds;
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    const auto work = [&] {
        do {
            const std::uint64_t seed = options.number + done++;
            const auto [verdict, reasons] = outcome_of(scene_for_povray(seed));
            const std::lock_guard lock(mutex);
            pixels += verdict.pixels, off += verdict.beyond_off_edges, on_edges += verdict.beyond_on_edges;
            if (verdict.beyond_off_edges == 0) continue;
            ++disagree;
            std::string words;
            for (const auto& [reason, count] : reasons.pixels)
                ++scenes_of[reason], words += ", " + reason + " " + std::to_string(count);
            if (reasons.unexplained)
                ++unexplained, words += ", WITHOUT A REASON " + std::to_string(reasons.unexplained) + ", worst " +
                                        std::to_string(reasons.worst);
            std::fprintf(stderr, "seed %llu: %zu pixels off edges differ by up to %d steps, at x %d, y %d%s\n",
                         number(seed), verdict.beyond_off_edges, verdict.worst_off_edges, verdict.x, verdict.y,
                         words.c_str());
        } while (attack::now() < end && !options.alone);
    };
    {
        std::vector<std::jthread> threads;  // POV-Ray sleeps most of the half second that it takes for a small picture
        for (int i = 0; i < (options.alone ? 1 : 4); ++i) threads.emplace_back(work);
    }
    std::printf(
        "%llu scenes, %llu disagree, %llu of them without a reason; of %zu pixels %zu off edges, %zu on edges\n",
        number(done), number(disagree), number(unexplained), pixels, off, on_edges);
    for (const auto& [reason, count] : scenes_of) std::printf("%5d scenes: %s\n", count, reason.c_str());
    return unexplained > 0;
}

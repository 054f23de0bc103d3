// Pictures of wild scenes: the same bit for bit at every SIMD level, with any number of threads, whole and in part; and
// finite. A difference or a value that is not finite is a fault.
//
// attack_renderer [--seconds S] [--first N]   the seeds from N on
// attack_renderer --seed N                    this one alone
// attack_renderer --seed N --write            its scene as text
// attack_renderer --seed N --shrink           a scene as small as possible with the same kind of fault, as text
// While it runs, and after a crash, the file attack-renderer-seed in the working directory holds the seed.
#include <malloc.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>

#include "tests/attack/shrink.h"
#include "tests/attack/wild_scene.h"
#include "tests/unit/levels.h"
#include "text/parse.h"
#include "text/write.h"
#include "trace/thread_pool.h"

using namespace strahl;

namespace {

using Values = std::vector<double>;

std::string words_of(const WildScene& wild) {
    char view[200];
    std::snprintf(view, sizeof view, "// --size %dx%d --depth %d, error %.17g, shift %.17g %.17g\n", wild.view.width,
                  wild.view.height, wild.view.depth, wild.view.error, wild.view.shift_x, wild.view.shift_y);
    return view + write_scene(wild.scene);
}

class Attack {
  public:
    /// What is wrong with this scene's pictures, a line each.
    std::vector<std::string> attack(const WildScene& wild);

  private:
    Values trace(Tracer& tracer, const Lattice& lattice, ThreadPool& pool);
    void attack(Precision precision);
    void look_for_strange_values(const Values& values, Precision precision, const std::string& setting);
    void compare(const Values& values, const Lattice& lattice, const Values& expected, const std::string& setting);

    ThreadPool one{1}, three{3};
#if defined(__SANITIZE_ADDRESS__)
    std::vector<Simd> levels{Simd::scalar};  // the others are not instrumented
#else
    std::vector<Simd> levels = fused_levels();
#endif
    WildScene wild;
    std::vector<std::string> faults;
};

Values Attack::trace(Tracer& tracer, const Lattice& lattice, ThreadPool& pool) {
    Values values(std::size_t(3) * lattice.columns * lattice.rows);
    tracer.trace(wild.view, lattice, pool, [&](const Tile& tile) { place(tile, lattice, values); });
    return values;
}

/// Infinity would come out as the largest number of the precision.
void Attack::look_for_strange_values(const Values& values, Precision precision, const std::string& setting) {
    const double most =
        precision == Precision::float32 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    std::size_t count = 0, first = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!(values[i] >= 0 && values[i] < most) && count++ == 0) first = i;
    if (count)
        faults.push_back(setting + ": " + std::to_string(count) + " of " + std::to_string(values.size()) +
                         " values are not finite or negative, the first in pixel " +
                         std::to_string(first / 3 % wild.view.width) + "," +
                         std::to_string(first / 3 / wild.view.width) + ": " + std::to_string(values[first]));
}

void Attack::compare(const Values& values, const Lattice& lattice, const Values& expected, const std::string& setting) {
    std::size_t count = 0;
    std::string first;
    for (int row = 0; row < lattice.rows; ++row)
        for (int column = 0; column < lattice.columns; ++column) {
            const int x = lattice.x + column * lattice.step_x, y = lattice.y + row * lattice.step_y;
            const double* const a = &values[3 * (std::size_t(row) * lattice.columns + column)];
            const double* const b = &expected[3 * (std::size_t(y) * wild.view.width + x)];
            if (std::memcmp(a, b, 3 * sizeof(double)) == 0 || count++ > 0) continue;
            char words[300];
            std::snprintf(words, sizeof words, "pixel %d,%d: %.17g %.17g %.17g against %.17g %.17g %.17g", x, y, a[0],
                          a[1], a[2], b[0], b[1], b[2]);
            first = words;
        }
    if (count)
        faults.push_back(setting + " against scalar: " + std::to_string(count) + " of " +
                         std::to_string(lattice.columns * lattice.rows) + " pixels differ, the first is " + first);
}

void Attack::attack(Precision precision) {
    const auto setting = [&](Simd simd, const char* more) {
        return name(precision) + std::string(", ") + name(simd) + more;
    };
    const View& view = wild.view;
    const Lattice whole{.columns = view.width, .rows = view.height};
    Tracer scalar(wild.scene, precision, Simd::scalar);
    const Values expected = trace(scalar, whole, one);
    look_for_strange_values(expected, precision, setting(Simd::scalar, ""));
    for (const Simd simd : levels) {
        Tracer tracer(wild.scene, precision, simd);
        if (simd != Simd::scalar) compare(trace(tracer, whole, one), whole, expected, setting(simd, ""));
        if (simd != levels.back()) continue;
        compare(trace(tracer, whole, three), whole, expected, setting(simd, ", 3 threads"));
        const int x = view.width * 2 / 7, y = view.height / 3;
        const Lattice crop{x, y, view.width - x, view.height - y};
        compare(trace(tracer, crop, one), crop, expected, setting(simd, ", a crop"));
        const Lattice pass{0, 1, (view.width + 2) / 3, (view.height + 1) / 3, 3, 3};
        compare(trace(tracer, pass, one), pass, expected, setting(simd, ", every third pixel"));
    }
    if (view.width % 8 == 0 && supported(Simd::v2)) {  // has no fused multiply-add, so differs
        Tracer tracer(wild.scene, precision, Simd::v2);
        look_for_strange_values(trace(tracer, whole, one), precision, setting(Simd::v2, ""));
    }
}

std::vector<std::string> Attack::attack(const WildScene& scene) {
    wild = scene, faults.clear();
    try {
        if (parse_scene(write_scene(wild.scene), "written") != wild.scene)
            faults.push_back("written and parsed it is another scene");
    } catch (const FileError& error) {
        return {std::string("what was written does not parse: ") + error.what()};
    }
    attack(Precision::float32);
    attack(Precision::float64);
    return std::move(faults);
}

/// Tells what is wrong with the scene of a seed, and writes it to a file. Is anything?
bool attack_seed(Attack& attack, std::uint64_t seed) {
    const WildScene wild = wild_scene(seed);
    const std::vector<std::string> faults = attack.attack(wild);
    if (faults.empty()) return false;
    const std::string file = "seed-" + std::to_string(seed) + ".rt";
    for (const std::string& fault : faults) std::fprintf(stderr, "%s: %s\n", file.c_str(), fault.c_str());
    std::ofstream(file) << words_of(wild);
    return true;
}

/// The first fault tells the kind: the setting, and whether values differ or are not finite.
void shrink(std::uint64_t seed) {
    Attack attack;
    const auto kind = [&](const WildScene& wild) {
        const std::vector<std::string> faults = attack.attack(wild);
        return faults.empty() ? "" : faults[0].substr(0, faults[0].find(':'));
    };
    const WildScene wild = wild_scene(seed);
    const std::string first = kind(wild);
    if (!first.empty())
        std::printf("// %s\n%s", first.c_str(),
                    words_of(shrunk(wild, [&](const WildScene& w) { return kind(w) == first; })).c_str());
}

}  // namespace

int main(int count, char** arguments) {
    double seconds = std::numeric_limits<double>::infinity();
    std::uint64_t seed = 1;
    bool write = false, smaller = false, alone = false;
    for (int i = 1; i < count; ++i) {
        const std::string option = arguments[i];
        if (option == "--write")
            write = true;
        else if (option == "--shrink")
            smaller = true;
        else if (option == "--seconds" && i + 1 < count)
            seconds = std::stod(arguments[++i]);
        else if ((option == "--first" || option == "--seed") && i + 1 < count)
            seed = std::stoull(arguments[++i]), alone = option == "--seed";
        else
            return std::fprintf(stderr, "attack_renderer: what is '%s'?\n", arguments[i]), 2;
    }
    if (write) return std::fputs(words_of(wild_scene(seed)).c_str(), stdout), 0;

    // Each tracer's workspaces come from what the last one left, which is faster, and shows who reads before writing.
    ::mallopt(M_MMAP_THRESHOLD, 1 << 30), ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
    if (smaller) return shrink(seed), 0;

    std::FILE* const progress = std::fopen("attack-renderer-seed", "w");
    if (!progress) return std::perror("attack-renderer-seed"), 1;
    const auto start = std::chrono::steady_clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
    Attack attack;
    std::uint64_t done = 0, faults = 0;
    double slowest = 0, now = 0;
    do {
        std::rewind(progress);
        std::fprintf(progress, "%llu\n", static_cast<unsigned long long>(seed + done));
        std::fflush(progress);
        faults += attack_seed(attack, seed + done++);
        const double before = now;
        now = passed();
        slowest = std::max(slowest, now - before);
    } while (now < seconds && !alone);
    std::fclose(progress);
    std::remove("attack-renderer-seed");
    std::printf("%llu scenes, %llu faults, %.2f s the slowest\n", static_cast<unsigned long long>(done),
                static_cast<unsigned long long>(faults), slowest);
    return faults > 0;
}

// Pictures of wild scenes: the same bit for bit at every SIMD level, with any number of threads, whole and in part; and
// finite. A difference or a value that is not finite is a fault.
//
// attack_renderer [--seconds S] [--first N]   the seeds from N on
// attack_renderer --seed N [--write]          this one alone; or its scene as text
// While it runs, and after a crash, the file attack-renderer-seed in the working directory holds the seed.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>

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
    /// Counts what is wrong with this scene's pictures, and tells it.
    void attack(std::uint64_t seed);
    std::uint64_t faults = 0;

  private:
    Values trace(Tracer& tracer, const Lattice& lattice, ThreadPool& pool);
    void attack(Precision precision);
    void look_for_strange_values(const Values& values, Precision precision, const std::string& setting);
    void compare(const Values& values, const Lattice& lattice, const Values& expected, const std::string& setting);
    void fault(const std::string& words);

    ThreadPool one{1}, three{3};
    std::vector<Simd> levels = fused_levels();
    std::uint64_t seed = 0;
    WildScene wild;
    bool told = false;  // of this scene
};

void Attack::fault(const std::string& words) {
    const std::string file = "seed-" + std::to_string(seed) + ".rt";
    std::fprintf(stderr, "%s: %s\n", file.c_str(), words.c_str());
    if (!told) ++faults, std::ofstream(file) << words_of(wild);
    told = true;
}

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
        fault(setting + ": " + std::to_string(count) + " of " + std::to_string(values.size()) +
              " values are not finite or negative, the first in pixel " + std::to_string(first / 3 % wild.view.width) +
              "," + std::to_string(first / 3 / wild.view.width) + ": " + std::to_string(values[first]));
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
        fault(setting + " against scalar: " + std::to_string(count) + " of " +
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
        // Neither from tile to tile nor at the lanes of the whole.
        const int x = static_cast<int>(seed % view.width), y = static_cast<int>(seed % view.height);
        const Lattice crop{x, y, view.width - x, view.height - y};
        compare(trace(tracer, crop, one), crop, expected, setting(simd, ", a crop"));
        const Lattice pass{x % 3, y % 3, (view.width - x % 3 + 2) / 3, (view.height - y % 3 + 2) / 3, 3, 3};
        compare(trace(tracer, pass, one), pass, expected, setting(simd, ", every third pixel"));
    }
    if (seed % 8 == 0 && supported(Simd::v2)) {  // has no fused multiply-add, so differs
        Tracer tracer(wild.scene, precision, Simd::v2);
        look_for_strange_values(trace(tracer, whole, one), precision, setting(Simd::v2, ""));
    }
}

void Attack::attack(std::uint64_t number) {
    seed = number, told = false;
    wild = wild_scene(seed);
    try {
        if (parse_scene(write_scene(wild.scene), "written") != wild.scene)
            fault("written and parsed it is another scene");
    } catch (const FileError& error) {
        return fault(std::string("what was written does not parse: ") + error.what());
    }
    attack(Precision::float32);
    attack(Precision::float64);
}

}  // namespace

int main(int count, char** arguments) {
    double seconds = std::numeric_limits<double>::infinity();
    std::uint64_t seed = 1;
    bool write = false, alone = false;
    for (int i = 1; i < count; ++i) {
        const std::string option = arguments[i];
        if (option == "--write")
            write = true;
        else if (option == "--seconds" && i + 1 < count)
            seconds = std::stod(arguments[++i]);
        else if ((option == "--first" || option == "--seed") && i + 1 < count)
            seed = std::stoull(arguments[++i]), alone = option == "--seed";
        else
            return std::fprintf(stderr, "attack_renderer: what is '%s'?\n", arguments[i]), 2;
    }
    if (write) return std::fputs(words_of(wild_scene(seed)).c_str(), stdout), 0;

    std::FILE* const progress = std::fopen("attack-renderer-seed", "w");
    if (!progress) return std::perror("attack-renderer-seed"), 1;
    const auto start = std::chrono::steady_clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
    Attack attack;
    std::uint64_t done = 0;
    double slowest = 0, now = 0;
    do {
        std::rewind(progress);
        std::fprintf(progress, "%llu\n", static_cast<unsigned long long>(seed + done));
        std::fflush(progress);
        attack.attack(seed + done++);
        const double before = now;
        now = passed();
        slowest = std::max(slowest, now - before);
    } while (now < seconds && !alone);
    std::fclose(progress);
    std::remove("attack-renderer-seed");
    std::printf("%llu scenes, %llu faults, %.2f s the slowest\n", static_cast<unsigned long long>(done),
                static_cast<unsigned long long>(attack.faults), slowest);
    return attack.faults > 0;
}

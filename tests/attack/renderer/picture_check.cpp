// Traces a scene in every setting and compares.
#include "tests/attack/renderer/picture_check.h"

#include <cstdio>
#include <cstring>
#include <limits>

#include "tests/referee/random_pattern.h"
#include "text/parse.h"
#include "text/write.h"
#include "trace/world/light_bound.h"

namespace strahl {

WildScene affordable(WildScene wild) {
    constexpr int most = 10000, step = 4;
    View& view = wild.view;
    const Lattice few{0, 0, (view.width + step - 1) / step, (view.height + step - 1) / step, step, step};
    ThreadPool one(1);
    Tracer tracer(wild.scene, Precision::float32, Simd::scalar);
    const Counts counts = tracer.trace({view, one, [](const Tile&) {}}, few);
    const double rays = static_cast<double>(counts.total()) / few.columns / few.rows;
    while (view.width * view.height * rays > most && view.width > 5)
        view.width = (view.width + 1) / 2, view.height = (view.height + 1) / 2;
    return wild;
}

PictureCheck::Values PictureCheck::trace(Tracer& tracer, const Lattice& lattice, ThreadPool& pool) {
    return values_of(tracer, wild.view, lattice, pool);
}

/// Checks that no value is brighter than light in this scene can be, up to rounding. Where that is more than the
/// precision can hold, infinity is written as its largest number. The value in double is no bound for the one in float,
/// where a ray may pass one glass body more, or miss a shadow.
void PictureCheck::look_for_strange_values(const Values& values, Precision precision, const std::string& setting) {
    const double most =
        precision == Precision::float32 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    const double bound = 1.001 * bound_for(wild.scene, wild.view.depth).brightest.back();
    const double limit =
        bound < most || precision == Precision::float32 ? std::min(bound, most) : std::nextafter(most, 0);
    std::size_t count = 0, first = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!(values[i] >= 0 && values[i] <= limit) && count++ == 0) first = i;
    if (count)
        found.push_back(setting + ": " + std::to_string(count) + " of " + std::to_string(values.size()) +
                        " values are not finite, negative or too bright, the first in pixel " +
                        std::to_string(first / 3 % wild.view.width) + "," +
                        std::to_string(first / 3 / wild.view.width) + ": " + std::to_string(values[first]));
}

void PictureCheck::compare(const Values& values, const Lattice& lattice, const Values& expected,
                           const std::string& setting) {
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
        found.push_back(setting + " against scalar: " + std::to_string(count) + " of " +
                        std::to_string(lattice.columns * lattice.rows) + " pixels differ, the first is " + first);
}

void PictureCheck::check(Precision precision) {
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

std::vector<std::string> PictureCheck::faults(const WildScene& scene) {
    wild = scene, found.clear();
    try {
        if (parse_scene(write_scene(wild.scene), "written", {}, made_up_pixels) != wild.scene)
            found.push_back("written and parsed it is another scene");
    } catch (const FileError& error) {
        return {std::string("what was written does not parse: ") + error.what()};
    }
    for (const Precision precision : precisions) check(precision);
    return std::move(found);
}

}  // namespace strahl

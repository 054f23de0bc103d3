#include "tests/attack/bodies/body_check.h"

#include <algorithm>
#include <cmath>

#include "tests/referee/referee.h"

namespace strahl {
namespace {

struct BodyLimits {
    Precision precision;
    double unit, tolerance, reach;  // of coordinates; of values; of points of the picture, in pixels
};
// The numbers of bodies in extended precision come from double.
constexpr BodyLimits limits[]{{Precision::float32, 0x1p-24, 4e-3, .05},
                              {Precision::float64, 0x1p-53, 1e-7, 1e-5},
                              {Precision::extended, 0x1p-53, 1e-9, 1e-7}};

}  // namespace

BodyFaults faults_of(const Scene& scene, double condition) {
    BodyFaults faults;
    const View view{.camera = scene.camera, .width = body_columns, .height = body_rows, .depth = body_depth};
    const Referee<long double> referee(scene, scene.camera, body_columns, body_rows, body_depth);
    const Referee<Quadruple> exact(scene, scene.camera, body_columns, body_rows, body_depth);
    std::vector<Sample> right;
    for (int j = 0; j < body_rows; ++j)
        for (int i = 0; i < body_columns; ++i) right.push_back(referee.at(i + .5, j + .5));
    for (std::size_t p = 0; p < 3; ++p) {
        const double lost = limits[p].unit * condition;
        if (lost > 3e-4) continue;
        faults.checked[p] = true;
        const Precision precision = limits[p].precision;
        const double tolerance = limits[p].tolerance + 100 * lost, reach = limits[p].reach + 1000 * lost;
        const Frame frame = render(scene, view, precision, 1);
        for (int k = 0; k < body_columns * body_rows; ++k) {
            const double* const rgb = &frame.rgb[3 * static_cast<std::size_t>(k)];
            double off = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const double apart = std::abs(rgb[c] - static_cast<double>(right[static_cast<std::size_t>(k)].rgb[c]));
                off = std::max(off, std::isnan(apart) ? HUGE_VAL : apart);
            }
            const int i = k % body_columns, j = k / body_columns;
            if (off <= tolerance || referee.explains(i, j, rgb, tolerance, reach) ||
                exact.explains(i, j, rgb, tolerance, reach))
                continue;
            ++faults.pixels[p];
            faults.worst[p] = std::max(faults.worst[p], off);
        }
    }
    return faults;
}

}  // namespace strahl

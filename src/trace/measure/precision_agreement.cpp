#include "trace/measure/precision_agreement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strahl {

Agreements::Agreements(const Scene& scene, int threads, std::function<int(double)> code_function)
    : code(std::move(code_function)),
      tracers{Tracer(scene, Precision::float32), Tracer(scene, Precision::float64), Tracer(scene, Precision::extended)},
      pool(threads),
      alone(1) {}

bool Agreements::same(const double* a, const double* b) const {
    for (int c = 0; c < 3; ++c)
        if (code(a[c]) != code(b[c]) && !(std::abs(a[c] - b[c]) <= rounding_tie)) return false;
    return true;
}

std::vector<Agreement> Agreements::of(const View& view, const Lattice& lattice, std::vector<double>* shown,
                                      const std::atomic<bool>* stop) {
    ThreadPool& threads = lattice.columns * lattice.rows > 1 ? pool : alone;
    std::array<std::vector<double>, 3> rgb;
    for (std::size_t i = 0; i < 3; ++i) rgb[i] = values_of(tracers[i], view, lattice, threads, {.grid = 1}, stop);
    std::vector<Agreement> map;
    if (stop && *stop) return map;
    for (std::size_t i = 0; i < rgb[0].size(); i += 3)
        map.push_back(!same(&rgb[1][i], &rgb[2][i])   ? Agreement::not_float64
                      : !same(&rgb[0][i], &rgb[2][i]) ? Agreement::not_float32
                                                      : Agreement::all);
    if (shown) *shown = std::move(rgb[1]);
    return map;
}

}  // namespace strahl

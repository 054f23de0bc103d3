// Checks one scene's pictures: they must be finite, and the same bit for bit at every SIMD level, with any number
// of threads, whole and in part.
#pragma once
#include <string>
#include <vector>

#include "num/thread_pool.h"
#include "tests/attack/renderer/wild_scene.h"
#include "tests/unit/levels.h"
#include "tests/unit/sanitized.h"

namespace strahl {

/// The scene, seen in a smaller picture where one as large would take very many rays. It is traced a dozen times, and
/// without this half of the time would go to one scene in a hundred. The same at every SIMD level.
WildScene affordable(WildScene wild);

class PictureCheck {
  public:
    /// Returns the faults of this scene's pictures, a line each, which starts with the setting.
    std::vector<std::string> faults(const WildScene& scene);

    // In the sanitize build of tests/run only the kernels of long double are instrumented.
    std::vector<Precision> precisions = sanitized()
                                            ? std::vector{Precision::extended, Precision::float64, Precision::float32}
                                            : std::vector{Precision::float64, Precision::float32};

  private:
    using Values = std::vector<double>;
    Values trace(Tracer& tracer, const Lattice& lattice, ThreadPool& pool);
    void check(Precision precision);
    void look_for_strange_values(const Values& values, Precision precision, const std::string& setting);
    void compare(const Values& values, const Lattice& lattice, const Values& expected, const std::string& setting);

    ThreadPool one{1}, three{3};
    // In a sanitize build only the scalar level is instrumented.
    std::vector<Simd> levels = sanitized() ? std::vector{Simd::scalar} : fused_levels();
    WildScene wild;
    std::vector<std::string> found;
};

}  // namespace strahl

// Where a picture depends on the precision it is traced in.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "num/thread_pool.h"
#include "trace/tracer.h"

namespace strahl {

/// Values no farther apart than this agree whatever their codes are: a background of .7 is 178.5 steps of an 8-bit
/// file, and which way that is rounded says nothing about how a picture was traced. A 257th of such a step.
inline constexpr double rounding_tie = 1. / 65535;

/// Of a pixel: traced in float, double and long double, its codes are the same, or differ by a rounding tie; or float's
/// differ from long double's; or even double's do.
enum class Agreement { all, not_float32, not_float64 };

/// A scene in all three precisions.
class Agreements {
  public:
    /// `code` makes of a value what the file or screen holds.
    Agreements(const Scene& scene, int threads, std::function<int(double)> code);

    /// Every pixel of the lattice (steps of 1), row by row. If `shown` is given it gets the values in double. Nothing
    /// if `stop` became true.
    std::vector<Agreement> of(const View& view, const Lattice& lattice, std::vector<double>* shown = nullptr,
                              const std::atomic<bool>* stop = nullptr);

  private:
    bool same(const double* a, const double* b) const;

    std::function<int(double)> code;
    std::array<Tracer, 3> tracers;
    ThreadPool pool, alone;  // the second for single pixels
};

}  // namespace strahl

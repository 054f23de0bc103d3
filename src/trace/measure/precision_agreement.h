// Finds the pixels of a picture that depend on the precision it is traced in.
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

/// The agreement of the codes of a pixel that is traced in float, double and long double: all are the same or differ by
/// a rounding tie; or float's differ from long double's; or even double's do.
enum class Agreement { all, not_float32, not_float64 };

/// Traces a scene in all three precisions.
class Agreements {
  public:
    /// `code` converts a value to the number that the file or screen holds.
    Agreements(const Scene& scene, int threads, std::function<int(double)> code);

    /// Traces a lattice with steps of 1. Returns the agreement of every pixel, row by row, or nothing if `stop` became
    /// true. If `shown` is given it gets the values in double.
    std::vector<Agreement> of(const View& view, const Lattice& lattice, std::vector<double>* shown = nullptr,
                              const std::atomic<bool>* stop = nullptr);

  private:
    bool same(const double* a, const double* b) const;

    std::function<int(double)> code;
    std::array<Tracer, 3> tracers;
    ThreadPool pool, alone;  // the second for single pixels
};

}  // namespace strahl

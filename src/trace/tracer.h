// The tracer: a scene made ready for one precision, and pictures of it, traced by all threads.
#pragma once
#include <atomic>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "scene/scene.h"
#include "trace/cells/filled_lattice.h"
#include "trace/cells/pixel_sampling.h"
#include "trace/kernel/ray_counts.h"
#include "trace/world/view.h"

namespace strahl {

class ThreadPool;
class CellPicture;

enum class Precision { float32, float64, extended };
/// Instruction sets of the lanes: levels of x86-64, or NEON of aarch64; scalar is one lane without SIMD.
enum class Simd { automatic, scalar, v2, v3, v4, neon };

const char* name(Precision precision);  // "float", "double", "extended"
const char* name(Simd simd);            // "scalar", "x86-64-v2", ...
/// Returns the best level that this processor and this build have.
Simd best_simd();
/// Does this program have its kernels, and can this processor run them?
bool supported(Simd simd);
/// Returns whether this program has the code of a level; this processor may lack its instructions.
bool built(Simd simd);
/// Does this program have the kernels that View::prove needs?
bool proves();
/// Does this program have a kernel that any processor of this kind can run, and not only the scalar one?
bool for_other_processors();
/// Returns the number of lanes of a pack; 1 for scalar and for extended precision.
int lanes(Precision precision, Simd simd);

/// Throws FileError if the scene has more surfaces than numbers of this precision can tell apart: 2^24 in float. A
/// tracer does so too when it prepares such a scene.
void check_capacity(const Scene& scene, Precision precision);

/// A region, which is a lattice with steps of 1, with more than one ray in a pixel. Values are in double, in every
/// precision.
struct SampledRegion {
    Lattice region;
    Sampling sampling;
};
/// Refines a picture of the view until no unfinished cell is larger than `finest` pixels, or with 0 until all are
/// finished. A picture whose job was stopped cannot be refined further.
struct CellPass {
    CellPicture& picture;
    int finest;
};
/// Places with one ray each, many at once. Their values go to `rgb`, 3 for each; they stay as they were where the job
/// was stopped before.
struct PointList {
    std::span<const PicturePoint> points;
    std::variant<float*, double*> rgb;
    double side = 0;  // see FilledLattice
};
/// The pixels that a tracer can be asked for: a lattice or a list with one ray in each pixel, or one of the above.
using TracedPixels = std::variant<Lattice, std::span<const Pixel>, FilledLattice, SampledRegion, CellPass, PointList>;

class AnyTracer;

/// A scene made ready. Pictures depend on the scene, view, precision and (x86-64-v2 and extended apart) nothing else:
/// not on lanes, threads, tiles, crops, or the views traced before.
class Tracer {
  public:
    Tracer(Scene scene, Precision precision, Simd simd = Simd::automatic);
    ~Tracer();
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;

    /// Builds the world for this view if it is not there yet: cameras near the scene share it, and if nothing moves all
    /// times do. `trace` does so as well; call this before if scene() has to be that of the view.
    void prepare(const View& view, ThreadPool& pool);

    /// Traces the pixels and returns the rays that it took. Not to be called from two threads at once.
    Counts trace(const Job& job, const TracedPixels& pixels);

    /// Returns the scene at the time of the last view, with unions split (split_unions.h). At time 0 motions may be as
    /// declared.
    const Scene& scene() const;
    /// Returns the scene with its motions as declared.
    const Scene& declared() const;
    Precision precision() const;
    Simd simd() const;

  private:
    std::unique_ptr<AnyTracer> own;
};

/// Traces a lattice, in which other samplings than one ray in each pixel need steps of 1. Returns 3 values for each
/// pixel, row by row; they are 0 where nothing was traced before `stop` became true.
std::vector<double> values_of(Tracer& tracer, const View& view, const Lattice& lattice, ThreadPool& pool,
                              const Sampling& sampling = {.grid = 1}, const std::atomic<bool>* stop = nullptr);

/// A whole picture in double.
struct Frame {
    int width = 0, height = 0;
    std::vector<double> rgb;  // 3 * width * height, row by row from the top
    bool operator==(const Frame&) const = default;
};

/// Traces the whole view.
Frame render(const Scene& scene, const View& view, Precision precision = Precision::float64, int threads = 0,
             Simd simd = Simd::automatic);

}  // namespace strahl

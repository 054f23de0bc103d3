// The tracer: a scene made ready for one precision, and pictures of it, traced by all threads.
#pragma once
#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "scene/scene.h"
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
/// The best level this processor and this build have.
Simd best_simd();
/// Can this processor run it?
bool supported(Simd simd);
/// Does this program have a kernel that any processor of this kind can run, and not only the scalar one?
bool for_other_processors();
/// Lanes of a pack (1 for scalar and for extended precision).
int lanes(Precision precision, Simd simd);

/// Throws FileError if the scene has more surfaces than numbers of this precision can tell apart: 2^24 in float. So
/// does a tracer when it prepares such a scene.
void check_capacity(const Scene& scene, Precision precision);

/// A scene made ready. Pictures depend on the scene, view, precision and (x86-64-v2 and extended apart) nothing else:
/// not on lanes, threads, tiles, crops, or the views traced before.
class Tracer {
  public:
    Tracer(Scene scene, Precision precision, Simd simd = Simd::automatic);
    ~Tracer();
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;

    /// Builds what tracing for this view needs, if it is not there yet: cameras near the scene share it, and where
    /// nothing moves all times do. Otherwise `trace` does.
    void prepare(const View& view, ThreadPool& pool);

    /// Traces the lattice on all threads of the pool and returns when it is done or `stop` became true; tiles that
    /// were handed to the sink are whole in both cases. Not to be called from two threads at once.
    Counts trace(const View& view, const Lattice& lattice, ThreadPool& pool, const Sink& sink,
                 const std::atomic<bool>* stop = nullptr);

    /// The same of single pixels, each of them a tile.
    Counts trace(const View& view, std::span<const Pixel> pixels, ThreadPool& pool, const Sink& sink,
                 const std::atomic<bool>* stop = nullptr);

    /// The same with rays only where the picture is not smooth; what lies between is interpolated (lattice_cells.h).
    /// Pixels that are filled are off by half of `contrast`, in linear values, and few by more: not a bound. Worlds of
    /// very many bodies are traced as they are. A crop must begin at multiples of 8 pixels of the lattice.
    Counts trace_filled(const View& view, const Lattice& lattice, double contrast, ThreadPool& pool, const Sink& sink,
                        const std::atomic<bool>* stop = nullptr);

    /// The same with more than one ray in a pixel: of a region, a lattice with steps of 1. Values are in double, in
    /// every precision.
    Counts trace(const View& view, const Sampling& sampling, const Lattice& region, ThreadPool& pool, const Sink& sink,
                 const std::atomic<bool>* stop = nullptr);

    /// Refines a picture of this view until no unfinished cell is larger than `finest` pixels, or with 0 until all are
    /// finished. If it was stopped the picture can't go on.
    Counts trace(const View& view, CellPicture& picture, int finest, ThreadPool& pool, const Sink& sink,
                 const std::atomic<bool>* stop = nullptr);

    /// As it is at the time of the last view, with unions split (split_unions.h); at time 0 motions may be as declared.
    const Scene& scene() const;
    Precision precision() const;
    Simd simd() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
};

/// A whole picture in double.
struct Frame {
    int width = 0, height = 0;
    std::vector<double> rgb;  // 3 * width * height, row by row from the top
    bool operator==(const Frame&) const = default;
};

/// The plain way: the whole view as a frame.
Frame render(const Scene& scene, const View& view, Precision precision = Precision::float64, int threads = 0,
             Simd simd = Simd::automatic);

}  // namespace strahl

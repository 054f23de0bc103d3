// Pictures of one scene: traced, encoded meanwhile, and written.
#pragma once
#include <string>

#include "image/picture.h"
#include "image/picture_writer.h"
#include "main/interrupt.h"
#include "main/render_options.h"
#include "main/stats.h"
#include "main/stopwatch.h"
#include "scene/motion.h"
#include "trace/accuracy.h"
#include "trace/thread_pool.h"

namespace strahl {

/// A moment of the scene.
struct Shot {
    Camera camera;
    double time;
};
inline Shot shot_of(const Scene& scene, std::optional<double> time) {
    return {camera_at(scene, time), time.value_or(0)};
}

class Renderer {
  public:
    /// `first` is the moment by which precision and pruning are chosen; `part` is the part of the picture that is
    /// traced. Times and rays are added to `sums`.
    Renderer(const RenderOptions& options, Scene scene, const Shot& first, const Lattice& part, FileFormat format,
             Stats& sums);

    const Scene& scene() const { return tracer.scene(); }
    bool interrupted() const { return *interrupt.flag(); }

    /// Traces and writes one picture. If interrupted, writes the finished part to a file of its own and returns
    /// false.
    bool render(const Shot& shot, const std::string& path, const std::string& ending, const std::string& label);

  private:
    Accuracy choose(const Scene& scene, const Shot& shot);
    View view(const Shot& shot, int depth, double dropped) const;
    std::uint64_t pixels() const { return std::uint64_t(part.columns) * part.rows; }
    std::uint64_t trace(const Shot& shot, PictureWriter& writer, const std::string& label);

    const RenderOptions& options;
    const FileFormat format;
    const Lattice part;
    Stats& stats;
    Stopwatch watch;
    ThreadPool pool;
    const Accuracy accuracy;
    Tracer tracer;
    Interrupt interrupt;
};

}  // namespace strahl

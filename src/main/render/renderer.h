// Pictures of one scene: traced, encoded meanwhile, and written.
#pragma once
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/os/interrupt.h"
#include "image/picture.h"
#include "image/picture_writer.h"
#include "main/process/stopwatch.h"
#include "main/render/checkpoint.h"
#include "main/render/layer_names.h"
#include "main/render/proof.h"
#include "main/render/render_options.h"
#include "main/render/stats.h"
#include "num/thread_pool.h"
#include "scene/moving_scene.h"
#include "trace/measure/picture_accuracy.h"

namespace strahl {

inline Shot shot_of(const Scene& scene, std::optional<double> time) {
    return {camera_at(scene, time), time.value_or(0)};
}

/// The destination of a picture: a file, or a stream, for which there are no checkpoints.
struct Destination {
    std::string path, ending;
    Encoder::Append stream;
};

class Renderer {
  public:
    /// `scene_hash` identifies the text and the pictures. Precision and pruning are chosen for the moment `first`;
    /// `part` is the part of the picture that is traced, with these layers. Times and rays are added to `sums`.
    Renderer(const RenderOptions& options, Scene scene, std::string scene_hash, const Shot& first, const Lattice& part,
             FileFormat format, NamedLayers layers, Stats& sums);

    const Scene& scene() const { return tracer.scene(); }
    /// Goes on with another scene, whose precision and pruning stay those of the first.
    void replace(Scene scene, NamedLayers own) {
        tracer = Tracer(std::move(scene), accuracy.precision, options.simd);
        named = std::move(own);
    }
    bool interrupted() const { return *interrupt.flag(); }
    /// Becomes true when the user interrupts the program.
    const std::atomic<bool>* interrupt_flag() const { return interrupt.flag(); }

    /// Traces and writes one picture, or the bands of a share. If interrupted, saves the finished part to a file of its
    /// own (but not of a stream) and returns false.
    bool render(const Shot& shot, const Destination& destination, const std::string& label,
                std::optional<Share> share = {});

  private:
    Accuracy choose(const Scene& scene, const Shot& shot);
    View view(const Shot& shot, int depth, double dropped) const;
    std::shared_ptr<const std::vector<Shot>> moments(const Shot& shot) const;
    BandHeader header(const Shot& shot, const PictureWriter& writer, const std::string& ending, Share share) const;
    std::vector<Lattice> missing(const PictureWriter& writer, Share share) const;
    std::uint64_t trace(const Shot& shot, const std::vector<Lattice>& regions, std::uint64_t all, PictureWriter& writer,
                        Checkpoint& checkpoint, const std::string& label);
    void prove_again(const Shot& shot, PictureWriter& writer, const std::string& label);
    void tell_interrupted(const std::string& done, const std::string& path, bool shared, PictureWriter& writer,
                          Checkpoint& checkpoint);

    const RenderOptions& options;
    const std::string scene_hash;
    const FileFormat format;
    NamedLayers named;
    const Lattice part;
    Stats& stats;
    Stopwatch watch;
    ThreadPool pool;
    const Accuracy accuracy;
    Tracer tracer;
    os::Interrupt interrupt;
    std::optional<Proof> proof;
};

}  // namespace strahl

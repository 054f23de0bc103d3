// Stills: pictures in full quality, rendered in the background.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/transfer.h"
#include "show/work/worker.h"
#include "trace/tracer.h"

namespace strahl {

struct Still {
    std::shared_ptr<const Scene> scene;
    View view;
    std::string name;  // of the file, without ending; "-2", "-3", ... is added if that exists
    std::string ending = ".bmp";
    Exposure exposure{};
};

/// A queue of stills. They are traced in double on all threads, at low priority: they take the processor time that the
/// window leaves.
class Stills {
  public:
    /// `notify` is called from another thread when a still is finished or its progress has visibly changed.
    Stills(int threads, std::function<void()> notify) : threads(threads), worker(std::move(notify)) {}

    void add(Still still);
    /// Number of stills that are not written yet.
    int pending() const { return static_cast<int>(worker.unfinished()); }
    /// The share of the current still that is done, 0 to 1.
    double progress() const { return share; }
    /// Stops at once. Returns the names of the stills that were not written.
    std::vector<std::string> drop();

    /// The results since the last call: the file written, or the reason why not.
    struct Outcome {
        std::string path, fault;
    };
    std::vector<Outcome> outcomes();

  private:
    /// Renders and writes a still. Returns nothing if it was stopped.
    std::optional<Outcome> make(const Still& still, const std::atomic<bool>& stop);

    const int threads;
    std::vector<std::string> names;  // of all that were asked for
    std::atomic<double> share = 0;
    Worker<Outcome> worker;
};

/// Creates an empty file `name` with this ending, or `name`-2, ... if that exists. The caller fills it. Throws
/// FileError.
std::string reserve_file(const std::string& name, const std::string& ending);

/// Returns a name made of the scene's, the current time and the moment of the flight, if given:
/// "article-20260131-235959", "article-20260131-235959-at-1.5s".
std::string still_name(const std::string& scene_path, std::optional<double> moment);

/// Returns the reason why no file can be created in this folder, the current one if it is empty; or "".
std::string folder_fault(const std::string& folder);

}  // namespace strahl

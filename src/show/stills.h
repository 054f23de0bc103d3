// Stills of full quality, traced in the background while the flight goes on.
#pragma once
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "trace/tracer.h"

namespace strahl {

struct Still {
    std::shared_ptr<const Scene> scene;
    View view;
    std::string name;  // of the file, without ending; "-2", "-3", ... is added where there is one already
};

/// A queue of stills. They are traced in double precision on all threads, but with low priority: they take the
/// processor time that the window leaves.
class Stills {
  public:
    /// `news` is called from another thread when there is something to hear or the progress has changed visibly.
    Stills(int threads, std::function<void()> news);
    /// Drops what is not finished.
    ~Stills();

    void add(Still still);
    /// How many are not written yet.
    int pending() const;
    /// Of the one that is being traced.
    double progress() const { return share; }
    /// Ends at once; the names of those that were not written.
    std::vector<std::string> drop();

    /// What happened since the last call: a file written, or why it could not be.
    struct Outcome {
        std::string path, fault;
    };
    std::vector<Outcome> outcomes();

  private:
    void loop(std::stop_token quit, int threads);
    /// Empty if it was stopped.
    Outcome make(const Still& still, class ThreadPool& pool);

    mutable std::mutex mutex;
    std::condition_variable_any wake;
    std::deque<Still> queue;  // the front one is in work
    std::vector<Outcome> finished;
    std::atomic<double> share = 0;
    std::atomic<bool> stop = false;
    const std::function<void()> news;
    std::jthread thread;
};

/// Makes a new, empty file `name`.bmp, or `name`-2.bmp, ... if that is there already; it is the caller's to fill.
/// Throws FileError.
std::string reserve_file(const std::string& name, const std::string& ending);

/// "article-20260131-235959" for a scene file and this moment.
std::string still_name(const std::string& scene_path);

}  // namespace strahl

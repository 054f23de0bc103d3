// The thread that traces for the window: the newest view wins, coarse at first, then sharper.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "show/image.h"
#include "show/resolution.h"
#include "trace/thread_pool.h"
#include "trace/tracer.h"

namespace strahl {

/// What the window wants to see.
struct Order {
    std::uint64_t number = 0;  // of the picture: the same number, the same scene and view
    std::shared_ptr<const Scene> scene;
    View view;
    bool moving = false;        // then the picture is not refined: the next one comes soon
    double budget = 0.01;       // seconds for the first, coarse picture
    int finest = finest_level;  // of the first picture, while moving
};

/// How far the picture on show is.
struct Refinement {
    std::uint64_t number = 0;  // of the order; 0 before the first
    int width = 0, height = 0;
    int level = 0;       // the finest that is complete
    double share = 0;    // of the pixels that are traced
    double seconds = 0;  // spent on tracing them
    Counts rays;
    bool finished() const { return number > 0 && level == finest_level; }
};

/// What of the picture on show is new: rows of an image that stands for `width` x `height` pixels.
struct Fresh {
    const Image& image;
    Steps steps;  // of the level that the image is; 1 for the whole picture
    int width, height;
    int first_row, rows;
};

class TraceThread {
  public:
    /// `news` is called from other threads when there is something to take; once, until it is taken.
    TraceThread(int threads, std::function<void()> news);
    ~TraceThread();

    /// Replaces what was wanted before. Never waits for the tracing.
    void want(Order order);

    /// Hands what is new since the last call to `upload` and returns how far it is; nothing if nothing is new. `upload`
    /// should be brief: finished tiles wait for it.
    using Upload = std::function<void(const Fresh&)>;
    std::optional<Refinement> take(const Upload& upload);

    /// Is there something to take?
    bool has_news() const { return fresh; }
    /// Is what was wanted last traced to the end?
    bool finished() const { return complete; }
    int threads() const { return pool.size(); }

  private:
    using Clock = std::chrono::steady_clock;
    enum class Work { none, first, refining };

    void loop(std::stop_token quit);
    bool accept(std::stop_token quit);
    void first_picture();
    void begin_refining();
    void refine();
    void announce(std::unique_lock<std::mutex>& lock);
    bool outdated(const Order& order) const;

    // Of the thread alone.
    Order order;
    std::optional<Tracer> tracer;
    std::optional<Codes> codes;
    Resolution resolution;
    Image spare;          // pictures are made here and then change places with the one on show
    int done = -1;        // the finest level of `order` that is complete
    bool coarse = false;  // the image on show is that of a level, not the whole picture
    double traced = 0;    // pixels of `order`

    // Between the threads.
    std::mutex mutex;
    std::condition_variable_any wake;
    std::optional<Order> next;
    std::shared_ptr<const Scene> scene_in_work;
    View view_in_work;
    Work work = Work::none;
    double budget_in_work = 0;
    int level_in_work = 0;
    Clock::time_point work_began;
    std::atomic<bool> stop = false;
    Image shown;
    Steps shown_steps;
    int new_from = 0, new_to = 0;  // rows of `shown` that are new
    std::atomic<bool> fresh = false, complete = false;
    Refinement state;

    const std::function<void()> news;
    ThreadPool pool;
    std::jthread thread;
};

}  // namespace strahl

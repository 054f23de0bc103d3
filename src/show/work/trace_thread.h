// The thread that traces for the window: always the newest view, first a coarse picture, which is then refined.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>

#include "num/thread_pool.h"
#include "show/motion/quick_pictures.h"
#include "show/motion/screen_image.h"
#include "show/work/worker.h"
#include "trace/cells/cell_picture.h"
#include "trace/tracer.h"

namespace strahl {

/// A picture that the window asks for.
struct Order {
    std::uint64_t number = 0;  // the same number means the same scene and view
    std::shared_ptr<const Scene> scene;
    View view;
    bool moving = false;           // pictures in motion are not refined: the next one comes soon
    double budget = 0.01;          // seconds for the first, coarse picture
    int finest = sharpened_level;  // level of the first picture in motion
    Exposure exposure{};
};

/// The progress of the picture on the screen.
struct Refinement {
    std::uint64_t number = 0;            // that of its order; 0 before the first order
    std::shared_ptr<const Scene> scene;  // that of its order, as the view is
    View view;
    int level = 0;       // the finest that is complete
    double share = 0;    // of its passes that is done
    double seconds = 0;  // spent tracing them
    Counts rays;
    bool finished() const { return number > 0 && level == averaged_level; }
};

/// New rows of the picture on the screen.
struct Fresh {
    const ScreenImage& image;
    const Refinement& picture;
    int first_row, rows;
};

/// The picture on the screen, of which some rows are new to it.
class PictureOnScreen {
  public:
    /// Takes a whole picture, and leaves the last one in `made`.
    void replace(ScreenImage& made);
    /// Replaces the pixels of a part.
    void store(const Lattice& part, const std::uint32_t* colors);
    /// Passes the new rows to `upload`, if there are any.
    void take(const std::function<void(const Fresh&)>& upload, const Refinement& picture);

  private:
    ScreenImage image;
    int new_from = 0, new_to = 0;
};

class TraceThread {
  public:
    /// `notify` is called from other threads when there is something to take, once until it is taken.
    TraceThread(int threads, std::function<void()> notify);

    /// Replaces the last order. Never waits for tracing.
    void want(Order order);

    /// Passes what is new since the last call to `upload` and returns the progress; nothing if nothing is new. `upload`
    /// should be brief, because finished tiles wait for it.
    using Upload = std::function<void(const Fresh&)>;
    std::optional<Refinement> take(const Upload& upload);

    /// Is there something to take?
    bool has_update() const { return fresh; }
    /// Is the last order finished?
    bool finished() const { return complete; }
    int threads() const { return pool.size(); }
    /// Returns for how many seconds it has been making a scene ready; 0 if it is not.
    double seconds_built() const;

  private:
    using Clock = std::chrono::steady_clock;
    enum class Work { none, first, refining };

    void trace(const Order& newer, const std::atomic<bool>& stop);
    void first_picture(const std::atomic<bool>& stop);
    bool sharpens() const { return order.moving && order.finest == sharpened_level; }
    QuickPictures::Wish wish() const;
    void refine(const std::atomic<bool>& stop);
    void announce(std::unique_lock<std::mutex>& lock);
    bool outdated(const Order& order) const;

    // Used by the thread alone:
    std::optional<Tracer> tracer;
    std::optional<TransferTable> table;
    QuickPictures quick;
    ScreenImage spare;                 // pictures are made here and then swapped with the one on the screen
    int done = -1;                     // the finest level of `order` that is complete
    std::optional<CellPicture> cells;  // of `order`, while it is refined

    // Shared between threads:
    std::mutex mutex;
    Order order;  // read by its thread without a lock, because no other one changes it
    Work work = Work::none;
    double planned = 0;  // seconds for the first picture in work; 0 if none would be faster
    Clock::time_point work_began;
    PictureOnScreen shown;
    std::atomic<bool> fresh = false, complete = false;
    std::atomic<Clock::time_point> building;  // since then; zero if it is not
    Refinement state;

    const std::function<void()> notify;
    ThreadPool pool;
    Worker<std::monostate> worker;
};

}  // namespace strahl

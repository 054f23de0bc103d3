// Threads beside the window's.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "files/os/thread.h"

namespace strahl {

/// Does jobs one after the other in a thread of its own, so that the window need not wait for them. Its functions are
/// for the window's thread, but for those that a job calls.
template <class Result>
class Worker {
  public:
    /// A job looks at `stop` now and then, and ends early when that is true.
    using Job = std::function<std::optional<Result>(const std::atomic<bool>& stop)>;

    /// `notify` is called from the thread when a job has ended. A destructor that has waited for `patience` seconds
    /// leaves the thread behind, whose jobs may then only use data that they own a share of.
    explicit Worker(std::function<void()> notify, std::optional<double> patience = {})
        : shared(std::make_shared<WorkerState>(std::move(notify))), patience(patience) {}
    ~Worker() {
        cancel(patience);
        if (!thread.joinable()) return;
        std::unique_lock lock(shared->mutex);
        shared->quit = true;
        shared->changed.notify_all();
        const bool left = shared->running;
        lock.unlock();
        left ? thread.detach() : thread.join();
        if (left) os::leave_thread_behind();
    }
    Worker(const Worker&) = delete;

    /// Does a job after those that were asked for before.
    void add(Job job) {
        std::lock_guard lock(shared->mutex);
        if (!shared->running && shared->jobs.empty()) shared->stop = false;
        shared->jobs.push_back(std::move(job));
        shared->changed.notify_all();
        if (!thread.joinable()) thread = std::thread([shared = shared] { shared->work(); });
    }
    /// Does a job in place of those that wait. If `at_once` it also stops the one under way.
    void replace(Job job, bool at_once) {
        drop(at_once);
        add(std::move(job));
    }
    /// Asks the job under way to end, or the next one if that has not begun. Its result counts.
    void stop() { shared->stop = true; }
    /// Drops the jobs that wait, and if `at_once` also stops the one under way, whose result does not count. Does not
    /// wait for its end. Returns how many jobs these are.
    std::size_t drop(bool at_once = true) {
        std::lock_guard lock(shared->mutex);
        std::size_t dropped = shared->jobs.size();
        shared->jobs.clear();
        if (at_once && shared->running && !std::exchange(shared->dropped, true)) shared->stop = true, ++dropped;
        return dropped;
    }
    /// Drops all jobs, and waits until none is under way, but no longer than so many seconds. Returns as drop() does.
    std::size_t cancel(std::optional<double> seconds = {}) {
        const std::size_t dropped = drop();
        std::unique_lock lock(shared->mutex);
        const auto idle = [this] { return !shared->running; };
        if (seconds)
            shared->changed.wait_for(lock, std::chrono::duration<double>(*seconds), idle);
        else
            shared->changed.wait(lock, idle);
        return dropped;
    }

    /// Returns how many jobs wait or are under way.
    std::size_t unfinished() const {
        std::lock_guard lock(shared->mutex);
        return shared->jobs.size() + shared->running;
    }
    /// Is there a job that is not finished, or a result that was not taken yet?
    bool busy() const {
        std::lock_guard lock(shared->mutex);
        return shared->running || !shared->jobs.empty() || !shared->results.empty();
    }
    /// Returns the oldest result that was not taken yet.
    std::optional<Result> take() {
        std::lock_guard lock(shared->mutex);
        if (shared->results.empty()) return std::nullopt;
        Result first = std::move(shared->results.front());
        shared->results.pop_front();
        return first;
    }

    /// For jobs: does another job wait?
    bool waiting() const {
        std::lock_guard lock(shared->mutex);
        return !shared->jobs.empty();
    }
    /// For jobs: has a result to take before the job ends.
    void give(Result result) {
        {
            std::lock_guard lock(shared->mutex);
            if (shared->dropped) return;
            shared->results.push_back(std::move(result));
        }
        notify();
    }
    /// For jobs: tells the window that there is something new.
    void notify() const { shared->notify(); }

  private:
    /// Holds all that the thread uses, so that one that was left behind can go on.
    struct WorkerState {
        explicit WorkerState(std::function<void()> notify) : notify(std::move(notify)) {}
        void work();

        const std::function<void()> notify;
        std::mutex mutex;
        std::condition_variable changed;
        std::deque<Job> jobs;
        std::deque<Result> results;
        bool running = false, quit = false;
        std::atomic<bool> stop = false;  // the job under way
        bool dropped = false;            // is its result no longer wanted?
    };

    const std::shared_ptr<WorkerState> shared;
    const std::optional<double> patience;
    std::thread thread;
};

template <class Result>
void Worker<Result>::WorkerState::work() {
    for (std::unique_lock lock(mutex);; lock.lock()) {
        changed.wait(lock, [this] { return quit || !jobs.empty(); });
        if (quit) return;
        const Job job = std::move(jobs.front());
        jobs.pop_front();
        running = true;
        lock.unlock();
        std::optional<Result> result = job(stop);
        lock.lock();
        if (result && !dropped) results.push_back(std::move(*result));
        running = stop = dropped = false;
        changed.notify_all();
        if (quit) return;
        lock.unlock();
        notify();
    }
}

}  // namespace strahl

// A pool of threads that share out numbered pieces of work.
#pragma once
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace strahl {

class ThreadPool {
  public:
    /// `threads` workers, the calling thread being one of them; 0 takes as many as the machine has processors. Throws
    /// std::runtime_error, with advice, if so many cannot be started.
    explicit ThreadPool(int threads = 0);
    ~ThreadPool();
    int size() const { return static_cast<int>(workers.size()) + 1; }

    /// Calls work(thread) once on every thread (0 <= thread < size()), and returns when all are done. The pieces are
    /// taken from a counter of the caller's own. What `work` throws on any of them is thrown here, the first of it,
    /// when all are done.
    void run(const std::function<void(int thread)>& work);

  private:
    void loop(int thread, std::stop_token stop);
    void work_on(const std::function<void(int)>& work, int thread);
    std::mutex mutex;
    std::condition_variable_any wake, done;
    const std::function<void(int)>* job = nullptr;
    std::uint64_t generation = 0;
    int busy = 0;
    std::exception_ptr failure;
    std::vector<std::jthread> workers;
};

/// Calls work(first, last) for stretches of [0, count) of `step` each, the last one of what remains, in any order.
template <class Work>
void share_out(ThreadPool& pool, std::int32_t count, std::int32_t step, const Work& work) {
    if (count <= step) {  // not worth waking anybody
        if (count > 0) work(0, count);
        return;
    }
    std::atomic<std::int32_t> next{0};
    const std::int32_t pieces = (count - 1) / step + 1;
    pool.run([&](int) {
        try {
            for (std::int32_t i; (i = next++) < pieces;) work(i * step, i + 1 < pieces ? (i + 1) * step : count);
        } catch (...) {
            next = pieces;  // the other threads need not go on
            throw;
        }
    });
}

}  // namespace strahl

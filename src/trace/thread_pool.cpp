#include "trace/thread_pool.h"

#include <algorithm>

namespace strahl {

ThreadPool::ThreadPool(int threads) {
    if (threads <= 0) threads = std::max(1u, std::thread::hardware_concurrency());
    for (int i = 1; i < threads; ++i) workers.emplace_back([this, i](std::stop_token stop) { loop(i, stop); });
}

ThreadPool::~ThreadPool() {
    for (auto& worker : workers) worker.request_stop();
    wake.notify_all();
}

void ThreadPool::run(const std::function<void(int)>& work) {
    {
        std::lock_guard lock(mutex);
        job = &work;
        busy = static_cast<int>(workers.size());
        ++generation;
    }
    wake.notify_all();
    work(0);
    std::unique_lock lock(mutex);
    done.wait(lock, [this] { return busy == 0; });
    job = nullptr;
}

void ThreadPool::loop(int thread, std::stop_token stop) {
    std::uint64_t seen = 0;
    while (true) {
        const std::function<void(int)>* work;
        {
            std::unique_lock lock(mutex);
            if (!wake.wait(lock, stop, [&] { return generation != seen; })) return;
            seen = generation;
            work = job;
        }
        (*work)(thread);
        std::lock_guard lock(mutex);
        if (--busy == 0) done.notify_one();
    }
}

}  // namespace strahl

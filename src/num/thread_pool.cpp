#include "num/thread_pool.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "files/os/thread.h"

namespace strahl {

ThreadPool::ThreadPool(int threads) {
    if (threads <= 0) threads = std::max(1u, std::thread::hardware_concurrency());
    try {
        for (int i = 1; i < threads; ++i)
            workers.emplace_back([this, i, lower = os::threads_need_lowering()](std::stop_token stop) {
                if (lower) os::lower_priority();
                loop(i, stop);
            });
    } catch (const std::system_error&) {
        throw std::runtime_error("of " + std::to_string(threads) + " threads only " + std::to_string(size()) +
                                 " can be started here; ask for fewer with --threads");
    }
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
    work_on(work, 0);
    std::unique_lock lock(mutex);
    done.wait(lock, [this] { return busy == 0; });
    job = nullptr;
    if (failure) std::rethrow_exception(std::exchange(failure, nullptr));
}

void ThreadPool::work_on(const std::function<void(int)>& work, int thread) {
    try {
        work(thread);
    } catch (...) {
        std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
    }
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
        work_on(*work, thread);
        std::lock_guard lock(mutex);
        if (--busy == 0) done.notify_one();
    }
}

}  // namespace strahl

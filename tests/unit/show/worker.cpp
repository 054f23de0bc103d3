// Jobs in the background: their order, their results, and that all of them can be stopped.
#include "show/work/worker.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "tests/unit/show/soon.h"

namespace strahl {
namespace {

void await(const std::atomic<bool>& flag) {
    while (!flag) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::vector<int> all_of(Worker<int>& worker) {
    std::vector<int> all;
    while (const auto one = worker.take()) all.push_back(*one);
    return all;
}

}  // namespace

TEST_CASE("jobs are done in their order, and told of") {
    std::atomic<int> told = 0;
    Worker<int> worker([&] { ++told; });
    CHECK(!worker.busy());
    for (int i = 0; i < 3; ++i) worker.add([i](const std::atomic<bool>&) { return i; });
    worker.add([](const std::atomic<bool>&) { return std::nullopt; });
    REQUIRE(soon([&] { return told == 4; }));
    CHECK(worker.unfinished() == 0);
    CHECK(worker.busy());  // results wait to be taken
    CHECK(all_of(worker) == std::vector{0, 1, 2});
    CHECK(!worker.busy());
}

TEST_CASE("a job gives results before its end, until it is dropped") {
    std::atomic<bool> given = false;
    Worker<int> worker([] {});
    worker.add([&](const std::atomic<bool>& stop) {
        worker.give(1);
        given = true;
        await(stop);
        worker.give(2);
        return 3;
    });
    await(given);
    CHECK(all_of(worker) == std::vector{1});
    CHECK(worker.cancel() == 1);
    CHECK(!worker.busy());
}

TEST_CASE("a newer job replaces those that wait, and the one under way if it is to") {
    std::atomic<bool> begun = false, end = false;
    Worker<int> worker([] {});
    const auto until_stopped = [&](const std::atomic<bool>& stop) {
        begun = true;
        await(stop);
        return 1;
    };
    worker.add(until_stopped);
    worker.add([](const std::atomic<bool>&) { return 2; });
    await(begun);
    worker.replace(
        [&](const std::atomic<bool>&) {
            await(end);
            return 3;
        },
        true);
    worker.replace([](const std::atomic<bool>&) { return 4; }, false);
    worker.replace([](const std::atomic<bool>&) { return 5; }, false);
    end = true;
    REQUIRE(soon([&] { return worker.unfinished() == 0; }));
    const std::vector<int> results = all_of(worker);
    CHECK((results == std::vector{3, 5} || results == std::vector{5}));  // 3 may not have begun
}

TEST_CASE("a job that is asked to stop still has its result, also if it has not begun") {
    Worker<int> worker([] {});
    for (int i = 0; i < 20; ++i) {
        worker.add([i](const std::atomic<bool>& stop) {
            await(stop);
            return i;
        });
        worker.stop();
        REQUIRE(soon([&] { return worker.unfinished() == 0; }));
        CHECK(all_of(worker) == std::vector{i});
    }
}

TEST_CASE("a worker stops its job in the end, and leaves behind one that does not") {
    std::atomic<bool> stopped = false;
    {
        Worker<int> worker([] {});
        std::atomic<bool> begun = false;
        worker.add([&](const std::atomic<bool>& stop) {
            begun = true;
            await(stop);
            stopped = true;
            return 0;
        });
        await(begun);
    }
    CHECK(stopped);
    const auto end = std::make_shared<std::atomic<bool>>(false);
    {
        Worker<int> worker([] {}, .01);
        const auto begun = std::make_shared<std::atomic<bool>>(false);
        worker.add([end, begun](const std::atomic<bool>&) {
            *begun = true;
            await(*end);
            return 0;
        });
        await(*begun);
    }
    CHECK(end.use_count() == 2);  // the thread goes on
    *end = true;
    CHECK(soon([&] { return end.use_count() == 1; }));
}

}  // namespace strahl

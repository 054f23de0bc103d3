// Threads that cannot be started, and work that throws on them.
#include "num/thread_pool.h"

#include <dlfcn.h>
#include <doctest/doctest.h>
#include <pthread.h>

#include <cerrno>
#include <new>
#include <stdexcept>
#include <string>

#include "text/parse.h"
#include "trace/tracer.h"

namespace {
int threads_left = 1000;
}

// The address sanitizer's function, where there is one: it joins only threads that it has seen start.
extern "C" [[gnu::weak]] decltype(pthread_create) __interceptor_pthread_create;

// Replaces the C library's function: lets only so many threads start.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                              void* argument) {
    if (threads_left == 0) return EAGAIN;
    --threads_left;
    static const auto create = __interceptor_pthread_create
                                   ? &__interceptor_pthread_create
                                   : reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
    return create(thread, attributes, work, argument);
}

namespace strahl {
namespace {

TEST_CASE("what is thrown on any thread is thrown where the work was given out, and the pool goes on") {
    for (const int threads : {1, 3}) {
        ThreadPool pool(threads);
        for (int thrower = 0; thrower < threads; ++thrower) {
            std::atomic<int> calls = 0;
            const auto work = [&](int thread) {
                ++calls;
                if (thread == thrower) throw std::bad_alloc();
            };
            CHECK_THROWS_AS(pool.run(work), std::bad_alloc);
            CHECK(calls == threads);
        }
        CHECK_THROWS_AS(pool.run([](int) { throw std::runtime_error("all of them"); }), std::runtime_error);
        std::atomic<int> calls = 0;
        pool.run([&](int) { ++calls; });
        CHECK(calls == threads);
        std::atomic<int> pieces = 0;
        const auto piece = [&](std::int32_t, std::int32_t) {
            ++pieces;
            throw std::bad_alloc();
        };
        CHECK_THROWS_AS(share_out(pool, 1000, 1, piece), std::bad_alloc);
        CHECK(pieces <= threads);
    }
}

TEST_CASE("a picture that cannot be finished for lack of memory is not traced to its end") {
    const Scene scene = parse_scene(
        "camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 25 } background { color <1,1,1> }", "test");
    ThreadPool pool(2);
    Tracer tracer(scene, Precision::float32);
    std::atomic<int> tiles = 0;
    const auto sink = [&](const Tile&) {
        ++tiles;
        throw std::bad_alloc();
    };
    const View view{.camera = scene.camera, .width = 2000, .height = 2000, .depth = 1};
    CHECK_THROWS_AS(tracer.trace({view, pool, sink}, Lattice{.columns = 2000, .rows = 2000}), std::bad_alloc);
    CHECK(tiles <= 2);
}

TEST_CASE("threads that cannot be started are reported, with advice") {
    for (const int left : {0, 2}) {
        threads_left = left;
        std::string told;
        try {
            ThreadPool pool(4);
        } catch (const std::runtime_error& error) {
            told = error.what();
        }
        threads_left = 1000;
        CHECK(told ==
              "of 4 threads only " + std::to_string(left + 1) + " can be started here; ask for fewer with --threads");
    }
}

}  // namespace
}  // namespace strahl

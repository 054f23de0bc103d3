// Time, memory, and the line in which programs of ours tell them.
#pragma once
#include <sys/resource.h>

#include <chrono>
#include <cstdint>
#include <cstdio>

namespace strahl::bench {

inline double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Memory is this process' peak so far, in KiB.
inline void print_figures(double build, double trace, std::uint64_t rays) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("build %.9g trace %.9g rays %llu memory %ld\n", build, trace, static_cast<unsigned long long>(rays),
                usage.ru_maxrss);
}

}  // namespace strahl::bench

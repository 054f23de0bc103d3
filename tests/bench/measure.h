// Shared by the benchmarks' programs: time, memory and medians.
#pragma once
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace strahl::bench {

inline double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Returns the value in the middle; of an even number of values, the mean of the two in the middle.
inline double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// Prints the line that tests/bench/run reads. Memory is this process' peak so far, in KiB.
inline void print_figures(double build, double trace, std::uint64_t rays) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("build %.9g trace %.9g rays %llu memory %ld\n", build, trace, static_cast<unsigned long long>(rays),
                usage.ru_maxrss);
}

}  // namespace strahl::bench

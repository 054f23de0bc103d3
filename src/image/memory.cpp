#include "image/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace strahl {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

double available_to_all() {
    std::ifstream file("/proc/meminfo");
    std::string word;
    while (file >> word)
        if (double kilobytes; word == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
    return unknown;
}

/// The file holds "max" where there is no limit.
double container_limit() {
    std::ifstream file("/sys/fs/cgroup/memory.max");
    double bytes;
    return file >> bytes ? bytes : unknown;
}

double address_space_limit() {
    rlimit limit{};
    return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? static_cast<double>(limit.rlim_cur)
                                                                                : unknown;
}

}  // namespace

double available_memory() { return std::min({available_to_all(), container_limit(), address_space_limit()}); }

}  // namespace strahl

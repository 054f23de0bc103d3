// The file through which the attacker controls the library in the attacked program: both map it.
#pragma once
#include <atomic>
#include <cstdint>

namespace strahl::attack {

/// Allocations while a library is loaded are watched apart: they are a hundred times as many as all others.
enum class Watched : int { nothing, allocations, loading, threads, files };
enum class Harm : int { error, cut, kill_before, kill_after };

/// A path of calls that ends in an allocation. Almost all allocations come by a path that was there before.
struct Path {
    std::atomic<std::uint64_t> hash;  // 0: none
    Watched kind;
    long first;  // the number of the first allocation that came by it
};

struct Control {
    static constexpr int most_paths = 1 << 16;
    Watched watched;
    Harm harm;
    int error;                    // the errno of Harm::error
    long at;                      // the call that comes to harm, from 1; 0: none
    bool only_named;              // the file system knows no files without names
    bool attached;                // the library is in the program
    bool finds_paths;             // of allocations
    std::atomic<long> counts[5];  // calls of each kind so far
    std::atomic<int> done;        // harm was done
    bool foreign;                 // in a library that is not ours
    char where[2000];             // the function that was called, and the functions that called it
    Path paths[most_paths];       // each somewhere from the place that its hash tells on
};

/// The name of the environment variable that holds the path of the file with the Control, and of that with the log.
inline constexpr char control_variable[] = "STRAHL_ATTACK_CONTROL", log_variable[] = "STRAHL_ATTACK_LOG";

}  // namespace strahl::attack

// Why a command stops, where that is not the fault of a file a person wrote (FileError, exit status 3).
#pragma once
#include <stdexcept>

namespace strahl {

namespace exit_status {
inline constexpr int done = 0, failed = 1, usage = 2, bad_file = 3, interrupted = 130;
}

/// What was asked for makes no sense, or not on this machine: exit status 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The result could not be written: exit status 1.
struct OutputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace strahl

// Exit statuses, and what is wrong with a command line. (What is wrong with files: scene/error.h.)
#pragma once
#include <stdexcept>

namespace strahl {

namespace exit_status {
inline constexpr int done = 0, failed = 1, usage = 2, bad_file = 3, interrupted = 130;
}

/// What was asked for makes no sense, or not on this machine: exit status 2.
struct UsageError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

}  // namespace strahl

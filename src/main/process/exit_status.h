// Exit statuses of the program.
#pragma once

namespace strahl::exit_status {

inline constexpr int done = 0, failed = 1, usage = 2, bad_file = 3, interrupted = 130;

}  // namespace strahl::exit_status

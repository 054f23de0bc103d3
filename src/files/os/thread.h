// Sets the priority of threads, and ends the program beside threads that were left behind.
#pragma once

namespace strahl::os {

/// Lowers the priority of this thread, and of the programs that it starts from now on. Threads that it starts have it
/// too, unless threads_need_lowering().
void lower_priority();
/// Was the priority of this thread lowered, on a system where threads that it starts do not inherit it?
bool threads_need_lowering();

/// Lets the program end without destroying static data, which a thread that nobody waits for may still use.
void leave_thread_behind();

}  // namespace strahl::os

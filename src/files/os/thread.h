// Sets the priority of threads, and ends the program beside threads that were left behind.
#pragma once

namespace strahl::os {

/// Lowers the priority of this thread, and of the threads and programs that it starts from now on.
void lower_priority();

/// Lets the program end without destroying static data, which a thread that nobody waits for may still use.
void leave_thread_behind();

}  // namespace strahl::os

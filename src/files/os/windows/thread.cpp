#include "files/os/thread.h"

#include <cstdlib>

#include "files/os/windows/win32.h"

namespace strahl::os {

void lower_priority() { ::SetThreadPriority(::GetCurrentThread(), THREAD_PRIORITY_LOWEST); }

bool threads_need_lowering() { return ::GetThreadPriority(::GetCurrentThread()) < THREAD_PRIORITY_NORMAL; }

void leave_thread_behind() {
    // Functions that are registered later run first, so static data still exist.
    std::atexit([] { ::TerminateProcess(::GetCurrentProcess(), 0); });
}

}  // namespace strahl::os

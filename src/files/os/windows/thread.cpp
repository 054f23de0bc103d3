#include "files/os/thread.h"

#include <cxxabi.h>

#include <cstdlib>

#include "files/os/windows/win32.h"

namespace strahl::os {
namespace {

/// Makes threads that end destroy their thread_local objects before they free the memory of these. mingw-w64 does both
/// in the order in which their keys were made: that of destructors is made here, by the first one that is registered;
/// that of memory when the first object is used, which is later.
[[maybe_unused]] const int destructors_first = abi::__cxa_thread_atexit([](void*) {}, nullptr, nullptr);

}  // namespace

void lower_priority() { ::SetThreadPriority(::GetCurrentThread(), THREAD_PRIORITY_LOWEST); }

bool threads_need_lowering() { return ::GetThreadPriority(::GetCurrentThread()) < THREAD_PRIORITY_NORMAL; }

void leave_thread_behind() {
    // Functions that are registered later run first, so static data still exist.
    std::atexit([] { ::TerminateProcess(::GetCurrentProcess(), 0); });
}

}  // namespace strahl::os

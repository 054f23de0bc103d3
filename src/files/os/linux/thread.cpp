#include "files/os/thread.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>

namespace strahl::os {

void lower_priority() { static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10)); }

bool threads_need_lowering() { return false; }

void leave_thread_behind() {
    ::on_exit([](int status, void*) { std::_Exit(status); }, nullptr);
}

}  // namespace strahl::os

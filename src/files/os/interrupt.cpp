// Signal handling. A handler can only reach static data, so the flag is static, in this file alone.
#include "files/os/interrupt.h"

namespace strahl::os {
namespace {

std::atomic<bool> was_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void strahl_interrupted(int) {
    was_asked = true;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGHUP, SIG_DFL);
}

void handle(int signal, struct sigaction& old) {
    struct sigaction action {};
    action.sa_handler = strahl_interrupted;
    action.sa_flags = 0;  // not SA_RESTART: a write to a pipe that nobody reads must end
    sigaction(signal, nullptr, &old);
    if (old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
    handle(SIGINT, old_interrupt);
    handle(SIGTERM, old_terminate);
    handle(SIGHUP, old_hang_up);
}

Interrupt::~Interrupt() {
    sigaction(SIGINT, &old_interrupt, nullptr);
    sigaction(SIGTERM, &old_terminate, nullptr);
    sigaction(SIGHUP, &old_hang_up, nullptr);
    was_asked = false;
}

const std::atomic<bool>* Interrupt::flag() const { return &was_asked; }

}  // namespace strahl::os

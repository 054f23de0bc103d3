// Signal handling. A handler can only reach static data, so the flag is static, in this file alone.
#include "files/os/interrupt.h"

#include <csignal>
#include <cstddef>
#include <iterator>

namespace strahl::os {
namespace {

std::atomic<bool> was_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
struct sigaction old_actions[std::size(signals)];

extern "C" void strahl_interrupted(int) {
    was_asked = true;
    for (const int signal : signals) std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupt::Interrupt() {
    struct sigaction action {};
    action.sa_handler = strahl_interrupted;
    action.sa_flags = 0;  // not SA_RESTART: a write to a pipe that nobody reads must end
    for (std::size_t i = 0; i < std::size(signals); ++i) {
        sigaction(signals[i], nullptr, &old_actions[i]);
        if (old_actions[i].sa_handler != SIG_IGN) sigaction(signals[i], &action, nullptr);
    }
}

Interrupt::~Interrupt() {
    for (std::size_t i = 0; i < std::size(signals); ++i) sigaction(signals[i], &old_actions[i], nullptr);
    was_asked = false;
}

const std::atomic<bool>* Interrupt::flag() const { return &was_asked; }

}  // namespace strahl::os

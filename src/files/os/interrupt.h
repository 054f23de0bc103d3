// Handles Ctrl-C while a picture is traced: the program saves what is finished; a second Ctrl-C ends it at once.
#pragma once
#include <atomic>
#include <csignal>

namespace strahl::os {

/// While one of these lives, SIGINT, SIGTERM and SIGHUP (the terminal was closed) set a flag instead of ending the
/// program; after the first of them the next one ends it as usual. A signal that was ignored when the program started
/// (as under nohup) stays ignored.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    const std::atomic<bool>* flag() const;

  private:
    struct sigaction old_interrupt, old_terminate, old_hang_up;
};

}  // namespace strahl::os

// Ctrl-C while a picture is traced: the program saves what is finished; a second one ends it at once.
#pragma once
#include <atomic>
#include <csignal>

namespace strahl {

/// While an object lives, the first SIGINT or SIGTERM sets a flag instead of ending the program; the next one ends it
/// as usual. A signal that was ignored when the program started (as under nohup) stays ignored.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    const std::atomic<bool>* flag() const;

  private:
    struct sigaction old_interrupt, old_terminate;
};

}  // namespace strahl

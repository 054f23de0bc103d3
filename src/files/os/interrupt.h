// Handles Ctrl-C while a picture is traced: the program saves what is finished; a second Ctrl-C ends it at once.
#pragma once
#include <atomic>

namespace strahl::os {

/// While one of these lives, SIGINT, SIGTERM and SIGHUP (the terminal was closed) set a flag instead of ending the
/// program; after the first of them the next one ends it as usual. A signal that was ignored when the program started
/// (as under nohup) stays ignored. There is one at a time.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    const std::atomic<bool>* flag() const;
};

}  // namespace strahl::os

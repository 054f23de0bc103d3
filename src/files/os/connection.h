// Connections to other programs.
#pragma once
#include <cstddef>
#include <string_view>

#include "files/os/descriptor.h"

namespace strahl::os {

/// A connection to a program on this machine, by TCP.
class Connection {
  public:
    /// Connects to the program that listens at a port. Throws std::system_error.
    explicit Connection(int port);

    /// Waits for bytes, and puts up to `size` of them into `buffer`. Returns how many; 0 if the other program has ended
    /// the connection, or an errno, negative.
    std::ptrdiff_t receive(char* buffer, std::size_t size);
    /// Lets receive() wait no longer than so many seconds; 0: for ever.
    void set_timeout(int seconds);
    /// Sends what can be sent without waiting. Returns how many bytes that is.
    std::size_t send(std::string_view bytes);
    /// Ends the connection, and the waiting of receive() in another thread.
    void end();

  private:
    Descriptor socket;
};

}  // namespace strahl::os

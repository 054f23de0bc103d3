// Starts other programs.
#pragma once
#include <atomic>
#include <string>
#include <string_view>
#include <vector>

#include "files/os/descriptor.h"

namespace strahl::os {

/// How a program is started.
struct ProgramStart {
    std::vector<std::string> words;  // its name or path, and its arguments
    std::string folder{};            // the one in which it runs, or "" for this program's
    std::string writable{};          // if given, the only folder below which it can write files
    bool own_session = false;        // Ctrl-C in the terminal does not reach it
};

/// A program that runs beside this one. What it prints is kept in memory.
class Process {
  public:
    /// Throws std::system_error if it cannot be started, and std::bad_alloc.
    explicit Process(const ProgramStart& start);
    /// Ends it at once, if it has not ended.
    ~Process();
    Process(const Process&) = delete;

    /// Sends the next bytes of what it reads. Signals do not interrupt that. Returns false if it reads no more.
    bool send(std::string_view bytes);
    /// Waits until it has ended; ends it at once when `stop` becomes true. What it reads has an end then. Returns its
    /// exit status, or the number of the signal that ended it, negative.
    int wait(const std::atomic<bool>* stop = nullptr);
    /// Returns what it has printed.
    std::string output() const;

  private:
    Descriptor input, printed;
    int process = 0, status = 0;
};

/// Says why ProgramStart::writable is refused on this system, or returns "".
std::string confinement_fault();

/// Starts a program that goes on when this one ends, also by Ctrl-C in its terminal. Returns false if it cannot.
bool start_apart(const std::vector<std::string>& words);

/// Returns the path of a program in PATH, or "".
std::string find_program(const std::string& name);

}  // namespace strahl::os

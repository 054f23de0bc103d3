// The list of commands. CLI11 compiles slowly, so this only names its class.
#pragma once
#include <functional>

namespace CLI {
class App;
}

namespace strahl {

/// The work that a command line asks for; returns the exit status. Empty until a command has been parsed.
using ChosenCommand = std::function<int()>;

/// Adds all commands with their options to `app`. When one has been parsed, `chosen` is its work.
void add_commands(CLI::App& app, ChosenCommand& chosen);

}  // namespace strahl

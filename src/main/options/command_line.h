// The command line: chooses a command and reads its options.
#pragma once

namespace strahl {

/// Parses the arguments of main() and runs the command that they name. Returns the exit status. Throws UsageError if
/// they make no sense, and what commands throw.
int run_command_line(int argc, char** argv);

}  // namespace strahl

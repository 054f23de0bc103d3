// The terminal that the program writes to.
#pragma once

namespace strahl {

/// Returns the number of columns of the terminal on standard output, or what COLUMNS says; 0 if there is neither.
int terminal_columns();

}  // namespace strahl

#include "main/process/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>

namespace strahl {

int terminal_columns() {
    if (const char* const given = std::getenv("COLUMNS")) return std::atoi(given);
    winsize size{};
    return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace strahl

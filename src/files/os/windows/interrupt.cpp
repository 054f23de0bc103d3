// Handles Ctrl-C, Ctrl-Break and a console that is closed. A handler can only reach static data.
#include "files/os/interrupt.h"

#include "files/os/windows/win32.h"

namespace strahl::os {
namespace {

std::atomic<bool> was_asked = false;

/// Runs in a thread of Windows' own. After FALSE Windows ends the program.
BOOL WINAPI interrupted(DWORD event) {
    if (was_asked.exchange(true)) return FALSE;
    // Once this returns, the program ends with its console; else after 5 seconds, or when it has saved its work.
    if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(INFINITE);
    return TRUE;
}

}  // namespace

Interrupt::Interrupt() { ::SetConsoleCtrlHandler(interrupted, TRUE); }

Interrupt::~Interrupt() {
    ::SetConsoleCtrlHandler(interrupted, FALSE);
    was_asked = false;
}

const std::atomic<bool>* Interrupt::flag() const { return &was_asked; }

}  // namespace strahl::os

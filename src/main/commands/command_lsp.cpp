#include "main/commands/command_lsp.h"

#include <iostream>

#include "files/error.h"
#include "files/os/system.h"
#include "main/lsp/server.h"

namespace strahl {

int lsp_command(const LspOptions&) {
    if (os::is_terminal(stdin)) throw UsageError("strahl lsp answers an editor, which starts it; this is a terminal");
    std::ios::sync_with_stdio(false);  // so that the server sees whether more messages have come
    return serve_editor(std::cin, std::cout);
}

}  // namespace strahl

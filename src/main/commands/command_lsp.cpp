#include "main/commands/command_lsp.h"

#include <unistd.h>

#include <iostream>

#include "main/lsp/server.h"
#include "scene/error.h"

namespace strahl {

int lsp_command(const LspOptions&) {
    if (::isatty(STDIN_FILENO)) throw UsageError("strahl lsp answers an editor, which starts it; this is a terminal");
    std::ios::sync_with_stdio(false);  // so that the server sees whether more messages have come
    return serve_editor(std::cin, std::cout);
}

}  // namespace strahl

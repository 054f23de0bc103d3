// strahl lsp: a language server for editors.
#pragma once

namespace strahl {

struct LspOptions {
    bool stdio = false;  // what is always done; some editors ask for it
};

/// Returns the exit status. Throws FileError for what is no message, OutputError, or UsageError in a terminal.
int lsp_command(const LspOptions& options);

}  // namespace strahl

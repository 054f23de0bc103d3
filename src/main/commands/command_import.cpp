// strahl import: reads another program's scene, tells what can't be said, and writes the rest as text.
#include "main/commands/command_import.h"

#include <filesystem>
#include <iostream>

#include "files/output_file.h"
#include "files/read_file.h"
#include "files/utf8.h"
#include "import/import.h"
#include "main/process/exit_status.h"
#include "text/parse.h"
#include "text/write.h"

namespace strahl {

int import_command(const ImportOptions& options) {
    const bool piped = options.file == "-";
    refuse_overwriting("-o", options.output, "the file to import", options.file);
    const Imported imported = import_scene(read_text(options.file), piped ? "standard input" : options.file);
    std::string text = "// Imported";
    if (!piped) text += " from " + show(std::filesystem::path(options.file).filename().string()).text;
    text += '.';
    if (imported.size)
        text += " Its picture: --size " + std::to_string(imported.size->width) + "x" +
                std::to_string(imported.size->height);
    write_file(options.output, text + "\n\n" + write_scene(imported.scene));
    for (const std::string& warning : imported.warnings) std::cerr << "strahl: warning: " << printable(warning) << '\n';
    return exit_status::done;
}

}  // namespace strahl

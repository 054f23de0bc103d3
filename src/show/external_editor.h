// Opens a line of a file in the user's text editor.
#pragma once
#include <string>
#include <vector>

namespace strahl {

/// Returns the command that opens a file at a line in `editor`, the value of VISUAL or EDITOR, which may have options.
/// Editors that need a terminal get one of their own.
std::vector<std::string> editor_command(const std::string& editor, const std::string& terminal, const std::string& file,
                                        int line);

/// Opens the file in the editor that VISUAL or else EDITOR names, without waiting for it. Returns the reason if it
/// cannot, or "".
std::string open_in_editor(const std::string& file, int line);

}  // namespace strahl

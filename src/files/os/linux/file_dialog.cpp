// Asks by the dialog of zenity or of kdialog.
#include "files/os/file_dialog.h"

#include <stdexcept>
#include <system_error>

#include "files/os/process.h"

namespace strahl::os {
namespace {

constexpr const char* script = R"sh(
if command -v zenity >/dev/null && [ -n "$2" ]; then
    exec zenity --file-selection --save --confirm-overwrite --title="$3" --filename="$1$2" 2>/dev/null
elif command -v zenity >/dev/null; then
    exec zenity --file-selection --title="$3" --filename="$1" \
        --file-filter="$4 | $5" --file-filter='All files | *' 2>/dev/null
elif command -v kdialog >/dev/null && [ -n "$2" ]; then
    exec kdialog --title "$3" --getsavefilename "$1$2" "$4 ($5)" 2>/dev/null
elif command -v kdialog >/dev/null; then
    exec kdialog --title "$3" --getopenfilename "$1" "$4 ($5)" 2>/dev/null
fi
exit 127)sh";

}  // namespace

std::string ask_for_file(const FileQuestion& question, const std::atomic<bool>& stop) try {
    Process dialog({.words = {"/bin/sh", "-c", script, "sh", question.folder, question.new_name, question.title,
                              question.kind, question.pattern}});
    const int status = dialog.wait(&stop);
    if (status == 127)
        throw std::runtime_error("there is no file dialog: install zenity or kdialog, or drop a file onto the window");
    if (status != 0) return "";
    const std::string said = dialog.output();
    return said.substr(0, said.find_last_not_of('\n') + 1);
} catch (const std::system_error&) {
    throw std::runtime_error("the file dialog cannot be started");
}

}  // namespace strahl::os

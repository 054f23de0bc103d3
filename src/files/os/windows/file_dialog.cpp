#include "files/os/file_dialog.h"

#include "files/os/windows/win32.h"
// after windows.h
#include <commdlg.h>

#include <algorithm>
#include <filesystem>

namespace strahl::os {
namespace {

/// Returns the program's window, which waits for the dialog, or null if another program's has the keyboard.
HWND own_window() {
    const HWND window = ::GetForegroundWindow();
    DWORD process = 0;
    ::GetWindowThreadProcessId(window, &process);
    return process == ::GetCurrentProcessId() ? window : nullptr;
}

}  // namespace

std::string ask_for_file(const FileQuestion& question, const std::atomic<bool>&) {
    std::string pattern = question.pattern;
    std::ranges::replace(pattern, ' ', ';');
    const std::wstring title = utf16(question.title),
                       folder = std::filesystem::absolute(question.folder).make_preferred().wstring(),
                       filter = utf16(question.kind + '\0' + pattern + '\0' + "All files" + '\0' + "*.*" + '\0');
    std::wstring path = utf16(question.new_name);
    path.resize(32768);
    OPENFILENAMEW dialog{};
    dialog.lStructSize = sizeof dialog;
    dialog.hwndOwner = own_window();
    dialog.lpstrTitle = title.c_str(), dialog.lpstrInitialDir = folder.c_str(), dialog.lpstrFilter = filter.c_str();
    dialog.lpstrFile = path.data(), dialog.nMaxFile = DWORD(path.size());
    dialog.Flags = OFN_NOCHANGEDIR | OFN_HIDEREADONLY | OFN_PATHMUSTEXIST;
    const BOOL chosen = question.new_name.empty() ? (dialog.Flags |= OFN_FILEMUSTEXIST, ::GetOpenFileNameW(&dialog))
                                                  : (dialog.Flags |= OFN_OVERWRITEPROMPT, ::GetSaveFileNameW(&dialog));
    return chosen ? utf8(path.c_str()) : "";
}

}  // namespace strahl::os

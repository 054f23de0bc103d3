// Programs that this one starts: they read from a pipe, and print into a temporary file.
#include "files/os/process.h"

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <system_error>

#include "files/os/thread.h"
#include "files/os/windows/win32.h"

namespace strahl::os {
namespace {

/// Windows uses only 32 bits of a handle ("Interprocess Communication Between 32-bit and 64-bit Applications").
HANDLE handle_of(int process) { return reinterpret_cast<HANDLE>(std::intptr_t(process)); }

/// Joins words to a line that programs take apart again as CommandLineToArgvW does: in quotes, a backslash counts as
/// itself unless a quote follows the last one of its row.
std::wstring command_line(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) {
        line += line.empty() ? "\"" : " \"";
        std::size_t backslashes = 0;
        for (const char c : word) {
            if (c == '"') line.append(backslashes + 1, '\\');
            backslashes = c == '\\' ? backslashes + 1 : 0;
            line += c;
        }
        line.append(backslashes, '\\');
        line += '"';
    }
    return utf16(line);
}

/// Starts a program, and returns its handle. Throws std::system_error.
HANDLE start_program(const ProgramStart& start, STARTUPINFOW with, bool inherits) {
    std::wstring line = command_line(start.words);
    const std::wstring folder = utf16(start.folder);
    with.cb = sizeof with;
    const DWORD session = start.own_session ? CREATE_NEW_PROCESS_GROUP : 0;
    const DWORD priority = threads_need_lowering() ? BELOW_NORMAL_PRIORITY_CLASS : 0;
    PROCESS_INFORMATION started{};
    if (!::CreateProcessW(nullptr, line.data(), nullptr, nullptr, inherits, session | priority, nullptr,
                          folder.empty() ? nullptr : folder.c_str(), &with, &started))
        throw std::system_error(errno_of(::GetLastError()), std::generic_category());
    ::CloseHandle(started.hThread);
    return started.hProcess;
}

}  // namespace

Process::Process(const ProgramStart& start) {
    if (!start.writable.empty()) throw std::runtime_error(confinement_fault());
    std::wstring ignored;
    printed = scratch_file(ignored);
    HANDLE theirs = nullptr, ours = nullptr;
    if (!printed || !::CreatePipe(&theirs, &ours, nullptr, 1 << 16))
        throw std::system_error(EMFILE, std::generic_category());
    input = descriptor_of(ours);
    const Descriptor their_input = descriptor_of(theirs);
    STARTUPINFOW with{};
    with.dwFlags = STARTF_USESTDHANDLES;
    with.hStdInput = theirs, with.hStdOutput = with.hStdError = os::handle_of(printed);
    for (const HANDLE handle : {with.hStdInput, with.hStdOutput})
        ::SetHandleInformation(handle, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
    process = int(reinterpret_cast<std::intptr_t>(start_program(start, with, true)));
}

Process::~Process() {
    if (process) ::TerminateProcess(handle_of(process), 1);
    wait();
}

bool Process::send(std::string_view bytes) { return write_all(input, bytes); }

int Process::wait(const std::atomic<bool>* stop) {
    input = {};
    if (!process) return status;
    while (::WaitForSingleObject(handle_of(process), stop ? 5 : INFINITE) == WAIT_TIMEOUT)
        if (*stop) ::TerminateProcess(handle_of(process), 1), stop = nullptr;
    DWORD code = 0;
    ::GetExitCodeProcess(handle_of(process), &code);
    ::CloseHandle(handle_of(std::exchange(process, 0)));
    return status = int(code);
}

std::string Process::output() const {
    LARGE_INTEGER size{}, start{};
    ::GetFileSizeEx(os::handle_of(printed), &size);
    ::SetFilePointerEx(os::handle_of(printed), start, nullptr, FILE_BEGIN);
    std::string text(std::size_t(size.QuadPart), '\0');
    DWORD got = 0;
    ::ReadFile(os::handle_of(printed), text.data(), DWORD(text.size()), &got, nullptr);
    text.resize(got);
    return text;
}

std::string confinement_fault() {
    return "POV-Ray is not started on Windows, where nothing would keep the scene from writing files with it";
}

bool start_apart(const std::vector<std::string>& words) try {
    ::CloseHandle(start_program({.words = words, .own_session = true}, {}, false));
    return true;
} catch (const std::system_error&) {
    return false;
}

std::string find_program(const std::string& name) {
    const char* const folders = std::getenv("PATH");  // without it, Windows would search the current folder first
    wchar_t path[MAX_PATH];
    const DWORD size =
        ::SearchPathW(utf16(folders ? folders : "").c_str(), utf16(name).c_str(), L".exe", MAX_PATH, path, nullptr);
    return size < MAX_PATH ? utf8({path, size}) : "";
}

}  // namespace strahl::os

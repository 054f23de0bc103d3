#include "files/os/system.h"

#include <fcntl.h>
#include <io.h>

#include <cstdlib>

#include "files/os/windows/win32.h"

namespace strahl::os {

namespace fs = std::filesystem;

void prepare_streams() {
    for (std::FILE* const stream : {stdin, stdout, stderr}) ::_setmode(::_fileno(stream), _O_BINARY);
    ::SetConsoleOutputCP(CP_UTF8);
    DWORD mode = 0;
    for (const DWORD stream : {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE})
        if (const HANDLE handle = ::GetStdHandle(stream); ::GetConsoleMode(handle, &mode))
            ::SetConsoleMode(handle, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

std::string program_file() {
    std::wstring path(32768, L'\0');
    path.resize(::GetModuleFileNameW(nullptr, path.data(), DWORD(path.size())));
    return utf8(path);
}

fs::path program_folder() { return fs::path(utf16(program_file())).parent_path(); }

std::vector<fs::path> shared_folders() {
    const char* const home = std::getenv("USERPROFILE");
    return {fs::path(home ? home : "") / "Documents"};
}

std::vector<fs::path> loaded_libraries() { return {}; }  // for bundles, which are not made here

const char* system_name() { return "Windows"; }

std::string system_needed() { return "Windows 10 on x86_64, version 1903 or later"; }

Library::Library(const std::string& path) : handle(reinterpret_cast<void*>(::LoadLibraryW(utf16(path).c_str()))) {
    if (!handle) why = "'" + path + "' is missing, or needs others that are";
}

void* Library::find(const char* name) const {
    return handle ? reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(handle), name)) : nullptr;
}

int terminal_columns() {
    if (const char* const given = std::getenv("COLUMNS")) return std::atoi(given);
    CONSOLE_SCREEN_BUFFER_INFO info{};
    return ::GetConsoleScreenBufferInfo(::GetStdHandle(STD_OUTPUT_HANDLE), &info) ? info.dwSize.X : 0;
}

bool is_terminal(std::FILE* stream) {
    DWORD mode = 0;
    return ::GetConsoleMode(reinterpret_cast<HANDLE>(::_get_osfhandle(::_fileno(stream))), &mode);
}

void set_variable(const char* name, const char* value) {
    if (!std::getenv(name)) ::_putenv_s(name, value);
}

std::tm local_time(std::time_t moment) {
    std::tm local{};
    ::localtime_s(&local, &moment);
    return local;
}

}  // namespace strahl::os

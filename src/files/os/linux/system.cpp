#include "files/os/system.h"

#include <dlfcn.h>
#include <link.h>
#include <sys/ioctl.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

namespace strahl::os {

namespace fs = std::filesystem;

std::string program_file() { return "/proc/self/exe"; }

fs::path program_folder() {
    std::error_code error;
    return fs::read_symlink(program_file(), error).parent_path();
}

std::vector<fs::path> shared_folders() { return {"/usr/share", "/usr/local/share"}; }

std::vector<fs::path> loaded_libraries() {
    std::vector<fs::path> all;
    const auto add = [](dl_phdr_info* info, std::size_t, void* list) {
        static_cast<std::vector<fs::path>*>(list)->emplace_back(info->dlpi_name);
        return 0;
    };
    ::dl_iterate_phdr(add, &all);
    std::erase_if(all, [](const fs::path& path) { return !path.has_filename(); });  // the program itself
    return all;
}

const char* system_name() { return "Linux"; }

std::string system_needed() {
    utsname system{};
    ::uname(&system);
    return std::string("Linux on ") + system.machine + " with glibc " + std::to_string(__GLIBC__) + "." +
           std::to_string(__GLIBC_MINOR__) + " or later";
}

Library::Library(const std::string& path) : handle(::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
    if (!handle) why = ::dlerror();
}

void* Library::find(const char* name) const { return handle ? ::dlsym(handle, name) : nullptr; }

void prepare_streams() {}  // so they are on Linux

int terminal_columns() {
    if (const char* const given = std::getenv("COLUMNS")) return std::atoi(given);
    winsize size{};
    return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

bool is_terminal(std::FILE* stream) { return ::isatty(::fileno(stream)); }

void set_variable(const char* name, const char* value) { ::setenv(name, value, 0); }

std::tm local_time(std::time_t moment) {
    std::tm local{};
    ::localtime_r(&moment, &local);
    return local;
}

}  // namespace strahl::os

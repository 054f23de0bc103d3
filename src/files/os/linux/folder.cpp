#include "files/os/folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <system_error>
#include <utility>

#include "files/os/descriptor.h"

namespace strahl::os {

NewFolder::NewFolder(const std::string& start, std::vector<const char*> own_usual)
    : own_path(start + "XXXXXX"), usual(std::move(own_usual)) {
    if (!::mkdtemp(own_path.data())) throw std::system_error(errno, std::generic_category());
}

int NewFolder::become(const std::filesystem::path& target) {
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::chmod(own_path.c_str(), 0777 & ~mask);
    const Descriptor folder = ::open(own_path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (!folder || ::syncfs(folder.number) != 0) return errno;
    const unsigned how = std::filesystem::exists(target) ? RENAME_EXCHANGE : RENAME_NOREPLACE;
    return ::renameat2(AT_FDCWD, own_path.c_str(), AT_FDCWD, target.c_str(), how) == 0 ? 0 : errno;
}

int NewFolder::remove() {
    if (const Descriptor folder = ::open(own_path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC))
        for (const char* const file : usual) ::unlinkat(folder.number, file, 0);
    if (::rmdir(own_path.c_str()) == 0) return 0;
    // Not std::filesystem::remove_all, which ends the program if memory runs out.
    const auto remove = [](const char* name, const struct stat*, int, FTW*) { return std::remove(name); };
    return ::nftw(own_path.c_str(), remove, 16, FTW_DEPTH | FTW_PHYS) == 0 || errno == ENOENT ? 0 : errno;
}

bool is_empty_folder(const std::filesystem::path& path) {
    DIR* const listed = ::opendir(path.c_str());
    if (!listed && errno == ENOMEM) throw std::bad_alloc();
    if (!listed) return false;
    int entries = 0;
    while (::readdir(listed)) ++entries;
    ::closedir(listed);
    return entries == 2;  // "." and ".."
}

}  // namespace strahl::os

#include "files/regular_file.h"

#include <cerrno>
#include <system_error>

#include "files/error.h"

namespace strahl {

RegularFile::RegularFile(const std::string& path) : own_path(path), file(path, os::OpenFile::OpenMode::read) {
    if (!file) fail(errno == ENOENT ? "there is no such file" : std::generic_category().message(errno));
    const os::FileStatus status = file.status();
    if (status.error) fail(std::generic_category().message(status.error));
    if (!status.regular()) fail(status.folder() ? "it is a folder" : "it is not a regular file");
    own_size = status.size;
}

std::size_t RegularFile::read(std::uint64_t at, char* to, std::size_t count) const {
    if (const int error = file.read(at, to, count)) fail(std::generic_category().message(error));
    return count;
}

std::string RegularFile::bytes(std::uint64_t at, std::size_t count) const {
    std::string part(count, '\0');
    part.resize(read(at, part.data(), count));
    return part;
}

void RegularFile::fail(const std::string& why) const { throw FileError("cannot read '" + own_path + "': " + why); }

}  // namespace strahl

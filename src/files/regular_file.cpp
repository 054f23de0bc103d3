#include "files/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "scene/error.h"

namespace strahl {

RegularFile::RegularFile(const std::string& path)
    : own_path(path), descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (descriptor < 0) fail(errno == ENOENT ? "there is no such file" : std::generic_category().message(errno));
    struct stat status {};
    std::string fault;
    if (::fstat(descriptor, &status) != 0)
        fault = std::generic_category().message(errno);
    else if (!S_ISREG(status.st_mode))
        fault = S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file";
    own_size = static_cast<std::uint64_t>(status.st_size);
    if (fault.empty()) return;
    ::close(descriptor);
    fail(fault);
}
RegularFile::~RegularFile() { ::close(descriptor); }

std::size_t RegularFile::read(std::uint64_t at, char* to, std::size_t count) const {
    for (std::size_t done = 0; done < count;) {
        const ssize_t got = ::pread(descriptor, to + done, count - done, static_cast<off_t>(at + done));
        if (got < 0 && errno != EINTR) fail(std::generic_category().message(errno));
        if (got == 0) return done;
        if (got > 0) done += static_cast<std::size_t>(got);
    }
    return count;
}

std::string RegularFile::bytes(std::uint64_t at, std::size_t count) const {
    std::string part(count, '\0');
    part.resize(read(at, part.data(), count));
    return part;
}

void RegularFile::fail(const std::string& why) const { throw FileError("cannot read '" + own_path + "': " + why); }

}  // namespace strahl

#include "files/os/linux/confine.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "files/os/descriptor.h"

namespace strahl::os {
namespace {

constexpr std::uint64_t all_writing = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                                      LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                                      LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                                      LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                                      LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;

/// Adds to the rules that `access` is allowed at a path and below it.
bool allow(const Descriptor& rules, const char* path, std::uint64_t access) {
    const Descriptor place = ::open(path, O_PATH | O_CLOEXEC);
    const landlock_path_beneath_attr rule{access, place.number};
    return ::syscall(SYS_landlock_add_rule, rules.number, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
}

}  // namespace

void write_only_below(const std::string& folder) {
    landlock_ruleset_attr handled{};
    handled.handled_access_fs = all_writing;
    const Descriptor rules = int(::syscall(SYS_landlock_create_ruleset, &handled, sizeof handled.handled_access_fs, 0));
    if (rules && allow(rules, folder.c_str(), all_writing) &&
        allow(rules, "/dev/null", LANDLOCK_ACCESS_FS_WRITE_FILE) && ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
        ::syscall(SYS_landlock_restrict_self, rules.number, 0) == 0)
        return;
    throw std::runtime_error(
        std::string("POV-Ray is not started: nothing here would keep the scene from writing files with it "
                    "(Landlock, in Linux from 5.13 on: ") +
        std::strerror(errno) + ")");
}

}  // namespace strahl::os

// Files are written whole or not at all.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <new>
#include <system_error>
#include <vector>

#include "files/os/folder.h"
#include "files/output_file.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"

namespace {

/// Calls on files, in order: "sync 3 bytes", "rename", "sync folder"; and the number of the sync that fails.
std::vector<std::string> events;
int failing_sync = 0;
bool deadly_sync = false;
std::size_t most_memory = -1;  // that can be had in one piece

}  // namespace

// These replace the C library's functions.
extern "C" int fsync(int file) {
    struct stat status {};
    ::fstat(file, &status);
    events.push_back(S_ISDIR(status.st_mode) ? "sync folder" : "sync " + std::to_string(status.st_size) + " bytes");
    if (deadly_sync) ::raise(SIGKILL);
    if (failing_sync > 0 && --failing_sync == 0) return errno = EIO, -1;
    return static_cast<int>(::syscall(SYS_fsync, file));
}
extern "C" int rename(const char* from, const char* to) noexcept {
    events.push_back("rename");
    return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

[[gnu::noinline]] void* operator new(std::size_t size) {
    if (size > most_memory) throw std::bad_alloc();
    if (void* const p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace strahl {
namespace {

mode_t mode_of(const std::string& path) {
    struct stat status {};
    REQUIRE(::stat(path.c_str(), &status) == 0);
    return status.st_mode & 07777;
}

std::string fault_in(const std::string& path, const std::string& bytes = "new") {
    return fault_of([&] { write_file(path, bytes); });
}

/// Lets files grow to no more than `bytes` while it lives.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &old_limit);
        const rlimit limit{bytes, old_limit.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &old_limit); }

  private:
    rlimit old_limit{};
};

TEST_CASE("a file holds the bytes, and no other file is left in the folder") {
    const Scratch folder;
    const std::string bytes("a\0b\n\xff", 5);
    write_file(folder / "new", "older and longer");
    write_file(folder / "new", bytes);
    CHECK(bytes_of(folder / "new") == bytes);
    write_file(folder / "empty", "");
    CHECK(bytes_of(folder / "empty").empty());
    CHECK(folder.files() == 2);
}

TEST_CASE("an older file survives a write that fails halfway") {
    const Scratch folder;
    write_file(folder / "file", "old");
    std::string fault;
    {
        const FileSizeLimit limit(1000);
        fault = fault_in(folder / "file", std::string(100000, 'x'));
    }
    CHECK(says(fault, folder / "file"));
    CHECK(says(fault, "File too large"));
    CHECK(bytes_of(folder / "file") == "old");
    CHECK(folder.files() == 1);
}

TEST_CASE("permissions: the umask's for a new file, unchanged for an old one, and respected") {
    const Scratch folder;
    const mode_t umask = ::umask(027);
    write_file(folder / "new", "x");
    ::umask(umask);
    CHECK(mode_of(folder / "new") == 0640);
    ::chmod((folder / "new").c_str(), 0604);
    write_file(folder / "new", "y");
    CHECK(mode_of(folder / "new") == 0604);
    ::chmod((folder / "new").c_str(), 0400);
    if (::geteuid() != 0) {  // root may write everything
        CHECK(says(fault_in(folder / "new"), "Permission denied"));
        CHECK(bytes_of(folder / "new") == "y");
    }
}

TEST_CASE("bytes are on the disk before they get the name, and the name before the call returns") {
    const Scratch folder;
    for (const char* older : {"none", "one"}) {
        CAPTURE(older);
        events.clear();
        write_file(folder / "file", "new");
        CHECK(events == std::vector<std::string>{"sync 3 bytes", "rename", "sync folder"});
    }
    for (const int sync : {1, 2}) {
        failing_sync = sync;
        CHECK(says(fault_in(folder / "file", "newer"), "Input/output error"));
        CHECK(failing_sync == 0);
        CHECK(bytes_of(folder / "file") == (sync == 1 ? "new" : "newer"));
    }
    CHECK(folder.files() == 1);
}

TEST_CASE("a program that is killed leaves no file behind, where the file system knows files without names") {
    const Scratch folder;
    const int nameless = ::open((folder / "").c_str(), O_WRONLY | O_TMPFILE, 0600);
    if (nameless < 0) return;
    ::close(nameless);
    write_file(folder / "file", "old");
    const pid_t child = ::fork();
    if (child == 0) {
        deadly_sync = true;
        write_file(folder / "file", "new");
        ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
    CHECK(bytes_of(folder / "file") == "old");
    CHECK(folder.files() == 1);
}

TEST_CASE("set-user-ID is not handed on to other bytes, and the owner keeps the file") {
    const Scratch folder;
    write_file(folder / "file", "x");
    const uid_t owner = ::geteuid() == 0 ? 65534 : ::geteuid();
    REQUIRE(::chown((folder / "file").c_str(), owner, -1) == 0);
    ::chmod((folder / "file").c_str(), 06755);
    write_file(folder / "file", "y");
    CHECK(mode_of(folder / "file") == 0755);
    struct stat status {};
    ::stat((folder / "file").c_str(), &status);
    CHECK(status.st_uid == owner);
}

TEST_CASE("all names of a file show the new bytes, and a failure leaves it its older ones") {
    const Scratch folder;
    write_file(folder / "one", "old");
    std::filesystem::create_hard_link(folder / "one", folder / "two");
    for (const std::string bytes : {"longer than before", "less", ""}) {
        write_file(folder / "one", bytes);
        CHECK(bytes_of(folder / "two") == bytes);
    }
    write_file(folder / "one", "old");
    CHECK(std::filesystem::hard_link_count(folder / "one") == 2);
    {
        const FileSizeLimit limit(1000);
        CHECK(says(fault_in(folder / "one", std::string(100000, 'x')), "File too large"));
    }
    CHECK(bytes_of(folder / "two") == "old");
    CHECK(folder.files() == 2);
    most_memory = 100000;
    CHECK_THROWS_AS(write_file(folder / "one", "longer than before"), const std::bad_alloc&);
    most_memory = -1;
    CHECK(bytes_of(folder / "two") == "old");
    CHECK(folder.files() == 2);
    failing_sync = 2;  // of the folder with the copy: until that is on the disk, nothing is overwritten
    CHECK(says(fault_in(folder / "one", "new"), "Input/output error"));
    CHECK(bytes_of(folder / "two") == "old");
    CHECK(folder.files() == 2);
    events.clear();
    write_file(folder / "one", "newer");
    CHECK(events == std::vector<std::string>{"sync 5 bytes", "sync folder", "sync 5 bytes", "sync folder"});
    failing_sync = 3;  // of the file in place: what it holds is no longer certain
    const std::string fault = fault_in(folder / "one", "new");
    CHECK(says(fault, "all of it is in '" + (folder / ".strahl-")));
    const std::string copy = fault.substr(fault.rfind(".strahl-"), fault.rfind('\'') - fault.rfind(".strahl-"));
    CHECK(bytes_of(folder / copy) == "new");
    write_file(folder / "three", "x");
    CHECK(bytes_of(folder / copy) == "new");
}

TEST_CASE("what killed programs left is removed, what others are writing is not") {
    const Scratch folder;
    const auto make = [&](const char* name) { std::ofstream(folder / name) << "half"; };
    make(".strahl-1-0.tmp"), make(".strahl-2-0.tmp"), make(".strahl-3-0.copy"), make("file.tmp");
    std::filesystem::create_directory(folder / ".strahl-4-0.tmp");
    std::filesystem::create_symlink("file.tmp", folder / ".strahl-5-0.tmp");
    const int writing = ::open((folder / ".strahl-2-0.tmp").c_str(), O_WRONLY);
    REQUIRE(::flock(writing, LOCK_EX) == 0);
    write_file(folder / "file", "new");
    CHECK(folder.files() == 6);
    CHECK_FALSE(std::filesystem::exists(folder / ".strahl-1-0.tmp"));
    ::close(writing);
    write_file(folder / "file", "newer");
    CHECK(folder.files() == 5);
    CHECK_FALSE(std::filesystem::exists(folder / ".strahl-2-0.tmp"));
    CHECK(bytes_of(folder / "file.tmp") == "half");
}

TEST_CASE("symbolic links stay links") {
    const Scratch folder;
    std::filesystem::create_directory(folder / "deep");
    std::filesystem::create_symlink("deep/target", folder / "one");  // dangling at first
    std::filesystem::create_symlink("one", folder / "two");
    for (const std::string bytes : {"first", "second"}) {
        write_file(folder / "two", bytes);
        CHECK(bytes_of(folder / "deep/target") == bytes);
        CHECK(std::filesystem::is_symlink(folder / "one"));
        CHECK(std::filesystem::is_symlink(folder / "two"));
    }
    std::filesystem::create_symlink("circle", folder / "circle");
    CHECK_FALSE(fault_in(folder / "circle").empty());
}

TEST_CASE("devices and pipes are written to, not replaced") {
    write_file("/dev/null", "x");
    CHECK(std::filesystem::is_character_file("/dev/null"));
    CHECK(says(fault_in("/dev/full"), "No space left"));
    CHECK(std::filesystem::is_character_file("/dev/full"));
}

TEST_CASE("impossible paths are reported with advice") {
    const Scratch folder;
    CHECK(says(fault_in(folder / "no/file"), "folder does not exist"));
    CHECK(says(fault_in(folder / ""), "it is a folder"));
    write_file(folder / "file", "old");
    CHECK(says(fault_in(folder / "file/below"), "Not a directory"));
    CHECK(says(fault_in(folder / std::string(300, 'x')), "name too long"));
    CHECK_FALSE(fault_in("").empty());
    CHECK(folder.files() == 1);
}

TEST_CASE("a folder is removed with all that is in it, and links are not followed") {
    const Scratch folder;
    os::NewFolder made(folder / "a");
    CHECK(::mkdir((made.path() + "/b").c_str(), 0700) == 0);
    write_file(made.path() + "/b/file", "bytes");
    write_file(folder / "kept", "bytes");
    CHECK(::symlink("../kept", (made.path() + "/link").c_str()) == 0);
    CHECK(made.remove() == 0);
    CHECK(folder.files() == 1);
    CHECK(made.remove() == 0);  // nothing is left of it
    CHECK_THROWS_AS(os::NewFolder(folder / "none/a"), std::system_error);
}

TEST_CASE("- is standard output") {
    const Scratch folder;
    std::fflush(stdout);
    const int saved = ::dup(STDOUT_FILENO);
    const int file = ::open((folder / "out").c_str(), O_WRONLY | O_CREAT, 0600);
    ::dup2(file, STDOUT_FILENO);
    std::fputs("before ", stdout);
    write_file("-", "bytes");
    ::dup2(saved, STDOUT_FILENO);
    ::close(file), ::close(saved);
    CHECK(bytes_of(folder / "out") == "before bytes");
}

}  // namespace
}  // namespace strahl

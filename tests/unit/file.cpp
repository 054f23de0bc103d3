// Files are written whole or not at all.
#include "text/file.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "scratch.h"

namespace strahl {
namespace {

mode_t mode_of(const std::string& path) {
    struct stat status {};
    REQUIRE(::stat(path.c_str(), &status) == 0);
    return status.st_mode & 07777;
}

std::string fault_of(const std::string& path, const std::string& bytes = "new") {
    try {
        write_file(path, bytes);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Lets files grow to no more than `bytes` while it lives.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &old_limit);
        const rlimit limit{bytes, old_limit.rlim_max};
        old_action = std::signal(SIGXFSZ, SIG_IGN);
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &old_limit);
        std::signal(SIGXFSZ, old_action);
    }

  private:
    rlimit old_limit{};
    void (*old_action)(int) = SIG_DFL;
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
        fault = fault_of(folder / "file", std::string(100000, 'x'));
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
        CHECK(says(fault_of(folder / "new"), "Permission denied"));
        CHECK(bytes_of(folder / "new") == "y");
    }
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
    CHECK_FALSE(fault_of(folder / "circle").empty());
}

TEST_CASE("devices and pipes are written to, not replaced") {
    write_file("/dev/null", "x");
    CHECK(std::filesystem::is_character_file("/dev/null"));
    CHECK(says(fault_of("/dev/full"), "No space left"));
    CHECK(std::filesystem::is_character_file("/dev/full"));
}

TEST_CASE("impossible paths are reported with advice") {
    const Scratch folder;
    CHECK(says(fault_of(folder / "no/file"), "folder does not exist"));
    CHECK(says(fault_of(folder / ""), "it is a folder"));
    write_file(folder / "file", "old");
    CHECK(says(fault_of(folder / "file/below"), "Not a directory"));
    CHECK(says(fault_of(folder / std::string(300, 'x')), "name too long"));
    CHECK_FALSE(fault_of("").empty());
    CHECK(folder.files() == 1);
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

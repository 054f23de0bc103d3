// Children of this process: they read from a socket, and print into a file in memory.
#include "files/os/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "files/os/linux/confine.h"

namespace strahl::os {
namespace {

/// Starts a program that reads `input` and prints into `output`. Returns an errno, or 0.
int spawn(pid_t& child, const ProgramStart& start, int input, int output) {
    std::vector<std::string> words = start.words;
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    if (start.own_session) posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    // These calls can run out of memory, and without them the program would read what the user types, or write into
    // another folder.
    const bool ready =
        (start.folder.empty() || posix_spawn_file_actions_addchdir_np(&files, start.folder.c_str()) == 0) &&
        posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO) == 0 &&
        posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO) == 0 &&
        posix_spawn_file_actions_adddup2(&files, output, STDERR_FILENO) == 0;
    const int error =
        ready ? posix_spawnp(&child, arguments[0], &files, &attributes, arguments.data(), environ) : ENOMEM;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

/// Does the same from a thread that can write only where the program may.
int spawn_confined(pid_t& child, const ProgramStart& start, int input, int output) {
    int error = 0;
    std::exception_ptr fault;
    std::thread([&] {
        try {
            write_only_below(start.writable);
            error = spawn(child, start, input, output);
        } catch (...) {
            fault = std::current_exception();
        }
    }).join();
    if (fault) std::rethrow_exception(fault);
    return error;
}

}  // namespace

Process::Process(const ProgramStart& start) : printed(::memfd_create("printed", MFD_CLOEXEC)) {
    int pair[2];
    if (!printed || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
        throw std::system_error(errno, std::generic_category());
    input = pair[0];
    const Descriptor theirs = pair[1];
    const int error = (start.writable.empty() ? spawn : spawn_confined)(process, start, theirs.number, printed.number);
    if (error) throw std::system_error(error, std::generic_category());
}

Process::~Process() {
    if (process > 0) ::kill(process, SIGKILL);
    wait();
}

bool Process::send(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(input.number, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

int Process::wait(const std::atomic<bool>* stop) {
    input = {};
    while (process > 0) {
        // A signal may reach another thread, and would then not end a wait in this one.
        const pid_t ended = ::waitpid(process, &status, stop ? WNOHANG : 0);
        if (ended > 0 || (ended < 0 && errno != EINTR)) process = 0;
        if (ended == 0 && *stop) ::kill(process, SIGKILL), stop = nullptr;
        if (ended == 0 && stop) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

std::string Process::output() const {
    std::string text(static_cast<std::size_t>(::lseek(printed.number, 0, SEEK_END)), '\0');
    text.resize(static_cast<std::size_t>(::pread(printed.number, text.data(), text.size(), 0)));
    return text;
}

std::string confinement_fault() { return ""; }  // whether the kernel can do it, it says when asked

bool start_apart(const std::vector<std::string>& words) try {
    // The shell starts it in the background and ends at once, so that nobody has to wait for it.
    const char* const script =
        "command -v \"$1\" >/dev/null || exit 1; trap '' HUP; \"$@\" </dev/null >/dev/null 2>&1 &";
    std::vector<std::string> all{"sh", "-c", script, "sh"};
    all.insert(all.end(), words.begin(), words.end());
    return Process({.words = std::move(all), .own_session = true}).wait() == 0;
} catch (const std::system_error&) {
    return false;
}

std::string find_program(const std::string& name) {
    const char* const path = std::getenv("PATH");
    std::string_view folders = path ? path : "/usr/bin:/bin";
    while (true) {
        const std::string folder(folders.substr(0, folders.find(':')));
        const std::string program = (folder.empty() ? "." : folder) + "/" + name;
        if (::access(program.c_str(), X_OK) == 0) return program;
        if (folder.size() == folders.size()) return "";
        folders.remove_prefix(folder.size() + 1);
    }
}

}  // namespace strahl::os

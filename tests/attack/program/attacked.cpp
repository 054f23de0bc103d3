#include "attacked.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace strahl::attack {
namespace {

namespace fs = std::filesystem;

/// Stands for a folder where the bytes of a file are expected.
const std::string a_folder = "a folder";

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Prints where the child waits to standard error, if gdb is installed.
void show_stacks(pid_t child) {
    const std::string command = "gdb -batch -ex 'thread apply all bt' -p " + std::to_string(child) + " >&2 2>/dev/null";
    if (std::system(command.c_str()) != 0) std::fprintf(stderr, "no stacks: no gdb\n");
}

/// Waits until the child ends, or kills it when the time is up. Returns its status as Ran has it. A library that came
/// to harm may hang, and is not waited for so long.
int wait_for(pid_t child, double seconds, const Control& control) {
    const int ended = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
    const auto goes_on_after = [&](double time) {
        pollfd wait{ended, POLLIN, 0};
        const timespec left{static_cast<time_t>(time), static_cast<long>(1e9 * (time - std::floor(time)))};
        return ::ppoll(&wait, 1, &left, nullptr) == 0;
    };
    const double at_first = std::min(seconds, longest / 4);
    const bool late = goes_on_after(at_first) && (control.foreign || goes_on_after(seconds - at_first));
    if (late && seconds >= longest && !control.foreign) show_stacks(child);
    if (late) ::kill(child, SIGKILL);
    ::close(ended);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (late && WIFSIGNALED(status)) return -1000;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

Files files_in(const fs::path& folder) {
    Files files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        files[entry.path().lexically_relative(folder).string()] =
            entry.is_regular_file() ? bytes_of(entry.path()) : a_folder;
    return files;
}

void put(const Files& files, const fs::path& folder) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const auto& [name, bytes] : files) {
        if (bytes == a_folder) {
            fs::create_directory(folder / name);
            continue;
        }
        std::ofstream(folder / name, std::ios::binary) << bytes;
        if (bytes.starts_with("#!")) fs::permissions(folder / name, fs::perms::owner_all);
    }
}

Attacker::Attacker(std::string tried, std::string preloaded)
    : program(fs::absolute(tried)),
      library(fs::absolute(preloaded)),
      work(fs::absolute("work")),
      control_path(fs::absolute("control")) {
    const int file = ::open(control_path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0 || ::ftruncate(file, sizeof(Control)) != 0)
        throw std::runtime_error("no file " + control_path.string());
    orders = static_cast<Control*>(::mmap(nullptr, sizeof(Control), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
    ::close(file);
}

void Attacker::order(Watched watched, long at, Harm harm, int error) {
    control().watched = watched, control().at = at, control().harm = harm, control().error = error;
}

Ran Attacker::run(const Case& attacked, double seconds, bool preloaded) {
    for (std::atomic<long>& count : control().counts) count = 0;
    control().done = 0, control().foreign = false, control().where[0] = 0, control().attached = false;
    if (control().finds_paths) std::ranges::for_each(control().paths, [](Path& path) { path.hash = 0; });
    std::vector<char*> words{program.data()};
    std::vector<std::string> own = attacked.words;
    for (std::string& word : own) words.push_back(word.data());
    words.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("fork fails");
    if (child == 0) {
        const rlimit no_core{0, 0};
        ::setrlimit(RLIMIT_CORE, &no_core);
        const int none = ::open("/dev/null", O_RDONLY), out = ::open("out", O_WRONLY | O_CREAT | O_TRUNC, 0600),
                  err = ::open("err", O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(none, 0), ::dup2(out, 1), ::dup2(err, 2);
        if (::chdir(work.c_str()) != 0) ::_exit(127);
        ::personality(ADDR_NO_RANDOMIZE);  // so that paths of calls are the same in all runs, where that is allowed
        ::setenv("TMPDIR", work.c_str(), 1);
        ::setenv("PATH", (work.string() + ":/usr/bin:/bin").c_str(), 1);
        // A library behind the pictures starts a thread for each processor, which takes half of the time of such a run.
        if (control().watched != Watched::threads) ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
        // A sanitizer wants to be the first library, and a failed allocation to be an error of ours.
        ::setenv("ASAN_OPTIONS", "verify_asan_link_order=0:allocator_may_return_null=1:detect_leaks=0", 1);
        if (preloaded) ::setenv(control_variable, control_path.c_str(), 1), ::setenv("LD_PRELOAD", library.c_str(), 1);
        if (!log.empty()) ::setenv(log_variable, log.c_str(), 1);
        ::execv(program.c_str(), words.data());
        ::_exit(127);
    }
    Ran ran;
    ran.status = wait_for(child, seconds, control());
    if (preloaded && !control().attached) throw std::runtime_error("the library is not preloaded");
    ran.out = bytes_of("out"), ran.err = bytes_of("err"), ran.files = files_in(work);
    return ran;
}

void Attacker::record(const std::string& path) {
    log = path.empty() ? fs::path() : fs::absolute(path);
    if (!path.empty()) std::ofstream(log, std::ios::trunc);
}

std::vector<Case> Attacker::completed(std::vector<Case> all) {
    for (Case& attacked : all) {
        put(attacked.before, work);
        for (const std::vector<std::string>& words : attacked.first)
            attacked.before = run({.name = attacked.name, .words = words, .before = {}}, longest, false).files;
    }
    return all;
}

void Attacker::prepare(const Case& attacked) const {
    put(attacked.before, work);
    if (attacked.hard_link) fs::create_hard_link(work / "picture.bmp", work / "other.bmp");
}

Ran Attacker::run_fresh(const Case& attacked) {
    prepare(attacked);
    return run(attacked);
}

}  // namespace strahl::attack

#include "attacked.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace strahl::attack {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Waits until the child ends, or kills it when the time is up. Returns its status as Ran has it.
int wait_for(pid_t child, double seconds) {
    const int ended = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
    pollfd wait{ended, POLLIN, 0};
    timespec left{static_cast<time_t>(seconds),
                  static_cast<long>(1e9 * (seconds - static_cast<double>(time_t(seconds))))};
    const bool late = ::ppoll(&wait, 1, &left, nullptr) == 0;
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
            entry.is_regular_file() ? bytes_of(entry.path()) : "a folder";
    return files;
}

void put(const Files& files, const fs::path& folder) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const auto& [name, bytes] : files) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        if (name == "povray") fs::permissions(folder / name, fs::perms::owner_all);
    }
}

Attacker::Attacker(std::string tried, std::string preloaded)
    : program(std::move(tried)),
      library(std::move(preloaded)),
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
    control().count = 0, control().done = 0, control().foreign = false, control().where[0] = 0;
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
        ::setenv("TMPDIR", work.c_str(), 1);
        ::setenv("PATH", (work.string() + ":/usr/bin:/bin").c_str(), 1);
        // A library behind the pictures starts a thread for each processor, which takes half of the time of such a run.
        if (control().watched != Watched::threads) ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
        // A sanitizer wants to be the first library, and a failed allocation to be an error of ours.
        ::setenv("ASAN_OPTIONS", "verify_asan_link_order=0:allocator_may_return_null=1:detect_leaks=0", 1);
        if (preloaded) ::setenv(control_variable, control_path.c_str(), 1), ::setenv("LD_PRELOAD", library.c_str(), 1);
        ::execv(program.c_str(), words.data());
        ::_exit(127);
    }
    Ran ran;
    ran.status = wait_for(child, seconds);
    ran.out = bytes_of("out"), ran.err = bytes_of("err"), ran.files = files_in(work);
    return ran;
}

Ran Attacker::run_fresh(const Case& attacked) {
    put(attacked.before, work);
    if (attacked.hard_link) fs::create_hard_link(work / "picture.bmp", work / "other.bmp");
    return run(attacked);
}

bool whole(const std::string& name, const std::string& bytes, const Files& before, const Files& good) {
    const auto old = before.find(name), done = good.find(name);
    if (old != before.end() && bytes == old->second) return true;
    if (done == good.end()) return false;
    // Statistics hold times.
    return name.ends_with(".json") ? bytes.starts_with("{") && bytes.ends_with("}\n") : bytes == done->second;
}

std::string verdict(const Case& attacked, const Ran& good, const Ran& ran, const Control& control) {
    const bool kill = control.done && control.harm != Harm::error && control.harm != Harm::cut;
    if (ran.status == -1000) return "it did not end within 20 s";
    const bool died = ran.status < 0 && control.foreign;  // in somebody else's code
    if (!kill && !died && (ran.status < 0 || ran.status > 3))
        return ran.status < 0 ? "it was ended by signal " + std::to_string(-ran.status)
                              : "exit status " + std::to_string(ran.status);
    if (ran.status > 0 && ran.err.empty()) return "no message";
    for (const char* word : {"Sanitizer", "runtime error:"})
        if (ran.err.find(word) != std::string::npos) return "a sanitizer's report";
    if (ran.status == 0 && !attacked.times && ran.out != good.out) return "done, but it printed something else";

    const bool unlink_failed = std::string_view(control.where).starts_with("unlink");
    Files before = attacked.before;
    if (attacked.hard_link) before["other.bmp"] = before["picture.bmp"];
    for (const auto& [name, bytes] : before)
        if (!ran.files.contains(name)) return name + " is gone";
    for (const auto& [name, bytes] : good.files) {
        const auto found = ran.files.find(name);
        if (ran.status == 0 && (found == ran.files.end() || !whole(name, found->second, {}, good.files)))
            return "done, but " + name + " is not there or not whole";
    }
    // Of a file with several names, overwritten in place, a copy is whole whenever the file itself is not.
    bool copied = false;
    for (const auto& [name, bytes] : ran.files)
        copied |= name.ends_with(".copy") && bytes == good.files.at("picture.bmp");
    for (const auto& [name, bytes] : ran.files) {
        if (whole(name, bytes, before, good.files)) continue;
        if (name.starts_with(".strahl-") && (unlink_failed || kill || copied)) continue;
        if (copied && (name == "picture.bmp" || name == "other.bmp") &&
            (kill || ran.err.find("all of it is in '.strahl-") != std::string::npos))
            continue;
        if (kill && name.starts_with("strahl-povray-")) continue;
        return name + " should not be there, or is not whole";
    }
    return "";
}

}  // namespace strahl::attack

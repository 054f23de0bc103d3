// Workers that read spoilt files, and the process that watches them.
#include "tests/attack/file_attack.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>

#include "files/error.h"
#include "tests/attack/options.h"
#include "tests/unit/scratch.h"

namespace strahl {
namespace {

constexpr double most_seconds = 5, most_megabytes = 1000;
constexpr int files_of_a_worker = 20000, too_much_memory = 3;

using attack::now;

/// Memory that the worker shares with the process that watches it.
struct Shared {
    std::atomic<std::uint64_t> number, read;
    std::atomic<double> begun, slowest, largest;  // begun is 0 between two files
    std::size_t size;                             // of the file it came to
    char bytes[1 << 18];
};

/// The most memory so far, in MB. (Address space is more: OpenEXR reserves up to 2 GB for a forged header and then
/// finds nothing to put there.)
double memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

/// A file in memory, which is read by name; a name with another ending is a link to it.
class MemoryFile {
  public:
    explicit MemoryFile(const FileAttack& attack)
        : attack(attack), file(::memfd_create(attack.what, MFD_CLOEXEC)), name(folder / attack.what) {
        if (file < 0) throw std::runtime_error("no file in memory");
        for (const char* ending : attack.endings)
            if (::symlink(("/proc/self/fd/" + std::to_string(file)).c_str(), (name + ending).c_str()) != 0)
                throw std::runtime_error("no link to the file in memory");
    }
    /// Can it be read by one of its names?
    bool read(const std::string& bytes) const {
        if (::ftruncate(file, 0) != 0 || ::pwrite(file, bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
            throw std::runtime_error("the file in memory cannot be written");
        bool is_read = false;
        for (const char* ending : attack.endings) try {
                attack.read(name + ending);
                is_read = true;
            } catch (const FileError&) {
            }
        return is_read;
    }

  private:
    const FileAttack& attack;
    const Scratch folder;
    int file;
    std::string name;
};

/// Reads the file of one number, and prints time and memory.
int read_alone(const FileAttack& attack, std::uint64_t number, bool write) {
    const std::vector<std::string> valid = attack.valid();
    const std::string bytes = attack.mutated(valid, number);
    if (write) return std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size();
    const MemoryFile file(attack);
    for (const std::string& one : valid) file.read(one);
    const double before = memory(), start = now();
    const bool is_read = file.read(bytes);
    std::printf("%s in %.3f s, %.0f MB\n", is_read ? "read" : "refused", now() - start, memory() - before);
    return 0;
}

/// The worker. It makes the valid files too: the picture library's threads do not survive a fork.
[[noreturn]] void work(const FileAttack& attack, const MemoryFile& file, Shared& shared, double end) {
    const std::vector<std::string> valid = attack.valid();
    for (const std::string& one : valid)
        if (!file.read(one)) std::fprintf(stderr, "a valid %s is refused\n", attack.what), std::_Exit(1);
    const double before = memory();
    for (int i = 0; i < files_of_a_worker && now() < end; ++i, ++shared.number) {
        const std::string bytes = attack.mutated(valid, shared.number);
        shared.size = bytes.copy(shared.bytes, sizeof shared.bytes);
        shared.begun = now();
        shared.read += file.read(bytes);
        shared.slowest = std::max<double>(shared.slowest, now() - shared.begun);
        const double needed = memory() - before;
        shared.largest = std::max<double>(shared.largest, needed);
        if (needed > most_megabytes) std::_Exit(too_much_memory);
        shared.begun = 0;
    }
    std::_Exit(0);
}

/// Waits until the worker ends or takes too long; returns the fault of the file it was reading, or "".
std::string watch(pid_t worker, const Shared& shared) {
    int status = 0;
    while (::waitpid(worker, &status, WNOHANG) == 0) {
        const double begun = shared.begun;
        if (begun > 0 && now() - begun > most_seconds) {
            ::kill(worker, SIGKILL), ::waitpid(worker, &status, 0);
            return "took more than 5 s";
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (WIFSIGNALED(status)) return std::string("killed its reader: ") + ::strsignal(WTERMSIG(status));
    const int code = WEXITSTATUS(status);
    if (code == too_much_memory) return "took more than 1 GB";
    return code == 0 ? "" : "ended its reader with status " + std::to_string(code);
}

int attack_all(const FileAttack& attack, std::uint64_t first, double seconds) {
    void* const memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return std::perror("mmap"), 1;
    Shared& shared = *new (memory) Shared{};
    shared.number = first;
    const MemoryFile file(attack);
    const double end = now() + seconds;
    int faults = 0;
    do {
        const pid_t worker = ::fork();
        if (worker < 0) return std::perror("fork"), 1;
        if (worker == 0) work(attack, file, shared, end);
        const std::string fault = watch(worker, shared);
        if (fault.empty()) continue;
        ++faults;
        const std::string name = std::string(attack.what) + "-" + std::to_string(shared.number);
        std::fprintf(stderr, "%s %s\n", name.c_str(), fault.c_str());
        std::ofstream(name, std::ios::binary).write(shared.bytes, static_cast<std::streamsize>(shared.size));
        shared.begun = 0;
        ++shared.number;
    } while (now() < end);
    std::printf("%llu files, %llu of them readable, %d faults, %.2f s the slowest, %.0f MB the largest\n",
                static_cast<unsigned long long>(shared.number - first), static_cast<unsigned long long>(shared.read),
                faults, shared.slowest.load(), shared.largest.load());
    return faults > 0;
}

}  // namespace

int run_attack(const FileAttack& attack, int count, char** arguments) {
    attack::Options options(count, arguments);
    const bool write = options.take("--write");
    refuse(options, "attack_" + std::string(attack.what) + "s");
    return options.alone ? read_alone(attack, options.number, write)
                         : attack_all(attack, options.number, options.seconds);
}

}  // namespace strahl

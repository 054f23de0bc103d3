#include "povref/compare/run_povray.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <regex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

#include "files/output_file.h"
#include "files/read_file.h"
#include "files/streams.h"
#include "num/decimal.h"
#include "povref/compare/confine.h"
#include "povref/convert/images.h"

extern char** environ;

namespace strahl {
namespace {

namespace fs = std::filesystem;

/// A temporary folder, in the one that TMPDIR names or else in /tmp; removed with its content.
class Scratch {
  public:
    Scratch() {
        const char* const given = std::getenv("TMPDIR");
        const bool named = given && given[0] != 0;
        const std::string parent = named ? given : "/tmp";
        folder = parent + "/strahl-povray-XXXXXX";
        if (::mkdtemp(folder.data())) return;
        throw std::runtime_error("cannot make a folder in '" + parent + (named ? "', which TMPDIR names: " : "': ") +
                                 std::strerror(errno));
    }
    /// Removes the files that are always there without needing memory, or a folder that can be listed; others need
    /// both.
    ~Scratch() {
        const int opened = ::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
        for (const char* const file : {"scene.pov", "scene.ini", "view.pov", "scene.ppm", "log"})
            ::unlinkat(opened, file, 0);
        ::close(opened);
        if (::rmdir(folder.c_str()) != 0) remove_folder(folder);
    }
    Scratch(const Scratch&) = delete;
    std::string path(const char* name) const { return folder + "/" + name; }

  private:
    std::string folder;
};

/// A program's folder, and if given the one below which it can write files.
struct Place {
    std::string folder, writable{};
};

/// Starts a program as posix_spawnp does, from a thread that can write only where the program may.
int spawn(pid_t& child, const Place& place, const posix_spawn_file_actions_t& files, std::vector<char*>& arguments) {
    int failed = 0;
    const auto start = [&] { failed = posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environ); };
    if (place.writable.empty()) return start(), failed;
    std::exception_ptr fault;
    std::thread([&] {
        try {
            write_only_below(place.writable);
            start();
        } catch (...) {
            fault = std::current_exception();
        }
    }).join();
    if (fault) std::rethrow_exception(fault);
    return failed;
}

/// Runs `words` in a place, with all output in the file `log`. Returns the exit status, or -1 if there is no such
/// program.
int run(std::vector<std::string> words, const Place& place, const std::string& log, const std::atomic<bool>* stop) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    // These calls can run out of memory, and without the first one POV-Ray would write into the user's folder.
    const bool ready =
        posix_spawn_file_actions_addchdir_np(&files, place.folder.c_str()) == 0 &&
        posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0) == 0 &&
        posix_spawn_file_actions_addopen(&files, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600) == 0 &&
        posix_spawn_file_actions_adddup2(&files, 1, 2) == 0;
    pid_t child = 0;
    const int failed = ready ? spawn(child, place, files, arguments) : ENOMEM;
    posix_spawn_file_actions_destroy(&files);
    if (failed == ENOENT) return -1;
    if (failed == ENOMEM) throw std::bad_alloc();
    if (failed) throw std::runtime_error("cannot start povray: " + std::generic_category().message(failed));
    int status = 0;
    // A signal may reach another thread, and would then not end a wait in this one.
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (stop && *stop) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (stop && *stop) throw Stopped{};
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

std::string content(const std::string& path) {
    TextStream text;
    text << FileStream(path).rdbuf();
    return text.str();
}

/// Returns all warnings of POV-Ray with their continuation lines, except the one about the keyword `refraction`.
std::string warnings_in(const std::string& log) {
    std::string found, message;
    const auto keep = [&] {
        if (message.find("Refraction value unnecessary") == std::string::npos) found += message;
        message.clear();
    };
    WordStream lines(log);
    for (std::string line; std::getline(lines, line);) {
        const bool goes_on = !message.empty() && line.starts_with(' ');
        if (goes_on)
            message.back() = line[0], message += line.substr(1) + "\n";
        else
            keep();
        if (line.find("Warning: ") != std::string::npos) message = line + "\n";
    }
    keep();
    return found;
}

/// Returns the "Trace Time" of its log, or 0.
double trace_seconds(const std::string& log) {
    std::smatch match;
    double seconds = 0;
    if (std::regex_search(log, match, std::regex(R"(Trace Time:[^\n]*\(([0-9.]+) seconds\))"))) {
        const std::string digits = match[1];
        std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
    }
    return seconds;
}

Picture picture_of(const std::string& path, int width, int height) try {
    Picture picture = read_picture(path);
    if (picture.width != width || picture.height != height || picture.channels != 3)
        throw FileError("it is " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                        " pixels of " + std::to_string(picture.channels) + " channels");
    return picture;
} catch (const FileError& error) {
    throw std::runtime_error(std::string("povray succeeded, but its picture is not the requested one: ") +
                             error.what());
}

/// Runs POV-Ray; its picture and its log go to the scratch folder.
PovRun finished(const Scratch& scratch, const Place& place, std::vector<std::string> words, int width, int height,
                const std::atomic<bool>* stop) {
    const std::string log_path = scratch.path("log");
    const int status = run(std::move(words), place, log_path, stop);
    if (status == -1 || status == 127)
        throw std::runtime_error("povray is not installed; on Debian: apt install povray");
    const std::string log = content(log_path);
    if (status != 0)
        throw std::runtime_error("povray failed:\n" + log.substr(log.size() < 1500 ? 0 : log.size() - 1500));
    return {picture_of(scratch.path("scene.ppm"), width, height), trace_seconds(log), warnings_in(log)};
}

/// Returns the option by which files hold the values of a scene without a transfer curve.
std::string file_gamma(double assumed) { return "File_Gamma=" + gamma_word(assumed); }

/// Adds the options for averages over pixels.
void add_grid(std::vector<std::string>& words, int grid) {
    if (grid == 0) return;
    words.insert(words.end(), {"Antialias=On", "Sampling_Method=1", "Antialias_Threshold=0", "Jitter=Off",
                               "Antialias_Depth=" + std::to_string(grid)});
}

}  // namespace

PovRun run_povray(const Scene& scene, PovRequest request, int threads, const std::atomic<bool>* stop) {
    const Scratch scratch;
    // It runs in that folder: no .ini file need hold the folder's name, whatever characters are in it.
    request.pov_path = "scene.pov";
    request.picture_path = "scene.ppm";
    request.bits = 16;
    const PovFiles files = write_pov(scene, request);
    write(files, scratch.path("scene.pov"));
    // The library that reads .png files takes longer to load than many a picture to trace.
    std::vector<std::string> words{"povray", "scene.ini", "Output_File_Type=P", "Warning_Console=On", "Verbose=Off"};
    words.push_back(file_gamma(scene.settings.assumed_gamma));
    if (threads > 0) words.push_back("Work_Threads=" + std::to_string(threads));
    add_grid(words, request.grid);
    return finished(scratch, {scratch.path(".")}, std::move(words), request.width, request.height, stop);
}

PovRun run_povray_file(const PovFile& file, int threads, const std::atomic<bool>* stop) {
    const Scratch scratch;
    const fs::path path = fs::absolute(file.path);
    // It runs far below the scratch folder: what the scene writes beside itself is made there, and what it reads from
    // folders above its own is looked for there in vain, and then as from its own folder, to which `own` leads.
    const std::string inside = scratch.path("run/in/some/folders/below/the/scratch/one"), own = inside + "/own";
    fs::create_directories(inside);
    fs::create_directory_symlink(path.parent_path(), own);
    std::string input = "own/" + path.filename().string();
    if (file.camera) {
        // POV-Ray takes the last camera. A text that included the file would have another #version than its own.
        input = scratch.path("view.pov");
        const double aspect = double(file.width) / file.height;
        write_file(input, read_text(file.path) + "\n" + pov_camera(*file.camera, aspect, file.mirrored));
    }
    std::vector<std::string> words{"povray",
                                   "+I\"" + input + '"',  // a name may have spaces
                                   "+Lown",
                                   "+O" + scratch.path("scene.ppm"),
                                   "+W" + std::to_string(file.width),
                                   "+H" + std::to_string(file.height),
                                   "+FP16",
                                   "Antialias=Off",
                                   "Display=Off",
                                   "Dither=Off",
                                   "Output_Alpha=Off",
                                   "Warning_Console=On",
                                   "Verbose=Off",
                                   file_gamma(file.gamma)};
    if (file.moved > 0)
        words.insert(words.end(), {"Antialias=On", "Sampling_Method=1", "Antialias_Threshold=0", "Antialias_Depth=1",
                                   "Jitter=On", "Jitter_Amount=" + text_of(file.moved)});
    if (file.by_tree) words.push_back("Bounding_Method=2");
    if (file.clock) words.push_back("+K" + text_of(*file.clock));
    for (const std::string& folder : file.library) words.push_back("+L\"" + fs::absolute(folder).string() + '"');
    if (threads > 0) words.push_back("Work_Threads=" + std::to_string(threads));
    if (file.part)
        words.insert(words.end(),
                     {"+SC" + std::to_string(file.part->left + 1), "+EC" + std::to_string(file.part->right + 1),
                      "+SR" + std::to_string(file.part->top + 1), "+ER" + std::to_string(file.part->bottom + 1)});
    add_grid(words, file.grid);
    return finished(scratch, {inside, scratch.path(".")}, std::move(words), file.width, file.height, stop);
}

}  // namespace strahl

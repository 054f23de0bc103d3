#include "povref/compare/run_povray.h"

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <regex>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "files/os/folder.h"
#include "files/os/process.h"
#include "files/output_file.h"
#include "files/read_file.h"
#include "files/streams.h"
#include "num/decimal.h"
#include "povref/convert/images.h"

namespace strahl {
namespace {

namespace fs = std::filesystem;

/// Makes a temporary folder, in the one that TMPDIR names or else in /tmp.
os::NewFolder scratch_folder() {
    if (const std::string fault = os::confinement_fault(); !fault.empty()) throw std::runtime_error(fault);
    const char* const given = std::getenv("TMPDIR");
    const bool named = given && given[0] != 0;
    const std::string parent = named ? given : "/tmp";
    try {
        return os::NewFolder(parent + "/strahl-povray-", {"scene.pov", "scene.ini", "view.pov", "scene.ppm"});
    } catch (const std::system_error& error) {
        throw std::runtime_error("cannot make a folder in '" + parent + (named ? "', which TMPDIR names: " : "': ") +
                                 error.code().message());
    }
}

/// Runs a program. Throws if it is not there, or fails, or is stopped. Returns what it has printed.
std::string run(const os::ProgramStart& start, const std::atomic<bool>* stop) try {
    os::Process process(start);
    const int status = process.wait(stop);
    if (stop && *stop) throw Stopped{};
    if (status == 127) throw std::system_error(ENOENT, std::generic_category());
    const std::string log = process.output();
    if (status == 0) return log;
    throw std::runtime_error("povray failed:\n" + log.substr(log.size() < 1500 ? 0 : log.size() - 1500));
} catch (const std::system_error& error) {
    if (error.code() == std::errc::not_enough_memory) throw std::bad_alloc();
    if (error.code() == std::errc::no_such_file_or_directory)
        throw std::runtime_error("povray is not installed; on Debian: apt install povray");
    throw std::runtime_error("cannot start povray: " + error.code().message());
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

/// Runs POV-Ray, whose picture goes to this path.
PovRun finished(const os::ProgramStart& start, const std::string& picture, int width, int height,
                const std::atomic<bool>* stop) {
    const std::string log = run(start, stop);
    return {picture_of(picture, width, height), trace_seconds(log), warnings_in(log)};
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
    const os::NewFolder scratch = scratch_folder();
    // POV-Ray runs in that folder: no .ini file need hold the folder's name, whatever characters are in it.
    request.pov_path = "scene.pov";
    request.picture_path = "scene.ppm";
    request.bits = 16;
    const PovFiles files = write_pov(scene, request);
    write(files, scratch.path() + "/scene.pov");
    // The library that reads .png files takes longer to load than many a picture to trace.
    std::vector<std::string> words{"povray", "scene.ini", "Output_File_Type=P", "Warning_Console=On", "Verbose=Off"};
    words.push_back(file_gamma(scene.settings.assumed_gamma));
    if (threads > 0) words.push_back("Work_Threads=" + std::to_string(threads));
    add_grid(words, request.grid);
    return finished({.words = std::move(words), .folder = scratch.path()}, scratch.path() + "/scene.ppm", request.width,
                    request.height, stop);
}

PovRun run_povray_file(const PovFile& file, int threads, const std::atomic<bool>* stop) {
    const os::NewFolder scratch = scratch_folder();
    const fs::path path = fs::absolute(file.path);
    // It runs far below the scratch folder: what the scene writes beside itself is made there, and what it reads from
    // folders above its own is looked for there in vain, and then as from its own folder, to which `own` leads.
    const std::string inside = scratch.path() + "/run/in/some/folders/below/the/scratch/one", own = inside + "/own";
    fs::create_directories(inside);
    fs::create_directory_symlink(path.parent_path(), own);
    const std::string picture = scratch.path() + "/scene.ppm";
    std::string input = "own/" + path.filename().string();
    if (file.camera) {
        // POV-Ray takes the last camera. A text that included the file would have another #version than its own.
        input = scratch.path() + "/view.pov";
        const double aspect = double(file.width) / file.height;
        write_file(input, read_text(file.path) + "\n" + pov_camera(*file.camera, aspect, file.mirrored));
    }
    std::vector<std::string> words{"povray",
                                   "+I\"" + input + '"',  // a name may have spaces
                                   "+Lown",
                                   "+O" + picture,
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
    return finished({.words = std::move(words), .folder = inside, .writable = scratch.path()}, picture, file.width,
                    file.height, stop);
}

}  // namespace strahl

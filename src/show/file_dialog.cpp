#include "show/file_dialog.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>

extern char** environ;

namespace strahl {
namespace {

/// $1 is the folder, with a slash at its end; $2 is the name of a new file, if one is asked for; $3 is the title, $4
/// and $5 say which files are shown.
constexpr const char* script = R"sh(
if command -v zenity >/dev/null && [ -n "$2" ]; then
    exec zenity --file-selection --save --confirm-overwrite --title="$3" --filename="$1$2" 2>/dev/null
elif command -v zenity >/dev/null; then
    exec zenity --file-selection --title="$3" --filename="$1" \
        --file-filter="$4 | $5" --file-filter='All files | *' 2>/dev/null
elif command -v kdialog >/dev/null && [ -n "$2" ]; then
    exec kdialog --title "$3" --getsavefilename "$1$2" "$4 ($5)" 2>/dev/null
elif command -v kdialog >/dev/null; then
    exec kdialog --title "$3" --getopenfilename "$1" "$4 ($5)" 2>/dev/null
fi
exit 127)sh";

}  // namespace

FileDialog::~FileDialog() {
    if (!thread.joinable()) return;
    ::kill(child, SIGTERM);
    thread.join();
    ::waitpid(child, nullptr, 0);
}

std::string FileDialog::open(const std::string& scene, const std::string& made_of) {
    if (thread.joinable()) return "";
    std::string folder = std::filesystem::path(scene).parent_path().string();
    folder = folder.empty() ? "./" : folder + "/";
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return "the file dialog cannot be started";
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, pipe[1], 1);
    from = made_of;
    const bool sound = from == for_sound, copies = from == for_saving, saves = !sound && !from.empty();
    const std::string own_name = std::filesystem::path(scene).filename().string();
    std::string words[]{"sh",
                        "-c",
                        script,
                        "sh",
                        folder,
                        copies && scene != "-" ? own_name
                        : saves                ? "untitled.rt"
                                               : "",
                        sound    ? "Choose the music"
                        : copies ? "Save the scene as"
                        : saves  ? "Save the new scene as"
                                 : "Open a scene",
                        sound ? "Ogg Vorbis" : "Scenes",
                        sound              ? "*.ogg"
                        : saves && !copies ? "*.rt"
                                           : "*.rt *.pov"};
    std::array<char*, std::size(words) + 1> arguments{};
    for (std::size_t i = 0; i < std::size(words); ++i) arguments[i] = words[i].data();
    const bool started = posix_spawn(&child, "/bin/sh", &files, nullptr, arguments.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&files);
    ::close(pipe[1]);
    if (!started) return ::close(pipe[0]), "the file dialog cannot be started";
    said.clear();
    thread = std::thread([this, from = pipe[0]] {
        std::array<char, 4096> block;
        for (ssize_t got = 0; (got = ::read(from, block.data(), block.size())) > 0;)
            said.append(block.data(), static_cast<std::size_t>(got));
        ::close(from);
        done = true;
        notify();
    });
    return "";
}

std::optional<FileDialog::ChosenFile> FileDialog::take() {
    if (!done.exchange(false)) return std::nullopt;
    thread.join();
    int status = 0;
    ::waitpid(child, &status, 0);  // it has closed its output, and ends
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
        return ChosenFile{"", "there is no file dialog: install zenity or kdialog, or drop a file onto the window",
                          from};
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return ChosenFile{};
    return ChosenFile{said.substr(0, said.find_last_not_of('\n') + 1), "", from};
}

}  // namespace strahl

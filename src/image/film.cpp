// Runs ffmpeg as a child process: its input is a socket, and its messages go to a file in memory.
#include "image/film.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "files/streams.h"
#include "image/picture.h"
#include "num/decimal.h"

extern char** environ;

namespace strahl {
namespace {

/// Returns ffmpeg's name of the format, or "".
std::string format_of(const std::string& path) {
    const std::string ending = ending_of(path);
    return ending == ".mp4" ? "mp4" : ending == ".mkv" ? "matroska" : ending == ".webm" ? "webm" : "";
}

/// Returns the command line. Colours are declared as those of the stream, BT.709; every player can show 4:2:0. CRF 18
/// makes files twice as large as ffmpeg's default, 43 dB instead of 41.5 from the stream (scenes/flythrough.rt,
/// 640x360, H.264).
std::vector<std::string> command_of(const std::string& ffmpeg, const std::string& format, const std::string& file,
                                    const FrameRate& rate, const std::optional<FilmSound>& sound) {
    std::vector<std::string> words{ffmpeg};
    const auto add = [&](const std::string& options) {
        WordStream rest(options);
        for (std::string word; rest >> word;) words.push_back(word);
    };
    // ffmpeg 5.1 rounds some rates in the stream's head, 120000:1001 to 120, but none that it is told.
    add("-nostdin -y -v error -f yuv4mpegpipe -r " + rate.text() + " -i pipe:0");
    if (sound) {
        add("-ss " + text_of(sound->from) + " -i");
        words.push_back("file:" + sound->file);
        add("-map 0:v -map 1:a -af apad -shortest");
    }
    add("-crf 18 -vf setparams=range=tv:colorspace=bt709:color_primaries=bt709:color_trc=bt709,format=yuv420p -f");
    words.push_back(format);
    words.push_back("file:" + file);
    return words;
}

}  // namespace

bool is_film(const std::string& path) { return !format_of(path).empty(); }

std::string find_ffmpeg(const std::string& film) {
    const char* const path = std::getenv("PATH");
    WordStream folders(path ? path : "/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::string program = (folder.empty() ? "." : folder) + "/ffmpeg";
        if (::access(program.c_str(), X_OK) == 0) return program;
    }
    throw OutputError("cannot make " + film +
                      ": there is no ffmpeg in PATH, which films need; on Debian: apt install ffmpeg. Without it, "
                      "-o film-%04d.png --frames LIST makes pictures");
}

Film::Film(const std::string& ffmpeg, const std::string& own_path, const FrameRate& rate,
           const std::optional<FilmSound>& sound)
    : path(own_path), file(path, OutputFile::Writer::other_program) {
    start(ffmpeg, rate, sound);
}

Film::~Film() {
    if (process > 0) ::kill(process, SIGKILL);
    wait();
    if (messages >= 0) ::close(messages);
}

void Film::start(const std::string& ffmpeg, const FrameRate& rate, const std::optional<FilmSound>& sound) {
    int pair[2];
    messages = ::memfd_create("ffmpeg", MFD_CLOEXEC);
    if (messages < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
        throw OutputError("cannot start ffmpeg: " + std::generic_category().message(errno));
    stream = pair[0];
    std::vector<std::string> words = command_of(ffmpeg, format_of(path), file.name(), rate, sound);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    // These calls can run out of memory, and without the first one ffmpeg would read what the user types.
    const bool ready = posix_spawn_file_actions_adddup2(&files, pair[1], STDIN_FILENO) == 0 &&
                       posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0) == 0 &&
                       posix_spawn_file_actions_adddup2(&files, messages, STDERR_FILENO) == 0;
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    const int error =
        ready ? ::posix_spawn(&process, ffmpeg.c_str(), &files, &attributes, arguments.data(), environ) : ENOMEM;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    ::close(pair[1]);
    if (!error) return;
    process = 0;
    ::close(stream), ::close(messages);
    throw OutputError("cannot start '" + ffmpeg + "': " + std::generic_category().message(error));
}

void Film::append(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(stream, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) fail();
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
}

void Film::wait() {
    if (stream >= 0) ::close(std::exchange(stream, -1));
    while (process > 0 && ::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
    process = 0;
}

void Film::fail() {
    wait();
    std::string said(static_cast<std::size_t>(::lseek(messages, 0, SEEK_END)), '\0');
    said.resize(static_cast<std::size_t>(::pread(messages, said.data(), said.size(), 0)));
    constexpr std::size_t most = 1500;
    if (said.size() > most) said = "..." + said.substr(said.size() - most);
    while (said.ends_with('\n')) said.pop_back();
    if (said.empty())
        said = WIFSIGNALED(status) ? "it was ended by signal " + std::to_string(WTERMSIG(status))
                                   : "its exit status is " + std::to_string(WEXITSTATUS(status));
    try {
        if (std::filesystem::file_size(file.name()) > 0) said += "\nthe film so far is in '" + keep() + "'";
    } catch (const std::exception&) {  // the failure of ffmpeg is the one to report
    }
    throw OutputError("cannot write '" + path + "': ffmpeg failed: " + said);
}

std::string Film::keep() {
    std::filesystem::path name = path;
    name.replace_extension(".part" + name.extension().string());
    file.finish_as(name.string());
    return name.string();
}

void Film::finish() {
    wait();
    if (status != 0) fail();
    file.finish();
}

std::string Film::finish_part() {
    wait();
    if (status != 0) fail();
    return keep();
}

}  // namespace strahl

// Films: frames go to ffmpeg, which encodes them.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include <sys/types.h>

#include "files/output_file.h"

namespace strahl {

/// Does the ending say so: .mp4, .mkv or .webm?
bool is_film(const std::string& path);

/// The program `ffmpeg` in PATH. Throws FileError if there is none.
std::string find_ffmpeg(const std::string& film);

/// What is heard: a file, from a moment in seconds on.
struct FilmSound {
    std::string file;
    double from = 0;
};

/// The file is written as any other: an older one stays until finish(). ffmpeg has a session of its own, so that Ctrl-C
/// in a terminal does not reach it. If this program is killed it finishes what it was sent, in the temporary file.
class Film {
  public:
    /// Starts ffmpeg for a stream of Y4M. A sound is cut where the frames end, or goes on as silence until there.
    Film(const std::string& ffmpeg, const std::string& path, const std::optional<FilmSound>& sound);
    ~Film();
    Film(const Film&) = delete;

    /// Part of the stream. Is not interrupted by signals, because ffmpeg would get half of a frame. This and the
    /// following functions throw OutputError with what ffmpeg said, if it failed.
    void append(std::string_view bytes);
    void finish();
    /// What came until now becomes film.part.mp4. Returns that name.
    std::string finish_part();

  private:
    void start(const std::string& ffmpeg, const std::optional<FilmSound>& sound);
    void wait();
    [[noreturn]] void fail();
    std::string keep();

    const std::string path;
    OutputFile file;
    int stream = -1, messages = -1;  // ffmpeg's input and its errors
    pid_t process = 0;
    int status = 0;
};

}  // namespace strahl

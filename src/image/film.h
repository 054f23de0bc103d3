// Films: frames go to ffmpeg, which encodes them.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "files/os/process.h"
#include "files/output_file.h"
#include "image/frame_rate.h"

namespace strahl {

/// Returns whether the ending is that of a film: .mp4, .mkv or .webm.
bool is_film(const std::string& path);

/// Returns the path of the program `ffmpeg` in PATH. Throws OutputError, which says that `film` cannot be made, if
/// there is none.
std::string find_ffmpeg(const std::string& film);

/// The sound of a film: a file, from a moment in seconds on.
struct FilmSound {
    std::string file;
    double from = 0;
};

/// A film that ffmpeg encodes. An older file stays until finish(), as with any other output. ffmpeg has a session of
/// its own, so that Ctrl-C in a terminal does not reach it. If this program is killed, ffmpeg finishes the frames that
/// it was sent, in the temporary file.
class Film {
  public:
    /// Starts ffmpeg for a stream of Y4M of this rate. A sound is cut, or continued by silence, to end with the frames.
    Film(const std::string& ffmpeg, const std::string& path, const FrameRate& rate,
         const std::optional<FilmSound>& sound);

    /// Sends the next bytes of the stream. Signals do not interrupt it, because ffmpeg would get half of a frame. This
    /// and the following functions throw OutputError with ffmpeg's message if it failed.
    void append(std::string_view bytes);
    void finish();
    /// Finishes the frames so far as film.part.mp4. Returns that name.
    std::string finish_part();

  private:
    [[noreturn]] void fail();
    std::string keep();

    const std::string path;
    OutputFile file;
    os::Process process;
};

}  // namespace strahl

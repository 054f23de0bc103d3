// Runs ffmpeg, and sends it the frames.
#include "image/film.h"

#include <exception>
#include <filesystem>
#include <system_error>
#include <vector>

#include "files/streams.h"
#include "image/picture.h"
#include "num/decimal.h"

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
    const std::string program = os::find_program("ffmpeg");
    if (!program.empty()) return program;
    throw OutputError(
        "cannot make " + film +
        ": there is no ffmpeg in PATH, which films need (ffmpeg.org; on Debian: apt install ffmpeg). Without it, "
        "-o film-%04d.png --frames LIST makes pictures");
}

Film::Film(const std::string& ffmpeg, const std::string& own_path, const FrameRate& rate,
           const std::optional<FilmSound>& sound) try
    : path(own_path),
      file(path, OutputFile::Writer::other_program),
      process({.words = command_of(ffmpeg, format_of(path), file.name(), rate, sound), .own_session = true}) {
} catch (const std::system_error& error) {
    throw OutputError("cannot start '" + ffmpeg + "': " + error.code().message());
}

void Film::append(std::string_view bytes) {
    if (!process.send(bytes)) fail();
}

void Film::fail() {
    const int status = process.wait();
    std::string said = process.output();
    constexpr std::size_t most = 1500;
    if (said.size() > most) said = "..." + said.substr(said.size() - most);
    while (said.ends_with('\n')) said.pop_back();
    if (said.empty())
        said = status < 0 ? "it was ended by signal " + std::to_string(-status)
                          : "its exit status is " + std::to_string(status);
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
    if (process.wait() != 0) fail();
    file.finish();
}

std::string Film::finish_part() {
    if (process.wait() != 0) fail();
    return keep();
}

}  // namespace strahl

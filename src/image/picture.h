// Reading and writing picture files. Callers need not know the library behind it.
#pragma once
#include <future>
#include <string>
#include <vector>

#include "scene/error.h"

namespace strahl {

/// Values row by row from the top, `channels` per pixel. Read from 8- and 16-bit files they are code / 255 or / 65535.
struct Picture {
    int width = 0, height = 0, channels = 3;
    std::vector<double> values;
    int bits = 32;  // of the file it came from: 8, 16, or 32 for float
};

struct FileFormat {
    int bits = 0;         // 8 for .bmp, 8 or 16 for .png, 32 (float) for .exr; 0 takes the first of these
    bool linear = false;  // the scene's `assumed_gamma 1`: 8- and 16-bit files are sRGB-encoded
};

/// Empty if write_picture can write this ending (.bmp .png .exr) with these bits, else a message that says what to do.
/// `bits` 0 means the default of the ending. `path` may be the ending alone.
std::string format_fault(const std::string& path, int bits);

/// The largest error that such a file can't show: half a step of its values before encoding (0 for floats).
double half_step(FileFormat format);

/// Writes atomically: to a temporary file beside `path`, which is then renamed. "-" is standard output, for which
/// `ending` (such as ".png") chooses the format. Throws OutputError.
void write_picture(const Picture& picture, const std::string& path, FileFormat format, const std::string& ending = "");

/// Reads any format that OpenImageIO does, except 16-bit PNM, whose values it gets wrong by one. Colours are not
/// converted. Throws FileError.
Picture read_picture(const std::string& path);

/// Starts loading the picture library in the background, which takes 0.2 s, so that write_picture need not wait. Keep
/// the future until the end of main: its destructor waits for the loading, and a program that ends meanwhile can crash
/// in the library's start-up. A failure is reported by the next read or write.
[[nodiscard]] std::future<void> preload_picture_library();

}  // namespace strahl

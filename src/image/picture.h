// Reads and writes picture files.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "files/error.h"
#include "image/transfer.h"

namespace strahl {

/// A picture: values row by row from the top, `channels` per pixel. From 8- and 16-bit files they are code / 255 or
/// code / 65535.
struct Picture {
    int width = 0, height = 0, channels = 3;
    std::vector<double> values;
    int bits = 32;            // of the file it came from: 8, 16, or 32 for float
    bool from_right = false;  // the file has the pixels of each row from right to left
};

/// How PNG is compressed: faster than pictures are traced, or as small as zlib can.
enum class Compression { fast, small };

struct FileFormat {
    int bits = 0;      // 8 for .bmp, 8 or 16 for .png, 32 (float) for .exr; 0 takes the first of these
    double gamma = 0;  // the scene's `assumed_gamma`: how values of 8- and 16-bit files are shown(), if it is not 0
    Compression compression = Compression::fast;
    Exposure exposure{};  // of 8-bit files
};

/// The ending of a path in lower case: ".png" of "a/b.PNG".
std::string ending_of(const std::string& path);
/// `bits`, or the default of the ending.
int bits_of(const std::string& ending, int bits);

/// Empty if write_picture can write this ending (.bmp .png .exr) with these bits, else a message that says what to do.
/// `bits` 0 means the default of the ending. `path` may be the ending alone.
std::string format_fault(const std::string& path, int bits);

/// The largest error that such a file cannot show: half a step of its values before encoding (0 for floats).
double half_step(FileFormat format);

/// Writes a picture atomically: to a temporary file beside `path`, which is then renamed. "-" is standard output, for
/// which `ending` (such as ".png") chooses the format. Throws OutputError.
void write_picture(const Picture& picture, const std::string& path, FileFormat format, const std::string& ending = "");

/// The most values that a picture may have unless the caller allows more: 2 GiB of doubles.
inline constexpr std::uint64_t most_values_read = std::uint64_t(1) << 28;

/// Reads a .bmp, .png, .exr, .jpg, .gif, .tga, .ppm, .pgm or .pfm file, whatever its name ends in, without converting
/// colours; of an animation the first picture. Throws FileError, also if it has more than `most` values or more than
/// there is memory for.
Picture read_picture(const std::string& path, std::uint64_t most = most_values_read);

/// Returns a picture of one line of text, of one channel: 1 in the letters of a font of the system, 0 around them.
/// `size` is that of the font in pixels. Throws FileError if there is no font, and OutputError without the library.
Picture text_picture(const std::string& text, int size);

}  // namespace strahl

// Reading and writing picture files. Callers need not know the library behind it.
#pragma once
#include <cstdint>
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

/// How hard PNG is compressed: faster than pictures are traced, or as small as zlib makes it.
enum class Compression { fast, small };

struct FileFormat {
    int bits = 0;         // 8 for .bmp, 8 or 16 for .png, 32 (float) for .exr; 0 takes the first of these
    bool linear = false;  // the scene's `assumed_gamma 1`: 8- and 16-bit files are sRGB-encoded
    Compression compression = Compression::fast;
};

/// ".png" of "a/b.PNG"; in lower case.
std::string ending_of(const std::string& path);
/// `bits`, or the default of the ending.
int bits_of(const std::string& ending, int bits);

/// Empty if write_picture can write this ending (.bmp .png .exr) with these bits, else a message that says what to do.
/// `bits` 0 means the default of the ending. `path` may be the ending alone.
std::string format_fault(const std::string& path, int bits);

/// The largest error that such a file can't show: half a step of its values before encoding (0 for floats).
double half_step(FileFormat format);

/// Writes atomically: to a temporary file beside `path`, which is then renamed. "-" is standard output, for which
/// `ending` (such as ".png") chooses the format. Throws OutputError.
void write_picture(const Picture& picture, const std::string& path, FileFormat format, const std::string& ending = "");

/// What a picture may cost to read, unless it is known to be larger: 2 GiB of doubles.
inline constexpr std::uint64_t most_values_read = std::uint64_t(1) << 28;

/// A .bmp, .png or .exr file, or one of image/netpbm.h, which its first bytes tell and not its ending; no colours are
/// converted. Throws
/// FileError, also if the picture has more than `most` values or more than there is memory for.
Picture read_picture(const std::string& path, std::uint64_t most = most_values_read);

/// Loads the library that reads pictures, before work whose result would be lost without it. Throws OutputError.
void require_picture_library();

}  // namespace strahl

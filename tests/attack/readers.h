// Checks what small readers do with any bytes: those of tracks, messages of a GNU Rocket editor, sound, checkpoints,
// and the state of the window.
#pragma once
#include <array>
#include <string>
#include <string_view>

namespace strahl {

/// A reader and the ending by which a file is given to it alone. It throws FileError if the bytes are unusable, and
/// std::logic_error if it does not keep what it promises.
struct AttackedReader {
    const char* ending;
    void (*read)(std::string_view bytes);
};

extern const std::array<AttackedReader, 5> attacked_readers;

}  // namespace strahl

// strahl sheet: a contact sheet, pictures of a flight's time in one picture.
#pragma once
#include <atomic>
#include <optional>
#include <string>

#include "image/transfer.h"
#include "main/render/values.h"
#include "pov/open_scene.h"

namespace strahl {

struct SheetOptions {
    std::string scene;  // a file, or "-" for standard input
    OpeningOptions opening{};
    std::string output;  // .bmp, .png or .exr
    int pictures = 12;
    int columns = 0;  // of the sheet; 0: as many as make it about as high as it is wide in pictures
    std::optional<PictureSize>
        size;                  // of each picture; by default 320 wide, with the camera's aspectratio, or else 4:3
    Exposure exposure;         // of 8-bit files
    std::optional<int> depth;  // 1 to 256; by default the scene's max_trace_level
    int threads = 0;           // 0: all processors
    bool quiet = false;
};

/// Returns the exit status: done, or interrupted if `stop` became true; then nothing is written. Throws FileError,
/// UsageError, also if nothing moves in the scene, or OutputError.
int sheet_command(const SheetOptions& options, const std::atomic<bool>* stop = nullptr);

}  // namespace strahl

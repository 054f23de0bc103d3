// Reads the blocks `camera` and `flythrough`.
#pragma once
#include <optional>

#include "scene/camera.h"
#include "text/blocks/motion_block.h"
#include "text/reading/reader.h"
#include "text/reading/text_limits.h"

namespace strahl {

class CameraBlocks {
  public:
    CameraBlocks(BlockReader& reader, const TextLimits& limits) : reader(reader), limits(limits) {}

    void camera(std::string_view word);
    void flythrough(std::string_view word);
    /// Checks, at the end of the text, that there is a camera and that it is valid at the keys of the flythrough.
    void check(std::string_view end_of_text);

    Camera the_camera;
    std::optional<Flythrough> path;
    std::vector<Follow> follows;  // numbers of the camera that follow tracks

  private:
    void key(std::string_view word, Flythrough& read_path, std::vector<KeyWords>& words, Block& outer);
    void check_times(const Flythrough& read_path, std::span<const KeyWords> words, std::string_view duration);

    BlockReader& reader;
    const TextLimits& limits;
    std::string_view camera_at, path_at;       // the first words of these blocks
    bool camera_good = false, by_sky = false;  // is it valid; is `sky` given
    std::vector<KeyWords> key_words;
};

}  // namespace strahl

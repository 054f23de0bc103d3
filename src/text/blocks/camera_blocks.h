// The blocks `camera` and `flythrough`.
#pragma once
#include <array>
#include <optional>

#include "scene/camera.h"
#include "text/reading/reader.h"
#include "text/reading/text_limits.h"

namespace strahl {

class CameraBlocks {
  public:
    CameraBlocks(Reader& reader, const TextLimits& limits) : reader(reader), limits(limits) {}

    void camera(std::string_view word);
    void flythrough(std::string_view word);
    /// To be called at the end of the text: is there a camera, and is it valid at the keys of the flythrough?
    void check(std::string_view end_of_text);

    Camera the_camera;
    std::optional<Flythrough> path;
    std::vector<Follow> follows;  // numbers of the camera that follow tracks

  private:
    struct KeyPlace {
        std::string_view key, time;  // where these words of a key are
    };
    void key(std::string_view word, Flythrough& read_path, std::vector<KeyPlace>& places, Block& outer);
    void check_times(const Flythrough& read_path, std::span<const KeyPlace> places, std::string_view duration);

    Reader& reader;
    const TextLimits& limits;
    std::string_view camera_at, path_at;  // where these blocks are
    bool camera_good = false;
    std::vector<KeyPlace> key_places;
};

}  // namespace strahl

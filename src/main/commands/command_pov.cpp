#include "main/commands/command_pov.h"

#include <cmath>
#include <filesystem>

#include "main/commands/scene_file.h"
#include "povref/convert/pov_scene.h"
#include "scene/moving_scene.h"

namespace strahl {
namespace {

/// Returns the cameras of all frames. Frame n is the view at `rate.moment(n)`; a path that loops ends one frame before
/// it would repeat its first.
std::vector<Camera> frames(const Scene& scene, const Flythrough& path, const FrameRate& rate) {
    const double last = path.duration * rate.per_second();
    if (!(last < 1e5)) throw UsageError("the animation would have more than 100000 frames; choose a smaller --fps");
    std::vector<Camera> cameras;
    for (int n = 0; path.loop ? n < last - 1e-9 : n <= last + 1e-9; ++n)
        cameras.push_back(camera_at(scene, rate.moment(n)));
    return cameras;
}

std::string ini_path(const PovOptions& options) {
    return std::filesystem::path(options.output).replace_extension(".ini").string();
}

void check(const PovOptions& options) {
    if (options.output.empty()) throw UsageError("no output file. Add -o FILE.pov");
    if (std::filesystem::path(options.output).extension() != ".pov")
        throw UsageError("'" + options.output + "' should end in .pov; the .ini is written beside it");
    refuse_overwriting_scene("-o", options.output, options.scene, options.opening);
    refuse_overwriting_scene("The .ini beside -o", ini_path(options), options.scene, options.opening);
    if (options.animation && options.time) throw UsageError("--animation and --time exclude each other");
}

}  // namespace

int pov_command(const PovOptions& options) {
    namespace fs = std::filesystem;
    check(options);
    OpeningOptions opening = options.opening;
    opening.as_text = true;
    Scene scene = load_scene(options.scene, opening, options.time);
    PovRequest request{.title = options.scene == "-" ? "A scene" : fs::path(options.scene).filename().string(),
                       .pov_path = options.output,
                       .picture_path = fs::path(options.output).replace_extension(".png").string(),
                       .width = opening.size.width,
                       .height = opening.size.height,
                       .depth = options.depth.value_or(scene.settings.max_trace_level),
                       .bits = options.bits};
    if (options.animation) {
        if (!followed_tracks(scene).empty())
            throw UsageError("--animation cannot follow the tracks of " + options.scene +
                             "; --time writes what they are at a moment");
        request.cameras = frames(scene, flight_for("--animation", scene, options.scene), options.rate);
        request.fps = options.rate.per_second();
    } else {
        if (options.time) flight_for("--time", scene, options.scene);
        request.cameras = {camera_at(scene, options.time)};
        request.time = options.time.value_or(0);
        scene = without_tracks(scene, request.time);
    }
    const PovFiles files = write_pov(scene, request);
    write(files, options.output);
    print_warnings(files.warnings);
    return 0;
}

}  // namespace strahl

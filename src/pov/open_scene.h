// Opens a scene by its ending: POV-Ray's .pov, a model, or else scene text.
#pragma once
#include <atomic>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "import/models/model.h"
#include "pov/ini_file.h"
#include "pov/open_pov.h"
#include "scene/picture_size.h"
#include "scene/scene.h"
#include "text/reading/scene_files.h"

namespace strahl {

/// Options for scenes of POV-Ray.
struct OpeningOptions {
    PictureSize size{};                  // of the picture, which a scene may ask for
    std::optional<double> clock{};       // at all times; by default it changes from 0 to 1 during the flight
    std::vector<std::string> library{};  // folders of included files, searched before those of POV-Ray's package
    bool strict = false;                 // whatever cannot be shown as it is meant is an error
    bool as_text = false;                // the scene is written: what scene text has no words for is approximated
    bool alpha = false;                  // the picture has alpha
    std::optional<pov::IniFile> ini{};   // given in place of the scene; by default the one beside it
    std::optional<double> time{};  // the moment of the flight at which the scene is read; without it the first one
    const std::atomic<bool>* stop = nullptr;    // throws Interrupted once it is true
    std::vector<std::string>* files = nullptr;  // receives the paths of all files that are read, also before an error
};

struct OpenedScene {
    Scene scene;
    // Messages for the user: "scene.pov:12: left out: media" for what a .pov has approximated or left out, and warnings
    // about models, and the meshes and pictures of scene text.
    std::vector<Message> notes{};
    std::vector<Message> warnings{};   // "scene.pov:12: ';' is missing", about the text of a .pov
    std::string summary{};             // of the notes; empty for scene text
    pov::SourceLines lines{};          // of the bodies and lights of a .pov, or names of bodies
    bool mirrored = false;             // the scene is the mirror image in z of that of a .pov
    std::vector<std::string> files{};  // of a .pov, model or text with directives: all that were read, its own first
    double background_opacity = 0;     // in a picture with alpha, as POV-Ray has it
    bool changes = false;              // a .pov that uses its clock, or a model that bends: read again for each moment
    bool sized = false;                // a .pov that asks for the picture's size: it is another scene in each size
    std::optional<double> clock{};     // of a .pov: its value, if POV-Ray's clock is on
    std::optional<std::pair<int, int>> frames{};  // the first and the last that an .ini file gives
};

/// Does the path end like a scene of POV-Ray?
bool is_pov(const std::string& path);

/// If `scene` is an .ini file, or FILE.ini[SECTION], replaces it by the scene that this names, and sets options.ini;
/// returns whether it is. Throws FileError.
bool follow_ini(std::string& scene, OpeningOptions& options);

/// Throws UsageError if `written`, which `option` names, is the scene, or the .ini file or the flight of a .pov.
void refuse_overwriting_scene(const std::string& option, const std::string& written, const std::string& scene,
                              const OpeningOptions& options);

/// Returns the text of a scene's file, or of standard input for "-". Models, which may be large and no text, have a
/// line in its place that changes when the file does. Throws FileError.
std::string read_scene_text(const std::string& path);

/// Reads a scene whose text is that of the file `path`. Throws FileError. `read` receives the names of files in scene
/// text.
OpenedScene open_scene(const std::string& text, const std::string& path, const OpeningOptions& options,
                       const ReadPixels& read_pixels, FilesRead* read = nullptr);

}  // namespace strahl

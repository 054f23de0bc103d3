#include "pov/open_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "files/output_file.h"
#include "files/read_file.h"
#include "files/regular_file.h"
#include "files/shell.h"
#include "files/utf8.h"
#include "files/words.h"
#include "import/models/stage.h"
#include "pov/animation.h"
#include "pov/expand.h"
#include "pov/flight_file.h"
#include "text/parse.h"
#include "text/reading/opacity.h"
#include "text/reading/other_files.h"

namespace strahl {

bool is_pov(const std::string& path) { return path.ends_with(".pov") || path.ends_with(".POV"); }

bool follow_ini(std::string& scene, OpeningOptions& options) {
    if (!pov::is_ini(scene)) return false;
    options.ini = pov::read_ini(scene);
    scene = options.ini->scene;
    return true;
}

namespace {

/// Returns what the folders of an .ini file may add to those that may be read: none that lie outside of them.
std::vector<std::string> library_of(pov::IniFile& ini, std::vector<std::string> known) {
    namespace fs = std::filesystem;
    const fs::path own = fs::path(ini.path).parent_path();
    known.push_back(own.empty() ? "." : own.string());
    std::vector<std::string> inside;
    for (const std::string& each : ini.library) {
        const std::string folder = (own / each).string();
        if (std::ranges::any_of(known, [&](const std::string& other) { return pov::lies_in(folder, other); }))
            inside.push_back(folder);
        else
            ini.notes.push_back(ini.path + ": Library_Path is not read; --library " +
                                in_shell_quotes(printable(folder)) + " allows it");
    }
    return inside;
}

/// Throws FileError with the first notes.
[[noreturn]] void refuse(std::vector<Message> notes) {
    constexpr std::size_t most = 10;
    const std::size_t more = notes.size() > most ? notes.size() - most : 0;
    notes.resize(notes.size() - more);
    notes.insert(notes.begin(), {"the scene cannot be shown as it is meant"});
    if (more > 0) notes.push_back({"and " + std::to_string(more) + " more"});
    throw FileError(std::move(notes));
}

OpenedScene open_scene_of_povray(const std::string& text, const std::string& path, const OpeningOptions& options,
                                 pov::InterpreterOptions how, const ReadPixels& read_pixels) {
    std::optional<pov::IniFile> ini = options.ini ? options.ini : pov::ini_beside(path);
    if (ini) {
        for (std::string& folder : library_of(*ini, how.library)) how.library.push_back(std::move(folder));
        how.declared = ini->declared;
    }
    const std::string flight_file = pov::flight_path(path);
    std::error_code error;
    const bool flies = std::filesystem::is_regular_file(flight_file, error);
    const auto flight = flies ? pov::parse_flight(read_text(flight_file), flight_file) : std::nullopt;
    const pov::Animation animation = pov::Animation::of(ini, flight ? std::optional(flight->duration) : std::nullopt);
    const double time = options.time.value_or(0);
    const bool runs = options.time || animation.counted, still = ini && ini->clock && !runs;
    how.clock_on = runs || still || options.clock;
    how.clock = options.clock ? *options.clock : still ? *ini->clock : animation.clock_at(time);
    if (runs)
        for (auto& each : animation.declared_at(time)) how.declared.push_back(std::move(each));
    pov::OpenedPov opened = open_pov(text, how, read_pixels);

    OpenedScene result{.scene = std::move(opened.scene),
                       .warnings = std::move(opened.warnings),
                       .summary = opened.summary(),
                       .lines = std::move(opened.lines),
                       .mirrored = opened.mirrored,
                       .files = std::move(opened.files),
                       .background_opacity = opened.background_opacity,
                       .changes = opened.clock_used && !options.clock,
                       .sized = opened.size_used,
                       .clock = how.clock_on ? std::optional(how.clock) : std::nullopt};
    for (const pov::PovNote& note : opened.notes) result.notes.push_back(note.message);
    if (options.strict && !result.notes.empty()) refuse(result.notes);
    if (ini) {
        for (const std::string& note : ini->notes) result.notes.push_back({note});
        result.files.push_back(ini->path);
        if (animation.counted) result.frames = animation.frames();
    }
    if (flies) result.files.push_back(flight_file);
    // A camera that asks for the picture's shape has none of its own.
    auto& aspect = result.scene.camera.aspectratio;
    const double picture = double(how.width) / how.height;
    if (result.sized && aspect && std::abs(*aspect - picture) < 1e-9 * picture) aspect.reset();
    if (flight)
        result.scene.flythrough = pov::flight_in(result.scene, result.mirrored, *flight, flight_file);
    else if (result.changes)
        result.scene.flythrough = Flythrough{.duration = animation.seconds, .loop = animation.cyclic, .keys = {}};
    return result;
}

OpenedScene open_scene_of_model(const std::string& path, const OpeningOptions& options, const ReadPixels& read_pixels) {
    Model model = read_model(path, read_pixels);
    OpenedScene result{.scene = staged(model, double(options.size.width) / options.size.height),
                       .files = std::move(model.files)};
    for (std::string& warning : model.warnings) result.notes.push_back({std::move(warning)});
    bool any_clear = false;
    for (Material& own : result.scene.materials)
        if (const Opacity* const clear = opacity_of(own.rgb); clear && options.as_text && !has_text(own.rgb)) {
            own.rgb = opaque_part(own.rgb);
            any_clear = true;
        }
    if (any_clear)
        result.notes.push_back({"opacity that does not lie as a picture of colours does is not in the text", path});
    for (ModelPart& part : model.parts) result.lines.names.push_back(std::move(part.name));
    if (options.files) *options.files = result.files;
    return result;
}

}  // namespace

void refuse_overwriting_scene(const std::string& option, const std::string& written, const std::string& scene,
                              const OpeningOptions& options) {
    refuse_overwriting(option, written, "the scene", scene);
    const std::string ini = options.ini ? options.ini->path : is_pov(scene) ? pov::beside(scene, ".ini") : "";
    refuse_overwriting(option, written, "the scene's .ini file", ini);
    if (is_pov(scene)) refuse_overwriting(option, written, "the scene's flight", pov::flight_path(scene));
}

std::string read_scene_text(const std::string& path) {
    if (!is_model(path)) return read_text(path);
    const RegularFile file(path);
    std::error_code error;
    const auto written = std::filesystem::last_write_time(path, error).time_since_epoch().count();
    return "// a model of " + std::to_string(file.size()) + " bytes, written at " + std::to_string(written) + "\n";
}

OpenedScene open_scene(const std::string& text, const std::string& path, const OpeningOptions& options,
                       const ReadPixels& read_pixels, FilesRead* read) {
    if (is_model(path)) return open_scene_of_model(path, options, read_pixels);
    pov::InterpreterOptions how;
    how.file = path, how.library = options.library, how.width = options.size.width, how.height = options.size.height;
    for (const std::string& folder : pov::standard_library()) how.library.push_back(folder);
    how.stop = options.stop, how.files = options.files, how.as_text = options.as_text, how.alpha = options.alpha;
    if (is_pov(path)) return open_scene_of_povray(text, path, options, std::move(how), read_pixels);
    how.clock = options.clock.value_or(0);
    FilesRead own;
    FilesRead& files = read ? *read : own;
    const std::string name = path == "-" ? "standard input" : path;
    OpenedScene result;
    refuse_other_files(text, name);
    if (pov::has_directives(text)) {
        const pov::ExpandedText expanded = pov::expand(text, how);
        result.scene = parse_scene(expanded.text, name, {}, read_pixels, &files, expanded.origins);
        result.files = expanded.files;
    } else {
        result.scene = parse_scene(text, name, {}, read_pixels, &files);
    }
    for (const std::string& warning : files.warnings) result.notes.push_back({warning});
    return result;
}

}  // namespace strahl

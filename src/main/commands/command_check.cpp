// strahl check: a summary of a scene in a few lines.
#include "main/commands/command_check.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <utility>

#include "files/output_file.h"
#include "files/read_file.h"
#include "files/streams.h"
#include "files/utf8.h"
#include "image/pixels.h"
#include "main/commands/scene_file.h"
#include "main/process/exit_status.h"
#include "num/decimal.h"
#include "scene/leaves.h"
#include "scene/moving_scene.h"
#include "scene/overlap.h"
#include "text/reading/tracks_file.h"
#include "text/scene_warnings.h"
#include "text/write.h"

namespace strahl {
namespace {

std::string counted(std::size_t count, const std::string& noun) {
    if (noun == "body") return std::to_string(count) + (count == 1 ? " body" : " bodies");
    const bool hisses = noun.ends_with('s') || noun.ends_with('x') || noun.ends_with("sh");
    return std::to_string(count) + " " + noun + (count == 1 ? "" : hisses ? "es" : "s");
}

std::ostream& operator<<(std::ostream& out, const DVec3& v) {
    return out << '<' << v.x << ", " << v.y << ", " << v.z << '>';
}

/// The number of bodies of each kind.
using CountOfKinds = std::array<std::size_t, std::variant_size_v<Shape>>;

/// "7: 5 spheres, 1 plane, 1 cylinder"
template <class... Kinds>
std::string kinds_in_words(const CountOfKinds& counts, std::variant<Kinds...>*) {
    constexpr std::array names{Kinds::name...};
    std::string words = std::to_string(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
    const char* separator = ": ";
    for (std::size_t i = 0; i < names.size(); ++i)
        if (counts[i] > 0) words += std::exchange(separator, ", ") + counted(counts[i], names[i]);
    return words;
}

/// Returns the lines that count the bodies, and the simple ones that composites consist of.
std::string bodies_in_words(const Scene& scene) {
    CountOfKinds bodies{}, parts{};
    for (const Primitive& primitive : scene.primitives) {
        ++bodies[primitive.shape.index()];
        for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
            if (&leaf != &primitive) ++parts[leaf.shape.index()];
        });
    }
    const auto line = [](const char* name, const CountOfKinds& counts) {
        return name + kinds_in_words(counts, static_cast<Shape*>(nullptr)) + "\n";
    };
    return line("  primitives   ", bodies) + (parts == CountOfKinds{} ? "" : line("  made of      ", parts));
}

/// Describes the box around all bounded bodies.
std::string bounds_in_words(const Scene& scene) {
    Box box;
    bool unbounded = false;
    for (const Primitive& primitive : scene.primitives) {
        if (const Box own = world_bounds(primitive); own.finite())
            box.add(own);
        else
            unbounded = true;
    }
    TextStream words;
    if (box.empty())
        words << (unbounded ? "infinite" : "no bodies");
    else
        words << box.low << " to " << box.high << (unbounded ? ", and unbounded bodies" : "");
    return words.str();
}

std::string values_in_words(double gamma) {
    if (gamma == 0) return "shown as they are";
    if (gamma == 1) return "linear light, shown sRGB-encoded";
    return "to the power of " + text_of(gamma) + " linear light, shown sRGB-encoded";
}

/// `path` is that of the scene.
std::string summary(const Scene& scene, const std::string& path) {
    const auto transparent = std::ranges::count_if(
        scene.primitives, [&](const Primitive& primitive) { return strahl::transparent(scene, primitive); });
    const Camera& camera = scene.camera;
    TextStream text;
    text << bodies_in_words(scene) << "  transparent  " << transparent << (transparent == 1 ? " body" : " bodies")
         << '\n'
         << "  materials    " << scene.materials.size() << '\n'
         << "  lights       " << scene.lights.size() << '\n'
         << "  bounds       " << bounds_in_words(scene) << '\n'
         << "  camera       at " << camera.position << ", looking at " << camera.look_at << ", " << 2 * camera.fov
         << " degrees wide"
         << (camera.projection == Projection::perspective ? "" : ", " + std::string(word_of(camera.projection)))
         << (camera.stereo == Stereo::none ? ""
                                           : ", " + std::string(stereo_words[static_cast<std::size_t>(camera.stereo)]))
         << '\n'
         << "  depth        " << scene.settings.max_trace_level << '\n'
         << "  background   " << scene.background.color << (scene.background.pattern ? " at most, by a pattern" : "")
         << '\n'
         << "  values       " << values_in_words(scene.settings.assumed_gamma) << '\n'
         << "  flythrough   ";
    if (const auto& flight = scene.flythrough)
        text << flight->duration << " s, "
             << (flight->keys.empty() ? "by the clock of POV-Ray" : counted(flight->keys.size(), "key"))
             << (flight->loop ? ", looping" : "") << '\n';
    else
        text << "none\n";
    if (const Movers movers(scene); movers.any())
        text << "  motion       " << movers.last_key << " s: " << counted(movers.bodies.size(), "body") << ", "
             << counted(movers.lights.size(), "light") << '\n';
    if (const std::vector<std::string> names = followed_tracks(scene); !names.empty()) {
        const auto saved = std::ranges::count_if(scene.tracks, [&](const Track& track) {
            return !track.keys.empty() && std::ranges::find(names, track.name) != names.end();
        });
        text << "  tracks       " << names.size() << ", " << saved << " with keys; " << scene.music.bpm
             << " beats a minute of " << scene.music.rows << " rows";
        if (const std::string file = tracks_path(path); scene.tracks.empty() && !std::filesystem::exists(file))
            text << "; there is no " << show(file).text;
        if (scene.music.offset > 0) text << ", the first at " << scene.music.offset << " s";
        text << '\n';
        for (const std::string& message : unfollowed_tracks(scene))
            text << "               " << printable(message) << '\n';
    }
    return text.str();
}

void check_scene(const CheckOptions& options, std::string path) {
    OpeningOptions opening = options.opening;
    opening.as_text = options.print;
    follow_ini(path, opening);
    const OpenedScene opened = open_scene(read_scene_text(path), path, opening, read_pixels);
    std::string text;
    if (options.print) {
        text = write_scene(opened.scene);
    } else {
        text = show(shown_name(path)).text + ": no errors\n" + summary(opened.scene, path);
        if (!opened.summary.empty()) text += "  as POV-Ray   " + opened.summary + '\n';
        for (const Message& note : opened.notes) text += show(note.told()).text + '\n';
    }
    write_file("-", text);
    if (options.print) return;
    print_warnings(opened.warnings);
    for (const std::string& warning : scene_warnings(opened.scene)) std::cerr << "strahl: warning: " << warning << '\n';
}

}  // namespace

int check_command(const CheckOptions& options) {
    int status = exit_status::done;
    for (const std::string& scene : options.scenes) try {
            check_scene(options, scene);
        } catch (const FileError& error) {
            if (options.scenes.size() == 1) throw;
            std::cerr << printable(error.what()) << '\n';
            status = exit_status::bad_file;
        }
    return status;
}

}  // namespace strahl

// strahl check: a summary of a scene in a few lines.
#include "main/command_check.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "main/exit_status.h"
#include "scene/overlap.h"
#include "text/file.h"
#include "text/parse.h"
#include "text/utf8.h"
#include "text/write.h"

namespace strahl {
namespace {

std::string counted(std::size_t count, const std::string& noun) {
    const bool hisses = noun.ends_with('s') || noun.ends_with('x') || noun.ends_with("sh");
    return std::to_string(count) + " " + noun + (count == 1 ? "" : hisses ? "es" : "s");
}

std::ostream& operator<<(std::ostream& out, const DVec3& v) {
    return out << '<' << v.x << ", " << v.y << ", " << v.z << '>';
}

/// "7: 5 spheres, 1 plane, 1 cylinder"
template <class... Kinds>
std::string kinds_in_words(const std::vector<Primitive>& primitives, std::variant<Kinds...>*) {
    std::array<std::size_t, sizeof...(Kinds)> counts{};
    for (const Primitive& primitive : primitives) ++counts[primitive.shape.index()];
    constexpr std::array names{Kinds::name...};
    std::string words = std::to_string(primitives.size());
    const char* separator = ": ";
    for (std::size_t i = 0; i < names.size(); ++i)
        if (counts[i] > 0) words += std::exchange(separator, ", ") + counted(counts[i], names[i]);
    return words;
}

/// The box around all bounded bodies.
std::string bounds_in_words(const Scene& scene) {
    Box box;
    bool unbounded = false;
    for (const Primitive& primitive : scene.primitives) {
        if (const Box own = world_bounds(primitive); own.finite())
            box.add(own);
        else
            unbounded = true;
    }
    std::ostringstream words;
    if (box.empty())
        words << (unbounded ? "infinite" : "no bodies");
    else
        words << box.low << " to " << box.high << (unbounded ? ", and unbounded bodies" : "");
    return words.str();
}

std::string summary(const Scene& scene) {
    const auto transparent = std::ranges::count_if(scene.primitives, [&](const Primitive& primitive) {
        return scene.materials[static_cast<std::size_t>(primitive.material)].refraction > 0;
    });
    const Camera& camera = scene.camera;
    std::ostringstream text;
    text << "  primitives   " << kinds_in_words(scene.primitives, static_cast<Shape*>(nullptr)) << '\n'
         << "  transparent  " << transparent << (transparent == 1 ? " body" : " bodies") << '\n'
         << "  materials    " << scene.materials.size() << '\n'
         << "  lights       " << scene.lights.size() << '\n'
         << "  bounds       " << bounds_in_words(scene) << '\n'
         << "  camera       at " << camera.position << ", looking at " << camera.look_at << ", " << 2 * camera.fov
         << " degrees wide\n"
         << "  depth        " << scene.settings.max_trace_level << '\n'
         << "  background   " << scene.background << '\n'
         << "  values       " << (scene.settings.linear ? "linear light, shown sRGB-encoded" : "shown as they are")
         << '\n'
         << "  flythrough   ";
    if (const auto& path = scene.flythrough)
        text << path->duration << " s, " << counted(path->keys.size(), "key") << (path->loop ? ", looping" : "")
             << '\n';
    else
        text << "none\n";
    return text.str();
}

}  // namespace

int check_command(const CheckOptions& options) {
    const std::string file = options.scene == "-" ? "standard input" : options.scene;
    const Scene scene = parse_scene(read_text(options.scene), file);
    write_file("-", options.print ? write_scene(scene) : show(file).text + ": no errors\n" + summary(scene));
    return exit_status::done;
}

}  // namespace strahl

#include "main/commands/scene_file.h"

#include <algorithm>
#include <array>
#include <iostream>

#include "files/utf8.h"
#include "image/pixels.h"

namespace strahl {

void print_warnings(std::span<const std::string> warnings) {
    for (const std::string& warning : warnings) std::cerr << "strahl: warning: " << printable(warning) << '\n';
}
void print_warnings(std::span<const Message> warnings) {
    for (const Message& warning : warnings) print_warnings(std::array{warning.told()});
}

void tell_notes(const OpenedScene& scene, bool all) {
    constexpr std::size_t usual = 10;
    const std::size_t count = all ? scene.notes.size() : std::min(usual, scene.notes.size());
    print_warnings(std::span(scene.notes).first(count));
    if (count < scene.notes.size())
        std::cerr << "strahl: warning: and " << scene.notes.size() - count << " more; strahl check lists them\n";
}

OpenedScene load_opened(const std::string& path, OpeningOptions options, std::optional<double> time) {
    options.time = time;
    OpenedScene opened = open_scene(read_scene_text(path), path, options, read_pixels);
    tell_notes(opened, false);
    return opened;
}

Scene load_scene(const std::string& path, OpeningOptions options, std::optional<double> time) {
    return load_opened(path, std::move(options), time).scene;
}

}  // namespace strahl

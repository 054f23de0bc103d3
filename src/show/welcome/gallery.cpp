#include "show/welcome/gallery.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "files/os/file.h"
#include "files/os/system.h"
#include "files/output_file.h"
#include "files/read_file.h"
#include "show/work/stills.h"

namespace strahl {
namespace {

namespace fs = std::filesystem;

/// The folders of scenes, and the titles of their sections.
constexpr std::pair<const char*, const char*> folders[] = {{"", "Scenes"},
                                                           {"tutorial", "Steps of the tutorial"},
                                                           {"article", "Terms of the article's equation"},
                                                           {"kinds", "Kinds of bodies"},
                                                           {"patterns", "Patterns"},
                                                           {"pictures", "Pictures on bodies"},
                                                           {"pov", "In POV-Ray's language"}};

std::string name_of(const fs::path& scene) {
    std::string name = scene.stem().string();
    std::ranges::replace(name, '_', ' ');
    return name;
}

GallerySection section_of(const char* title, const fs::path& folder, bool begins) {
    GallerySection section{title, {}};
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".rt" || entry.path().extension() == ".pov")
            section.items.push_back({name_of(entry.path()), entry.path().string(), begins});
    std::ranges::sort(section.items, {}, &GalleryItem::path);
    return section;
}

/// Returns the folders where installed scenes may be.
std::array<fs::path, 3> scene_folders() {
    const fs::path program = os::program_folder();
    return {(program / "../share/strahl/scenes").lexically_normal(),
            (program / "../../scenes").lexically_normal(),  // of a program in build/release
            program / "scenes"};                            // of one that was unpacked on Windows
}

}  // namespace

std::string installed_scenes() {
    std::error_code error;
    for (const fs::path& folder : scene_folders())
        if (fs::is_directory(folder / "templates", error)) return folder.string();
    return "";
}

bool installed(const std::string& path) {
    const std::string folder = installed_scenes();
    if (folder.empty() || path.empty() || path == "-") return false;
    std::error_code error;
    const fs::path inside =
        fs::weakly_canonical(fs::absolute(path, error), error).lexically_relative(fs::weakly_canonical(folder, error));
    return !inside.empty() && *inside.begin() != "..";
}

std::string missing_scenes() {
    if (!installed_scenes().empty()) return "";
    const auto folders = scene_folders();
    return "no scenes are installed with this program: there are none in " + folders[0].string() + " and none in " +
           folders[1].string();
}

std::vector<GallerySection> gallery_of(const std::string& scenes, const std::vector<std::string>& recent) {
    std::vector<GallerySection> sections;
    if (!scenes.empty()) sections.push_back(section_of("Begin a new scene", fs::path(scenes) / "templates", true));
    sections.push_back({"Opened last", {}});
    std::error_code error;
    for (const std::string& path : recent)
        if (fs::is_regular_file(path, error)) sections.back().items.push_back({name_of(path), path});
    if (!scenes.empty())
        for (const auto& [folder, title] : folders)
            sections.push_back(section_of(title, fs::path(scenes) / folder, false));
    std::erase_if(sections, [](const GallerySection& section) { return section.items.empty(); });
    return sections;
}

GalleryPlace moved(const std::vector<GallerySection>& sections, GalleryPlace from, int items, int rows, int columns) {
    if (sections.empty()) return {};
    const auto count = [&](std::size_t section) { return std::ssize(sections[section].items); };
    GalleryPlace to = from;
    for (; items > 0; --items)
        if (std::ssize(sections[to.section].items) > std::ptrdiff_t(to.item) + 1)
            ++to.item;
        else if (to.section + 1 < sections.size())
            to = {to.section + 1, 0};
    for (; items < 0; ++items)
        if (to.item > 0)
            --to.item;
        else if (to.section > 0)
            to = {to.section - 1, sections[to.section - 1].items.size() - 1};
    const auto wide = static_cast<std::size_t>(columns);
    const auto last_row = [&](std::size_t section) { return static_cast<std::size_t>(count(section) - 1) / wide; };
    const std::size_t column = to.item % wide;
    const auto in_row = [&](std::size_t section, std::size_t row) {
        return GalleryPlace{section, std::min(row * wide + column, sections[section].items.size() - 1)};
    };
    for (; rows > 0; --rows)
        if (to.item / wide < last_row(to.section))
            to = in_row(to.section, to.item / wide + 1);
        else if (to.section + 1 < sections.size())
            to = in_row(to.section + 1, 0);
    for (; rows < 0; ++rows)
        if (to.item / wide > 0)
            to = in_row(to.section, to.item / wide - 1);
        else if (to.section > 0)
            to = in_row(to.section - 1, last_row(to.section - 1));
    return to;
}

std::string begin_scene(const std::string& from, std::string path) {
    const std::string text = read_text(from);
    if (path.empty()) {
        path = reserve_file("untitled", ".rt");
    } else {
        if (!path.ends_with(".rt")) path += ".rt";
        if (!os::OpenFile(path, os::OpenFile::OpenMode::create))
            throw FileError(errno == EEXIST ? "'" + path + "' exists; choose another name, or open that file"
                                            : "cannot write '" + path + "': " + std::generic_category().message(errno));
    }
    try {
        write_file(path, text);
    } catch (...) {
        std::remove(path.c_str());
        throw;
    }
    return path;
}

}  // namespace strahl

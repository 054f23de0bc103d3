#include "show/welcome/kept_pictures.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string_view>

#include "files/os/system.h"
#include "files/os/user_file.h"
#include "files/output_file.h"
#include "files/regular_file.h"
#include "files/streams.h"

namespace strahl {
namespace {

namespace fs = std::filesystem;

std::string file_of(const std::string& scene) {
    TextStream name;
    name << "strahl/pictures/" << std::hex << std::hash<std::string>()(fs::absolute(scene).lexically_normal().string());
    return os::user_file("XDG_CACHE_HOME", ".cache", name.str().c_str());
}

/// Returns what must be the same for a picture to be still that of its scene: the size of the picture, and the times of
/// the program and of each file that was read for it.
std::string state_of(const std::string& scene, int width, int height, const std::vector<std::string>& files) {
    const auto time = [](const std::string& file) { return fs::last_write_time(file).time_since_epoch().count(); };
    TextStream state;
    state << time(os::program_file()) << ' ' << width << ' ' << height << '\n' << fs::absolute(scene).string() << '\n';
    for (const std::string& file : files) state << time(file) << ' ' << fs::absolute(file).string() << '\n';
    return state.str() + '\n';
}

/// Returns the paths in a state.
std::vector<std::string> files_of(std::string_view state) {
    std::vector<std::string> files;
    for (int line = 0; !state.empty(); ++line) {
        const std::string_view text = state.substr(0, state.find('\n'));
        const std::size_t space = text.find(' ');
        if (line > 1 && space != text.npos) files.emplace_back(text.substr(space + 1));
        state.remove_prefix(std::min(text.size() + 1, state.size()));
    }
    return files;
}

}  // namespace

ScreenImage kept_picture(const std::string& scene, int width, int height) try {
    const std::string bytes = RegularFile(file_of(scene)).bytes(0, 1 << 24);
    const std::size_t end = bytes.find("\n\n");
    if (end == bytes.npos) return {};
    const std::string_view state = std::string_view(bytes).substr(0, end + 2);
    if (state != state_of(scene, width, height, files_of(state))) return {};
    ScreenImage image;
    image.resize(width, height);
    const std::size_t size = image.pixels.size() * sizeof(std::uint32_t);
    if (bytes.size() - state.size() != size) return {};
    std::memcpy(image.pixels.data(), bytes.data() + state.size(), size);
    return image;
} catch (const std::exception&) {  // no such file, or one of those that were read for it is gone
    return {};
}

void keep_picture(const std::string& scene, const SmallPicture& picture) try {
    const std::string file = file_of(scene);
    if (file.empty()) return;
    const ScreenImage& image = picture.image;
    fs::create_directories(fs::path(file).parent_path());
    write_file(file, state_of(scene, image.width, image.height, picture.files) +
                         std::string(reinterpret_cast<const char*>(image.pixels.data()),
                                     image.pixels.size() * sizeof(std::uint32_t)));
} catch (const std::exception&) {
}

}  // namespace strahl

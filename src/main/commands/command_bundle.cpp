// strahl bundle: collects a folder under another name, then renames it.
#include "main/commands/command_bundle.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

#include "files/os/file.h"
#include "files/os/folder.h"
#include "files/os/interrupt.h"
#include "files/os/system.h"
#include "files/output_file.h"
#include "files/read_file.h"
#include "files/regular_file.h"
#include "files/shell.h"
#include "files/streams.h"
#include "files/utf8.h"
#include "image/pixels.h"
#include "image/recognise.h"
#include "image/uncompressed.h"
#include "main/commands/scene_file.h"
#include "main/licence.h"
#include "main/process/exit_status.h"
#include "main/render/values.h"
#include "pov/open_scene.h"
#include "text/parse.h"
#include "text/reading/tracks_file.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view script_head = "#!/bin/sh\n# Made by strahl bundle.\n";

/// Returns whether every desktop has this library, and its drivers need their own: the C and C++ libraries, zlib, X,
/// OpenGL and Wayland.
bool of_the_desktop(const std::string& library) {
    constexpr std::array<std::string_view, 22> names{
        "linux-vdso.", "ld-linux", "libc.",   "libm.",  "libdl.",  "libpthread.", "librt.",  "libstdc++.",
        "libgcc_s.",   "libz.",    "libX",    "libxcb", "libxkb",  "libGL",       "libEGL.", "libOpenGL.",
        "libgbm.",     "libdrm",   "libbsd.", "libmd.", "libffi.", "libwayland-"};
    return std::ranges::any_of(names, [&](std::string_view name) { return library.starts_with(name); });
}

/// Returns the shared libraries of this program that go into the bundle. Must be called before pictures are read: that
/// loads some that a bundle does without.
std::vector<fs::path> libraries() {
    std::vector<fs::path> all = os::loaded_libraries();
    std::erase_if(all, [](const fs::path& path) { return of_the_desktop(path.filename().string()); });
    return all;
}

[[noreturn]] void fail(const fs::path& path, int error) {
    throw OutputError("cannot write '" + path.string() + "': " + std::generic_category().message(error));
}

/// Makes a folder beside the target, whose place it takes in the end.
os::NewFolder new_folder(const fs::path& target) try {
    return os::NewFolder(target.string() + ".tmp-");
} catch (const std::system_error& error) {
    fail(target, error.code().value());
}

/// Throws UsageError if something is there that this command did not make.
void require_own(const fs::path& folder) {
    if (!fs::exists(folder) || os::is_empty_folder(folder)) return;
    std::string head(script_head.size(), '\0');
    if (const fs::path script = folder / "play"; fs::is_regular_file(script))
        FileStream(script.string()).read(head.data(), static_cast<std::streamsize>(head.size()));
    if (head != script_head)
        throw UsageError("'" + folder.string() +
                         "' is there already and was not made by strahl bundle; give -o "
                         "another name");
}

/// Puts files into the bundle, and chooses their names in the scene.
class Collection {
  public:
    Collection(const fs::path& own_folder, const os::Interrupt& own_interrupt)
        : folder(own_folder), interrupt(own_interrupt) {}

    void copy(const fs::path& from, const fs::path& to) {
        write(to, read_text(from.string()));
        fs::permissions(folder / to, fs::status(from).permissions() | fs::perms::owner_read | fs::perms::owner_write);
    }
    void write(const fs::path& to, std::string_view bytes) {
        const fs::path path = place(to);
        os::OpenFile file(path, os::OpenFile::OpenMode::create);
        int error = file ? file.append(bytes) : errno;
        if (!error) error = file.close();
        if (error) fail(path, error);
        total += double(bytes.size());
    }
    /// Returns the path of a file that is to be written, in a folder that is there.
    fs::path place(const fs::path& to) {
        if (*interrupt.flag()) throw Interrupted("interrupted; no bundle was made");
        const fs::path path = folder / to;
        fs::create_directories(path.parent_path());
        return path;
    }
    double size() const { return total; }
    /// Returns a name for a file of the scene in the folder `files`. Each name is given once.
    std::string name_for(const std::string& file, const char* ending) {
        const fs::path own = fs::path(file).filename();
        std::string name;
        for (int i = 1; name.empty() || !given.insert(name).second; ++i)
            name = "files/" + own.stem().string() + (i > 1 ? "-" + std::to_string(i) : "") +
                   (ending ? ending : own.extension().string());
        return name;
    }

  private:
    const fs::path folder;
    double total = 0;  // bytes
    const os::Interrupt& interrupt;
    std::set<std::string> given;
};

/// Copies a picture that is read without OpenImageIO, which needs hundreds of libraries; others, .gif and .exr files,
/// become .png and .pfm files. Returns its name. Throws FileError for floats that are not opaque.
std::string bundled_picture(const std::string& path, Collection& bundle) {
    if (recognised(RegularFile(path)).read) {
        const std::string name = bundle.name_for(path, nullptr);
        bundle.copy(path, "scene/" + name);
        return name;
    }
    Picture picture = read_picture(path);
    if (picture.bits != 32) {
        const std::string name = bundle.name_for(path, ".png");
        write_picture(picture, bundle.place("scene/" + name).string(), {.bits = picture.bits});
        return name;
    }
    const std::size_t all = std::size_t(picture.channels), colors = all < 3 ? 1 : 3;
    std::vector<double> values;
    for (auto pixel = picture.values.begin(); pixel != picture.values.end(); pixel += std::ptrdiff_t(all)) {
        if (all > colors && pixel[colors] != 1)
            throw FileError("cannot bundle '" + path + "': it has an alpha channel beside floats; save it as .png");
        values.insert(values.end(), pixel, pixel + std::ptrdiff_t(colors));
    }
    picture.channels = int(colors), picture.values = std::move(values);
    const std::string name = bundle.name_for(path, ".pfm");
    bundle.write("scene/" + name, netpbm_of(picture));
    return name;
}

/// Replaces the names in a text's quotation marks.
std::string renamed_in(const std::string& text, const std::map<std::string, std::string>& names) {
    std::string result;
    std::size_t at = 0;
    for (std::size_t open; (open = text.find('"', at)) != text.npos;) {
        const std::size_t close = text.find('"', open + 1);
        const auto other = close == text.npos ? names.end() : names.find(text.substr(open + 1, close - open - 1));
        result += text.substr(at, open + 1 - at);
        at = open + 1;
        if (other != names.end()) result += other->second, at = close;
    }
    return result + text.substr(at);
}

/// Copies the scene and the files that it names. Returns its path in the bundle.
std::string collect_scene(const std::string& path, Collection& bundle) {
    const std::string text = read_text(path);
    FilesRead names;
    const Scene scene = parse_scene(text, path, {}, read_pixels, &names);
    print_warnings(names.warnings);
    std::map<std::string, std::string> renamed;
    for (const std::string& name : names.pictures) renamed[name] = bundled_picture(path_beside(path, name), bundle);
    names.meshes.merge(names.sounds);
    for (const std::string& name : names.meshes) {
        renamed[name] = bundle.name_for(name, nullptr);
        bundle.copy(path_beside(path, name), "scene/" + renamed[name]);
    }
    const std::string name = "scene/" + fs::path(path).filename().string();
    bundle.write(name, renamed_in(text, renamed));
    if (!scene.tracks.empty()) bundle.copy(tracks_path(path), tracks_path(name));
    return name;
}

void collect_program(const std::vector<fs::path>& libraries, Collection& bundle) {
    bundle.copy(os::program_file(), "bin/strahl");
    for (const fs::path& library : libraries) bundle.copy(library, "lib" / library.filename());
}

std::string start_script(const std::string& scene) {
    return std::string(script_head) +
           "here=$(dirname -- \"$(readlink -f -- \"$0\")\")\n"
           "LD_LIBRARY_PATH=\"$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}\" \\\n"
           "    exec \"$here/bin/strahl\" play \"$here\"/" +
           in_shell_quotes(scene) + " \"$@\"\n";
}

std::string read_me(const BundleOptions& options, const std::vector<fs::path>& libraries) {
    std::string names;
    for (const fs::path& library : libraries) names += "\n    " + library.filename().string();
    return fs::path(options.scene).stem().string() +
           "\n\n"
           "    ./play                    in full screen; Esc ends it, Space pauses\n"
           "    ./play --loop             again and again\n"
           "    ./play --size 1280x720    in a window\n\n"
           "It needs " +
           os::system_needed() +
           ", and a desktop with OpenGL 3.2.\n\n"
           "It is played by Strahl " +
           options.version + ", a ray tracer:\n\n" + licence +
           "\n"
           "These libraries are copies of the system's that it was made on, under their own licences:" +
           names + "\n";
}

}  // namespace

int bundle_command(const BundleOptions& options) try {
    if (options.scene == "-") throw UsageError("a bundle needs a scene file; its folder has the other files");
    if (is_pov(options.scene))
        throw UsageError("a bundle holds scene text: convert " + options.scene + " with strahl import first");
    fs::path target = fs::path(options.output).lexically_normal();
    if (!target.has_filename()) target = target.parent_path();
    if (target.empty()) throw UsageError("no output folder. Add -o FOLDER");
    require_own(target);
    const std::vector<fs::path> own_libraries = libraries();
    if (own_libraries.empty())  // the program is all in one file
        throw UsageError(
            "on Windows there are no bundles: a .zip of strahl.exe, OpenAL32.dll, the scene and its files does");
    const os::Interrupt interrupt;
    os::NewFolder folder = new_folder(target);
    Collection bundle(folder.path(), interrupt);
    const std::string scene = collect_scene(options.scene, bundle);
    // Reading it again here shows errors that would otherwise be noticed on the other machine.
    const std::string copy = (fs::path(folder.path()) / scene).string();
    parse_scene(read_text(copy), copy, {}, read_pixels);
    collect_program(own_libraries, bundle);
    bundle.write("play", start_script(scene));
    fs::permissions(folder.path() + "/play", fs::perms(0111), fs::perm_options::add);
    bundle.write("README.txt", read_me(options, own_libraries));
    if (const int error = folder.become(target)) fail(target, error);
    if (const int error = folder.remove())
        throw OutputError("'" + target.string() + "' is made, but the older bundle stays in '" + folder.path() +
                          "': " + std::generic_category().message(error));
    std::cout << printable(target.string()) << ": " << bytes_in_words(bundle.size()) << "; "
              << printable(target.string()) << "/play plays it\n";
    if (!for_other_processors())
        std::cerr << "strahl: this strahl was built for processors like this one; on others it plays slowly. "
                     "cmake --preset release -D STRAHL_LEVELS=all builds one for all\n";
    return exit_status::done;
} catch (const fs::filesystem_error& error) {
    throw OutputError("cannot make the bundle: " + error.path1().string() + ": " + error.code().message());
}

}  // namespace strahl

// Reads and writes picture files, and loads the module that reads .exr, .gif and packed .bmp files.
#include "image/picture.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <system_error>
#include <thread>
#include <type_traits>

#include "files/os/memory.h"
#include "files/os/system.h"
#include "files/words.h"
#include "image/picture_module.h"
#include "image/picture_writer.h"
#include "image/recognise.h"
#include "image/transfer.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

namespace strahl {
namespace {

namespace fs = std::filesystem;

/// The functions of the module.
struct PictureLibrary {
    decltype(&strahl_decode_picture) decode;
    decltype(&strahl_draw_text) draw_text;
};

/// Throws OutputError if no more threads can be started. Some libraries behind the module start threads while they
/// load, at most a few for each processor, and end the program where they cannot. So as many are started first.
void require_threads() {
    std::atomic<bool> tried = false;
    std::vector<std::jthread> threads;
    // Lets the threads end before they are joined, whatever is thrown.
    const auto let_go = [](std::atomic<bool>* flag) { *flag = true, flag->notify_all(); };
    const std::unique_ptr<std::atomic<bool>, decltype(let_go)> guard(&tried, let_go);
    try {
        for (unsigned i = 0; i < 4 + 2 * std::thread::hardware_concurrency(); ++i)
            threads.emplace_back([&] { tried.wait(false); });
    } catch (const std::system_error&) {
        throw OutputError(
            "the part of strahl that reads pictures cannot start its threads here; let more processes run "
            "(ulimit -u), or ask for fewer with --threads");
    }
}

/// Loads the module from lib/strahl: in the build folder, whose programs are at its top or one folder down, or in the
/// folder that it was installed to, whose programs are in bin.
PictureLibrary load_library() {
    std::error_code error;
    const fs::path folder = os::program_folder();
    fs::path path = folder / "lib/strahl/libstrahl_image.so";
    if (!fs::exists(path, error)) path = folder.parent_path() / "lib/strahl/libstrahl_image.so";
    if (!fs::exists(path, error))
        throw OutputError(
            "the part of strahl that reads such pictures is missing: there is no '" + path.string() +
            "'; build or install strahl again, or on Windows, which has none, make a .png of the picture");
    require_threads();
    const os::Library loaded(path.string());
    if (!loaded.fault().empty())
        throw OutputError("the part of strahl that reads pictures does not load: " + loaded.fault() +
                          "; it needs OpenImageIO in the version that strahl was built with");
#if defined(__SANITIZE_ADDRESS__)
    // One of these libraries ends its threads at exit, and the leak check fails on threads that are just ending: check
    // before.
    std::atexit(__lsan_do_leak_check);
#endif
    return {loaded.function<std::remove_pointer_t<decltype(PictureLibrary::decode)>>("strahl_decode_picture"),
            loaded.function<std::remove_pointer_t<decltype(PictureLibrary::draw_text)>>("strahl_draw_text")};
}

/// The module, which is loaded once, on first use.
const PictureLibrary& library() {
    static const PictureLibrary loaded = load_library();
    return loaded;
}

}  // namespace

std::string ending_of(const std::string& path) {
    const auto dot = path.find_last_of("./\\");
    std::string ending = dot == std::string::npos || path[dot] != '.' ? "" : path.substr(dot);
    for (char& c : ending) c = lower(c);
    return ending;
}

int bits_of(const std::string& ending, int bits) { return bits ? bits : ending == ".exr" ? 32 : 8; }

double half_step(FileFormat format) {
    if (format.bits > 16) return 0;
    const double steps = format.bits == 16 ? 65535 : 255 * gain_of(format.exposure);
    return .5 / steps / steepest(format.gamma);
}

std::string format_fault(const std::string& path, int bits) {
    const std::string ending = ending_of(path);
    if (ending == ".ppm" || ending == ".y4m")  // streams
        return bits_of(ending, bits) == 8 ? "" : "a " + ending + " stream has 8 bits per channel";
    if (ending != ".bmp" && ending != ".png" && ending != ".exr")
        return "pictures are written as .bmp, .png or .exr; give '" + path + "' one of these endings";
    bits = bits_of(ending, bits);
    if (ending == ".bmp" && bits != 8)
        return "a .bmp file has 8 bits per channel; choose .png for 16 or .exr for float";
    if (ending == ".png" && bits != 8 && bits != 16)
        return "a .png file has 8 or 16 bits per channel; choose .exr for float";
    if (ending == ".exr" && bits != 32) return "an .exr file has 32 bits per channel (float); choose .png for 8 or 16";
    return "";
}

void write_picture(const Picture& picture, const std::string& path, FileFormat format, const std::string& ending) {
    PictureWriter writer(picture.width, picture.height, picture.channels, path == "-" ? ending : path, format);
    writer.put(0, 0, picture.width, picture.height, picture.values.data());
    writer.write(path);
}

Picture read_picture(const std::string& path, std::uint64_t most) {
    const RegularFile file(path);
    const PictureFormat format = recognised(file);
    most = std::min(most, format.most);
    if (format.read) return format.read(file, most);
    Picture picture;
    std::string reason;
    if (!library().decode({path, format.library_name, most, os::available_memory()}, picture, reason))
        fail_reading(path, reason.substr(0, reason.find('\n')));
    return picture;
}

Picture text_picture(const std::string& text, int size) {
    Picture picture;
    std::string reason;
    if (!library().draw_text(text, size, picture, reason)) throw FileError("cannot draw text: " + reason);
    return picture;
}

}  // namespace strahl

// strahl import: reads another program's scene, reports unsupported features, and writes the rest as text.
#include "main/commands/command_import.h"

#include <filesystem>

#include "files/output_file.h"
#include "files/read_file.h"
#include "files/utf8.h"
#include "image/pixels.h"
#include "import/import.h"
#include "main/commands/scene_file.h"
#include "main/process/exit_status.h"
#include "main/render/values.h"
#include "text/write.h"

namespace strahl {

namespace {

Imported import_any(const ImportOptions& options) {
    if (!is_pov(options.file)) return import_scene(read_text(options.file), shown_name(options.file));
    OpeningOptions opening = options.opening;
    opening.as_text = true;
    const std::string text = read_text(options.file);
    const auto read = [&](const PictureSize& size) {
        opening.size = size;
        return open_scene(text, options.file, opening, read_pixels);
    };
    OpenedScene opened = read({640, 480});
    // Does the camera follow the picture's shape, or is its own the same by chance?
    auto& aspect = opened.scene.camera.aspectratio;
    if (opened.sized && !aspect && read({640, 320}).scene.camera.aspectratio) aspect = 4. / 3;
    Imported imported{.scene = std::move(opened.scene), .size = {}, .warnings = {}};
    for (const Message& note : opened.notes) imported.warnings.push_back(note.told());
    return imported;
}

}  // namespace

int import_command(const ImportOptions& options) {
    refuse_overwriting("-o", options.output, "the file to import", options.file);
    const Imported imported = import_any(options);
    std::string text = "// Imported";
    if (options.file != "-") text += " from " + show(std::filesystem::path(options.file).filename().string()).text;
    text += '.';
    if (imported.size)
        text += " Its picture: --size " + size_text(imported.size->width, imported.size->height);
    write_file(options.output, text + "\n\n" + write_scene(imported.scene));
    print_warnings(imported.warnings);
    return exit_status::done;
}

}  // namespace strahl

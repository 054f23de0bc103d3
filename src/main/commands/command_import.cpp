// strahl import: reads another program's scene, reports unsupported features, and writes the rest as text.
#include "main/commands/command_import.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "files/output_file.h"
#include "files/read_file.h"
#include "files/utf8.h"
#include "image/picture.h"
#include "image/pixels.h"
#include "import/import.h"
#include "main/commands/scene_file.h"
#include "main/process/exit_status.h"
#include "main/render/values.h"
#include "text/reading/opacity.h"
#include "text/write.h"

namespace strahl {

namespace {

namespace fs = std::filesystem;

/// Gives the pictures of a model names that a scene at the path `to` can use. Pictures that are in no file, or have
/// been changed, are written beside it as NAME-1.png and so on.
class PictureNames {
  public:
    PictureNames(const std::string& model, const std::string& to) : model(model), to(to) {}

    void set(std::shared_ptr<const Pattern>& pattern, const Opacity* opacity = nullptr) {
        if (!pattern) return;
        Pattern own = *pattern;
        if (auto* const image = std::get_if<ImagePattern>(&own.kind)) set(*image, opacity);
        pattern = std::make_shared<const Pattern>(std::move(own));
    }
    void set(Pigment& pigment) {
        const Opacity* const clear = opacity_of(pigment);
        if (!clear) return set(pigment.pattern);
        Pigment shown = opaque_part(pigment);
        set(shown.pattern, clear->file.empty() ? clear : nullptr);
        Opacity own = *clear;
        if (!own.file.empty()) own.file = name_of(own.file);
        pigment = partly_clear(shown, std::make_shared<const Opacity>(std::move(own)), pigment.pattern->transformations,
                               pigment.pattern->by_uv);
    }
    /// Returns the name of a file for the scene, from that for the model.
    std::string name_of(const std::string& file) const {
        const fs::path path = fs::path(model).parent_path() / file;
        return (path.is_absolute() ? path : path.lexically_proximate(folder())).generic_string();
    }

  private:
    fs::path folder() const { return to == "-" ? fs::path() : fs::path(to).parent_path(); }

    /// `opacity` is the alpha channel of the picture, if it needs one.
    void set(ImagePattern& image, const Opacity* opacity) {
        if (!image.file.empty()) return void(image.file = name_of(image.file));
        std::string& name = written[{image.pixels.get(), opacity != nullptr}];
        if (name.empty()) {
            if (to == "-") throw UsageError("the model has pictures of its own, which need files; add -o SCENE.rt");
            name = fs::path(to).stem().string() + "-" + std::to_string(written.size()) +
                   (image.pixels->linear ? ".exr" : ".png");
            Picture picture{image.pixels->width, image.pixels->height, opacity ? 4 : 3, {}};
            for (std::size_t i = 0; i < image.pixels->values.size(); ++i) {
                picture.values.push_back(std::max(image.pixels->values[i], 0.F));
                if (opacity && i % 3 == 2) picture.values.push_back(opacity->channel()[i / 3]);
            }
            FileFormat format{};
            format.bits = image.pixels->linear ? 32 : 8;
            write_picture(picture, (folder() / name).string(), format);
        }
        image.file = name;
    }

    const std::string &model, &to;
    std::map<std::pair<const Pixels*, bool>, std::string> written;  // by pixels, and whether they have an alpha channel
};

Imported import_model(const ImportOptions& options) {
    OpeningOptions opening = options.opening;
    opening.as_text = true;
    OpenedScene opened = open_scene(read_scene_text(options.file), options.file, opening, read_pixels);
    Imported result{.scene = std::move(opened.scene), .size = {}, .warnings = {}};
    for (const Message& note : opened.notes) result.warnings.push_back(note.told());
    PictureNames names(options.file, options.output);
    for (Material& material : result.scene.materials) {
        names.set(material.rgb), names.set(material.bump.pattern), names.set(material.normal.pattern);
        for (Material& coat : material.coats) names.set(coat.rgb.pattern);
    }
    for (Primitive& primitive : result.scene.primitives)
        if (auto* const mesh = std::get_if<Mesh>(&primitive.shape); mesh && !mesh->file.empty())
            mesh->file = names.name_of(mesh->file);
    return result;
}

Imported import_any(const ImportOptions& options) {
    if (is_model(options.file)) return import_model(options);
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
    if (imported.size) text += " Its picture: --size " + size_text(imported.size->width, imported.size->height);
    write_file(options.output, text + "\n\n" + write_scene(imported.scene));
    print_warnings(imported.warnings);
    return exit_status::done;
}

}  // namespace strahl

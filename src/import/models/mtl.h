// Reads the materials of OBJ files (Alias/Wavefront's .mtl).
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/models/textures.h"

namespace strahl {

/// A picture that a line `map_...` names, with its options.
struct MtlPicture {
    std::string file;  // relative to the .mtl
    TexturePlace place{};
    double strength = 1;  // -bm
    std::size_t line = 0;
};
/// A block `newmtl`. Values are as in the file: colours as they are to be seen, sRGB-encoded.
struct MtlMaterial {
    std::string name;
    Color diffuse{.8}, specular{0}, emission{0};  // Kd, Ks, Ke
    std::optional<Color> filter{};                // Tf
    double shininess = 0, opacity = 1, ior = 1;   // Ns, d, Ni
    int illum = 2;
    std::optional<MtlPicture> color_picture{}, opacity_picture{}, bump{}, normal{};
};

/// Reads a text. `path` names it in messages. Throws FileError with the line of what is wrong. What is not known is
/// left out; `warnings` receives a sentence for each such word.
std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& path, std::vector<std::string>& warnings);

/// Makes the material that shows it. `folder` is that of the .mtl, `beside` its name as seen from the model's folder.
Material material_of(const MtlMaterial& own, const std::string& path, const std::string& beside, Textures& textures);

}  // namespace strahl

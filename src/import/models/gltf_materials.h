// Materials of glTF files.
#pragma once
#include <map>

#include "import/models/gltf_file.h"
#include "import/models/textures.h"
#include "scene/material.h"

namespace strahl {

/// A material, and what it needs of a mesh.
struct GltfMaterial {
    Material material;
    int places = 0;         // the number of the set of places of its pictures
    bool pictured = false;  // does it have pictures?
};

class GltfMaterials {
  public:
    GltfMaterials(GltfFile& file, const ReadPixels& read_pixels, std::vector<std::string>& warnings)
        : file(file), read_pixels(read_pixels), warnings(warnings) {}

    /// Makes the material of an entry of "materials".
    GltfMaterial read(const GltfValue& own);

    std::vector<std::string> files;  // of pictures

  private:
    struct GltfPicture {
        std::shared_ptr<const FilePixels> pixels;
        std::string name;  // for scenes; empty if it is in no file of its own
    };
    /// A picture as a material has it.
    struct PictureUse {
        GltfPicture picture;
        TexturePlace place;
        bool sharp = false;
        explicit operator bool() const { return picture.pixels != nullptr; }
        Pattern pattern(const Color& factor = Color(1), bool clear = false) const;
    };
    PictureUse use(const GltfValue& texture, GltfMaterial& result);
    GltfPicture picture(const GltfValue& index);
    void warn(const std::string& message) { warnings.push_back(file.path + ": " + message); }

    GltfFile& file;
    const ReadPixels& read_pixels;
    std::vector<std::string>& warnings;
    std::map<std::int64_t, GltfPicture> pictures;
};

}  // namespace strahl

// Meshes of glTF files.
#pragma once
#include <functional>
#include <glm/mat4x4.hpp>
#include <map>

#include "import/models/gltf_materials.h"
#include "import/models/model.h"
#include "mesh/source.h"

namespace strahl {

/// The triangles of one material of a mesh.
struct GltfPart {
    std::shared_ptr<const MeshData> mesh;
    int material;  // index of Model::materials
};

class GltfMeshes {
  public:
    GltfMeshes(GltfFile& file, const ReadPixels& read_pixels, Model& model)
        : file(file),
          model(model),
          materials(file, read_pixels, model.warnings),
          source{file.path, "", {}, losses, nullptr} {}

    /// Reads an entry of "meshes", moved by weights of its morph targets and by the joints of a skin, if there are any.
    std::vector<GltfPart> read(const GltfValue& mesh, const std::vector<double>& weights,
                               const std::vector<glm::dmat4>& joints);
    /// Adds warnings and names of files to the model.
    void finish();

  private:
    std::optional<GltfPart> read_primitive(const GltfValue& own, const std::vector<double>& weights,
                                           const std::vector<glm::dmat4>& joints);
    void morph(const GltfValue& own, const std::vector<double>& weights, const char* attribute,
               std::vector<DVec3>& values);
    void bend(const GltfValue& attributes, const std::vector<glm::dmat4>& joints, MeshData& mesh);
    int material_number(const GltfValue& index, GltfMaterial& own);

    GltfFile& file;
    Model& model;
    GltfMaterials materials;
    Losses losses;
    Source source;
    std::map<std::int64_t, std::pair<int, GltfMaterial>> known;  // by their numbers in the file
};

}  // namespace strahl

// Reads a model from its file: meshes with their materials, and the camera and lights if the file has some.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "text/reading/scene_files.h"

namespace strahl {

struct ModelPart {
    std::string name;  // of the object or the group; may be empty
    std::shared_ptr<const MeshData> mesh;
    int material = 0;                               // index of Model::materials
    std::vector<Transformation> transformations{};  // motions
    std::shared_ptr<const MeshData> first{};  // `mesh` at the beginning of the animation; null if that is the same

    const std::shared_ptr<const MeshData>& at_first() const { return first ? first : mesh; }
};

/// Lengths and axes are those of the file; colours are linear light.
struct Model {
    std::vector<ModelPart> parts;
    std::vector<Material> materials;
    DVec3 up{0, 1, 0}, front{0, 0, 1};  // perpendicular axes; `front` points from the model to who looks at it
    std::optional<Camera> camera{};
    std::vector<Light> lights{};
    double seconds = 0;                   // of its motions; 0 if nothing moves
    bool changes = false;                 // meshes bend in time: it has to be read again for each moment
    bool whole = false;                   // the meshes are all of one file, unchanged, which a scene can name
    std::vector<std::string> files{};     // that were read, the model's own first
    std::vector<std::string> warnings{};  // sentences on what is not shown as the file means it
};

/// Does the path end like that of a model: .obj, .ply, .stl, .gltf or .glb?
bool is_model(std::string_view path);

/// Reads a model with its materials and pictures, as its meshes are at a time. Throws FileError. Files that it names
/// may be missing: that is a warning.
Model read_model(const std::string& path, const ReadPixels& read_pixels, double time = 0);

/// The material of what has none: light grey.
Material plain_material(const Color& color = Color(.55));

/// Makes a transparent material reflect by Fresnel's law; what it reflects does not come through.
void reflect_as_glass(Material& material);

/// Returns the linear light of an sRGB-encoded value from 0 to 1 (IEC 61966-2-1).
double linear_light(double encoded);
/// Returns the linear light of a colour's channels: at most 1e9, as a scene cannot have brighter ones.
Color linear_light(const Color& encoded);

}  // namespace strahl

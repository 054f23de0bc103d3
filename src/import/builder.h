// Builds an imported scene, for both formats.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "import/import.h"
#include "import/warnings.h"
#include "import/word_reader.h"
#include "mesh/join.h"
#include "mesh/split.h"
#include "scene/kinds/mesh_data.h"
#include "text/blocks/materials.h"

namespace strahl {

/// Builds a scene that can be written as text and read again: bodies and lights that the language does not allow are
/// left out with a warning. Warnings name the line of the word taken last.
class SceneBuilder {
  public:
    SceneBuilder(WordReader& words, const ImportLimits& limits) : words(words), limits(limits) {}

    void warn(const std::string& message) { warnings.add(words.line(), message); }

    /// Fails if the camera is invalid.
    void set_camera(const Camera& camera);
    /// Limits values to their ranges. Leaves out a light without a direction that it needs.
    void add_light(Light light);
    void set_fog(Fog fog);

    /// Sets the material of the bodies that follow. Limits values to their ranges.
    void set_material(Material material);

    void add(const Shape& shape);
    void add_plane(const DVec3& point, const DVec3& normal);
    /// Adds a cylinder without ends, which gets ends far away.
    void add_endless_cylinder(const DVec3& centre, const DVec3& axis, double radius);
    /// Adds a plane polygon; `normals` is empty or has one for each corner. A run of polygons of one material becomes a
    /// mesh.
    void add_polygon(std::span<const DVec3> corners, std::span<const DVec3> normals);

    /// Changes all materials; to be called after the last body.
    template <class Change>
    void change_materials(const Change& change) {
        end_mesh();
        Materials changed;
        std::vector<int> numbers;
        for (Material each : materials.list) {
            change(each);
            numbers.push_back(changed.number(each));
        }
        for (Primitive& primitive : scene.primitives) primitive.material = numbers[primitive.material];
        materials = std::move(changed);
    }
    /// The largest coordinate of the camera and of bounded bodies, at least 1.
    double reach() const;
    Imported finish(std::string_view file);

    Scene scene;
    std::optional<PictureSize> size;

  private:
    struct EndlessCylinder {
        std::size_t number;  // in the list of primitives
        DVec3 centre, axis;
    };

    template <class Value>
    bool fits(const Value& value, Range range, const char* name, const char* kind);
    void put(const Shape& shape);
    void count_body();
    void end_mesh();
    void place_far();

    WordReader& words;
    const ImportLimits limits;
    Warnings warnings;
    Materials materials;
    Material material;

    // The current run of polygons.
    PointJoiner points, normals;
    std::vector<MeshData::Corners> triangles, corner_normals;
    FaceSplitter splitter;
    std::size_t bodies = 0;

    std::vector<EndlessCylinder> endless;
};

}  // namespace strahl

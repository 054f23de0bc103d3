// Reads what a POV-Ray scene declares: bodies, textures, lights and cameras.
#pragma once
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "pov/language/interpreter.h"
#include "pov/reading/pictures.h"
#include "pov/things/objects.h"
#include "pov/things/outlines.h"
#include "scene/kinds/mesh_data.h"
#include "text/reading/scene_files.h"

namespace strahl::pov {

class PovReader : public SceneLayer {
  public:
    /// Reads everything up to the end.
    void read_all(Interpreter& interpreter);
    /// Tells of the functions that are .5 everywhere, and have been called since.
    void tell_constants(Interpreter& interpreter) const;

    NamedValue read_thing(Interpreter& in) override;
    void read_default(Interpreter& in) override;
    std::shared_ptr<const FunctionThing> read_function(Interpreter& in) override;

    PovContents contents;

  protected:
    explicit PovReader(ReadPixels read_pixels) : pictures(std::move(read_pixels)) {}
    /// Returns the function that is 1 where a matrix moves points into the body, and 0 elsewhere.
    virtual std::shared_ptr<const FunctionThing> inside_of(Interpreter& in, const ObjectThing& object,
                                                           const glm::dmat4& inverse) = 0;

  private:
    // scene_items.cpp
    bool read_item(Interpreter& in);
    void read_settings(Interpreter& in);
    void place(std::shared_ptr<const ObjectThing> object);
    // cameras.cpp
    CameraThing read_camera(Interpreter& in);
    FogThing read_fog(Interpreter& in);
    SkyThing read_sky(Interpreter& in);
    // transforms.cpp
    bool read_step(Interpreter& in, Steps& steps);
    // textures.cpp
    void read_pigment(Interpreter& in, PigmentThing& pigment);
    void read_pigment_body(Interpreter& in, PigmentThing& pigment);
    void read_normal(Interpreter& in, NormalThing& normal);
    void read_normal_body(Interpreter& in, NormalThing& normal);
    void read_finish(Interpreter& in, FinishThing& finish);
    void read_interior(Interpreter& in, InteriorThing& interior);
    std::shared_ptr<const TextureThing> read_texture(Interpreter& in);
    /// Reads a texture's name, or texture { ... }.
    std::shared_ptr<const TextureThing> next_texture(Interpreter& in);
    std::shared_ptr<const TextureThing> read_texture_body(Interpreter& in);
    bool read_old_texture_word(Interpreter& in, LayerValues& layer);
    void read_tiles(Interpreter& in, Blend& blend);
    void read_material_map(Interpreter& in, LayerValues& layer);
    std::shared_ptr<const MaterialThing> read_material(Interpreter& in);
    // patterns.cpp
    bool read_pattern_word(Interpreter& in, Blend& blend, ValueKind level);
    bool read_modifier(Interpreter& in, Blend& blend, ValueKind level);
    std::shared_ptr<const Thing> read_nested(Interpreter& in, ValueKind level);
    std::shared_ptr<const MapThing> read_map(Interpreter& in, ValueKind level);
    void read_list(Interpreter& in, Blend& blend, ValueKind level);
    static Warp read_warp(Interpreter& in);
    // functions.cpp
    std::shared_ptr<const FunctionThing> read_inside(Interpreter& in);
    // objects.cpp
    std::shared_ptr<const ObjectThing> read_object(Interpreter& in);
    bool read_object_modifier(Interpreter& in, ObjectThing& object);
    void read_parts(Interpreter& in, ObjectThing& object);
    void add_texture(ObjectThing& object, std::shared_ptr<const TextureThing> more);
    std::shared_ptr<TextureThing> kept_texture(const ObjectThing& object);
    void join_textures(ObjectThing& object);
    void share_texture(Interpreter& in, ObjectThing& object);
    void transform_object(ObjectThing& object, std::span<const Step> steps);
    std::vector<std::shared_ptr<const ObjectThing>> read_object_block(Interpreter& in);
    // shapes.cpp
    static bool is_shape(std::uint16_t code);
    static void open_ends(ObjectThing& object);
    void read_shape(Interpreter& in, std::uint16_t code, ObjectThing& object);
    void read_mesh(Interpreter& in, ObjectThing& object);
    void read_mesh2(Interpreter& in, ObjectThing& object);
    // surfaces.cpp
    bool read_surface(Interpreter& in, std::uint16_t code, ObjectThing& object);
    void read_height_field(Interpreter& in, ObjectThing& object);
    void read_text_body(Interpreter& in, ObjectThing& object);
    // implicit.cpp
    bool read_implicit(Interpreter& in, std::uint16_t code, ObjectThing& object);
    void read_blob(Interpreter& in, ObjectThing& object);
    void read_isosurface(Interpreter& in, ObjectThing& object);
    void read_parametric(Interpreter& in, ObjectThing& object);
    static void set_polynomial(ObjectThing& object, int order, const std::vector<double>& coefficients);
    static void set_surface(ObjectThing& object, const char* name, std::function<MeshData(int cells)> make);
    // lights.cpp
    std::shared_ptr<const ObjectThing> read_light(Interpreter& in);
    std::shared_ptr<const ObjectThing> read_light_group(Interpreter& in);

    std::vector<std::pair<TextPlace, std::shared_ptr<std::atomic<bool>>>> pattern_functions;  // was it called?
    std::shared_ptr<const TextureThing> default_texture = std::make_shared<TextureThing>();
    std::shared_ptr<const TextureThing> last_texture;  // texture of the last body, if it was plain
    static constexpr int most_bodies = 5'000'000, most_levels = 2000;
    int bodies = 0;
    CameraThing default_camera;
    bool utf8 = false;                                                      // `text` is
    std::map<Point2, std::shared_ptr<const LevelSurface>> superellipsoids;  // so far, by their exponents
    PictureReader pictures;
};

}  // namespace strahl::pov

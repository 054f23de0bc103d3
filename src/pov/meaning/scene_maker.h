// Makes a scene of what a POV-Ray file declares.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "pov/meaning/materials.h"
#include "pov/meaning/sight.h"
#include "pov/things/objects.h"
#include "scene/scene.h"

namespace strahl::pov {

/// POV-Ray's picture plane: the ray through (x, y) in [-1/2, 1/2]^2, y up, is direction + x right + y up.
struct CameraAxes {
    DVec3 location{0}, direction{0, 0, 1}, right{1.33, 0, 0}, up{0, 1, 0};
    DVec3 sky{0, 1, 0};  // `up` is its part across the direction
    double angle = 0;    // as given, if the camera is not transformed; else 0
    /// Seen by it, does the scene's z axis point away where x points right and y up, as POV-Ray has it by default?
    bool left_handed() const;
};
CameraAxes axes_of(const CameraThing& camera);

class SceneMaker {
  public:
    /// `mirrored` decides whether the scene is turned over in z; by default it is if the camera is left-handed.
    SceneMaker(Interpreter& in, const PovContents& contents, std::optional<bool> mirrored = {});
    Scene make();
    /// Is the scene turned over in z?
    bool mirrors() const { return mirrored; }
    /// Returns the places of the scene's bodies in the texts.
    const std::vector<TextPlace>& places() const { return kept_places; }
    /// Returns the places of its lights.
    const std::vector<TextPlace>& places_of_lights() const { return light_places; }
    struct Part {
        Primitive primitive;
        bool negated = false;  // it fills the space outside of it
    };
    /// Returns the bodies of one object.
    std::vector<Part> bodies_of(const ObjectThing& object);

  private:
    struct Around;
    /// The material of a composite, which its parts without a texture share; its pattern is in the composite's space.
    struct Shared {
        const Around* within;
        std::optional<int> number;
    };
    /// How an object looks that has no properties of its own.
    struct Looks {
        std::shared_ptr<const TextureThing> texture;
        std::shared_ptr<const InteriorThing> interior;
        bool no_shadow = false, no_image = false, no_reflection = false, both_sides = false;
        int group = 0;             // of lights, see Material
        bool common = true;        // lights of no group shine on it
        bool hollow = false;       // there is fog in it
        int space = 0;             // the number of its interior, see Material::interior
        Shared* shared = nullptr;  // state of the outermost composite that gives it its texture
    };
    /// Holds the properties that an object takes over from the objects around it.
    struct Around : Looks {
        Steps after;                          // transformations of these, the innermost one's first
        std::vector<Transformation> moves{};  // the same steps as Strahl's transformations
        Steps to_owner;                       // from the space around the object into that of the texture
        bool clips = false;                   // it clips another object, and is not seen itself
        bool turned = false;                  // it is turned inside out, as what a difference takes away
        bool merges = false;                  // it was turned at some time: unions in it keep no surfaces inside them
        bool turned_last = false;             // it is turned by what is not moved later
    };
    // bodies.cpp
    void add(const ObjectThing& object, const Around& around);
    static void take_over(const ObjectThing& object, const Around& around, Looks& own);
    static Steps to_owner(const ObjectThing& object, const Around& around);
    Around inside(const ObjectThing& object, const Around& around);
    std::optional<Part> build(const ObjectThing& object, const Around& around);
    Steps fold_into_patch(const ObjectThing& object, const Around& around, Shape& shape, Steps& steps);
    std::optional<Part> build_turned(const ObjectThing& object, const Around& around);
    void tell_of_cuts(const Primitive& body, TextPlace place) const;
    bool clear(const Primitive& body, bool bends = false) const;
    void close_mesh(const ObjectThing& object, const Around& around, bool takes_away, Primitive& body);
    bool close(Primitive& body, TextPlace place);
    std::optional<Part> build_parts(const ObjectThing& object, const Around& around);
    void keep_surfaces(Primitive& whole, const Around& around, bool turned, TextPlace place) const;
    std::optional<Part> clipped(const ObjectThing& object, const Around& around, Part part);
    int number_of(Shared& shared);
    template <class Way>
    int number_of(const Looks& own, const UvMapping& uv, const Way& way);
    bool shows_inside(const ObjectThing& object, const Shape& shape, const Around& around, const Steps& steps) const;
    static UvMapping uv_of(const ObjectThing& object, const Around& around, bool mapped, const Steps& folded);
    int cells_of(const ObjectThing& object, const Around& around);
    int material_of(const ObjectThing& object, const Around& around, bool mapped, const Steps& folded);
    void set_single_planes(Primitive& body, TextPlace place);
    bool is_opaque_sweep(const ObjectThing& object, const Around& around);
    void fill_around(Primitive& whole);
    void push(Part part, const ObjectThing& object, const Around& around);
    void count_surfaces(const ObjectThing& object);
    void tell_notes(const ObjectThing& object) const;
    void take(double Material::*part, Primitive& body);
    void set_planes();
    void drop_shadow_copies();
    void settle_materials();
    void settle_spaces();
    void clear_overlapping();
    // lights.cpp
    void add_light(const ObjectThing& object, const Around& around);
    // view.cpp
    void set_camera();
    void set_background();
    void set_settings();
    void tell_of_lights_on_surfaces(SeenPlaces& sight) const;
    void tell_of_light_behind_planes(SeenPlaces& sight) const;
    void tell_of_fog_in_pieces() const;
    void set_bailout();

    Interpreter& in;
    const PovContents& contents;
    const CameraAxes axes;
    const bool mirrored;
    NoteTaker notes;
    MaterialMaker materials;
    Scene scene;
    struct Seen {
        bool no_shadow, no_image, no_reflection;
        TextPlace place;
        bool negated;  // see Part
    };
    std::vector<Seen> shown;  // how each primitive is seen
    std::vector<TextPlace> kept_places, light_places;
    int light_groups = 0;   // so far
    int spaces = 0;         // interiors so far
    int surfaces_made = 0;  // meshes of bodies that functions define
    struct SurfaceUse {
        int count = 0;  // number of bodies that are this surface
        int cells = 0;
    };
    std::map<const LevelSurface*, SurfaceUse> surface_uses;
    int objects_counted = 0;
    // Meshes and blobs by their data, of which all uses share one.
    std::map<std::shared_ptr<const void>, Shape> mirrored_shapes;
    std::map<std::shared_ptr<const MeshData>, std::shared_ptr<const MeshData>> single_planes;  // by those given
};

}  // namespace strahl::pov

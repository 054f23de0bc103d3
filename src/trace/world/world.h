// World: a scene made ready for one kind of number, as the kernels read it. Plain arrays, const ever after.
#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include "scene/kinds/kinds.h"
#include "trace/world/world_finishes.h"
#include "trace/world/world_patterns.h"

namespace strahl {

struct Node;
template <class T>
struct LightBuffer;
template <class T>
struct PlacedMesh;

/// Shares and weights above 1, of glass brighter than white or of total reflection, grow no further than this, or in
/// float they would become infinite and, times 0, NaN.
inline constexpr float largest_gain = 1e18f;
/// When a hit's direct light may be pruned, lights below this multiple of its diffuse term (of a light straight above)
/// are skipped.
inline constexpr float faint_share = 2;
/// The most lanes of a pack. Arrays hold as many elements more, because packs are loaded and stored whole.
inline constexpr int widest_pack = 16;

/// A kernel with the numbers of its surface and its material. It is made of elements of one type only, so that packs of
/// items are gathered lane by lane, and those two numbers come with the others as lanes. That is why they are stored as
/// T although they are integers, which T holds exactly up to `World::capacity`: 2^24 in float.
template <class Form, class T>
struct Item {
    using Kind = typename Form::Kind;
    static constexpr int faces = Form::Kind::faces;
    static constexpr bool has_exits = Form::Kind::bounded && Form::Kind::convex && Form::Kind::closed;
    typename Form::template Kernel<T> shape;
    T surface;  // number of its first face; faces are numbered through the scene in the order declared
    T material;
};

/// Material coefficients, multiplied out as far as they can be before a ray is known.
template <class T>
struct MaterialKernel {
    Vec3<T> ambient;  // Ia Ka Of
    Vec3<T> diffuse;  // Kd Of
    Vec3<T> filter;   // Kt Of, what a shadow ray keeps at each surface crossed
    T specular, pow, reflection, refraction, ior;
    T shines_from;  // the cosine up to which a highlight is below the last bit
    T scattered;    // see scattered_light
};

/// How shadow rays look for bodies: all at once; not for those near their ends; not for these, and surfaces that dim
/// them one after the other; all surfaces one after the other.
enum class ShadowRays : std::int32_t { whole, past_near, followed_where_dimmed, followed };

/// The cone of a spotlight, whose angles are given as 1 less their cosines.
template <class T>
struct SpotKernel {
    Vec3<T> axis{0};
    T radius = 0, falloff = 0;  // the angles up to which all light shines, and beyond which none does
    T per = 0;                  // 1 over their difference
    T tightness = 0;
};
/// A light that is a rectangle around its position, see Light.
template <class T>
struct AreaKernel {
    Vec3<T> u{0}, v{0};  // its edges
    bool soft = false;
    std::int32_t columns = 0, rows = 0, adaptive = 0;  // of a soft light's grid; 0 without one
    bool circular = false, orient = false, mirrored = false, jitter = false;
};
/// Parallel light around an axis, see Light.
template <class T>
struct BeamKernel {
    Vec3<T> on_axis{0};                     // a point of the axis
    T radius = 0, core = 0, tightness = 0;  // radius 0: there is no axis, and light everywhere
};
/// A light; parallel light has the direction towards it as its position.
template <class T>
struct LightKernel {
    Vec3<T> position, color;
    T finite = 1, far = 1;  // 0 and infinity for parallel light
    Vec3<T> u{0}, v{0};     // of parallel light that is no rectangle: unit vectors across it
    bool spot = false;      // does it have this cone?
    SpotKernel<T> cone;
    bool special = false;  // has any of what follows
    bool shadowless = false;
    T fade_per = 0, fade_power = 0;  // fade_per: 1 over the distance; 0 if the light does not fade
    bool area = false;               // is it this rectangle?
    AreaKernel<T> rectangle;
    bool starts = false;  // parallel light from the plane of the points p with position . p = start
    T start = 0;
    BeamKernel<T> beam;      // of such light
    std::int32_t group = 0;  // see FinishKernel
};

/// A body as seen from a point: around the direction `axis`, no further off than an angle with this cosine, and no
/// nearer than `distance`. Of a body without a known bound the cosine is -2 and the distance -infinity.
template <class T>
struct LightCone {
    Vec3<T> axis{0};
    T cosine = -2, distance = -std::numeric_limits<T>::infinity();
};

/// A set of bodies, with a bit for each by its sort bin.
using BodySet = std::uint64_t;
inline constexpr int most_item_bins = 64;  // up to here each item has a bin of its own, and there is no hierarchy

/// Items [first, first + count) of a form.
struct ItemRange {
    std::int32_t form, first, count;
};
/// The item of a surface: its index among the items of its form, and the bin by which hits are sorted.
struct ItemReference {
    std::int32_t item, bin;
};
/// The items that hits of a bin are on: one of this form with its material, or any item of the form if these are -1.
/// An item without a material has hits on any of its faces, or as a composite none: these are in its leaves' bins.
struct SortBin {
    std::int32_t form, item = -1, material = -1;
};

/// The items of a form. Those of the hierarchy come first, in the order of its leaves, then those that are looked at
/// one after the other: unbounded ones, and all in a world without a hierarchy.
template <class F, class T>
struct Group {
    using Form = F;
    template <class S>
    using ItemOf = Item<F, S>;
    const Item<F, T>* items = nullptr;
    int count = 0, in_hierarchy = 0;
    // The items of the leaves once more, field by field: field f of the i-th of a leaf's n items, the first of which is
    // item k, is columns[k * fields + f * n + i]. A pack may be read past the end. Only where there is a hierarchy.
    const T* columns = nullptr;
    int first_bin = 0;  // its bins are this one and, if there is a bin per item, one for each
};

/// The form of all composites.
using CompositeForm = Form<Union, 0>;

/// A plane that faces of a composite's parts lie in: normal . x = distance.
template <class T>
struct CompositePlane {
    Vec3<T> normal;
    T distance;
};
/// A ball around a leaf of a composite, infinite if none is known.
template <class T>
struct CompositeBall {
    Vec3<T> centre{0};
    T square = std::numeric_limits<T>::infinity();  // square of the radius
};
/// A simple body of a composite: an item of its form, beyond those that are looked at by themselves.
struct CompositeLeaf {
    std::int32_t form, item, material;
    std::int32_t surface, faces;      // the number of its first face, and how many it has
    std::int32_t half_space;          // of a half-space 1 if it is behind its plane's normal, -1 if before it; else 0
    bool listed = false;              // rays may cross it more than four times, as a mesh: these crossings are listed
    const Node* nodes = nullptr;      // of a mesh: the hierarchy of its triangles, which are the items from `item` on
    std::int32_t first_key = 0;       // of its first face; if listed, if that has one of its own
    bool in_planes = false;           // if listed: some of its faces have the keys of planes
    float low[3] = {}, high[3] = {};  // if listed: the box around it, as the hierarchy's are
    // Say, at the first leaf of what an intersection is made with or a difference takes away, which step does so, and
    // how many leaves there are up to it. Where no body comes before that leaf, nothing is left by the step either, so
    // that these leaves are not looked at.
    std::int32_t until = 0, leaves = 0;
    bool kept = false;  // a union keeps its surfaces
};
/// The steps that combine the insides of leaves to that of the whole: take the next leaf, or make one of the last two
/// results.
enum class CompositeStep : std::uint8_t { leaf, unite, intersect, subtract, keep };  // keep: see Composite::keeps
inline bool unites(CompositeStep step) { return step == CompositeStep::unite || step == CompositeStep::keep; }
/// Ranges of the world's arrays. Faces have keys: those below `most_planes` are numbers of planes, which half-spaces
/// have, and flat faces of parts if a face of another part lies in the same plane.
struct CompositeInfo {
    std::int32_t first_leaf, leaves, first_step, steps, first_plane;
    std::int32_t first_key, surface, surfaces;
    bool shares_faces;  // some keys are of planes, or of several parts
    bool keeps;         // does it contain a union that keeps inner surfaces?
};
inline constexpr int most_planes = 6 * most_leaves;

template <class T, class Forms>
struct GroupsOf;
template <class T, class... F>
struct GroupsOf<T, FormList<F...>> : Group<F, T>... {
    template <class Form>
    [[gnu::always_inline]] const Group<Form, T>& get() const {
        return *this;
    }
    /// Calls visit(group) for each form in the order of the list.
    template <class Visit>
    [[gnu::always_inline]] void each(const Visit& visit) const {
        (visit(static_cast<const Group<F, T>&>(*this)), ...);
    }
    template <class Visit>
    [[gnu::always_inline]] void each(const Visit& visit) {
        (visit(static_cast<Group<F, T>&>(*this)), ...);
    }
};

/// The shadows of bodies in parallel light, by bin: rectangles in the coordinates along the light's `u` and `v`, which
/// end at `end` towards the light. Of a body without a known bound all are infinite. A pack may be read past the last.
template <class T>
struct ParallelShadows {
    std::array<T, most_item_bins + 16> left, right, bottom, top, end;
};

/// A box around a body; infinite if none is known.
template <class T>
struct BodyBox {
    Vec3<T> low, high;
};

/// Bodies of a world with a bin for each item, by bin. Empty in other worlds.
template <class T>
struct FewBodies {
    Vec3<const T*> centres{nullptr};      // centres of balls around the bodies; a pack may be read past the end
    const T* radii = nullptr;             // radii of these balls; infinite for planes, -infinite past the end
    const BodyBox<T>* boxes = nullptr;    // around the bodies
    const LightCone<T>* cones = nullptr;  // by light * bins + bin: each body as seen from the light
    const BodySet* occluders =
        nullptr;         // by light * bins + bin: bodies that can keep the light from it, itself only from inside
    BodySet cold = 0;    // bodies of other than hot forms
    BodySet convex = 0;  // bodies that never shadow their own outside
    // Transparent convex bodies that nothing else reaches into: a ray inside meets the same body again.
    BodySet enclosed = 0;
    // For proofs the cones by columns: by light the axes' x, y and z, the cosines and the distances of all bins.
    const T* cone_columns = nullptr;
    static constexpr int cone_stride = most_item_bins + 16;  // a pack may be read past the end
    const ParallelShadows<T>* shadows = nullptr;             // by light; infinite for lights that are not parallel
};

/// Arrays of all composites and their leaves. Null in worlds without composites, but for the last one.
template <class T>
struct CompositeTables {
    const CompositeInfo* list = nullptr;  // by the number in a composite's kernel
    const CompositeLeaf* leaves = nullptr;
    const CompositeBall<T>* balls = nullptr;  // by leaf
    const CompositeStep* steps = nullptr;
    const CompositePlane<T>* planes = nullptr;
    const std::int32_t* face_keys = nullptr;
    // By surface: which face of its leaf, or of a body with contours, it is; else -1. Also without composites.
    const std::int32_t* leaf_faces = nullptr;
};

/// Patterns of materials and of the background. Materials with patterns follow those without: each as often as there
/// are bodies in spaces of their own that have it, with the largest colour of the pattern as its colour. Where normals
/// are bent all materials are repeated in this way, and the first ones are not used.
template <class T>
struct PatternTables {
    int first = std::numeric_limits<int>::max();  // the first material with patterns
    const PatternKernel<T>* list = nullptr;       // patterns of the materials from there on; null if there are none
    const BendKernel<T>* bends = nullptr;         // bumps of the same materials; null if no normals are bent
    const ColorStopKernel<T>* stops = nullptr;
    const MipMapKernel* mip_maps = nullptr;    // by the numbers of images; null where these are not filtered
    bool has_quick_means = false;              // some patterns have
    bool quick = false;                        // filters are approximate, and note nothing
    const PatternKernel<T>* sky = nullptr;     // of the background, by direction; null if it has none
    const PatternKernel<T>* nested = nullptr;  // patterns that are colours of other patterns
    const PatternKernel<T>* coats = nullptr;   // before the background, the lowest first
    int coat_count = 0;
};

/// Transparent bodies of nested worlds, by surface. Null in other worlds.
template <class T>
struct MediumTables {
    const T* iors = nullptr;
    const std::int32_t* bodies = nullptr;  // the first surface of the body that a surface is of
    const std::uint8_t* hollow = nullptr;  // 1 where there is fog in the body; null if there is in none
};

/// Fog of the whole scene. Kernels skip it if there is none.
template <class T>
struct FogKernel {
    bool any = false;
    T per = 0;  // 1 over its distance
    Vec3<T> color{0};
    bool even = true;       // everywhere the same, and hides the background
    Vec3<T> rise{0};        // ground fog: a point p is at the height rise . p + base
    T base = 0, least = 0;  // least: the share of light that always comes through
    bool swirls = false;    // noise makes it patchy; a point p of the world is at place + p * unit in the scene
    DVec3 turbulence{0}, place{0};
    double unit = 1, depth = 0;
    std::int32_t octaves = 1, generator = 2;
    float omega = 0, lambda = 0;
    Vec3<T> tint{1};  // factors of what is seen through it; 1 in worlds without POV-Ray's finishes
};

template <class T>
struct World {
    /// Surfaces that can be numbered exactly in T.
    static constexpr double capacity = 2 / std::numeric_limits<T>::epsilon();

    GroupsOf<T, Forms> groups;
    const Node* nodes = nullptr;                // the hierarchy of all bounded items; null: few items, or unbounded
    bool beyond_loops = false;                  // there is a hierarchy, or there are items of other than hot forms
    const ItemReference* references = nullptr;  // by surface, and of a miss by -1
    const SortBin* sort_bins = nullptr;         // by bin
    int bins = 0;
    bool bin_per_item = false;         // few items, up to most_item_bins: all hits of a bin are on the same item
    int hierarchy_bin = -1;            // bin of all items of the hierarchy, if they are of one form
    const ItemRange* loops = nullptr;  // where there is a hierarchy: items of other than hot forms that it lacks,
    int loop_count = 0;                // number of such ranges

    FewBodies<T> few;
    CompositeTables<T> composites;
    const ContourPiece<T>* contour_pieces = nullptr;  // of all contours
    const LumpPiece* lump_pieces = nullptr;           // of all blobs
    const SweepPiece* sweep_pieces = nullptr;         // of all sweeps
    const PlacedMesh<T>* meshes = nullptr;            // by the number in a shared mesh's kernel
    PatternTables<T> patterns;
    MediumTables<T> media;
    FinishTables<T> finishes;

    Vec3<T> eye{0};                                   // of the view that is traced
    T rounding = 0;                                   // what the coordinates of points on bodies may be off
    T passed_over = 0, passed_in_shadows = 0;         // what is nearer to the start of a ray is not there for it
    T farthest = std::numeric_limits<T>::infinity();  // rays see nothing that is as far away
    T around_lights = 0;  // what is so near to a light, as a share of its distance, is not in its way
    ShadowRays shadow_rays = ShadowRays::whole;
    const MaterialKernel<T>* materials = nullptr;
    const LightKernel<T>* lights = nullptr;
    int light_count = 0;
    const LightBuffer<T>* light_buffers = nullptr;  // by light; null if there are none
    Vec3<T> background{0};
    FogKernel<T> fog;
    // Kernels do not look for what the scene does not contain.
    bool transparent = false;  // some body lets light through
    bool nested = false;  // transparent bodies overlap, or bumps bend rays back: rays list the bodies that they are in
};

/// A linear map, and a place to which it moves the origin.
template <class T>
struct PlaceMap {
    Vec3<T> columns[3], offset{0};

    template <class S>
    STRAHL_INLINE Vec3<S> turn(const Vec3<S>& way) const {
        return fma(way.x, splat<S>(columns[0]), fma(way.y, splat<S>(columns[1]), scale(way.z, splat<S>(columns[2]))));
    }
    template <class S>
    STRAHL_INLINE Vec3<S> point(const Vec3<S>& p) const {
        return fma(p.x, splat<S>(columns[0]),
                   fma(p.y, splat<S>(columns[1]), fma(p.z, splat<S>(columns[2]), splat<S>(offset))));
    }
};
/// A mesh in a world that other worlds share, as it is placed in this one. Its triangle i is surface i there.
template <class T>
struct PlacedMesh {
    const World<T>& mesh;
    PlaceMap<T> in, out, normals;    // from this world into that one, back, and of normals but for their length
    std::int32_t surface, surfaces;  // the first surface in this world, and how many there are
};
template <class T>
STRAHL_INLINE const PlacedMesh<T>& placed_mesh(const World<T>& world, int item) {
    return world.meshes[static_cast<int>(world.groups.template get<SharedMeshForm>().items[item].shape.number)];
}

/// A composite by its item.
template <class T>
STRAHL_INLINE const CompositeInfo& composite_of(const World<T>& world, int item) {
    return world.composites.list[static_cast<int>(world.groups.template get<CompositeForm>().items[item].shape.number)];
}

}  // namespace strahl

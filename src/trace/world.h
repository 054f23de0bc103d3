// World: a scene made ready for one kind of number, as the kernels read it. Plain arrays, const ever after.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>

#include "scene/kinds.h"

namespace strahl {

struct Node;

/// Shares and weights above 1, of glass brighter than white or of total reflection, grow no further than this, or in
/// float they would become infinite and, times 0, no numbers.
inline constexpr float largest_gain = 1e18f;
/// Where a hit can do without the light of its lamps, it does without that of one lamp up to this many times the light
/// that the lamp, straight above, would scatter there.
inline constexpr float faint_share = 2;

/// A shape with its numbers. Made of elements only, so that it can be gathered lane by lane; whole numbers are exact in
/// every element type (in float up to 2^24, see `World::capacity`).
template <template <class> class K>
struct Item {
    template <class T>
    struct Of {
        K<T> shape;
        T surface;  // number of its first face; faces are numbered through the scene in the order declared
        T material;
    };
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

template <class T>
struct LightKernel {
    Vec3<T> position, color;
};

/// A body as seen from a point: around the direction `axis`, no further off than an angle with this cosine, and no
/// nearer than `distance`. What can't be told is around (-2) and here (-infinity).
template <class T>
struct Cone {
    Vec3<T> axis{0};
    T cosine = -2, distance = -std::numeric_limits<T>::infinity();
};

/// Bodies by key, a bit for each.
using BodySet = std::uint64_t;
inline constexpr int most_item_keys = 64;  // up to here there is a key per item, and no hierarchy

/// Where a surface's item is: its index among the items of its kernel, and the key by which hits are sorted.
struct Place {
    std::int32_t item, key;
};

template <class T>
struct World {
    /// Surfaces that can be numbered exactly in T.
    static constexpr double capacity = 2 / std::numeric_limits<T>::epsilon();

    template <template <class> class K>
    struct Group {
        template <class S>
        using ItemOf = typename Item<K>::template Of<S>;
        static constexpr bool bounded = !requires(K<T> kernel) { kernel.normal; };  // all but planes
        const ItemOf<T>* items = nullptr;
        int count = 0;
        // A hierarchy of them; null: few items, looked at one after the other. Item i's field f again is
        // columns[f * stride + i], and there is a pack's room behind each column.
        const Node* nodes = nullptr;
        const T* columns = nullptr;
        std::size_t stride = 0;
        int first_key = 0, last_key = 0;  // keys [first, last) are this group's
        int key(int item, bool key_per_item) const { return key_per_item ? first_key + item : first_key; }
    };
    PerKernel<Group> groups;
    const Place* places = nullptr;  // by surface
    int keys = 0;
    bool key_per_item = false;  // few items, up to most_item_keys: all hits of a key are on the same item
    // Only if there is a key per item, by key; the last two by light * keys + key.
    Vec3<const T*> centres{nullptr};     // of balls around the bodies, and a pack's room behind
    const T* radii = nullptr;            // of these; infinite for planes, and -infinite behind the last
    const Cone<T>* cones = nullptr;      // each body as seen from the light
    const BodySet* occluders = nullptr;  // the bodies that can keep light from this one; it itself only from its inside

    const MaterialKernel<T>* materials = nullptr;
    const LightKernel<T>* lights = nullptr;
    int light_count = 0;
    Vec3<T> background{0};
    const T* iors = nullptr;  // by surface; only in nested worlds

    // Transparent bodies, by key, that nothing else reaches into: a ray inside meets the same body again.
    BodySet enclosed = 0;

    // What the scene contains; what it does not is not looked for.
    bool transparent = false;  // some body lets light through
    bool nested = false;       // transparent bodies may overlap: rays carry the list of those entered
};

}  // namespace strahl

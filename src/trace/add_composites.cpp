// Composites become leaves, steps and planes.
#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "scene/overlap.h"
#include "trace/world_arrays.h"

namespace strahl {
namespace {

/// The plane that a face lies in, with its normal out of the body; nothing for a curved face.
std::optional<HalfSpace> plane_of(const Plane& plane, int) { return HalfSpace{plane.a, plane.normal()}; }
template <class Kind>
std::optional<HalfSpace> plane_of_ends(const Kind& body, int face) {
    if (face == 0) return {};
    return face == 1 ? HalfSpace{body.base, -body.axis()} : HalfSpace{body.cap, body.axis()};
}
std::optional<HalfSpace> plane_of(const Cylinder& cylinder, int face) { return plane_of_ends(cylinder, face); }
std::optional<HalfSpace> plane_of(const Cone& cone, int face) { return plane_of_ends(cone, face); }
std::optional<HalfSpace> plane_of(const Cuboid& cuboid, int face) {
    const Box box = cuboid.bounds();
    DVec3 normal(0);
    normal[face / 2] = face % 2 == 0 ? -1 : 1;
    return HalfSpace{face % 2 == 0 ? box.low : box.high, normal};
}
template <class Kind>
std::optional<HalfSpace> plane_of(const Kind&, int) {
    return {};
}

HalfSpace moved(const HalfSpace& space, const glm::dmat4& m) {
    return {transform_point(m, space.point), normalize(glm::transpose(glm::inverse(glm::dmat3(m))) * space.normal)};
}

/// A plane by numbers that are the same for all who lie in it, whichever side they are on.
struct PlaneNumbers {
    DVec3 normal;
    double distance, side;  // side is 1 if the normal is that of the half-space, else -1
    explicit PlaneNumbers(const HalfSpace& space) : normal(space.normal) {
        const DVec3& n = space.normal;
        side = n.x > 0 || (n.x == 0 && (n.y > 0 || (n.y == 0 && n.z > 0))) ? 1 : -1;
        normal = side * n + DVec3(0.);  // 0 is added because -0 equals it
        distance = dot_product(normal, space.point) + 0.;
    }
    bool same_plane(const PlaneNumbers& other) const { return normal == other.normal && distance == other.distance; }
};

/// Adds the leaves of one composite.
template <class T>
class CompositeBuilder {
  public:
    CompositeBuilder(WorldArrays<T>& arrays, std::array<std::vector<T>, Forms::size>& leaf_numbers,
                     const Primitive& whole, int surface, std::int32_t first_leaf, const Placement& placement)
        : arrays(arrays),
          leaf_numbers(leaf_numbers),
          placement(placement),
          outer(matrix(whole.transformations)),
          next_leaf(first_leaf) {
        info.first_leaf = static_cast<std::int32_t>(arrays.leaves.size());
        info.first_step = static_cast<std::int32_t>(arrays.steps.size());
        info.first_plane = static_cast<std::int32_t>(arrays.planes.size());
        info.first_key = static_cast<std::int32_t>(arrays.face_keys.size());
        info.surface = next_surface = surface;
        add(whole, glm::dmat4(1), similarity(whole.transformations), true);
        info.leaves = static_cast<std::int32_t>(arrays.leaves.size()) - info.first_leaf;
        info.steps = static_cast<std::int32_t>(arrays.steps.size()) - info.first_step;
        info.planes = static_cast<std::int32_t>(arrays.planes.size()) - info.first_plane;
        info.surfaces = next_surface - surface;
        arrays.composites.push_back(info);
    }

  private:
    /// `inner` is the matrix from the part's surroundings into the composite's own space.
    void add(const Primitive& part, const glm::dmat4& inner, double similar, bool whole) {
        const glm::dmat4 m = whole ? inner : inner * matrix(part.transformations);
        const double factor = whole ? similar : similar * similarity(part.transformations);
        std::visit(
            [&]<class Kind>(const Kind& shape) {
                if constexpr (is_composite<Kind>) {
                    for (std::size_t i = 0; i < shape.parts->size(); ++i) {
                        add((*shape.parts)[i], m, factor, false);
                        if (i > 0) arrays.steps.push_back(step(Kind::operation));
                    }
                } else {
                    add_leaf(shape, part, m, factor);
                }
            },
            part.shape);
    }
    static CompositeStep step(Operation operation) {
        return operation == Operation::unite       ? CompositeStep::unite
               : operation == Operation::intersect ? CompositeStep::intersect
                                                   : CompositeStep::subtract;
    }
    template <class Kind>
    void add_leaf(const Kind& shape, const Primitive& part, const glm::dmat4& m, double factor) {
        const WorldTransform to_world{outer * m, factor, placement.origin, placement.scale};
        const std::int32_t material = arrays.material_of(part, next_leaf);
        CompositeLeaf leaf{-1, 0, material, next_surface, Kind::faces, 0};
        shape.template emit<T>(to_world, [&]<class K>(const K& kernel) {
            constexpr int form = form_number<K, T>(Forms{});
            using Own = Item<FormAt<form, Forms>, T>;
            constexpr std::size_t fields = sizeof(Own) / sizeof(T);
            const Own item{kernel, static_cast<T>(next_surface), static_cast<T>(material)};
            std::vector<T>& numbers = leaf_numbers[form];
            leaf.form = form;
            leaf.item = arrays.forms[form].count + static_cast<std::int32_t>(numbers.size() / fields);
            const T* const first = reinterpret_cast<const T*>(&item);
            numbers.insert(numbers.end(), first, first + fields);
        });
        for (int face = 0; face < Kind::faces; ++face) {
            const std::optional<HalfSpace> plane = plane_of(shape, face);
            if (plane) {
                const PlaneNumbers numbers(moved(*plane, m));
                arrays.face_keys.push_back(plane_key(numbers));
                if constexpr (!Kind::bounded) leaf.half_space = static_cast<std::int32_t>(numbers.side);
            } else {
                arrays.face_keys.push_back(most_planes + 8 * equal_leaf(leaf) + face);
            }
        }
        next_surface += Kind::faces;
        arrays.leaves.push_back(leaf);
        arrays.steps.push_back(CompositeStep::leaf);
    }
    std::int32_t plane_key(const PlaneNumbers& own) {
        const auto same = [&](const PlaneNumbers& other) { return own.same_plane(other); };
        const auto found = std::find_if(planes.begin(), planes.end(), same);
        if (found != planes.end()) return static_cast<std::int32_t>(found - planes.begin());
        planes.push_back(own);
        const HalfSpace there = moved({own.distance * own.normal, own.normal}, outer);
        const DVec3 point = (there.point - placement.origin) * placement.scale;
        arrays.planes.push_back({cast<T>(there.normal), static_cast<T>(dot_product(there.normal, point))});
        return static_cast<std::int32_t>(planes.size()) - 1;
    }
    /// The number, in the composite, of the first leaf with the same numbers.
    int equal_leaf(const CompositeLeaf& own) const {
        const std::size_t fields = WorldArrays<T>::traits[own.form].fields;
        const auto numbers = [&](const CompositeLeaf& leaf) {
            return leaf_numbers[own.form].data() + (leaf.item - arrays.forms[own.form].count) * fields;
        };
        const std::size_t count = arrays.leaves.size() - info.first_leaf;
        for (std::size_t i = 0; i < count; ++i) {
            const CompositeLeaf& other = arrays.leaves[info.first_leaf + i];
            if (other.form == own.form && std::equal(numbers(own), numbers(own) + fields - 2, numbers(other)))
                return static_cast<int>(i);
        }
        return static_cast<int>(count);
    }

    WorldArrays<T>& arrays;
    std::array<std::vector<T>, Forms::size>& leaf_numbers;
    const Placement& placement;
    const glm::dmat4 outer;
    std::int32_t next_leaf;  // of the scene
    CompositeInfo info{};
    std::int32_t next_surface;
    std::vector<PlaneNumbers> planes;
};

}  // namespace

int faces_of(const Shape& shape) {
    return std::visit(
        []<class Kind>(const Kind& kind) {
            if constexpr (is_composite<Kind>) {
                int sum = 0;
                for (const Primitive& part : *kind.parts) sum += faces_of(part.shape);
                return sum;
            } else {
                return Kind::faces;
            }
        },
        shape);
}

/// The leaves follow the items of their forms.
template <class T>
void WorldArrays<T>::add_composites(const Scene& scene, const Placement& placement) {
    if (forms[place_of<CompositeForm>(Forms{})].count == 0) return;
    std::array<std::vector<T>, Forms::size> leaf_numbers;
    ItemCounts before;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const Primitive& primitive = scene.primitives[i];
        if (std::visit([]<class Kind>(const Kind&) { return is_composite<Kind>; }, primitive.shape))
            CompositeBuilder<T>(*this, leaf_numbers, primitive, static_cast<int>(before.surfaces),
                                leaf_of(static_cast<std::int32_t>(i)), placement);
        count_items<T>(primitive, before);
    }
    for (int form = 0; form < Forms::size; ++form) {
        FormItems<T>& own = forms[form];
        const std::size_t size = std::size_t(own.count) * traits[form].fields, more = leaf_numbers[form].size();
        Buffer<T> longer = uninitialized_buffer<T>(size + more + std::size_t(widest_pack) * traits[form].fields);
        std::copy_n(own.numbers.get(), size, longer.get());
        std::copy_n(leaf_numbers[form].data(), more, longer.get() + size);
        own.numbers = std::move(longer);
    }
    leaf_faces.assign(surfaces, -1);
    for (const CompositeLeaf& leaf : leaves)
        for (int face = 0; face < leaf.faces; ++face) {
            references[1 + leaf.surface + face] = {leaf.item, leaf.form};  // each form has one bin
            leaf_faces[leaf.surface + face] = face;
        }
    world.composites = composites.data();
    world.leaves = leaves.data();
    world.steps = steps.data();
    world.planes = planes.data();
    world.face_keys = face_keys.data();
    world.leaf_faces = leaf_faces.data();
}

template void WorldArrays<float>::add_composites(const Scene&, const Placement&);
template void WorldArrays<double>::add_composites(const Scene&, const Placement&);
template void WorldArrays<long double>::add_composites(const Scene&, const Placement&);

}  // namespace strahl

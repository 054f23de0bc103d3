#include "pov/meaning/shared_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "num/vec_math.h"
#include "pov/meaning/part_faces.h"
#include "pov/meaning/sight.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "scene/ray_hits.h"

namespace strahl::pov {
namespace {

constexpr std::size_t most_pairs = 100;  // of faces that are looked at in a composite
constexpr double step_aside = 1e-7;      // relative to coordinates: a step to one side of a face

/// One composite: its parts, in its own space.
class SharedFaces {
  public:
    SharedFaces(const Primitive& own, const glm::dmat4& to_world, const Primitive& whole, const Scene& scene,
                SeenPlaces& sight)
        : scene(scene), sight(sight), whole(whole), to_world(to_world), clear(shows_inside(own)) {
        each_part(own, [&](const Primitive& part) { parts.push_back(&part); });
        const auto look = [&]<class Kind>(const Kind& kind) {
            if constexpr (is_composite<Kind>) operation = Kind::operation, keeps = kind.keeps;
        };
        std::visit(look, own.shape);
        box = transformed_bounds(own.shape, glm::dmat4(1));
        const Box around = world_bounds(whole);
        reach = around.finite() ? length(around.size()) + length(around.centre()) : 1e4;
    }

    /// Returns how many of the places that are seen are such faces, or so many that they count if it does not show how
    /// many: where clear parts of a merge only touch.
    std::size_t found() {
        if (keeps) return 0;
        std::vector<PartFace> flat;
        std::vector<CurvedFace> curved;
        std::size_t with_points = 0;
        for (std::size_t i = 0; i < parts.size(); ++i)
            for_each_leaf(*parts[i], [&](const Primitive& leaf, const glm::dmat4& matrix) {
                const BodyFace face{i, leaf.material, !shows_nothing(material(leaf))};
                add_flat(flat, leaf.shape, matrix, face, reach), add_curved(curved, leaf.shape, matrix, face);
                if (with_points < curved.size())
                    curved.back().points = points_on(leaf.shape, matrix), with_points = curved.size();
            });
        std::vector<std::pair<BodyFace, BodyFace>> pairs;
        bool touches = false;
        const auto look = [&](const BodyFace& one, const BodyFace& other, const DVec3& p, const DVec3& normal) {
            const FaceVerdict decision = decision_on(one, other, p, normal);
            touches |= decision == FaceVerdict::touches;
            if (decision == FaceVerdict::by_rounding) pairs.emplace_back(one, other);
            return decision != FaceVerdict::none;
        };
        const auto enough = [&] { return touches || pairs.size() == most_pairs; };
        any_pair_of(flat, [&](const PartFace& one, const PartFace& other) {
            if (one.there || other.there)
                any_point_of(common_part(common_part(one.corners, other), box),
                             [&](const DVec3& p) { return look(one, other, p, one.normal); });
            return enough();
        });
        any_pair_of(curved, [&](const CurvedFace& one, const CurvedFace& other) {
            const auto is_decided = [&](const PointOnFace& own) { return look(one, other, own.p, own.normal); };
            std::ranges::any_of(one.points, is_decided) || std::ranges::any_of(other.points, is_decided);
            return enough();
        });
        if (touches) return std::numeric_limits<int>::max();
        if (pairs.empty()) return 0;
        const glm::dmat4 back = glm::inverse(to_world);
        const glm::dmat3 turn = glm::transpose(glm::dmat3(to_world));
        return static_cast<std::size_t>(std::ranges::count_if(sight.places(), [&](const SeenPlaces::Place& place) {
            if (&scene.primitives[place.body] != &whole) return false;
            const DVec3 p = transform_point(back, place.p), normal = normalize(turn * place.normal);
            return std::ranges::any_of(pairs, [&](const auto& pair) {
                return decision_on(pair.first, pair.second, p, normal) == FaceVerdict::by_rounding;
            });
        }));
    }

  private:
    const Material& material(const Primitive& leaf) const {
        return scene.materials[static_cast<std::size_t>(leaf.material)];
    }
    bool shows_inside(const Primitive& own) const {
        bool any = false;
        for_each_leaf(own, [&](const Primitive& leaf, const glm::dmat4&) {
            any |= material(leaf).transmits() && !shows_nothing(material(leaf));
        });
        return any;
    }

    enum class FaceVerdict { none, by_rounding, touches };
    /// Is a surface of the whole at a point, where faces of two parts are, there or one of theirs only if POV-Ray
    /// rounds the point to one side of them? Or is there none although there should be one? Or do clear parts touch
    /// there?
    FaceVerdict decision_on(const BodyFace& one, const BodyFace& other, const DVec3& p, const DVec3& normal) const {
        const DVec3 step = step_aside * (1 + length(p)) * normal;
        const DVec3 below = p - step, above = p + step;
        const auto in = [&](const BodyFace& face, const DVec3& q) { return contains(*parts[face.part], q); };
        const bool one_below = in(one, below), other_below = in(other, below);
        if (one_below == in(one, above) || other_below == in(other, above)) return FaceVerdict::none;
        const auto whole_at = [&](const DVec3& q) { return contains(whole, transform_point(to_world, q)); };
        const std::array<bool, 2> at_below = shown(one, other, below), at_above = shown(one, other, above);
        const bool any_below = at_below[0] || at_below[1], any_above = at_above[0] || at_above[1];
        if (operation == Operation::unite && one_below != other_below) {
            const bool touch = clear && any_below && any_above && whole_at(below) && whole_at(above);
            return touch ? FaceVerdict::touches : FaceVerdict::none;
        }
        const bool either = one.material != other.material && (at_below != at_above || (at_below[0] && at_below[1]));
        const bool certain = any_below && any_above && !either;
        return !certain && whole_at(below) != whole_at(above) ? FaceVerdict::by_rounding : FaceVerdict::none;
    }
    /// Does POV-Ray show the faces of two parts at a point that both have, if it rounds the point to q?
    std::array<bool, 2> shown(const BodyFace& one, const BodyFace& other, const DVec3& q) const {
        std::array<bool, 2> all{true, true};
        for (std::size_t k = 0; k < parts.size() && (all[0] || all[1]); ++k) {
            const bool outside = (k == one.part && one.round) || (k == other.part && other.round);
            const bool in = !outside && contains(*parts[k], q);
            const bool counts =
                operation == Operation::intersect || (operation == Operation::subtract && k == 0) ? in : !in;
            all[0] &= counts || k == one.part, all[1] &= counts || k == other.part;
        }
        return all;
    }

    const Scene& scene;
    SeenPlaces& sight;
    const Primitive& whole;
    const glm::dmat4 to_world;
    const bool clear;
    std::vector<const Primitive*> parts;
    Operation operation = Operation::unite;
    bool keeps = false;
    Box box;  // around the composite, in its own space
    double reach;
};

/// Returns how many places SharedFaces finds in a composite and in those within it.
std::size_t shared_in(const Primitive& own, const glm::dmat4& outer, const Primitive& whole, const Scene& scene,
                      SeenPlaces& sight) {
    std::size_t count = 0;
    bool composite = false;
    const glm::dmat4 to_world = outer * matrix(own.transformations);
    each_part(
        own, [&](const Primitive& part) { composite = true, count += shared_in(part, to_world, whole, scene, sight); });
    return composite ? count + SharedFaces(own, to_world, whole, scene, sight).found() : count;
}

/// Finds bodies of a scene that have surfaces in one place.
class BodiesInOnePlace {
  public:
    explicit BodiesInOnePlace(const Scene& scene) : scene(scene) {
        for (const Material& own : scene.materials) mirrors |= own.reflection > 0;
    }

    bool may_differ(const BodyFace& one, const BodyFace& other) const {
        const Material &own = material(one), &its = material(other);
        const bool patterned = own.patterned() || its.patterned();
        return clear(one.part) || clear(other.part) || !look_alike(own, its) ||
               (patterned && body(one.part).transformations != body(other.part).transformations);
    }
    /// Are there any that may be seen?
    bool any() const {
        std::vector<PartFace> flat;
        std::vector<CurvedFace> curved;
        for (std::size_t i = 0; i < scene.primitives.size(); ++i)
            for_each_leaf(body(i), [&](const Primitive& leaf, const glm::dmat4& matrix) {
                const BodyFace face{i, leaf.material};
                add_flat(flat, leaf.shape, matrix, face, reach), add_curved(curved, leaf.shape, matrix, face);
            });
        return any_pair_of(flat,
                           [&](const PartFace& a, const PartFace& b) {
                               return may_differ(a, b) && may_be_seen(common_part(a.corners, b), a, b);
                           }) ||
               any_pair_of(curved, [&](const CurvedFace& a, const CurvedFace& b) { return may_differ(a, b); });
    }

  private:
    const Primitive& body(std::size_t number) const { return scene.primitives[number]; }
    const Material& material(const BodyFace& face) const {
        return scene.materials[static_cast<std::size_t>(face.material)];
    }
    /// Are two materials the same but for colours that are closer than half a step of a picture?
    static bool look_alike(const Material& one, Material other) {
        const Color apart = one.rgb.color - other.rgb.color;
        other.rgb.color = one.rgb.color;
        return std::max({std::fabs(apart.x), std::fabs(apart.y), std::fabs(apart.z)}) < 1. / 510 && one == other;
    }
    bool clear(std::size_t number) const { return transparent(scene, body(number)); }
    /// Is the face of neither body behind itself for the camera, in the middle of what they have in common?
    bool may_be_seen(const std::vector<DVec3>& polygon, const PartFace& one, const PartFace& other) const {
        if (polygon.size() < 3) return false;
        if (mirrors) return true;
        DVec3 middle(0);
        for (const DVec3& corner : polygon) middle = middle + 1. / double(polygon.size()) * corner;
        const double side = dot_product(one.normal, scene.camera.position - middle) < 0 ? -1 : 1;
        const DVec3 before = middle + side * step_aside * (1 + length(middle)) * one.normal;
        const auto hides = [&](std::size_t number) { return !clear(number) && contains(body(number), before); };
        return !hides(one.part) && !hides(other.part);
    }

    const Scene& scene;
    bool mirrors = false;
    const double reach = 1e4;
};

}  // namespace

std::vector<std::size_t> shared_by_parts(const Scene& scene, SeenPlaces& sight) {
    std::vector<std::size_t> found;
    std::size_t count = 0;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const std::size_t own = shared_in(scene.primitives[i], glm::dmat4(1), scene.primitives[i], scene, sight);
        if (count += own; own > 0) found.push_back(i);
    }
    return count > 0 && sight.counts(count) ? found : std::vector<std::size_t>();
}

std::vector<SeenPlaces::Place> places_of_two_bodies(const Scene& scene, SeenPlaces& sight) {
    const BodiesInOnePlace bodies(scene);
    std::vector<SeenPlaces::Place> found;
    if (!bodies.any()) return found;
    for (const SeenPlaces::Place& place : sight.places())
        if (place.other && bodies.may_differ({place.body, place.material}, {*place.other, place.other_material}))
            found.push_back(place);
    return found;
}

std::set<std::size_t> clear_bodies_on_planes(const Scene& scene, SeenPlaces& sight,
                                             const std::vector<SeenPlaces::Place>& places) {
    std::set<std::size_t> found;
    std::size_t count = 0;
    for (const SeenPlaces::Place& place : places) {
        const auto is_plane = [&](std::size_t body) {
            return std::holds_alternative<Plane>(scene.primitives[body].shape);
        };
        if (is_plane(place.body) == is_plane(*place.other)) continue;
        const std::size_t own = is_plane(place.body) ? *place.other : place.body;
        if (!transparent(scene, scene.primitives[own]) || std::holds_alternative<Cuboid>(scene.primitives[own].shape))
            continue;
        ++count, found.insert(own);
    }
    return sight.counts(count) ? found : std::set<std::size_t>();
}

std::set<std::size_t> bodies_in_one_place(const Scene& scene, SeenPlaces& sight,
                                          const std::vector<SeenPlaces::Place>& places,
                                          const std::vector<SettledPair>& settled) {
    std::set<std::size_t> found;
    std::size_t count = 0;
    for (const SeenPlaces::Place& place : places) {
        const bool is_otherwise = std::ranges::any_of(settled, [&](const SettledPair& pair) {
            const bool own = (pair.seen == place.body && pair.hidden == *place.other) ||
                             (pair.seen == *place.other && pair.hidden == place.body);
            return own && !is_seen_first(scene, pair, place.p);
        });
        const double size = 1 + length(place.p), step = 1e-4 * size;
        const auto is_there = [&](std::size_t body) {
            const auto hits = ray_hits(scene.primitives[body], {place.p + step * place.normal, -place.normal, -1}, 0);
            return std::ranges::any_of(hits, [&](const RayHit& hit) { return std::fabs(hit.t - step) < 1e-10 * size; });
        };
        if (is_otherwise || (is_there(place.body) && is_there(*place.other)))
            ++count, found.insert(std::max(place.body, *place.other));
    }
    return sight.counts(count) ? found : std::set<std::size_t>();
}

}  // namespace strahl::pov

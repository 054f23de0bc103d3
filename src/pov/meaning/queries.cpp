#include "pov/meaning/queries.h"

#include <algorithm>
#include <cmath>

#include "num/vec_math.h"
#include "pov/meaning/extents.h"
#include "pov/meaning/scene_maker.h"
#include "scene/overlap.h"
#include "scene/ray_hits.h"

namespace strahl::pov {
namespace {

using Bodies = std::vector<AskedBody>;

/// Returns a body of the same inside: of a disc all that is below its plane, as in POV-Ray.
Primitive filled(Primitive body) {
    const auto* const disc = std::get_if<Disc>(&body.shape);
    if (!disc) return body;
    const DVec3 n = normalize(disc->normal);
    const DVec3 u = cross_product(n, std::fabs(n.x) < .5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0));
    body.shape = Plane{disc->centre, disc->centre + u, disc->centre + cross_product(n, u)};
    return body;
}

const Bodies& bodies_of(Interpreter& in, const Thing& thing) {
    const auto& object = dynamic_cast<const ObjectThing&>(thing);
    if (!object.made.bodies) {
        const PovContents nothing;
        Bodies made;
        for (auto& [body, negated] : SceneMaker(in, nothing, false).bodies_of(object)) {
            Primitive inside = filled(body);
            const Box box = world_bounds(body), around = world_bounds(inside);
            made.push_back({std::move(body), std::move(inside), box, around, negated});
        }
        object.made.bodies = std::make_shared<const Bodies>(std::move(made));
    }
    return *object.made.bodies;
}

/// Is a point in a box, or a rounding error beside it?
bool is_near(const Box& box, const DVec3& point) {
    for (int i = 0; i < 3; ++i) {
        const double margin = 1e-9 * (std::fabs(box.low[i]) + std::fabs(box.high[i]));
        if (!(point[i] >= box.low[i] - margin && point[i] <= box.high[i] + margin)) return false;
    }
    return true;
}

bool any_contains(const Bodies& bodies, const DVec3& point) {
    return std::ranges::any_of(bodies, [&](const AskedBody& own) {
        return (is_near(own.filled_box, point) && contains(own.filled, point)) != own.negated;
    });
}

struct InsideFunction : FunctionThing {
    InsideFunction(std::shared_ptr<const Bodies> bodies, const glm::dmat4& inverse)
        : bodies(std::move(bodies)), inverse(inverse) {}
    void evaluate(const double* given, double* result) const override {
        *result = any_contains(*bodies, transform_point(inverse, {given[0], given[1], given[2]}));
    }
    const std::shared_ptr<const Bodies> bodies;
    const glm::dmat4 inverse;
};

}  // namespace

bool PovLayer::inside(Interpreter& in, const Thing& object, const DVec3& point) {
    return any_contains(bodies_of(in, object), point);
}

std::shared_ptr<const FunctionThing> PovLayer::inside_of(Interpreter& in, const ObjectThing& object,
                                                         const glm::dmat4& inverse) {
    bodies_of(in, object);
    return std::make_shared<InsideFunction>(object.made.bodies, inverse);
}

std::pair<DVec3, DVec3> PovLayer::extent(Interpreter&, const Thing& object) {
    constexpr double far = 1e10;
    Box box = extent_of(dynamic_cast<const ObjectThing&>(object));
    if (box.empty()) return {DVec3(0), DVec3(0)};
    for (int i = 0; i < 3; ++i) {
        box.low[i] = static_cast<float>(std::max(box.low[i], -far));
        box.high[i] = static_cast<float>(std::min(box.high[i], far));
    }
    return {box.low, box.high};
}

bool PovLayer::trace(Interpreter& in, const Thing& object, const DVec3& from, const DVec3& direction, DVec3& hit,
                     DVec3& normal) {
    constexpr double least = 1e-4, most = 1e7;  // distances, as POV-Ray has them
    const double size = length(direction);
    if (!(size > 0)) return false;
    const Ray<double> ray{from, direction / size, {}};
    double nearest = most;
    for (const AskedBody& body : bodies_of(in, object))
        if (!meets(body.box, ray))
            continue;
        else if (const auto hits = ray_hits(body.own, ray, least, nearest, &trees); !hits.empty())
            nearest = hits[0].t, normal = (body.negated ? -1. : 1.) * hits[0].normal;
    if (nearest == most) return false;
    hit = from + nearest * ray.direction;
    return true;
}

}  // namespace strahl::pov

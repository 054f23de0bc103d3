// A scene's bodies in world coordinates, for programs that know no transformations.
#pragma once
#include <cmath>
#include <stdexcept>
#include <vector>

#include "num/vec_math.h"
#include "scene/scene.h"

namespace strahl::bench {

template <class Kind>
struct Body {
    Kind shape;
    int material;
};

struct FlatScene {
    std::vector<Body<Sphere>> spheres;
    std::vector<Body<Plane>> planes;
    std::vector<Body<Cylinder>> cylinders;
    std::vector<Body<MeshData>> meshes;  // of flat triangles
};

/// Throws std::invalid_argument for ellipsoids and their like, and for other kinds, lights and materials: peers have
/// none.
inline FlatScene flatten(const Scene& scene) {
    FlatScene flat;
    bool more = scene.fog || scene.background.pattern;
    for (const Light& light : scene.lights) more |= light.spot || light.area || light.direction;
    for (const Material& material : scene.materials) more |= material.patterned();
    if (more) throw std::invalid_argument("the other programs know only lights at points, and no patterns or fog");
    for (const Primitive& primitive : scene.primitives) {
        const glm::dmat4 m = matrix(primitive.transformations);
        const double factor = similarity(primitive.transformations);
        if (factor == 0) throw std::invalid_argument("a body is stretched: the other programs cannot show that");
        const auto moved = [&](const DVec3& p) { return transform_point(m, p); };
        const int material = primitive.material;
        if (const auto* s = std::get_if<Sphere>(&primitive.shape))
            flat.spheres.push_back({{moved(s->centre), s->radius * factor}, material});
        else if (const auto* c = std::get_if<Cylinder>(&primitive.shape))
            flat.cylinders.push_back({{moved(c->base), moved(c->cap), c->radius * factor}, material});
        else if (const auto* p = std::get_if<Plane>(&primitive.shape))
            flat.planes.push_back({{moved(p->a), moved(p->b), moved(p->c)}, material});
        else if (const auto* mesh = std::get_if<Mesh>(&primitive.shape); mesh && mesh->data->normals.empty()) {
            flat.meshes.push_back({*mesh->data, material});
            for (DVec3& p : flat.meshes.back().shape.points) p = moved(p);
        } else
            throw std::invalid_argument("the scene has bodies that are not spheres, planes, cylinders or flat meshes");
    }
    return flat;
}

}  // namespace strahl::bench

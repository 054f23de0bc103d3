// Composites: random trees of bodies, many of whose faces lie in the same planes, against plain inside tests.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "num/thread_pool.h"
#include "scene/camera.h"
#include "tests/referee/box.h"
#include "tests/referee/cone.h"
#include "tests/referee/torus.h"
#include "tests/referee/triangle.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

using R = long double;
using referee::Line;
using referee::LineCrossings;
using referee::Vector;

LineCrossings<R> crossings(const Sphere& sphere, const Line<R>& line, int) {
    LineCrossings<R> found;
    const Vector<R> o = line.origin - Vector<R>(sphere.centre), d = line.direction;
    referee::roots(dot(d, d), dot(o, d), dot(o, o) - R(sphere.radius) * R(sphere.radius), false,
                   [&](R t) { found.add(t, 0, o); });
    return found;
}
LineCrossings<R> crossings(const Plane& plane, const Line<R>& line, int) {
    LineCrossings<R> found;
    const Vector<R> n = plane.normal();
    if (dot(n, line.direction) != 0) found.add(dot(n, Vector<R>(plane.a) - line.origin) / dot(n, line.direction), 0, n);
    return found;
}

/// A tree whose leaves glow in colours of their own.
class Tree {
  public:
    /// Among its leaves are meshes, if wanted. The corners of those that are boxes lie at whole numbers.
    Tree(Dice& dice, bool meshes) : dice(dice), meshes(meshes) {
        stage.background({0, 0, 1});
        stage.scene.materials.clear();
        whole = branch(3);
        if (std::visit([]<class Kind>(const Kind&) { return !is_composite<Kind>; }, whole.shape))
            whole = Primitive{Union{std::make_shared<std::vector<Primitive>>(1, whole)}, whole.material, {}};
        stage.scene.primitives.push_back(whole);
    }

    Stage stage;
    Primitive whole;

    /// The number of the leaf that a ray sees, -1 if none, -2 if it passes too close to call.
    int seen(const Line<R>& line, R unsure) const {
        std::vector<End> ends;
        int leaf = 0;
        add_ends(whole, line, glm::dmat4(1), leaf, ends);
        std::ranges::stable_sort(ends, {}, &End::t);
        const auto inside = [&](R t) {
            const Vector<R> p = line.origin + t * line.direction;
            return [=, this, at = DVec3(double(p.x), double(p.y), double(p.z))](int other) {
                int leaf = 0;
                return holds(whole, at, leaf, other);
            };
        };
        R before = 0;
        for (std::size_t i = 0; i < ends.size();) {
            std::size_t last = i;
            while (last + 1 < ends.size() && ends[last + 1].t - ends[i].t < 1e-14L) ++last;
            std::vector<int> leaves;
            for (std::size_t k = i; k <= last; ++k) leaves.push_back(ends[k].leaf);
            std::ranges::sort(leaves);
            const R t = ends[i].t, next = last + 1 < ends.size() ? ends[last + 1].t : t + 2;
            i = last + 1;
            if (t <= 0) continue;
            if (t - before < unsure || next - t < unsure) return -2;
            const auto after = inside((t + next) / 2);
            if (inside((before + t) / 2)(-1) != after(-1)) {
                for (const int leaf : leaves)
                    if (after(leaf) != after(-1)) return leaf;
                return leaves[0];
            }
            before = t;
        }
        return -1;
    }

  private:
    struct End {
        R t;
        int leaf;
    };
    double whole_number(int low, int high) { return low + std::floor(dice(0, high - low + 1 - 1e-9)); }
    DVec3 corner() { return {whole_number(-2, 2), whole_number(-2, 2), whole_number(-2, 2)}; }

    Primitive branch(int depth) {
        if (depth == 0 || dice(0, 1) < .25) return leaf();
        std::vector<Primitive> parts;
        for (int i = static_cast<int>(whole_number(2, 3)); i > 0; --i) parts.push_back(branch(depth - 1));
        const auto shared = std::make_shared<const std::vector<Primitive>>(std::move(parts));
        const double kind = dice(0, 3);
        const Shape shape = kind < 1   ? Shape(Union{shared})
                            : kind < 2 ? Shape(Intersection{shared})
                                       : Shape(Difference{shared});
        return {shape, 0, dice(0, 1) < .4 ? steps() : std::vector<Transformation>{}};
    }
    Primitive leaf() {
        const double kind = dice(0, 6);
        const DVec3 c = corner();
        const DVec3 size(whole_number(1, 3), whole_number(1, 3), whole_number(1, 3));
        const DVec3 axes[]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const DVec3 axis = axes[static_cast<int>(whole_number(0, 2))];
        Shape shape = Cuboid{c, c + size};
        if (kind < 1) shape = Sphere{c, .5 * whole_number(1, 4)};
        if (kind >= 1 && kind < 2) shape = Cone{c, .5 * whole_number(1, 3), c + size.x * axis, .5 * whole_number(0, 3)};
        if (kind >= 2 && kind < 2.4) shape = Torus{c, axis, 1, .25 * whole_number(1, 3)};
        if (kind >= 2.4 && kind < 2.8) {
            const DVec3 u(axis.y, axis.z, axis.x), v(axis.z, axis.x, axis.y);
            shape = dice(0, 1) < .5 ? Plane{c, c + u, c + v} : Plane{c, c + v, c + u};
        }
        if (meshes && dice(0, 1) < .5) shape = mesh(dice(0, 1) < .5);
        Material& material = stage.scene.materials.emplace_back(glow(Color(1)));
        const int number = static_cast<int>(stage.scene.materials.size());
        material = glow({1, number / 256., 0});
        return {shape, number - 1, dice(0, 1) < .3 ? steps() : std::vector<Transformation>{}};
    }
    /// A box, or a ring with a hole.
    Mesh mesh(bool ring) {
        DVec3 low = corner(), size(whole_number(1, 3), whole_number(1, 3), whole_number(1, 3));
        constexpr int n = 7, m = 5;
        MeshData data;
        if (ring) {
            low += DVec3(dice(.1, .4), dice(.1, .4), dice(.1, .4));
            size = DVec3(dice(.6, 2.4), dice(.6, 2.4), dice(.6, 2.4));
            for (int i = 0; i < n; ++i)
                for (int k = 0; k < m; ++k) {
                    const double u = 6.283185307179586 * i / n, v = 6.283185307179586 * k / m;
                    data.points.push_back(low + size * DVec3((1 + .4 * std::cos(v)) * std::cos(u),
                                                             (1 + .4 * std::cos(v)) * std::sin(u), .4 * std::sin(v)));
                }
            for (int i = 0; i < n; ++i)
                for (int k = 0; k < m; ++k) {
                    const std::int32_t a = i * m + k, b = (i + 1) % n * m + k;
                    const std::int32_t c = (i + 1) % n * m + (k + 1) % m, d = i * m + (k + 1) % m;
                    data.triangles.push_back({a, b, c}), data.triangles.push_back({a, c, d});
                }
        } else {
            for (int i = 0; i < 8; ++i) data.points.push_back(low + size * DVec3(i & 1, i >> 1 & 1, i >> 2));
            data.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
        }
        return {std::make_shared<const MeshData>(std::move(data)), ""};
    }
    /// Returns transformations that keep whole numbers exact.
    std::vector<Transformation> steps() {
        const double kind = dice(0, 3);
        if (kind < 1) return {Rotate{{90 * whole_number(0, 3), 90 * whole_number(0, 3), 0}}};
        if (kind < 2) return {Translate{corner()}};
        return {Scale{DVec3(dice(0, 1) < .5 ? .5 : 2) * DVec3(1, dice(0, 1) < .3 ? -1 : 1, dice(0, 1) < .3 ? 2 : 1)}};
    }

    /// Is p inside, by the operations? The leaf `other` counts as the opposite of what it is.
    static bool holds(const Primitive& part, const DVec3& p, int& leaf, int other) {
        const DVec3 local = transform_point(glm::inverse(matrix(part.transformations)), p);
        return std::visit(
            [&]<class Kind>(const Kind& shape) {
                if constexpr (is_composite<Kind>) {
                    bool result = false;
                    for (std::size_t i = 0; i < shape.parts->size(); ++i) {
                        const bool own = holds((*shape.parts)[i], local, leaf, other);
                        result = i == 0                                    ? own
                                 : Kind::operation == Operation::unite     ? result || own
                                 : Kind::operation == Operation::intersect ? result && own
                                                                           : result && !own;
                    }
                    return result;
                } else {
                    return shape.contains(local) != (leaf++ == other);
                }
            },
            part.shape);
    }
    void add_ends(const Primitive& part, const Line<R>& line, const glm::dmat4& outer, int& leaf,
                  std::vector<End>& ends) const {
        const glm::dmat4 m = outer * matrix(part.transformations);
        std::visit(
            [&]<class Kind>(const Kind& shape) {
                if constexpr (is_composite<Kind>) {
                    for (const Primitive& inner : *shape.parts) add_ends(inner, line, m, leaf, ends);
                } else if constexpr (requires { crossings(shape, line, -1); }) {
                    const glm::dmat4 back = glm::inverse(m);  // of whole numbers and halves: exact
                    const auto turn = [&](const Vector<R>& v, R w) {
                        Vector<R> r(w * R(back[3].x), w * R(back[3].y), w * R(back[3].z));
                        const R in[]{v.x, v.y, v.z};
                        for (int i = 0; i < 3; ++i) r = r + in[i] * Vector<R>(DVec3(back[i]));
                        return r;
                    };
                    const Line<R> local{turn(line.origin, 1), turn(line.direction, 0)};
                    for (const auto& crossing : crossings(shape, local, -1)) ends.push_back({crossing.t, leaf});
                    ++leaf;
                }
            },
            part.shape);
    }

    Dice& dice;
    bool meshes;
};

struct Count {
    long rays = 0, unsure = 0, hits = 0, wrong = 0;
};
void compare(Dice& dice, bool meshes, Precision precision, R unsure, Count& sum) {
    Tree tree(dice, meshes);
    Camera& camera = tree.stage.scene.camera;
    tree.stage.look(dice.direction() * dice(7, 12), DVec3(dice(-1, 1), dice(-1, 1), dice(-1, 1)), 30, dice.direction());
    const Frame frame = shoot(tree.stage.scene, precision, Still{});
    const CameraFrame view = frame_of(camera, double(frame.width) / frame.height);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const R u = 2 * (x + .5L) / frame.width - 1, v = 2 * (y + .5L) / frame.height - 1;
            const Vector<R> d = Vector<R>(view.forward) + u * R(view.tan_x) * Vector<R>(view.right) +
                                v * R(view.tan_y) * Vector<R>(view.down);
            const int leaf = tree.seen({camera.position, unit(d)}, unsure);
            ++sum.rays, sum.unsure += leaf == -2, sum.hits += leaf >= 0;
            if (leaf == -2) continue;
            const Color expected = leaf < 0 ? Color(0, 0, 1) : Color(1, (leaf + 1) / 256., 0),
                        found = pixel(frame, x, y);
            sum.wrong += !(length(expected - found) < 1e-6);
        }
}

/// Tries as many rays in double as in float.
void compare(double rays, bool meshes) {
    for (const auto& [precision, unsure] :
         {std::pair(Precision::float64, 1e-9L), std::pair(Precision::float32, 2e-3L)}) {
        Dice dice;
        Count count;
        while (count.rays < rays) compare(dice, meshes, precision, unsure, count);
        MESSAGE(count.rays << " rays, " << count.hits << " hits, " << count.unsure << " too close to call, "
                           << count.wrong << " wrong");
        CHECK(count.wrong == 0);
        CHECK(count.hits > count.rays / 20);
        CHECK(count.unsure < count.rays / (precision == Precision::float64 ? 200 : 10));
    }
}
double wanted_rays() {
    const char* const wanted = std::getenv("STRAHL_RAYS");
    return wanted ? std::atof(wanted) : 6e4;
}

}  // namespace

TEST_CASE("random trees with faces in the same planes, against plain inside tests") { compare(wanted_rays(), false); }

TEST_CASE("random trees with closed meshes, against plain inside tests") {
    compare(std::max(wanted_rays() / 2, 3e4), true);
}

/// Half of the light is mirrored and some passes, so that rays start on faces; the sun makes shadows.
TEST_CASE("what a ray sees of random trees does not depend on the rays beside it") {
    Dice dice;
    ThreadPool pool(1);
    for (int round = 0; round < 120; ++round) {
        Tree tree(dice, round % 3 == 0);
        Scene& scene = tree.stage.scene;
        for (Material& material : scene.materials) {
            material.reflection = .5, material.diffuse = .3;
            if (dice(0, 1) < .3) material.refraction = .3, material.ior = 1.1;
        }
        tree.stage.light(dice.direction() * 20.);
        tree.stage.look(dice.direction() * dice(5, 9), DVec3(dice(-1, 1), dice(-1, 1), dice(-1, 1)), 30,
                        dice.direction());
        const Lattice all{.columns = 20, .rows = 15};
        const View view{.camera = scene.camera, .width = all.columns, .height = all.rows, .depth = 6};
        Tracer tracer(scene, round % 2 ? Precision::float32 : Precision::float64);
        std::vector<double> together(3 * all.columns * all.rows), alone(together.size());
        const auto trace = [&](const Lattice& part, std::vector<double>& rgb) {
            tracer.trace({view, pool, [&](const Tile& tile) { place(tile, all, rgb); }}, part);
        };
        trace(all, together);
        for (int y = 0; y < all.rows; ++y)
            for (int x = 0; x < all.columns; ++x) trace({.x = x, .y = y, .columns = 1, .rows = 1}, alone);
        CHECK(together == alone);
    }
}

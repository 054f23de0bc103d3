// Meshes: rays through sides and corners, and rays that start near them.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "scene/kinds/mesh.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

/// A ball of n rings of 2 n triangles, bent out of shape so that no corners lie in a plane or a row, moved far off or
/// not.
MeshData ball(Dice& dice, int n, const DVec3& centre) {
    MeshData mesh;
    const auto add = [&](double height, double angle) {
        const double r = std::sqrt(1 - height * height);
        mesh.points.push_back(centre + dice(.8, 1.2) * DVec3(r * std::cos(angle), r * std::sin(angle), height));
    };
    add(-1, 0);
    for (int i = 1; i < n; ++i)
        for (int k = 0; k < n; ++k) add(-std::cos(i * 3.14159 / n), (k + .5 * i) * 6.28319 / n);
    add(1, 0);
    const int last = static_cast<int>(mesh.points.size()) - 1;
    const auto at = [&](int i, int k) { return i == 0 ? 0 : i == n ? last : 1 + (i - 1) * n + k % n; };
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            if (i > 0) mesh.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
            if (i < n - 1) mesh.triangles.push_back({at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
        }
    return mesh;
}

template <class T>
std::vector<TriangleKernel<T>> kernels_of(const MeshData& mesh) {
    std::vector<TriangleKernel<T>> kernels;
    const auto point = [&](int i) { return naive::to<T>(mesh.points[i]); };
    for (const auto& [a, b, c] : mesh.triangles) kernels.push_back({point(a), point(b), point(c)});
    return kernels;
}

/// A point on a side or at a corner of a triangle.
template <class T>
Vec3<T> aim(Dice& dice, const TriangleKernel<T>& t) {
    const Vec3<T> corners[]{t.a, t.b, t.c};
    const int i = std::min(2, static_cast<int>(dice(0, 3)));
    if (dice(0, 1) < .3) return corners[i];
    const T share = dice(0, 1) < .3 ? T(.5) : static_cast<T>(dice(0, 1));
    return corners[i] + (corners[(i + 1) % 3] - corners[i]) * share;
}

struct Crossed {
    int fronts = 0, backs = 0;
};
template <class T>
Crossed cross_all(const std::vector<TriangleKernel<T>>& kernels, const Ray<T>& ray) {
    Crossed sum;
    for (const TriangleKernel<T>& kernel : kernels) {
        if (!kernel.span(ray, T(-1)).hit) continue;
        // As the line sees it: the sign of the area, not the rounded normal.
        const SeenTriangle<T> seen = kernel.seen(ray);
        (seen.of_a + seen.of_b + seen.of_c > 0 ? sum.fronts : sum.backs) += 1;
    }
    return sum;
}

template <class T>
void aim_at_sides(double most) {
    Dice dice;
    long rays = 0, uneven = 0, lost = 0;
    while (rays < most) {
        const bool far = dice(0, 1) < .3;
        const auto kernels = kernels_of<T>(ball(dice, 4, far ? DVec3(1000, -300, 70) : DVec3(0)));
        for (int i = 0; i < 2000; ++i) {
            const auto& kernel = kernels[static_cast<std::size_t>(dice(0, static_cast<double>(kernels.size())))];
            const Vec3<T> target = aim(dice, kernel);
            DVec3 way = dice.direction();
            if (dice(0, 1) < .2) way = DVec3(std::round(way.x), std::round(way.y), std::round(way.z));  // along axes
            if (!(naive::length(way) > 0)) continue;
            const Vec3<T> d = naive::to<T>(way / naive::length(way));
            const Vec3<T> from = target - d * static_cast<T>(std::exp2(std::round(dice(-3, 8))));
            const Crossed crossed = cross_all(kernels, Ray<T>{from, d, T(-1)});
            ++rays;
            uneven += crossed.fronts != crossed.backs;
            lost += crossed.fronts == 0;
        }
    }
    MESSAGE(rays << " rays aimed at sides and corners: " << uneven << " entered the mesh and left it unequally often, "
                 << lost << " passed its outline");
    CHECK(uneven == 0);
    CHECK(lost < rays / 2);
}

/// Counts rays that hit a triangle outside its box, by more than the boxes of a hierarchy are grown. The triangles are
/// far longer than wide, and seen from as far away as they are long.
template <class T>
void aim_at_needles() {
    constexpr double rounding = 32 * static_cast<double>(std::numeric_limits<T>::epsilon());
    Dice dice;
    int hits = 0, outside = 0;
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double length = std::exp2(dice(0, 40)), far = length * dice(.3, 1);
        const auto near = [&] { return naive::to<T>(2. * dice.direction()); };
        const TriangleKernel<T> needle{near(), near(), near() + naive::to<T>(DVec3(0, -length, 0))};
        const Vec3<T> from = naive::to<T>(far * dice.direction());
        const T u = static_cast<T>(dice(0, 1)), v = (1 - u) * static_cast<T>(dice(0, 1));
        const Vec3<T> aim = (needle.a * u + needle.b * v + needle.c * (1 - u - v)) - from;
        const Ray<T> ray{from, aim / naive::length(aim), T(-1)};
        const Span<T> span = needle.span(ray, T(-1));
        if (!span.hit || !(span.far > 0)) continue;
        const DVec3 at = naive::to<double>(naive::to<long double>(from) +
                                           naive::to<long double>(ray.direction) * static_cast<long double>(span.far));
        const Box box = needle.bounds();
        double off = 0;
        for (int c = 0; c < 3; ++c) off = std::max({off, box.low[c] - at[c], at[c] - box.high[c]});
        off /= rounding * (length + 4);
        ++hits, outside += off > 1, worst = std::max(worst, off);
    }
    MESSAGE(hits << " hits of needles: " << outside << " outside their boxes, by up to " << worst
                 << " of what these are grown by");
    CHECK(hits > 10'000);
    CHECK(outside == 0);
}

}  // namespace

TEST_CASE("a line hits a triangle within its box, however narrow it is") {
    aim_at_needles<float>();
    aim_at_needles<double>();
}

TEST_CASE("no line through a side or a corner of a closed mesh is lost or counted twice") {
    const char* const wanted = std::getenv("STRAHL_RAYS");
    const double rays = wanted ? std::atof(wanted) : 2e5;
    aim_at_sides<float>(rays);
    aim_at_sides<double>(rays);
}

TEST_CASE("lines through corners of whole numbers, where areas are exactly 0") {
    // A cube of eight smaller ones: 6 * 8 triangles whose sides lie in rows.
    MeshData cube;
    const auto number = [&](const DVec3& p) {
        for (std::size_t i = 0; i < cube.points.size(); ++i)
            if (cube.points[i] == p) return static_cast<std::int32_t>(i);
        cube.points.push_back(p);
        return static_cast<std::int32_t>(cube.points.size() - 1);
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const int end : {0, 2})
            for (int i = 0; i < 2; ++i)
                for (int k = 0; k < 2; ++k) {
                    const auto at = [&](int u, int v) {
                        DVec3 p;
                        p[axis] = end, p[(axis + 1) % 3] = i + u, p[(axis + 2) % 3] = k + v;
                        return number(p);
                    };
                    const std::int32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
                    if (end == 2)
                        cube.triangles.push_back({a, b, c}), cube.triangles.push_back({a, c, d});
                    else
                        cube.triangles.push_back({a, c, b}), cube.triangles.push_back({a, d, c});
                }
    CHECK(!open_side(cube));
    const auto check = [&]<class T>(T) {
        const auto kernels = kernels_of<T>(cube);
        int rays = 0, uneven = 0, through = 0;
        for (int x = -1; x <= 3; ++x)
            for (int y = -1; y <= 3; ++y)
                for (int dx = -2; dx <= 2; ++dx)
                    for (int dy = -2; dy <= 2; ++dy) {
                        const DVec3 way = DVec3(dx, dy, 1);
                        const Vec3<T> d = naive::to<T>(way / naive::length(way));
                        for (int turn = 0; turn < 3; ++turn) {
                            Ray<T> ray{{T(x - 2 * dx), T(y - 2 * dy), T(-2)}, d, T(-1)};
                            for (int i = 0; i < turn; ++i) {
                                ray.origin = {ray.origin.y, ray.origin.z, ray.origin.x};
                                ray.direction = {ray.direction.y, ray.direction.z, ray.direction.x};
                            }
                            const Crossed crossed = cross_all(kernels, ray);
                            ++rays, uneven += crossed.fronts != crossed.backs, through += crossed.fronts > 0;
                        }
                    }
        CHECK(rays == 1875);
        CHECK(through > 200);
        CHECK(uneven == 0);
    };
    check(1.f), check(1.);
}

TEST_CASE("a tetrahedron knows its inside") {
    const Mesh mesh;
    CHECK(mesh.contains({.1, .1, .1}));
    CHECK(!mesh.contains({.4, .4, .4}));
    CHECK(!mesh.contains({.1, .1, -.1}));
    MeshData open = *mesh.data;
    open.triangles.pop_back();
    CHECK(open_side(open));
    CHECK(!Mesh{std::make_shared<const MeshData>(open), ""}.contains({.1, .1, .1}));
}

namespace {

Shape shape_of(MeshData data) { return Mesh{std::make_shared<const MeshData>(std::move(data)), ""}; }

/// Dark pixels where nothing can be dark: `scene` has light or background everywhere.
void check_no_specks(const Scene& scene, const char* what) {
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        const Frame frame = shoot(scene, precision, {.width = 320, .height = 240});
        int dark = 0;
        for (std::size_t i = 0; i < frame.rgb.size(); i += 3)
            dark += frame.rgb[i] + frame.rgb[i + 1] + frame.rgb[i + 2] <= 0;
        CAPTURE(what);
        CHECK(dark == 0);
    }
}

}  // namespace

TEST_CASE("no specks: what starts on a convex mesh does not meet it") {
    Dice dice;
    MeshData round = ball(dice, 60, DVec3(0));
    for (DVec3& p : round.points) p = p / naive::length(p);
    for (const double away : {0., 300.}) {
        MeshData moved = round;
        for (DVec3& p : moved.points) p += DVec3(away, away / 3, -away / 7);
        const DVec3 middle(away, away / 3, -away / 7), eye = middle + DVec3(1, -4, 1.5);
        Stage lit;
        lit.put(shape_of(moved), paint(Color(1))).light(eye).look(eye, middle, 15).background({0, 0, 1});
        check_no_specks(lit.scene, "lit from the eye");
        Stage reflecting;
        reflecting.put(shape_of(moved), mirror(1)).look(eye, middle, 15).background({0, 0, 1});
        check_no_specks(reflecting.scene, "reflecting the sky alone");
    }
}

TEST_CASE("no specks: a flat field of many triangles, lit from the side") {
    MeshData field;
    constexpr int n = 40;
    const DVec3 u = naive::to<double>(Vec3<double>(.96, .28, 0)), v(-.28 * .8, .96 * .8, .6);
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= n; ++k) field.points.push_back((i - n / 2) * .3 * u + (k - n / 2) * .3 * v);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const int a = i * (n + 1) + k, b = a + n + 1;
            field.triangles.push_back({a, b, b + 1}), field.triangles.push_back({a, b + 1, a + 1});
        }
    const DVec3 normal(.28 * .6, -.96 * .6, .8);
    for (const double height : {.01, .1, 1., 30.}) {
        Stage stage;
        stage.put(shape_of(field), paint(Color(1))).light(50. * u + height * normal).look(4. * normal, DVec3(0), 25, u);
        check_no_specks(stage.scene, "lit from the side");
    }
}

// The Standard Procedural Databases as NFF on standard output: bench_spd WORLD [SIZE]
//
// A generator of our own after their descriptions (E. Haines, "A Proposal for Standard Graphics Environments", IEEE
// Computer Graphics and Applications, 1987): the same kinds of bodies in the same numbers and the same arrangement, not
// the same numbers in each line. Without SIZE it is the one that papers use.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "tests/bench/points.h"

namespace {

constexpr double pi = std::numbers::pi;

using namespace strahl::bench;

/// A number from 0 to 1 that looks random, the same for the same key everywhere.
double by_chance(std::uint64_t key) { return chance(key * next_state); }

void put(const char* word, const Point& p) { std::printf("%s %.9g %.9g %.9g\n", word, p.x, p.y, p.z); }
void view(const Point& from, const Point& at) {
    std::puts("v");
    put("from", from), put("at", at), put("up", {0, 0, 1});
    std::puts("angle 45\nhither 0\nresolution 512 512\nb 0.078 0.361 0.753");
}
void light(const Point& p) { put("l", p); }
void sphere(const Point& c, double r) { std::printf("s %.9g %.9g %.9g %.9g\n", c.x, c.y, c.z, r); }
void cone(const Point& a, double ra, const Point& b, double rb) {
    std::printf("c %.9g %.9g %.9g %.9g\n%.9g %.9g %.9g %.9g\n", a.x, a.y, a.z, ra, b.x, b.y, b.z, rb);
}
void polygon(const std::vector<Point>& corners) {
    std::printf("p %zu\n", corners.size());
    for (const Point& p : corners) std::printf("%.9g %.9g %.9g\n", p.x, p.y, p.z);
}
void floor_at(double z, double half) {
    polygon({{half, half, z}, {-half, half, z}, {-half, -half, z}, {half, -half, z}});
}

void balls(int size) {
    view({2.1, 1.3, 1.7}, {0, 0, 0});
    light({4, 3, 2}), light({1, -4, 4}), light({-3, 1, 5});
    std::puts("f 1 .75 .33 .8 0 0 0 0");
    floor_at(-.5, 12);
    std::puts("f 1 .9 .7 .5 .5 3.0827 0 0");
    flake(sphere, {0, 0, 0}, .5, {0, 0, 1}, size);
}

/// Adds a gear of 144 flanks and two ends of 144 corners, turned by half a tooth if `between` others.
void gear(const Point& middle, bool between, double height) {
    constexpr int teeth = 36;
    std::vector<Point> low, high;
    for (int i = 0; i < 4 * teeth; ++i) {
        // The first two of a tooth's four corners are its tip.
        const double share[] = {-.14, .14, .3, .7};
        const double turn = 2 * pi / teeth * (i / 4 + share[i % 4] + (between ? .5 : 0));
        const double radius = i % 4 < 2 ? 1.04 : .94;
        const Point corner = middle + Point{radius * std::cos(turn), radius * std::sin(turn), 0};
        low.push_back(corner - Point{0, 0, height / 2}), high.push_back(corner + Point{0, 0, height / 2});
    }
    polygon(high);
    polygon({low.rbegin(), low.rend()});
    for (std::size_t i = 0, k = low.size() - 1; i < low.size(); k = i++) polygon({low[k], low[i], high[i], high[k]});
}
void gears(int size) {
    const double middle = size - 1.;
    view({middle - 1.1 * size, middle - 2.9 * size, 1.9 * size}, {middle, middle, .35 * size});
    for (const double x : {-3., 3.})
        for (const double y : {-3., 3.}) light({middle + x * size, middle + y * size, 5. * size});
    light({middle, middle, 9. * size});
    std::puts("f .6 .55 .5 .8 0 0 0 0");
    floor_at(-.5, 10. * size);
    std::puts("f .9 .8 .6 .4 .3 20 .3 1.1");
    for (int k = 0; k < size; ++k)
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i) gear({2. * i, 2. * j, .8 * k}, (i + j) % 2 != 0, .5);
}

/// A mountain of 2 * 4^size triangles, by displacing midpoints, and four glass balls above it.
void mount(int size) {
    const int n = 1 << size;
    std::vector<double> heights(static_cast<std::size_t>((n + 1) * (n + 1)));
    const auto at = [&](int x, int y) -> double& { return heights[static_cast<std::size_t>(y * (n + 1) + x)]; };
    for (int step = n; step > 1; step /= 2) {
        const double rough = .55 * step / n;
        const auto middle = [&](int x, int y, double mean) {
            at(x, y) = mean + rough * (by_chance(static_cast<std::uint64_t>(y) * 65537 + x + 7) - .42);
        };
        const int half = step / 2;
        for (int y = 0; y <= n; y += step)
            for (int x = half; x < n; x += step) middle(x, y, (at(x - half, y) + at(x + half, y)) / 2);
        for (int y = half; y < n; y += step)
            for (int x = 0; x <= n; x += half)
                middle(x, y,
                       x % step == 0 ? (at(x, y - half) + at(x, y + half)) / 2
                                     : (at(x - half, y - half) + at(x + half, y + half)) / 2);
    }
    view({-1.6, 1.6, 1.7}, {0, 0, 0});
    light({-2, 4, 5});
    std::puts("f .1 .45 .15 .9 0 0 0 0");
    const auto point = [&](int x, int y) { return Point{2. * x / n - 1, 2. * y / n - 1, at(x, y) - .2}; };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            polygon({point(x, y), point(x + 1, y), point(x + 1, y + 1)});
            polygon({point(x, y), point(x + 1, y + 1), point(x, y + 1)});
        }
    std::puts("f 1 .9 .9 .1 .2 100 .7 1.5");
    for (const Point& p : {Point{-.8, .8, .45}, {-.35, .35, .75}, {.3, .85, .4}, {-.85, -.3, .4}}) sphere(p, .2);
}

/// A square pyramid of rings that hang in one another: 30 balls and 30 cylinders each.
void rings(int size) {
    view({1.3 * size, -2.1 * size, 1.6 * size}, {0, 0, .3 * size});
    light({3. * size, -4. * size, 4. * size}), light({-4. * size, -2. * size, 3. * size}), light({0, 1, 8. * size});
    std::puts("f .95 .88 .66 .9 0 0 0 0");
    floor_at(-.75, 4. * size);
    std::puts("f .4 .5 .9 .6 .4 25 0 0");
    constexpr int corners = 30;
    for (int k = 0; k < size; ++k)
        for (int j = 0; j < size - k; ++j)
            for (int i = 0; i < size - k; ++i) {
                const double start = (k + 1 - size) / 2.;
                const Point middle{1.4 * (start + i), start + j, 1.3 * k};
                const bool flat = j % 2 == 0;
                const auto corner = [&](int c) {
                    const double turn = 2 * pi * c / corners, a = .62 * std::cos(turn), b = .62 * std::sin(turn);
                    return middle + (flat ? Point{b, a, 0} : Point{0, a, b});
                };
                for (int c = 0; c < corners; ++c) {
                    sphere(corner(c), .07);
                    cone(corner(c), .05, corner(c + 1), .05);
                }
            }
}

/// 4^size triangles: a tetrahedron of four, each of four, and so on.
void tetrahedra(const Point& a, const Point& b, const Point& c, const Point& d, int generations) {
    if (generations == 0) return polygon({a, b, c}), polygon({a, c, d}), polygon({a, d, b}), polygon({b, d, c});
    const auto middle = [](const Point& p, const Point& q) { return .5 * (p + q); };
    const int next = generations - 1;
    tetrahedra(a, middle(a, b), middle(a, c), middle(a, d), next);
    tetrahedra(middle(a, b), b, middle(b, c), middle(b, d), next);
    tetrahedra(middle(a, c), middle(b, c), c, middle(c, d), next);
    tetrahedra(middle(a, d), middle(b, d), middle(c, d), d, next);
}
void tetra(int size) {
    view({1.02, -3.18, 2.17}, {0, 0, 0});
    light({1.88, -18.1, 5});
    std::puts("f 1 .2 .2 1 0 0 0 0");
    tetrahedra({1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, size - 1);
}

/// 2^(size + 1) - 1 branches, each a cone with a ball at its tip.
void branch(const Point& base, const Point& direction, double length, double radius, int generations, int key) {
    const Point tip = base + length * direction;
    cone(base, radius, tip, .7 * radius);
    sphere(tip, .7 * radius);
    if (generations == 0) return;
    Point u, v;
    across(direction, u, v);
    const double turn = 2 * pi * by_chance(static_cast<std::uint64_t>(key));
    const Point side = std::cos(turn) * u + std::sin(turn) * v;
    const auto grow = [&](double degrees, double sign, double shorter, int next_key) {
        const double angle = degrees * pi / 180;
        const Point next = unit(std::cos(angle) * direction + sign * std::sin(angle) * side + Point{0, 0, .04});
        branch(tip, next, shorter * length, .7 * radius, generations - 1, next_key);
    };
    grow(40, 1, .78, 2 * key);
    grow(25, -1, .88, 2 * key + 1);
}
void tree(int size) {
    view({8, .7, 3}, {0, 0, 2});
    light({30, 10, 40}), light({-20, 30, 35}), light({10, -30, 45}), light({40, -20, 20}), light({-10, -5, 60});
    light({20, 40, 30}), light({60, 0, 15});
    std::puts("f .4 .6 .2 .9 0 0 0 0");
    floor_at(0, 50);
    std::puts("f .55 .4 .2 1 0 0 0 0");
    branch({0, 0, 0}, {0, 0, 1}, .75, .09, size, 1);
}

}  // namespace

int main(int count, char** arguments) {
    struct World {
        const char* name;
        int size, largest;
        void (*put)(int);
    };
    constexpr World worlds[] = {{"balls", 4, 8, balls},  {"gears", 4, 40, gears}, {"mount", 6, 12, mount},
                                {"rings", 7, 60, rings}, {"tetra", 6, 12, tetra}, {"tree", 11, 20, tree}};
    const std::string name = count > 1 ? arguments[1] : "";
    for (const World& world : worlds) {
        if (name != world.name) continue;
        const int size = count > 2 ? std::atoi(arguments[2]) : world.size;
        if (size < 1 || size > world.largest) break;
        return world.put(size), 0;
    }
    std::fputs("bench_spd balls|gears|mount|rings|tetra|tree [SIZE]\n", stderr);
    return 2;
}

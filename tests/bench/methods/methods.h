// Ways to intersect, side by side: rays and answers as arrays, and the list of methods of one instruction set.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace strahl::bench {

/// n rays, each with a body of its own. `a` is a centre, a base, a point of a plane or a box's low corner; `b` an axis,
/// a normal or the high corner; `r` a radius. The axis of a cylinder is of length 1, its height is `h`.
template <class T>
struct Rays {
    enum Column { ox, oy, oz, dx, dy, dz, ax, ay, az, bx, by, bz, r, h, columns };
    std::array<std::vector<T>, columns> column;
    std::size_t size() const { return column[0].size(); }
};

/// t of each ray, infinite for a miss and -1 for a ray that meets the surface that it leaves; and the point there.
template <class T>
struct Answers {
    std::vector<T> t, x, y, z;
    explicit Answers(std::size_t n) : t(n), x(n), y(n), z(n) {}
};

template <class T>
struct Method {
    const char *group, *name;
    int lanes;
    bool engine;  // the one that the engine uses
    void (*run)(const Rays<T>&, Answers<T>&);
};

// One namespace per instruction set: one number at a time, 8 floats or 4 doubles, 16 or 8.
namespace scalar {
std::vector<Method<float>> methods_float();
std::vector<Method<double>> methods_double();
std::vector<Method<long double>> methods_extended();
}  // namespace scalar
namespace v3 {
std::vector<Method<float>> methods_float();
std::vector<Method<double>> methods_double();
}  // namespace v3
namespace v4 {
std::vector<Method<float>> methods_float();
std::vector<Method<double>> methods_double();
}  // namespace v4

}  // namespace strahl::bench

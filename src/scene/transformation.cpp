// Matrices of rotations, translations and scalings.
#include "scene/transformation.h"

#include <cmath>
#include <numbers>

#include "scene/motion.h"

namespace strahl {
namespace {

struct SinCos {
    double sin, cos;
};

/// Reduces the angle in degrees, which is exact: the cosine of 90 degrees is 0 and not 6e-17.
SinCos sin_cos(double degrees) {
    int quarters = 0;
    const double rest = std::remquo(degrees, 90.0, &quarters) * (std::numbers::pi / 180);
    const double s = std::sin(rest), c = std::cos(rest);
    switch (quarters & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

/// The rotation that turns axis `from` towards axis `to`.
glm::dmat4 turn(int from, int to, double degrees) {
    const SinCos a = sin_cos(degrees);
    glm::dmat4 m{1};  // m[column][row]
    m[from][from] = m[to][to] = a.cos;
    m[from][to] = a.sin;
    m[to][from] = -a.sin;
    return m;
}

glm::dmat4 matrix(const Rotate& r) {
    return turn(0, 1, r.degrees.z) * turn(2, 0, r.degrees.y) * turn(1, 2, r.degrees.x);
}
glm::dmat4 matrix(const Translate& t) {
    glm::dmat4 m{1};
    m[3] = {t.by.x, t.by.y, t.by.z, 1};
    return m;
}
glm::dmat4 matrix(const Scale& s) {
    glm::dmat4 m{1};
    for (int i = 0; i < 3; ++i) m[i][i] = s.by[i];
    return m;
}
void multiply(glm::dmat4& product, std::span<const Transformation> steps) {
    const auto one = [&]<class Step>(const Step& step) {
        if constexpr (std::is_same_v<Step, Motion>)
            multiply(product, at(step, 0));
        else
            product = matrix(step) * product;
    };
    for (const Transformation& step : steps) std::visit(one, step);
}

}  // namespace

glm::dmat4 matrix(std::span<const Transformation> steps) {
    glm::dmat4 product{1};
    multiply(product, steps);
    return product;
}

double similarity(std::span<const Transformation> steps) {
    double factor = 1;
    for (const Transformation& step : steps)
        if (const Scale* const scale = std::get_if<Scale>(&step)) {
            const double x = std::fabs(scale->by.x);
            if (std::fabs(scale->by.y) != x || std::fabs(scale->by.z) != x) return 0;
            factor *= x;
        } else if (const Motion* const motion = std::get_if<Motion>(&step)) {
            factor *= similarity(at(*motion, 0));
        }
    return factor;
}

}  // namespace strahl

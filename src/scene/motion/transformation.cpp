#include "scene/motion/transformation.h"

#include <cmath>
#include <numbers>

#include "scene/motion/motion.h"

namespace strahl {
namespace {

struct SinCos {
    double sin, cos;
};

/// Sine and cosine. Reducing the angle in degrees is exact: the cosine of 90 degrees is 0 and not 6e-17.
SinCos sin_cos(double degrees) {
    if (degrees == 0) return {0, 1};
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
glm::dmat3 turn(int from, int to, double degrees) {
    const SinCos a = sin_cos(degrees);
    glm::dmat3 m{1};  // m[column][row]
    m[from][from] = m[to][to] = a.cos;
    m[from][to] = a.sin;
    m[to][from] = -a.sin;
    return m;
}

/// Multiplies a matrix by transformations from the left, each by its few numbers: with products of whole matrices, they
/// would take most of the time for moving many bodies.
struct Multiply {
    glm::dmat4& product;

    void operator()(const Rotate& step) const {
        const DVec3& r = step.degrees;
        // Most turns are about one axis; the others would multiply by 1.
        const glm::dmat3 m = r.y == 0 && r.z == 0   ? turn(1, 2, r.x)
                             : r.x == 0 && r.z == 0 ? turn(2, 0, r.y)
                             : r.x == 0 && r.y == 0 ? turn(0, 1, r.z)
                                                    : turn(0, 1, r.z) * turn(2, 0, r.y) * turn(1, 2, r.x);
        for (int c = 0; c < 4; ++c) product[c] = glm::dvec4(m * glm::dvec3(product[c]), product[c].w);
    }
    void operator()(const Translate& step) const { product[3] += glm::dvec4(step.by.x, step.by.y, step.by.z, 0); }
    void operator()(const Scale& step) const {
        for (int c = 0; c < 4; ++c) product[c] *= glm::dvec4(step.by.x, step.by.y, step.by.z, 1);
    }
    void operator()(const Motion& step) const {
        for (const Transformation& own : at(step, 0)) std::visit(*this, own);
    }
};

}  // namespace

glm::dmat4 matrix(std::span<const Transformation> steps) {
    glm::dmat4 product{1};
    for (const Transformation& step : steps) std::visit(Multiply{product}, step);
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

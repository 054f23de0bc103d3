#include "pov/things/steps.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

#include "num/vec_math.h"

namespace strahl::pov {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // clang 16 does not find this by itself

glm::dmat4 matrix_of(const Step& step) {
    return std::visit(Overloaded{[](const MatrixStep& own) { return own.m(); },
                                 [](const auto& own) { return matrix(std::vector<Transformation>{own}); }},
                      step);
}

constexpr double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Returns the angles about x, then y, then z of a rotation.
Rotate rotation_of(const glm::dmat3& m) {
    const double sine = std::clamp(-m[0][2], -1., 1.);
    if (std::fabs(sine) > 1 - 1e-14) return {{degrees(std::atan2(-m[2][1], m[1][1])), degrees(std::asin(sine)), 0}};
    return {{degrees(std::atan2(m[1][2], m[2][2])), degrees(std::atan2(sine, std::hypot(m[0][0], m[0][1]))),
             degrees(std::atan2(m[0][1], m[0][0]))}};
}

/// Finds the eigenvectors of a symmetric matrix by C. Jacobi's rotations; they become the columns of `axes`.
void diagonalise(glm::dmat3& m, glm::dmat3& axes) {
    axes = glm::dmat3(1);
    for (int sweep = 0; sweep < 30; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (m[q][p] == 0) continue;
                const double theta = (m[q][q] - m[p][p]) / (2 * m[q][p]);
                const double t = std::copysign(1 / (std::fabs(theta) + std::hypot(theta, 1)), theta);
                const double c = 1 / std::hypot(t, 1), s = t * c;
                glm::dmat3 turn(1);
                turn[p][p] = turn[q][q] = c, turn[q][p] = s, turn[p][q] = -s;
                m = glm::transpose(turn) * m * turn, axes = axes * turn;
            }
}

/// Adds the steps of a matrix: turned into the axes of its singular values, scaled along them, and turned on.
void add_matrix(std::vector<Transformation>& all, const glm::dmat4& whole) {
    const glm::dmat3 m(whole);
    glm::dmat3 squares = glm::transpose(m) * m, axes;
    const double size = std::sqrt((squares[0][0] + squares[1][1] + squares[2][2]) / 3);
    bool similar = true;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            similar &= std::fabs(squares[i][j] - (i == j ? size * size : 0)) <= 1e-14 * size * size;
    DVec3 factors(size);
    if (similar) {
        axes = glm::dmat3(1);
    } else {
        diagonalise(squares, axes);
        if (glm::determinant(axes) < 0) axes[2] = -axes[2];
        // The last digits of small factors would be those of rounding errors in the squares.
        for (int i = 0; i < 3; ++i) factors[i] = std::max(length(m * axes[i]), 1e-9 * size);
    }
    if (glm::determinant(m) < 0) factors.z = -factors.z;
    glm::dmat3 turned;
    for (int i = 0; i < 3; ++i) turned[i] = m * axes[i] / factors[i];
    const auto add_rotation = [&](const glm::dmat3& turn) {
        if (const Rotate rotate = rotation_of(turn); rotate.degrees != DVec3(0)) all.push_back(rotate);
    };
    add_rotation(glm::transpose(axes));
    if (factors != DVec3(1)) all.push_back(Scale{factors});
    add_rotation(turned);
    if (const DVec3 by(whole[3]); by != DVec3(0)) all.push_back(Translate{by});
}

}  // namespace

glm::dmat4 matrix_of(std::span<const Step> steps) {
    glm::dmat4 product(1);
    for (const Step& step : steps) product = matrix_of(step) * product;
    return product;
}

Steps inverse(std::span<const Step> steps) {
    Steps all;
    for (auto step = steps.rbegin(); step != steps.rend(); ++step)
        std::visit(Overloaded{[&](const Rotate& own) {
                                  const DVec3 d = -own.degrees;
                                  for (const DVec3 turn : {DVec3(0, 0, d.z), DVec3(0, d.y, 0), DVec3(d.x, 0, 0)})
                                      if (turn != DVec3(0)) all.push_back(Rotate{turn});
                              },
                              [&](const Translate& own) { all.push_back(Translate{-own.by}); },
                              [&](const Scale& own) { all.push_back(Scale{1. / own.by}); },
                              [&](const MatrixStep& own) {
                                  if (glm::determinant(own.m()) != 0) all.push_back(MatrixStep(glm::inverse(own.m())));
                              }},
                   *step);
    return all;
}

void append(Steps& steps, std::span<const Step> more) { steps.insert(steps.end(), more.begin(), more.end()); }

std::vector<Transformation> transformations_of(std::span<const Step> steps, bool mirrored) {
    std::vector<Transformation> all;
    for (const Step& step : steps)
        std::visit(Overloaded{[&](const Rotate& own) {
                                  const DVec3& d = own.degrees;
                                  all.push_back(Rotate{mirrored ? DVec3(-d.x, -d.y, d.z) : d});
                              },
                              [&](const Translate& own) { all.push_back(Translate{mirror(own.by, mirrored)}); },
                              [&](const Scale& own) { all.push_back(own); },
                              [&](const MatrixStep& own) {
                                  glm::dmat4 m = own.m();
                                  if (mirrored)
                                      for (int i = 0; i < 3; ++i) m[i][2] = -m[i][2], m[2][i] = -m[2][i];
                                  if (mirrored) m[3][2] = -m[3][2];
                                  add_matrix(all, m);
                              }},
                   step);
    return all;
}

}  // namespace strahl::pov

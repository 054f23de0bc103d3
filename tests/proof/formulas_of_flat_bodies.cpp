// Each formula of flat bodies on its own, as formulas_of_bodies.cpp has those of round ones.
#include "tests/proof/cases.h"

using namespace strahl;
using namespace strahl::trial;

template <>
struct trial::Case<Cuboid> {
    Cuboid shape;
    BoxKernel<double> kernel;
    Slack<double> slack;
    /// Half of them are boards or rods.
    explicit Case(Dice& dice) {
        const auto half = [&] { return std::pow(10, dice.in(dice.chance(.5) ? -3 : -.7, .3)); };
        const DVec3 size{half(), half(), half()}, middle = dice.vector(-3, 3);
        shape = {middle - size, middle + size};
        const double off = any_size(dice, -7);
        const Vector low = shape.corner, high = shape.opposite, axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const R reach[] = {R(.5) * (high.x - low.x), R(.5) * (high.y - low.y), R(.5) * (high.z - low.z)};
        kernel.centre = rounded(R(.5) * (low + high) + R(off) * Vector(dice.direction()));
        kernel.box = {kernel.centre, size + 1e-6};  // where kernels look for hits at all
        R wrong = length(vector(kernel.centre) - R(.5) * (low + high));
        Vec3<double>* rows[] = {&kernel.row_x, &kernel.row_y, &kernel.row_z};
        Vector made[3];
        for (int i : {0, 1, 2}) {
            *rows[i] = rounded(1 / reach[i] * (axes[i] + R(off) * Vector(dice.direction())));
            made[i] = vector(*rows[i]);
            const R turned = length(made[i] - 1 / reach[i] * axes[i]) / length(made[i]);
            slack.turn = std::max(slack.turn, above(turned));
        }
        const R volume = dot(made[0], cross(made[1], made[2]));
        for (int i : {0, 1, 2})
            wrong = wrong + length(R(1) / volume * cross(made[(i + 1) % 3], made[(i + 2) % 3]) - reach[i] * axes[i]);
        slack.share = 1.0000001 * above(wrong / (R(norm1(kernel.centre)) + R(norm1(size))));
    }
    double scale() const { return kernel.box.half.x; }
    R off(const Vector& p, int face) const {
        const DVec3& corner = face % 2 ? shape.opposite : shape.corner;
        return size(face < 2 ? p.x - corner.x : face < 4 ? p.y - corner.y : p.z - corner.z);
    }
    /// Three quarters of them near an edge, on either side of it, or near a corner.
    std::pair<Vector, Vector> point(Dice& dice) const {
        const int axis = dice.upto(2), side = dice.upto(1);
        R place[3], normal[3] = {0, 0, 0};
        for (int i : {0, 1, 2}) {
            const R near = std::pow(10, dice.in(-15, -1)) * (dice.chance(.7) ? 1 : -1);
            place[i] = dice.chance(.5) ? R(dice.in(-1, 1)) : (dice.chance(.5) ? 1 : -1) * (1 - near);
        }
        place[axis] = normal[axis] = side ? 1 : -1;
        const Vector low = shape.corner, high = shape.opposite;
        return {R(.5) * (low + high + Vector{place[0], place[1], place[2]} * (high - low)),
                Vector{normal[0], normal[1], normal[2]}};
    }
};
template <>
struct trial::Case<Triangle> {
    Triangle shape;
    TriangleKernel<double> kernel;
    Slack<double> slack;
    Vector normal;
    /// A third of them are narrow.
    explicit Case(Dice& dice) {
        const DVec3 e = dice.arrow(.1, 3), f = dice.arrow(.1, 3);
        const double narrow = dice.chance(.3) ? std::pow(10, dice.in(-9, 0)) : 1;
        shape.a = dice.vector(-3, 3), shape.b = shape.a + e;
        shape.c = shape.a + (dice.chance(.5) ? narrow * f : dice.in(.1, 2) * e + narrow * f);
        normal = unit(cross(Vector(shape.b) - Vector(shape.a), Vector(shape.c) - Vector(shape.a)));
        const double off = any_size(dice, -7);
        const auto moved = [&](const DVec3& corner) { return rounded(Vector(corner) + R(off) * any_of(dice, normal)); };
        kernel = {moved(shape.a), moved(shape.b), moved(shape.c)};
        R wrong = length(vector(kernel.a) - Vector(shape.a));
        wrong = std::max(wrong, length(vector(kernel.b) - Vector(shape.b)));
        wrong = std::max(wrong, length(vector(kernel.c) - Vector(shape.c)));
        slack.share = 1.0000001 * above(wrong / R(norm1(kernel.a) + norm1(kernel.b) + norm1(kernel.c)));
    }
    double scale() const { return 1; }
    R off(const Vector& p, int) const { return size(dot(normal, p - Vector(shape.a))); }
    /// Three quarters of them near a side, on either side of it, or near a corner.
    std::pair<Vector, Vector> point(Dice& dice) const {
        const auto near = [&] { return R(std::pow(10, dice.in(-15, -1)) * (dice.chance(.7) ? 1 : -1)); };
        const R first = dice.chance(.5) ? near() : R(dice.in(0, 1));
        const R second = (1 - first) * (dice.chance(.5) ? near() : R(dice.in(0, 1)));
        const Vector corners[] = {shape.a, shape.b, shape.c};
        const int turned = dice.upto(2);
        return {first * corners[turned] + second * corners[(turned + 1) % 3] +
                    (1 - first - second) * corners[(turned + 2) % 3],
                normal};
    }
};

template <>
struct trial::Case<SmoothTriangle> {
    Case<Triangle> flat;
    SmoothTriangle shape;
    SmoothTriangleKernel<double> kernel;
    Slack<double> slack;
    /// Some have normals that all but cancel.
    explicit Case(Dice& dice) : flat(dice), slack(flat.slack) {
        const double bent = dice.chance(.1) ? 3 : dice.in(0, 1), off = any_size(dice, -7);
        const auto make = [&](DVec3& exact, Vec3<double>& made) {
            exact = rounded(flat.normal + R(bent) * Vector(dice.direction()));
            made = rounded(unit(Vector(exact)) + R(off) * Vector(dice.direction()));
            slack.turn = std::max(slack.turn, above(length(vector(made) - unit(Vector(exact)))));
        };
        shape.a = flat.shape.a, shape.b = flat.shape.b, shape.c = flat.shape.c, kernel.flat = flat.kernel;
        make(shape.normal_a, kernel.normal_a), make(shape.normal_b, kernel.normal_b);
        make(shape.normal_c, kernel.normal_c);
    }
    double scale() const { return flat.scale(); }
    R off(const Vector& p, int face) const { return flat.off(p, face); }
    std::pair<Vector, Vector> point(Dice& dice) const { return flat.point(dice); }
};

TEST_CASE("formulas of discs") { try_body<Disc>(11); }
TEST_CASE("formulas of cuboids") { try_body<Cuboid>(12); }
TEST_CASE("formulas of triangles") { try_body<Triangle>(13); }
TEST_CASE("formulas of smooth triangles") { try_body<SmoothTriangle>(20); }

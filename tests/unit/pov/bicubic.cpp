// Bicubic patches: how they are divided.
#include "pov/things/bicubic.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/unit/pov/opened.h"

using namespace strahl;
using namespace strahl::pov;

namespace {

/// Returns a patch over x and z from 0 to 3, whose control points are up to `height` above.
BicubicPatch random_patch(std::mt19937& random, double height) {
    BicubicPatch patch;
    for (std::size_t i = 0; i < 16; ++i)
        patch.points[i] = {double(i % 4), height * std::uniform_real_distribution<>(0, 1)(random), double(i / 4)};
    return patch;
}
std::size_t triangles(const BicubicPatch& patch) { return patch.mesh()->triangles.size(); }

}  // namespace

TEST_CASE("patches are halved as often as their steps say, and corners are on their surfaces") {
    std::mt19937 random(1);
    for (int u = 0; u < 4; ++u)
        for (int v = 0; v < 4; ++v) {
            BicubicPatch patch = random_patch(random, 2);
            patch.steps = {u, v};
            const MeshData mesh = *patch.mesh();
            CHECK(mesh.triangles.size() == 2u << (u + v));
            for (const DVec3& p : mesh.points) {
                // Their x and z are parameters, so that y is a sum of Bernstein's polynomials of these.
                double y = 0;
                for (int i = 0; i < 4; ++i)
                    for (int j = 0; j < 4; ++j) {
                        const auto weight = [](int k, double t) {
                            return (k % 3 ? 3 : 1) * std::pow(t, k) * std::pow(1 - t, 3 - k);
                        };
                        y += weight(i, p.z / 3) * weight(j, p.x / 3) * patch.points[std::size_t(4 * i + j)].y;
                    }
                CHECK(std::fabs(p.y - y) < 1e-14);
            }
        }
}

TEST_CASE("parts of patches that are flat enough in the world stay whole") {
    std::mt19937 random(2);
    BicubicPatch patch = random_patch(random, 0);
    patch.steps = {6, 6};
    CHECK(triangles(patch) == 2u << 12);  // nothing is nearer to a plane than 0
    patch.flatness = 1e-9;
    CHECK(triangles(patch) == 2);
    patch = random_patch(random, 2);
    patch.steps = {6, 6}, patch.flatness = .01;
    const std::size_t many = triangles(patch);
    patch.flatness = .1;
    const std::size_t few = triangles(patch);
    CHECK(2 < few);
    CHECK(few < many);
    CHECK(many < 2u << 12);
    std::string text = "bicubic_patch { type 1 flatness .1 u_steps 6 v_steps 6";
    for (const DVec3& p : patch.points)
        text += " <" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ">";
    for (const auto& [moves, count] :
         {std::pair("", few), std::pair("rotate 30 translate x", few), std::pair("scale 10", many)}) {
        CAPTURE(std::string(moves));
        const Scene scene = whole(text + " pigment { rgb 1 } " + moves + " }");
        CHECK(shape<Mesh>(scene).data->triangles.size() == count);
    }
}

TEST_CASE("patches of too many triangles are refused, however deep they are halved") {
    std::mt19937 random(3);
    BicubicPatch patch = random_patch(random, 1);
    patch.steps = {1'000'000'000, 0};
    CHECK_FALSE(patch.mesh());
}

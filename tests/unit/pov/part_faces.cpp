// Pairs of faces in one place: those found are those that a comparison of all with all finds.
#include "pov/meaning/part_faces.h"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <set>
#include <utility>

using namespace strahl;
using namespace strahl::pov;

namespace {

using Pairs = std::multiset<std::pair<std::size_t, std::size_t>>;  // of parts

/// Returns the pairs that any_pair_of() calls its test with.
template <class Face>
Pairs found(std::vector<Face> faces) {
    Pairs pairs;
    any_pair_of(faces, [&](const Face& a, const Face& b) {
        pairs.insert(std::minmax(a.part, b.part));
        return false;
    });
    return pairs;
}
template <class Face, class InOnePlace>
Pairs all_with_all(const std::vector<Face>& faces, const InOnePlace& in_one_place) {
    Pairs pairs;
    for (std::size_t a = 0; a < faces.size(); ++a)
        for (std::size_t b = a + 1; b < faces.size(); ++b)
            if (faces[a].part != faces[b].part && in_one_place(faces[a], faces[b]))
                pairs.insert(std::minmax(faces[a].part, faces[b].part));
    return pairs;
}

}  // namespace

TEST_CASE("faces in one place are found as a comparison of all with all finds them") {
    std::mt19937 random(7);
    const auto one_of = [&](int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); };
    std::size_t flat_pairs = 0, curved_pairs = 0;
    for (int world = 0; world < 20; ++world) {
        const bool turned = world % 2;
        const glm::dmat4 turn =
            turned ? glm::rotate(glm::dmat4(1), double(one_of(100)), DVec3(1, one_of(9), one_of(9))) : glm::dmat4(1);
        std::vector<PartFace> flat;
        std::vector<CurvedFace> curved;
        for (std::size_t part = 0; part < 60; ++part) {
            const DVec3 at(one_of(4), one_of(4), one_of(4));
            const glm::dmat4 matrix = glm::translate(turn, at);
            Shape shape = Sphere{DVec3(0), 1. + one_of(2)};
            if (part % 3 == 1) shape = Cuboid{DVec3(0), DVec3(1 + one_of(2), 1 + one_of(2), 1 + one_of(2))};
            if (part % 3 == 2) shape = Cylinder{DVec3(0), DVec3(0, 1 + one_of(2), 0), .5 * (1 + one_of(2))};
            add_flat(flat, shape, matrix, {part, 0}, 100), add_curved(curved, shape, matrix, {part, 0});
        }
        const Pairs flat_found = found(flat), curved_found = found(curved);
        CHECK(flat_found == all_with_all(flat, [](const PartFace& a, const PartFace& b) {
                  bool same = length(a.normal - b.normal) < 1e-9 && std::fabs(a.at - b.at) < 1e-9;
                  for (int i = 0; i < 3; ++i) same &= a.box.low[i] <= b.box.high[i] && b.box.low[i] <= a.box.high[i];
                  return same;
              }));
        CHECK(curved_found == all_with_all(curved, [](const CurvedFace& a, const CurvedFace& b) {
                  return a.kind == b.kind && std::fabs(a.size - b.size) < 1e-9 && length(a.centre - b.centre) < 1e-9 &&
                         length(a.axis - b.axis) < 1e-9;
              }));
        flat_pairs += flat_found.size(), curved_pairs += curved_found.size();
    }
    CHECK(flat_pairs > 1000);
    CHECK(curved_pairs > 100);
}

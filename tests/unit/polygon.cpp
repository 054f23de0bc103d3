// Polygons cut into triangles.
#include "import/polygon.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace strahl;

TEST_CASE("polygons are cut into triangles that cover them") {
    const auto area = [](const std::vector<DVec3>& corners, const Triangles& cut) {
        double sum = 0;
        for (const auto& [a, b, c] : cut.list)
            sum += (corners[b].x - corners[a].x) * (corners[c].y - corners[a].y) -
                   (corners[b].y - corners[a].y) * (corners[c].x - corners[a].x);
        return sum / 2;
    };
    const std::vector<DVec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    CHECK(triangles_of(square, 0).list.size() == 2);
    CHECK(area(square, triangles_of(square, 0)) == 1);
    // A comb with teeth; either way round, and with each corner as the first.
    std::vector<DVec3> comb{{9, 0, 0}, {9, -1, 0}, {0, -1, 0}};
    for (int i = 0; i < 9; ++i) comb.push_back({double(i), 0, 0}), comb.push_back({i + .5, 5, 0});
    for (std::size_t i = 0; i < comb.size(); ++i) {
        std::rotate(comb.begin(), comb.begin() + 1, comb.end());
        const Triangles cut = triangles_of(comb, 100);
        CHECK(cut.list.size() == comb.size() - 2 - (cut.list.size() < comb.size() - 2));
        CHECK(area(comb, cut) == doctest::Approx(-31.5));
        CHECK(!cut.crossing);
        const std::vector<DVec3> back(comb.rbegin(), comb.rend());
        CHECK(area(back, triangles_of(back, 100)) == doctest::Approx(31.5));
        CHECK(triangles_of(comb, 20).too_long);
    }
    // A square with a square hole, reached by a seam.
    const std::vector<DVec3> frame{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                   {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    CHECK(area(frame, triangles_of(frame, 100)) == 12);
    CHECK(!triangles_of(frame, 100).crossing);
    CHECK(triangles_of(std::vector<DVec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, 9).list.empty());
    CHECK(triangles_of(std::vector<DVec3>{{0, 0, 0}, {4, 1, 0}, {4, 0, 0}, {0, 1, 0}, {2, 5, 0}}, 9).list.size() == 3);
}

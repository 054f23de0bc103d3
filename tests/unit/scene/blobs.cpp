// Blobs: where rays cross them, against the referee's formulas; rays that start on them; and many lumps.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/kinds/blob/blob.h"
#include "tests/referee/dice.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/scene/placed_pieces.h"

using namespace strahl;

namespace {

Blob blob_of(Dice& dice, int) { return random_blob(dice); }

/// Makes a ray towards the blob: any, along the line of a lump, or to its end.
RayBetween ray_to_blob(Dice& dice, const Blob& body, int n) {
    const Lump& lump =
        body.data->lumps[static_cast<std::size_t>(dice.upto(static_cast<int>(body.data->lumps.size()) - 1))];
    DVec3 to = dice.vector(-1, 1), from = 5. * dice.direction();
    if (n % 4 == 1) {  // along its line
        const DVec3 line = lump.to - lump.from;
        to = lump.from, from = to - 5. * (length(line) > 0 ? normalize(line) : DVec3(0, 0, 1));
    }
    if (n % 4 == 2) to = lump.to;
    if (n % 4 == 3) from = {to.x, to.y, 5};
    return {from, to};
}

}  // namespace

TEST_CASE("blobs: rays cross them where the referee says") {
    compare_crossings<double>(blob_of, ray_to_blob, 1e-12);
    compare_crossings<float>(blob_of, ray_to_blob, 1e-5);
    compare_crossings<long double>(blob_of, ray_to_blob, 1e-12);
}

TEST_CASE("blobs: rays that start on a surface do not meet it there again, and meet what is ahead") {
    check_rays_on_pieces(blob_of, ray_to_blob);
}

TEST_CASE("blobs: many lumps are a sum, however they are grouped, and lumps in pieces are whole") {
    Dice dice{4};
    std::vector<Lump> lumps(300);
    for (Lump& own : lumps) {
        own.from = own.to = dice.vector(-3, 3);
        if (dice.chance(.3)) own.to = own.from + dice.vector(-.5, .5);
        own.radius = dice.in(.3, .7);
    }
    const Blob body{.4, std::make_shared<const BlobData>(lumps)};
    compare_many(body, dice, 3, 200, [&] { return dice.vector(-3, 3); });
    // A ray along the plane in which the cylinder of a lump ends counts each piece once.
    const Blob line{.5, std::make_shared<const BlobData>(std::vector<Lump>{{{0, 0, 0}, {0, 0, 2}}})};
    const auto across =
        PlacedPieces<Blob, double>(line).crossings({Vec3<double>(-3, 0, 0), Vec3<double>(1, 0, 0), -1.});
    REQUIRE(across.size() == 2);
    CHECK(across[0] == doctest::Approx(3 - std::sqrt(1 - std::sqrt(.5))).epsilon(1e-12));
}

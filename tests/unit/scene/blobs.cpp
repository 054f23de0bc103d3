// Blobs: where rays cross them, against the referee's formulas; rays that start on them; and many lumps.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "num/vec_math.h"
#include "scene/kinds/blob/blob.h"
#include "tests/referee/blob.h"
#include "tests/referee/dice.h"
#include "tests/referee/random_scene.h"

using namespace strahl;

namespace {

template <class T>
struct PlacedBlob {
    BlobKernel<T> kernel{};
    const LumpPiece* pieces;

    explicit PlacedBlob(const Blob& body) : pieces(body.data->pieces.data()) {
        body.emit<T>(WorldTransform(), [&](const BlobKernel<T>& own) { kernel = own; });
    }
    std::vector<T> crossings(const Ray<T>& ray, int enough = BlobData::unlimited) const {
        std::vector<T> found;
        kernel.each_crossing(pieces, enough, ray, ray.source, true, [&](bool, T t, T) { found.push_back(t); });
        return found;
    }
    SurfacePoint<T> at(const Ray<T>& ray, T t) const { return kernel.at(pieces, ray, t); }
};

template <class T>
Ray<T> random_ray(Dice& dice, const Blob& body, int n) {
    const Lump& lump =
        body.data->lumps[static_cast<std::size_t>(dice.upto(static_cast<int>(body.data->lumps.size()) - 1))];
    DVec3 to = dice.vector(-1, 1), from = 5. * dice.direction();
    if (n % 4 == 1) {  // along its line
        const DVec3 line = lump.to - lump.from;
        to = lump.from, from = to - 5. * (length(line) > 0 ? normalize(line) : DVec3(0, 0, 1));
    }
    if (n % 4 == 2) to = lump.to;
    if (n % 4 == 3) from = {to.x, to.y, 5};
    return {cast<T>(from), cast<T>(normalize(to - from)), T(-1)};
}

/// Compares crossings with the referee's, which are off by at most `error` times the distance; grazed surfaces apart.
template <class T>
void compare_blobs(double error) {
    Dice dice{1};
    int compared = 0, grazed = 0;
    for (int n = 0; n < 80; ++n) {
        const Blob body = random_blob(dice);
        const PlacedBlob<T> placed(body);
        for (int m = 0; m < 12; ++m) {
            const Ray<T> ray = random_ray<T>(dice, body, m);
            const std::vector<T> found = placed.crossings(ray);
            auto wanted = referee::crossings<long double>(body, {DVec3(ray.origin), DVec3(ray.direction)}, -1).list;
            std::erase_if(wanted, [](const auto& own) { return own.t < 0; });
            std::ranges::sort(wanted, {}, [](const auto& own) { return own.t; });
            CHECK(std::ranges::is_sorted(found));
            if (found.size() != wanted.size()) {
                ++grazed;
                MESSAGE("blob " << n << " ray " << m << ": " << found.size() << " of " << wanted.size());
                continue;
            }
            for (std::size_t i = 0; i < found.size(); ++i) {
                const DVec3 normal(placed.at(ray, found[i]).normal);
                const auto [off, cosine, slant] = referee::error_of(found[i], normal, wanted[i], DVec3(ray.direction));
                CHECK_MESSAGE(off * slant < error, n << " " << m << " " << i << " off " << off << " slant " << slant);
                CHECK_MESSAGE(cosine > 1 - 1e3 * error, n << " " << m << " " << i << " cosine " << cosine);
                ++compared;
            }
        }
    }
    CHECK(compared > 1000);
    CHECK(grazed < 4);
}

}  // namespace

TEST_CASE("blobs: rays cross them where the referee says") {
    compare_blobs<double>(1e-12);
    compare_blobs<float>(1e-5);
    compare_blobs<long double>(1e-12);
}

TEST_CASE("blobs: rays that start on a surface do not meet it there again, and meet what is ahead") {
    Dice dice{3};
    int far = 0, near = 0, tried = 0;
    for (int n = 0; n < 100; ++n) {
        const Blob body = random_blob(dice);
        const PlacedBlob<float> placed(body);
        for (int m = 0; m < 10; ++m) {
            const Ray<float> ray = random_ray<float>(dice, body, m);
            const std::vector<float> found = placed.crossings(ray);
            CHECK(found.size() % 2 == 0);
            if (found.empty()) continue;
            CHECK(placed.crossings(ray, 1).at(0) == found[0]);
            ++tried;
            const auto point = placed.at(ray, found[0]);
            const std::vector<float> ahead = placed.crossings({point.position, ray.direction, 0.F});
            near += ahead.size() != found.size() - 1;
            for (std::size_t i = 0; i + 1 < found.size() && i < ahead.size(); ++i)
                far += std::fabs(ahead[i] - (found[i + 1] - found[0])) > 1e-3;
            near += placed.crossings({point.position, -ray.direction, 0.F}).size() % 2 != 0;
        }
    }
    CHECK(tried > 300);
    CHECK(near < 4);  // where a ray grazes the surface
    CHECK(far < 4);
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
    const PlacedBlob<double> placed(body);
    int compared = 0;
    for (int n = 0; n < 60; ++n) {
        const DVec3 from = 9. * dice.direction(), way = normalize(dice.vector(-3, 3) - from);
        const auto found = placed.crossings({Vec3<double>(from), Vec3<double>(way), -1.});
        auto wanted = referee::crossings<long double>(body, {from, way}, -1).list;
        std::ranges::sort(wanted, {}, [](const auto& own) { return own.t; });
        REQUIRE(found.size() == wanted.size());
        for (std::size_t i = 0; i < found.size(); ++i, ++compared)
            CHECK(std::fabs(static_cast<double>(found[i] - wanted[i].t)) < 1e-9);
        const DVec3 p = dice.vector(-3, 3);
        CHECK(body.contains(p) == referee::contains<long double>(body, p));
    }
    CHECK(compared > 200);
    // A ray along the plane in which the cylinder of a lump ends counts each piece once.
    const Blob line{.5, std::make_shared<const BlobData>(std::vector<Lump>{{{0, 0, 0}, {0, 0, 2}}})};
    const auto across = PlacedBlob<double>(line).crossings({Vec3<double>(-3, 0, 0), Vec3<double>(1, 0, 0), -1.});
    REQUIRE(across.size() == 2);
    CHECK(across[0] == doctest::Approx(3 - std::sqrt(1 - std::sqrt(.5))).epsilon(1e-12));
}

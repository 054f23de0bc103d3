// Prisms and lathes by themselves: crosses them with rays one by one, and tests rays that start on them.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/kinds/contours.h"
#include "scene/kinds/world_transform.h"
#include "tests/referee/dice.h"

namespace strahl {

/// A body's kernel in its own space, and its pieces.
template <class Body, class T>
struct PlacedContours {
    using Kernel = std::tuple_element_t<0, typename Body::template Kernels<T>>;
    std::vector<ContourPiece<T>> pieces;
    Kernel kernel{};

    explicit PlacedContours(const Body& body) {
        for (const auto& piece : body.data->pieces) pieces.push_back(piece.template rounded<T>());
        body.template emit<T>(WorldTransform(), [&](const Kernel& own) { kernel = own; });
    }
    /// Returns the piece of a face; of caps the first.
    ContourPiece<T> piece_of(T face) const {
        return pieces[std::min(static_cast<std::size_t>(std::max(face - Kernel::caps, T(0))), pieces.size() - 1)];
    }
    struct Place {
        T t, face;
    };
    /// Returns all crossings, the nearest first.
    std::vector<Place> crossings(const Ray<T>& ray) const {
        std::vector<Place> found;
        kernel.each_crossing(
            pieces.data(), [&](T face) { return piece_of(face); }, ray, ray.source, true,
            [&](bool, T t, T face) {
                found.push_back({t, face});
            });
        std::ranges::sort(found, {}, &Place::t);
        return found;
    }
    SurfacePoint<T> at(const Ray<T>& ray, const Place& place) const {
        return kernel.at(piece_of(place.face), ray, place.t, place.face);
    }
};

inline DVec3 point_near_body(Dice& dice) { return dice.vector(-1.2, 1.2); }

/// Checks that a ray which goes on from its first crossing of a body meets the others, and not the first again.
template <class Body>
void check_rays_that_start_on(int bodies, Body (*random_body)(Dice&)) {
    Dice dice{3};
    int far = 0, near = 0;
    for (int n = 0; n < bodies; ++n) {
        const Body body = random_body(dice);
        const PlacedContours<Body, float> placed(body);
        for (int m = 0; m < 10; ++m) {
            const DVec3 from = 5. * dice.direction();
            const Ray<float> ray{cast<float>(from), cast<float>(normalize(point_near_body(dice) - from)), -1};
            const auto found = placed.crossings(ray);
            if (found.empty()) continue;
            const Ray<float> on{placed.at(ray, found[0]).position, ray.direction, found[0].face};
            std::vector<float> ahead;
            for (const auto& place : placed.crossings(on))
                if (place.t > 0) ahead.push_back(place.t);
            near += ahead.size() != found.size() - 1;
            for (std::size_t i = 0; i + 1 < found.size() && i < ahead.size(); ++i)
                far += std::fabs(ahead[i] - (found[i + 1].t - found[0].t)) > 1e-3;
        }
    }
    CHECK(near == 0);
    CHECK(far == 0);
}

}  // namespace strahl

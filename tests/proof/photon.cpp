// Problem 2 of the SIAM 100-digit challenge (L. N. Trefethen, SIAM News 35(1), 2002): a photon between round mirrors.
// See tests/proof/photon.md.
//
//     PROOF_PHOTON=photon.rt test_proof -tc='a photon*'     the table there, and a scene that shows the photon's way
#include <array>
#include <fstream>

#include "tests/proof/trial.h"

using namespace strahl;
using namespace strahl::trial;

namespace {

constexpr int bounces = 14;
constexpr double flight = 10;
const char* const published = "0.9952629194433541608903118094267216210294669227341543498032088580729861796";

/// The photon's places and directions on its way.
template <class R>
struct Way {
    std::array<referee::Vector<R>, bounces> points;
    referee::Vector<R> end;
};

/// In exact arithmetic.
Way<R> exact_way() {
    Way<R> way;
    Vector p(R(1) / 2, R(1) / 10, 0), e(1, 0, 0);
    R left = flight;
    int last_x = 99, last_y = 99;
    for (int bounce = 0;; ++bounce) {
        R nearest = left;
        int hit_x = 99, hit_y = 99;
        for (int x = -4; x <= 4; ++x)
            for (int y = -4; y <= 4; ++y) {
                if (x == last_x && y == last_y) continue;
                const Vector o = p - Vector(x, y, 0);
                referee::roots<R>(1, dot(o, e), dot(o, o) - R(1) / 9, false, [&](R t) {
                    if (t > 0 && t < nearest) nearest = t, hit_x = x, hit_y = y;
                });
            }
        p = p + nearest * e;
        if (hit_x == 99) return way.end = p, way;
        left = left - nearest, last_x = hit_x, last_y = hit_y;
        const Vector n = 3 * (p - Vector(hit_x, hit_y, 0));
        e = unit(e - 2 * dot(e, n) * n);
        way.points[bounce] = p;
    }
}

/// A photon as the kernel follows it, in T, with its bounds.
template <class T>
struct Photon {
    Ray<T> ray{{T(.5), T(1) / 10, 0}, {1, 0, 0}, -1};
    Doubt<T> doubt{unit_error<T>, 0};
    Slack<T> slack;
    T left = flight;
    bool certain = true;

    /// Goes to the next mirror. False if the flight ends before. Which one it is, spans tell as they do for a picture;
    /// candidates, whether that is certain.
    bool bounce() {
        Candidates<T> found;
        Nearest<T> best;
        std::array<CylinderKernel<T>, 81> mirrors;
        for (int i = 0; i < 81; ++i) {
            mirrors[i] = {{T(i % 9 - 4), T(i / 9 - 4), -1}, {0, 0, 1}, T(1) / 3, 2};
            const T start = ray.source - 3 * i;
            const SpanBounds<T> span = span_bounds(mirrors[i], ray, doubt, start, slack);
            const Span<T> crossed = mirrors[i].span(ray, start);
            if (!span.maybe || span.near_high <= 0) continue;
            found.add(true, span.near_low, span.sure && span.near_low > 0 ? span.near_high : found.inf, crossed.near,
                      T(3 * i), 0);
            if (crossed.hit && crossed.near > 0 && crossed.near < best.t) best = {crossed.near, T(3 * i), 0};
        }
        if (!(best.t < left)) return false;
        const auto& mirror = mirrors[static_cast<int>(best.surface) / 3];
        const SurfacePoint<T> point = mirror.at(ray, best.t, T(0));
        const PointBounds<T> known = point_bounds(mirror, ray, doubt, best.t, point, T(0), slack);
        certain = certain && found.hits() && found.surface == best.surface && known.sure;
        left -= best.t;
        std::tie(ray, doubt) = mirrored(ray, doubt, point, known, best.surface);
        return true;
    }
};

/// Errors of a photon in T by bounce, and its bounds.
template <class T>
struct Flight {
    std::array<T, bounces> errors{}, bounds{};
    int certain = 0;
    T distance;
    explicit Flight(const Way<R>& exact) {
        Photon<T> photon;
        photon.slack.share = unit_error<T>;  // radii are rounded
        for (int i = 0; i < bounces; ++i) {
            REQUIRE(photon.bounce());
            certain += photon.certain;
            const Vec3<T>& p = photon.ray.origin;
            errors[i] = static_cast<T>(length(Vector(p.x, p.y, p.z) - exact.points[i])), bounds[i] = photon.doubt.away;
            if (photon.certain) CHECK(errors[i] <= bounds[i]);
        }
        CHECK(!photon.bounce());
        const Vec3<T> end = fma(photon.left, photon.ray.direction, photon.ray.origin);
        distance = std::sqrt(dot(end, end));
    }
};

/// A scene of the mirrors from above, with the photon's way.
void write_scene(const Way<R>& way, const char* path) {
    std::ofstream file(path);
    file << "// Made by tests/proof/photon.cpp.\n"
            "background { color <1,1,1> }\n"
            "camera { position <-.1,.5,30>  look_at <-.1,.5,0>  up <0,-1,0>  fov 3.6 }\n"
            "light { position <0,0,30>  color <0,0,0> }\n"
            "defaultmaterial { rgb <.55,.66,.80>  reflection 0  refraction 0  diffuse 0  ambient 1  specular 0 }\n";
    for (int x = -2; x <= 2; ++x)
        for (int y = -1; y <= 2; ++y)
            file << "cylinder { <" << x << "," << y << ",-.2>, <" << x << "," << y << ",0>, .3333333333 }\n";
    const auto put = [&](const Vector& p) {
        file << "<" << static_cast<double>(p.x) << "," << static_cast<double>(p.y) << ",.1>";
    };
    const char* const line = "rgb <.85,.15,.10>  reflection 0  diffuse 0  ambient 1  specular 0";
    Vector from(R(1) / 2, R(1) / 10, 0);
    for (int i = 0; i <= bounces; ++i) {
        const Vector to = i < bounces ? way.points[i] : way.end;
        file << "cylinder { ", put(from), file << ", ", put(to), file << ", .012  material { " << line << " } }\n";
        from = to;
    }
    file << "sphere { <.5,.1,.1>, .035  material { " << line << " } }\nsphere { ", put(way.end);
    file << ", .035  material { " << line << " } }\n";
}

}  // namespace

TEST_CASE("a photon between mirrors") {
    const Way<R> exact = exact_way();
    const Flight<double> narrow(exact);
    const Flight<long double> wide(exact);
    std::printf("| bounce | error in double | bound | error in long double | bound |\n|--:|--:|--:|--:|--:|\n");
    for (int i = 0; i < bounces; ++i)
        std::printf("| %d | %.1e | %.1e | %.1Le | %.1Le |\n", i + 1, narrow.errors[i], narrow.bounds[i], wide.errors[i],
                    wide.bounds[i]);
    const R distance = length(exact.end);
    std::printf("distance: %.7f in double, %.12Lf in long double, %.20Lf exact; %d and %d bounces certain\n",
                narrow.distance, wide.distance, static_cast<long double>(distance), narrow.certain, wide.certain);
    const long double truth = strtold(published, nullptr);
    CHECK(std::abs(static_cast<long double>(distance) - truth) < 1e-18L);
    CHECK(std::abs(wide.distance - truth) < 1e-10L);
    CHECK(narrow.certain >= 10);
    if (const char* const path = std::getenv("PROOF_PHOTON")) write_scene(exact, path);
}

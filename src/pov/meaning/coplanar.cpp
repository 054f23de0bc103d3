#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/matrix.hpp>
#include <span>
#include <utility>
#include <vector>

#include "pov/meaning/coincident.h"
#include "scene/overlap.h"

namespace strahl::pov {
namespace {

constexpr double nudge = 1e-9;  // relative to coordinates

/// A flat face of a box or a disc that slants: points middle + a u + b v, a and b from -1 to 1, or in the circle.
struct SlantedFace {
    std::size_t body;
    DVec3 middle, u, v, normal;  // the normal is of length 1, and turned towards the eye
    double at;                   // normal . p of its points
    bool round;
    double hole = 0;                     // a share of the radius
    std::function<void(double)> move{};  // moves it along the normal

    bool holds(const DVec3& p) const {
        const DVec3 way = p - middle;
        const double a = dot_product(way, u) / dot_product(u, u), b = dot_product(way, v) / dot_product(v, v);
        const double away = std::hypot(a, b);
        return round ? away < 1 && away > hole : std::max(std::fabs(a), std::fabs(b)) < 1;
    }
    bool beside(const SlantedFace& other) const {
        return round == other.round && length(normal - other.normal) < nudge &&
               std::fabs(at - other.at) < 1e-12 * (1 + std::fabs(at)) && reaches(other) && other.reaches(*this);
    }
    /// Is some of a rectangle around the other face in the stripes along this one's sides?
    bool reaches(const SlantedFace& other) const {
        const DVec3 way = other.middle - middle;
        const auto along = [&](const DVec3& own) {
            return std::fabs(dot_product(way, own)) <=
                   dot_product(own, own) + std::fabs(dot_product(other.u, own)) + std::fabs(dot_product(other.v, own));
        };
        return along(u) && along(v);
    }
};

/// Does a vector lead along an axis?
bool is_along_axis(const DVec3& v) { return (v.x == 0) + (v.y == 0) + (v.z == 0) == 2; }

/// Adds the faces of a body that the eye sees.
void add_faces(Primitive& body, std::size_t number, const DVec3& eye, std::vector<SlantedFace>& faces) {
    const bool slants = std::holds_alternative<Cuboid>(body.shape) && !body.transformations.empty();
    if (!slants && !std::holds_alternative<Disc>(body.shape)) return;
    const glm::dmat4 m = matrix(body.transformations);
    const auto moved = [&](const DVec3& v) { return DVec3(glm::dmat3(m) * v); };
    const auto add = [&](const DVec3& middle, const DVec3& u, const DVec3& v, bool two_sided, bool round, double hole,
                         const DVec3& outwards, const std::function<void(double)>& move) {
        SlantedFace face{number, transform_point(m, middle), moved(u), moved(v), DVec3(0), 0, round, hole};
        const DVec3 across = cross_product(face.u, face.v);
        if (!(length(across) > 0)) return;
        face.normal = normalize(across);
        const double turned = dot_product(face.normal, moved(outwards)) < 0 ? -1 : 1;
        const double seen = dot_product(face.normal, eye - face.middle) < 0 ? -1 : 1;
        if (is_along_axis(face.normal) || (!two_sided && turned != seen)) return;
        face.normal = seen * face.normal;
        face.at = dot_product(face.normal, face.middle);
        const double per = 1 / std::fabs(dot_product(face.normal, moved(outwards)));
        face.move = [=](double way) { move(turned == seen ? way * per : -way * per); };
        faces.push_back(std::move(face));
    };
    if (auto* const disc = std::get_if<Disc>(&body.shape)) {
        const DVec3 n = normalize(disc->normal);
        const DVec3 u = normalize(cross_product(std::fabs(n.x) < .5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0), n));
        add(disc->centre, disc->radius * u, disc->radius * cross_product(n, u), true, true, disc->hole / disc->radius,
            n, [disc, n](double way) { disc->centre = disc->centre + way * n; });
    }
    auto* const box = std::get_if<Cuboid>(&body.shape);
    if (!box) return;
    const DVec3 middle = .5 * (box->corner + box->opposite), half = .5 * (box->opposite - box->corner);
    for (int i = 0; i < 3; ++i)
        for (DVec3* const corner : {&box->corner, &box->opposite}) {
            DVec3 centre = middle, u(0), v(0), outwards(0);
            centre[i] = (*corner)[i], u[(i + 1) % 3] = half[(i + 1) % 3], v[(i + 2) % 3] = half[(i + 2) % 3];
            outwards[i] = (*corner)[i] < middle[i] ? -1 : 1;
            add(centre, u, v, false, false, 0, outwards,
                [corner, i, outwards](double way) { (*corner)[i] += way * outwards[i]; });
        }
}

/// Returns where the way from the eye to a point enters a box, as a share of its length.
double entry(const Box& box, const DVec3& eye, const DVec3& point) {
    double enters = -HUGE_VAL;
    for (int i = 0; i < 3; ++i)
        if (point[i] != eye[i])
            enters = std::max(enters, ((point[i] > eye[i] ? box.low[i] : box.high[i]) - eye[i]) / (point[i] - eye[i]));
    return enters;
}

/// Returns how many rays from the eye to points of both faces POV-Ray sees meet the first of them, less those that meet
/// the second: the one of the body whose box the ray enters first.
int lead_of(const SlantedFace& a, const SlantedFace& b, const Box& box_a, const Box& box_b, const DVec3& eye) {
    constexpr int steps = 24;
    constexpr double certain = 1e-6;
    int lead = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const DVec3 p = a.middle + ((2 * i + 1.) / steps - 1) * a.u + ((2 * k + 1.) / steps - 1) * a.v;
            if (!a.holds(p) || !b.holds(p)) continue;
            const double behind = entry(box_b, eye, p) - entry(box_a, eye, p);
            lead += (behind > certain) - (behind < -certain);
        }
    return lead;
}

}  // namespace

std::vector<SettledPair> settle_slanted_faces(Scene& scene) {
    constexpr std::size_t most = 100'000;  // pairs that are looked at
    const DVec3 eye = scene.camera.position;
    std::vector<SlantedFace> faces;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) add_faces(scene.primitives[i], i, eye, faces);
    std::ranges::sort(faces, {}, &SlantedFace::at);
    const bool bounded = scene.primitives.size() + scene.lights.size() > 2;  // POV-Ray looks at fewer in their order
    std::vector<std::pair<std::size_t, std::size_t>> order;                  // numbers of faces: seen, and hidden
    std::size_t pairs = 0;
    const auto apart = [](const SlantedFace& a, const SlantedFace& b) {
        return b.at - a.at >= 1e-11 * (1 + std::fabs(a.at));
    };
    for (std::size_t first = 0, end; first < faces.size(); first = end) {
        const auto last = std::adjacent_find(faces.begin() + std::ptrdiff_t(first), faces.end(), apart);
        end = last == faces.end() ? faces.size() : static_cast<std::size_t>(last - faces.begin()) + 1;
        // The faces of a regular solid are as far from the origin as each other, and their normals differ.
        std::ranges::sort(std::span(faces).subspan(first, end - first), {}, [](const auto& f) { return f.normal.x; });
        for (std::size_t i = first; i < end; ++i)
            for (std::size_t k = i + 1; k < end && faces[k].normal.x - faces[i].normal.x < nudge; ++k) {
                const SlantedFace &a = faces[i], &b = faces[k];
                if (a.body == b.body || !a.beside(b) || ++pairs > most) continue;
                const auto box = [&](const SlantedFace& face) { return world_bounds(scene.primitives[face.body]); };
                const int lead = bounded ? lead_of(a, b, box(a), box(b), eye) : a.body < b.body ? 1 : -1;
                if (lead != 0) order.push_back(lead > 0 ? std::pair(i, k) : std::pair(k, i));
            }
    }
    // Each face is moved further than all that it hides, unless they hide each other in a circle.
    constexpr int most_moved = 100;
    std::vector<int> rank(faces.size());
    for (bool changed = true; std::exchange(changed, false);)
        for (const auto& [seen, hidden] : order)
            if (rank[seen] <= rank[hidden] && rank[hidden] < most_moved) rank[seen] = rank[hidden] + 1, changed = true;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (rank[i] > 0) faces[i].move(rank[i] * nudge * (1 + std::fabs(faces[i].at)));
    std::vector<SettledPair> settled;
    for (const auto& [seen, hidden] : order) settled.push_back({faces[seen].body, faces[hidden].body});
    return settled;
}

bool is_seen_first(const Scene& scene, const SettledPair& pair, const DVec3& p) {
    const bool bounded = scene.primitives.size() + scene.lights.size() > 2;
    const auto enters = [&](std::size_t body) {
        return entry(world_bounds(scene.primitives[body]), scene.camera.position, p);
    };
    return !bounded || enters(pair.hidden) > enters(pair.seen);
}

}  // namespace strahl::pov

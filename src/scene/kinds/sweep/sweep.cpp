#include "scene/kinds/sweep/sweep.h"

#include <algorithm>

#include "num/vec_math.h"

namespace strahl {
namespace {

/// Returns the controls of the curve that four numbers or points in a row make.
template <class V>
std::array<V, 4> controls_of(const V& a, const V& b, const V& c, const V& d, bool through) {
    if (through) return {b, b + (1. / 6) * (c - a), c - (1. / 6) * (d - b), c};
    const auto join = [](const V& p, const V& q, const V& r) { return (1. / 6) * (p + 4. * q + r); };
    return {join(a, b, c), (1. / 3) * (2. * b + c), (1. / 3) * (b + 2. * c), join(b, c, d)};
}

/// A ball around others: around the middle of the box around their centres.
struct BallAround {
    DVec3 middle{0};
    double reach = 0;

    template <class Each>
    explicit BallAround(const Each& each) {
        Box box;
        each([&](const DVec3& p, double) { box.add(p); });
        middle = box.centre();
        each([&](const DVec3& p, double radius) { reach = std::max(reach, length(p - middle) + std::fabs(radius)); });
    }
};

}  // namespace

SweepData::SweepData(std::vector<SweptBall> all) : balls(std::move(all)) {
    for (std::size_t i = 0; i + 3 < balls.size(); ++i) {
        const SweptBall &a = balls[i], &b = balls[i + 1], &c = balls[i + 2], &d = balls[i + 3];
        SweepPiece own{};
        own.centre = controls_of(a.centre, b.centre, c.centre, d.centre, balls[0].through);
        own.radius = controls_of(a.radius, b.radius, c.radius, d.radius, balls[0].through);
        for (std::size_t k = 0; k < 4; ++k) {
            const DVec3 half(std::fabs(own.radius[k]));
            box.add(own.centre[k] - half), box.add(own.centre[k] + half);
        }
        pieces.push_back(own);
    }
    if (pieces.empty()) return;
    const DVec3 size = box.size();
    centre = box.centre(), unit = std::max({size.x, size.y, size.z, 1e-300}) / 2;
    for (SweepPiece& own : pieces) {
        for (DVec3& p : own.centre) p = (p - centre) / unit;
        for (double& radius : own.radius) radius /= unit;
        const BallAround around([&](const auto& visit) {
            for (std::size_t k = 0; k < 4; ++k) visit(own.centre[k], own.radius[k]);
        });
        own.middle = around.middle, own.reach = around.reach;
    }
    for (std::size_t i = 0; i < pieces.size(); i += group) {
        const BallAround around([&](const auto& visit) {
            for (std::size_t k = i; k < std::min(i + group, pieces.size()); ++k)
                visit(pieces[k].middle, pieces[k].reach);
        });
        pieces[i].group_middle = around.middle, pieces[i].group_reach = around.reach;
    }
}

bool SweepData::contains(const DVec3& p) const {
    DeepestBall<double> ball;
    SweepKernel<double>::visit_near(pieces.data(), static_cast<int>(pieces.size()), (p - centre) / unit, 0., ball);
    return ball.depth > 0;
}

std::shared_ptr<const SweepData> SweepData::usual() {
    static const auto shared = std::make_shared<const SweepData>(std::vector<SweptBall>{
        {{-2, 0, 0}, .2}, {{-.8, 0, .3}, .2}, {{0, .4, -.3}, .3}, {{.8, 0, .3}, .1}, {{2, 0, 0}, .1}});
    return shared;
}

std::vector<Capsule> SphereSweep::capsules() const {
    constexpr double most = 64;  // chords of a piece
    std::vector<Capsule> around;
    for (const SweepPiece& piece : data->pieces) {
        // A cubic curve is no further from n chords than its second derivative over 8 n^2.
        const auto bend = [](const auto& p, const auto& size) {
            return .75 * std::max(size(p[0] - 2. * p[1] + p[2]), size(p[1] - 2. * p[2] + p[3]));
        };
        const double bent = bend(piece.centre, [](const DVec3& v) { return length(v); }) +
                            bend(piece.radius, [](double v) { return std::fabs(v); });
        const auto [thin, thick] = std::minmax({std::fabs(piece.radius[0]), std::fabs(piece.radius[3])});
        const double wanted = std::sqrt(4 * bent / std::max({thin, thick / 8, 1e-9}));
        const int chords = static_cast<int>(std::ceil(std::clamp(wanted, 1., most)));
        const auto at = [chords](const auto& p, int i) {
            const double t = double(i) / chords, s = 1 - t;
            return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
        };
        const auto place = [&](int i) { return data->centre + data->unit * at(piece.centre, i); };
        for (int i = 0; i < chords; ++i) {
            const double radius = std::max(std::fabs(at(piece.radius, i)), std::fabs(at(piece.radius, i + 1)));
            around.push_back({place(i), place(i + 1), data->unit * (radius + bent / (chords * chords))});
        }
    }
    return around;
}

const char* SphereSweep::fault() const {
    const std::vector<SweptBall>& balls = data->balls;
    if (balls.size() < 4) return "it has fewer than four balls";
    if (std::ranges::any_of(balls, [&](const SweptBall& own) { return own.through != balls[0].through; }))
        return "it has balls of both sorts";
    if (std::ranges::any_of(balls, [](const SweptBall& own) { return own.radius < 0; }))
        return "one of its radii is below 0";
    if (std::ranges::none_of(data->pieces, [](const SweepPiece& own) {
            return std::ranges::any_of(own.radius, [](double radius) { return radius != 0; });
        }))
        return "it has no thickness";
    return nullptr;
}

}  // namespace strahl

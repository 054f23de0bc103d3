#include "trace/thin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "num/vec_math.h"
#include "scene/capsule.h"

namespace strahl {
namespace {

/// A camera's way from space to pixels.
class Projection {
  public:
    explicit Projection(const View& view)
        : frame(frame_of(view.camera, static_cast<double>(view.width) / view.height)),
          eye(view.camera.position),
          half_width(view.width / 2.),
          half_height(view.height / 2.) {}

    /// To the right, down, and forward from the eye.
    DVec3 seen(const DVec3& p) const {
        const DVec3 way = p - eye;
        return {dot_product(way, frame.right), dot_product(way, frame.down), dot_product(way, frame.forward)};
    }
    double x(const DVec3& seen) const { return half_width * (1 + seen.x / (seen.z * frame.tan_x)); }
    double y(const DVec3& seen) const { return half_height * (1 + seen.y / (seen.z * frame.tan_y)); }
    /// Of balls of this radius, a bound: towards the picture's sides they appear longer.
    double reach(const DVec3& seen, double radius) const {
        const double slant = std::sqrt(1 + (seen.x * seen.x + seen.y * seen.y) / (seen.z * seen.z));
        return std::max(half_width / frame.tan_x, half_height / frame.tan_y) * slant * radius / (seen.z - radius);
    }

  private:
    const CameraFrame frame;
    const DVec3 eye;
    const double half_width, half_height;
};

constexpr double near_by = 4;  // radii; bodies nearer than so many are not thin
constexpr int most_halvings = 6;

/// Halves what is twice as far away at one end as at the other, so that `reach` fits both.
void add_strips(const Projection& projection, const View& view, const DVec3& a, const DVec3& b, double radius,
                double widest, int halvings, std::vector<Strip>& strips) {
    if (halvings > 0 && std::max(a.z, b.z) > 2 * std::min(a.z, b.z)) {
        const DVec3 middle = (a + b) / 2.;
        add_strips(projection, view, a, middle, radius, widest, halvings - 1, strips);
        add_strips(projection, view, middle, b, radius, widest, halvings - 1, strips);
        return;
    }
    const Strip strip{.x0 = projection.x(a),
                      .y0 = projection.y(a),
                      .x1 = projection.x(b),
                      .y1 = projection.y(b),
                      .reach = std::max(projection.reach(a, radius), projection.reach(b, radius)),
                      .nearest = std::min(a.z, b.z) - radius};
    const bool beside = std::max(strip.x0, strip.x1) + strip.reach < 0 || std::max(strip.y0, strip.y1) + strip.reach < 0 ||
                        std::min(strip.x0, strip.x1) - strip.reach > view.width ||
                        std::min(strip.y0, strip.y1) - strip.reach > view.height;
    if (!beside && 2 * strip.reach < widest) strips.push_back(strip);
}

}  // namespace

std::vector<Strip> thin_strips(const Scene& scene, const View& view, double widest) {
    const Projection projection(view);
    std::vector<Strip> strips;
    for (const Primitive& primitive : scene.primitives)
        for (const Capsule& capsule : capsules_of(primitive)) {
            DVec3 a = projection.seen(capsule.from), b = projection.seen(capsule.to);
            const double nearest = near_by * capsule.radius;
            if (a.z > b.z) std::swap(a, b);
            if (!(b.z > nearest)) continue;
            if (a.z < nearest) a = a + (nearest - a.z) / (b.z - a.z) * (b - a);
            add_strips(projection, view, a, b, capsule.radius, widest, most_halvings, strips);
        }
    return strips;
}

bool meets(const Strip& strip, double x, double y, double size) {
    // The square lies in a circle.
    const double middle_x = x + size / 2, middle_y = y + size / 2;
    const double dx = strip.x1 - strip.x0, dy = strip.y1 - strip.y0, squared = dx * dx + dy * dy;
    const double along = (middle_x - strip.x0) * dx + (middle_y - strip.y0) * dy;
    const double t = squared > 0 ? std::clamp(along / squared, 0., 1.) : 0.;
    const double off_x = strip.x0 + t * dx - middle_x, off_y = strip.y0 + t * dy - middle_y;
    const double reach = strip.reach + size * (std::numbers::sqrt2 / 2);
    return off_x * off_x + off_y * off_y <= reach * reach;
}

bool hides_in(const std::vector<Strip>& strips, double x, double y, double size, double furthest, double least_area) {
    return std::ranges::any_of(strips, [&](const Strip& strip) {
        const double width = 2 * strip.reach;
        if (width > size * std::numbers::sqrt2 || strip.nearest > furthest) return false;
        const double length = std::min(size, std::hypot(strip.x1 - strip.x0, strip.y1 - strip.y0)) + width;
        return width * length >= least_area && meets(strip, x, y, size);
    });
}

}  // namespace strahl

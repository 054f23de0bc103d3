#include "import/polygon.h"

#include <cmath>
#include <numeric>

#include "num/vec_math.h"

namespace strahl {
namespace {

struct Point {
    double x, y;
};

/// Twice the area; positive if a, b, c run counter-clockwise.
double area(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The polygon on the coordinate plane that it is most parallel to, running counter-clockwise. Its normal is that of
/// M. E. Newell: what the edges add up to, which a concave or slightly bent polygon has too.
std::vector<Point> flatten(std::span<const DVec3> corners) {
    DVec3 normal(0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += cross_product(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::fabs(normal[i]) > std::fabs(normal[axis])) axis = i;
    const int right = (axis + 1) % 3, up = (axis + 2) % 3;
    const double sign = normal[axis] < 0 ? -1 : 1;
    std::vector<Point> points;
    for (const DVec3& corner : corners) points.push_back({sign * corner[right], corner[up]});
    return points;
}

/// What is left of a polygon while ears are cut off (G. H. Meisters, "Polygons have ears"): numbers of its corners.
class Rest {
  public:
    explicit Rest(const std::vector<Point>& points) : points(points), corners(points.size()) {
        std::iota(corners.begin(), corners.end(), 0);
    }
    std::size_t size() const { return corners.size(); }
    CornerNumbers triangle(std::size_t i) const { return {at(i + size() - 1), at(i), at(i + 1)}; }
    double area(std::size_t i) const {
        const auto [a, b, c] = triangle(i);
        return strahl::area(points[a], points[b], points[c]);
    }
    /// Is the triangle at this corner inside the polygon, and no other corner in it?
    bool ear(std::size_t i) const {
        if (!(area(i) >= 0)) return false;
        const auto [a, b, c] = triangle(i);
        for (const std::int32_t k : corners)
            if (k != a && k != b && k != c && strahl::area(points[a], points[b], points[k]) >= 0 &&
                strahl::area(points[b], points[c], points[k]) >= 0 &&
                strahl::area(points[c], points[a], points[k]) >= 0 && !same(k, a) && !same(k, b) && !same(k, c))
                return false;
        return true;
    }
    void cut(std::size_t i) { corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i)); }

  private:
    std::int32_t at(std::size_t i) const { return corners[i % size()]; }
    /// A polygon with a hole is written with a seam, along which corners come twice.
    bool same(std::int32_t i, std::int32_t k) const { return points[i].x == points[k].x && points[i].y == points[k].y; }

    const std::vector<Point>& points;
    std::vector<std::int32_t> corners;
};

}  // namespace

Triangles triangles_of(std::span<const DVec3> corners, std::size_t most) {
    Triangles result;
    const std::vector<Point> points = flatten(corners);
    bool fan = true;
    const auto last = static_cast<std::int32_t>(points.size()) - 1;
    for (std::int32_t i = 1; i < last; ++i) {
        const double size = area(points[0], points[i], points[i + 1]);
        fan &= size >= 0;
        if (size > 0) result.list.push_back({0, i, i + 1});
    }
    if (fan) return result;
    result.list.clear();
    result.too_long = points.size() > most;
    if (result.too_long) return result;

    Rest rest(points);
    for (std::size_t i = 0, failed = 0; rest.size() > 2;) {
        const bool ear = rest.ear(i);
        if (!ear && failed++ < rest.size()) {
            i = (i + 1) % rest.size();
            continue;
        }
        result.crossing |= !ear;
        failed = 0;
        if (rest.area(i) != 0) result.list.push_back(rest.triangle(i));
        rest.cut(i);
        i = i % rest.size();
    }
    return result;
}

}  // namespace strahl

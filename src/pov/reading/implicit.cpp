// Reads bodies that are defined by functions, and makes them meshes: blobs, polynomials and isosurfaces.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "files/words.h"
#include "num/vec_math.h"
#include "pov/reading/next_value.h"
#include "pov/reading/reader.h"
#include "pov/things/implicit.h"

namespace strahl::pov {
namespace {

/// Polynomials are shown within this distance from their origin along each axis.
constexpr double reach = 20;

/// A part of a blob: a ball, or a cylinder with round ends. The matrix takes points into its own space.
struct BlobPart {
    DVec3 base, axis;
    double radius, strength;
    glm::dmat4 inverse{1};

    double field(const DVec3& point) const {
        const DVec3 p = transform_point(inverse, point) - base;
        const double squared = dot_product(axis, axis);
        const double along = squared > 0 ? std::clamp(dot_product(p, axis) / squared, 0., 1.) : 0;
        const DVec3 away = p - along * axis;
        const double share = 1 - dot_product(away, away) / (radius * radius);
        return share > 0 ? strength * share * share : 0;
    }
    void add_to(Box& box) const {
        const glm::dmat4 m = glm::inverse(inverse);
        for (int corner = 0; corner < 8; ++corner) {
            const DVec3 side(corner & 1 ? radius : -radius, corner & 2 ? radius : -radius,
                             corner & 4 ? radius : -radius);
            box.add(transform_point(m, base + side)), box.add(transform_point(m, base + axis + side));
        }
    }
};

/// The parts of a blob by the cells of a grid that they reach.
class BlobField {
  public:
    BlobField(const std::vector<BlobPart>& parts, const Box& box) : box(box), near(side * side * side) {
        for (const BlobPart& part : parts) {
            Box own;
            part.add_to(own);
            const DVec3 margin = 1e-9 * (abs(own.low) + abs(own.high));
            const std::array<int, 3> from = cell_of(own.low - margin), to = cell_of(own.high + margin);
            for (int k = from[2]; k <= to[2]; ++k)
                for (int j = from[1]; j <= to[1]; ++j)
                    for (int i = from[0]; i <= to[0]; ++i) near[number({i, j, k})].push_back(&part);
        }
    }
    /// Returns the threshold less the fields of all parts, in their order.
    double value(double threshold, const DVec3& p) const {
        for (const BlobPart* part : near[number(cell_of(p))]) threshold -= part->field(p);
        return threshold;
    }

  private:
    static constexpr int side = 16;

    std::array<int, 3> cell_of(const DVec3& p) const {
        std::array<int, 3> cell{};
        for (int i = 0; i < 3; ++i) {
            const double at = side * (p[i] - box.low[i]) / (box.high[i] - box.low[i]);
            cell[std::size_t(i)] = at > 0 ? static_cast<int>(std::min(at, side - 1.)) : 0;
        }
        return cell;
    }
    static std::size_t number(const std::array<int, 3>& cell) {
        return std::size_t((cell[2] * side + cell[1]) * side + cell[0]);
    }

    Box box;
    std::vector<std::vector<const BlobPart*>> near;
};

std::vector<double> read_coefficients(Interpreter& in, int order) {
    std::vector<double> all;
    in.expect('<');
    for (int i = (order + 1) * (order + 2) * (order + 3) / 6; i > 0; --i)
        all.push_back(in.read_number()), in.skip_comma();
    in.expect('>');
    return all;
}

}  // namespace

/// Makes an object the body that a mesh will show.
void PovReader::set_surface(ObjectThing& object, const char* name, std::function<MeshData(int cells)> make) {
    object.kind = ObjectKind::shape;
    object.shape = Mesh{std::make_shared<const MeshData>(), ""};
    object.surface = std::make_shared<const LevelSurface>(LevelSurface{std::move(make)});
    object.approximated(strahl::quoted(name) + " is a mesh of flat pieces");
}

void PovReader::read_blob(Interpreter& in, ObjectThing& object) {
    double threshold = 1;
    std::vector<BlobPart> parts;
    for (;;) {
        BlobPart part{};
        if (in.accept("threshold")) {
            threshold = in.read_number();
            in.skip_comma();
            continue;
        }
        if (in.accept("component")) {  // the old form
            part.strength = in.read_number(), part.radius = next_number(in), part.base = next_vector(in);
            in.skip_comma();
            parts.push_back(part);
            continue;
        }
        const bool cylinder = in.at("cylinder");
        if (!cylinder && !in.at("sphere")) break;
        in.skip();
        in.begin_block();
        part.base = in.read_vector();
        if (cylinder) part.axis = next_vector(in) - part.base;
        part.radius = next_number(in);
        in.skip_comma();
        in.accept("strength");
        part.strength = in.read_number();
        Steps steps;
        while (!in.at('}')) {
            if (read_step(in, steps)) continue;
            in.skip();
            if (!in.at('{')) continue;
            in.skip_block();
            object.approximated("the parts of a blob have the texture of the whole");
        }
        in.end_block();
        part.inverse = glm::inverse(matrix_of(steps));
        if (part.radius > 0) parts.push_back(part);
    }
    Box box;
    for (const BlobPart& part : parts) part.add_to(box);
    if (parts.empty()) return object.left_out("a blob without parts");
    set_surface(object, "blob", [threshold, parts, box](int cells) {
        const BlobField field(parts, box);
        const Inside inside = [&](std::span<const DVec3> points, double* values) {
            for (const DVec3& p : points) *values++ = field.value(threshold, p);
        };
        return level_surface(inside, box, cells);
    });
}

void PovReader::read_isosurface(Interpreter& in, ObjectThing& object) {
    std::shared_ptr<const FunctionThing> function;
    double threshold = 0;
    bool open = false, ball = false;
    Box box{DVec3(-1), DVec3(1)};
    for (;;) {
        if (in.at("function")) {
            function = in.read_function();
        } else if (in.accept("contained_by")) {
            in.begin_block();
            ball = in.at("sphere");
            in.skip();
            in.begin_block();
            const DVec3 first = in.read_vector();
            if (ball) {
                const DVec3 radius(std::fabs(next_number(in)));
                box = {first - radius, first + radius};
            } else {
                const DVec3 second = next_vector(in);
                box = {min(first, second), max(first, second)};
            }
            in.end_block();
            in.end_block();
        } else if (in.accept("threshold")) {
            threshold = in.read_number();
        } else if (in.accept("accuracy") || in.accept("max_gradient") || in.accept("max_trace")) {
            in.read_number();
        } else if (in.accept("evaluate")) {
            in.read_number(), next_number(in), next_number(in);
        } else if (in.accept("open")) {
            open = true;
        } else if (!in.accept("all_intersections")) {
            break;
        }
        in.skip_comma();
    }
    if (!function) return object.left_out("an isosurface without a function");
    set_surface(object, "isosurface", [function, threshold, open, ball, box](int cells) {
        const DVec3 middle = box.centre(), half = box.size() / 2.;
        const auto beyond = [&](const DVec3& p) {  // of the container
            const DVec3 off = abs(p - middle);
            return ball ? length(p - middle) - half.x
                        : std::max({off.x - half.x, off.y - half.y, off.z - half.z});
        };
        const Inside inside = [&](std::span<const DVec3> points, double* values) {
            function->evaluate_all(points, values);
            for (const DVec3& p : points) {
                const double own = *values - threshold;
                *values++ = open ? own : std::max(own, beyond(p));
            }
        };
        const DVec3 margin = (open ? 0. : .02) * box.size();
        return level_surface(inside, {box.low - margin, box.high + margin}, cells);
    });
}

/// Reads the arguments of a body that a function defines; reads nothing and returns false for all others.
bool PovReader::read_implicit(Interpreter& in, std::uint16_t code, ObjectThing& object) {
    switch (code) {
        case word("blob"):
            return read_blob(in, object), true;
        case word("isosurface"):
            return read_isosurface(in, object), true;
        case word("cubic"):
        case word("quartic"):
        case word("poly"): {
            const int order = code == word("cubic") ? 3 : code == word("quartic") ? 4 : in.read_integer();
            if (order < 2 || order > 35) in.fail("the order of a polynomial is from 2 to 35");
            in.skip_comma();
            return set_polynomial(object, order, read_coefficients(in, order)), true;
        }
        default:
            return false;
    }
}

void PovReader::set_polynomial(ObjectThing& object, int order, const std::vector<double>& coefficients) {
    set_surface(object, order == 2 ? "quadric" : "polynomial", [order, coefficients](int cells) {
        const Inside inside = [&](std::span<const DVec3> points, double* values) {
            for (const DVec3& p : points) *values++ = polynomial(order, coefficients, p);
        };
        Box region = region_of(inside, {DVec3(-reach), DVec3(reach)});
        for (int i = 0; i < 2 && !region.empty(); ++i) region = region_of(inside, region);
        if (region.empty()) region = region_of(inside, {DVec3(-2), DVec3(2)});
        return region.empty() ? MeshData() : level_surface(inside, region, cells);
    });
    object.approximated("of a polynomial the part within 20 of its origin is there");
}

}  // namespace strahl::pov

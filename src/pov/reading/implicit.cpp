// Reads blobs, and bodies that other functions define, which become meshes: polynomials, isosurfaces and parametric
// surfaces.
#include "pov/things/implicit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "files/words.h"
#include "num/vec_math.h"
#include "pov/reading/reader.h"
#include "pov/reading/values.h"
#include "pov/things/surfaces.h"

namespace strahl::pov {
namespace {

/// Polynomials are shown within this distance from their origin along each axis.
constexpr double reach = 20;

/// The body within which a surface is shown: a box, or a ball.
struct Container {
    bool ball = false;
    Box box{DVec3(-1), DVec3(1)};

    /// Returns how far a point is outside of it.
    double beyond(const DVec3& p) const {
        const DVec3 half = box.size() / 2., off = p - box.centre(), far = abs(off) - half;
        return ball ? length(off) - half.x : std::max({far.x, far.y, far.z});
    }
};

/// Reads what follows the word `contained_by`.
Container read_container(Interpreter& in) {
    Container own;
    in.begin_block();
    own.ball = in.at("sphere");
    in.take();
    in.begin_block();
    const DVec3 first = in.read_vector();
    if (own.ball) {
        const DVec3 radius(std::fabs(next_number(in)));
        own.box = {first - radius, first + radius};
    } else {
        const DVec3 second = next_vector(in);
        own.box = {min(first, second), max(first, second)};
    }
    in.end_block();
    in.end_block();
    return own;
}

std::vector<double> read_coefficients(Interpreter& in, int order) {
    std::vector<double> all;
    in.expect('<');
    for (int i = (order + 1) * (order + 2) * (order + 3) / 6; i > 0; --i)
        all.push_back(in.read_number()), in.skip_comma();
    in.expect('>');
    return all;
}

/// Makes an object of the fourth degree a torus or a superellipsoid if it is one whose axes are those of space, and
/// whose first coefficient is above 0; returns false if it is not.
bool set_quartic(ObjectThing& object, const std::vector<double>& coefficients) {
    // The places of x^4, y^4 and z^4, of their roots x^2, y^2 and z^2, and of the products y^2 z^2 and so on.
    constexpr std::size_t fourth[]{0, 20, 30}, second[]{9, 25, 32}, product[]{23, 7, 4}, constant = 34;
    std::vector<double> c = coefficients, rest = coefficients;
    for (double& own : c) own /= coefficients[0];
    for (int i = 0; i < 3; ++i) rest[fourth[i]] = rest[second[i]] = rest[product[i]] = rest[constant] = 0;
    if (!(coefficients[0] > 0) || std::ranges::any_of(rest, [](double own) { return own != 0; })) return false;
    const auto are = [&](const std::size_t(&places)[3], double value) {
        return std::ranges::all_of(places, [&](std::size_t i) { return c[i] == value; });
    };
    object.kind = ObjectKind::shape;
    if (are(second, 0) && are(product, 0) && c[fourth[1]] > 0 && c[fourth[2]] > 0 && c[constant] < 0) {
        DVec3 size;
        for (int i = 0; i < 3; ++i) size[i] = std::sqrt(std::sqrt(-c[constant] / c[fourth[i]]));
        object.shape = Superellipsoid{.5, .5};
        object.steps = {Scale{size}};
        return true;
    }
    if (!are(fourth, 1) || !are(product, 2)) return false;
    for (int i = 0; i < 3; ++i) {
        // (x^2 + y^2 + z^2)^2 - 2 (R^2 + r^2) (x^2 + z^2) + 2 (R^2 - r^2) y^2 + (R^2 - r^2)^2
        const double across = c[second[(i + 1) % 3]], along = c[second[i]];
        const double major = (along - across) / 4, minor = -(along + across) / 4;
        const auto near = [&](double a, double b) { return std::fabs(a - b) < 1e-12 * major * major; };
        if (!(minor > 0 && major >= minor) || across != c[second[(i + 2) % 3]]) continue;
        if (!near(c[constant], along * along / 4)) continue;
        Torus torus{DVec3(0), DVec3(0), std::sqrt(major), std::sqrt(minor)};
        torus.axis[i] = 1;
        object.shape = torus;
        return true;
    }
    return false;
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
    Blob blob{1, {}};
    std::vector<Lump> lumps;
    std::vector<std::shared_ptr<const TextureThing>> textures;
    for (;;) {
        Lump lump;
        if (in.accept("threshold")) {
            blob.threshold = in.read_number();
            in.skip_comma();
            continue;
        }
        if (in.accept("component")) {  // the old form
            lump.strength = in.read_number(), lump.radius = next_number(in), lump.from = lump.to = next_vector(in);
            in.skip_comma();
            lumps.push_back(lump), textures.emplace_back();
            continue;
        }
        const bool cylinder = in.at("cylinder");
        if (!cylinder && !in.at("sphere")) break;
        in.take();
        in.begin_block();
        lump.from = in.read_vector();
        lump.to = cylinder ? next_vector(in) : lump.from;
        lump.radius = next_number(in);
        in.skip_comma();
        in.accept("strength");
        lump.strength = in.read_number();
        ObjectThing part;
        while (!in.at('}')) {
            if (read_object_modifier(in, part)) continue;
            in.take();
            if (in.at('{')) in.skip_block();
        }
        in.end_block();
        if (!(lump.radius > 0)) continue;
        textures.push_back(part.texture ? kept_texture(part) : nullptr);
        if (!part.steps.empty()) {
            const glm::dmat4 m = matrix_of(part.steps);
            lump.x = DVec3(m[0]), lump.y = DVec3(m[1]), lump.z = DVec3(m[2]);
            const DVec3 moved = glm::inverse(glm::dmat3(m)) * DVec3(m[3]);
            lump.from += moved, lump.to += moved;
        }
        lumps.push_back(lump);
    }
    if (std::ranges::any_of(textures, [](const auto& own) { return own != nullptr; }))
        object.lump_textures = std::make_shared<const decltype(textures)>(std::move(textures));
    blob.data = std::make_shared<const BlobData>(std::move(lumps));
    if (blob.threshold > 0 && blob.data->box.empty()) return void(object.thin = true);  // it is empty
    if (const char* const fault = blob.fault()) return object.left_out(std::string("a blob: ") + fault);
    object.kind = ObjectKind::shape, object.shape = std::move(blob);
}

void PovReader::read_isosurface(Interpreter& in, ObjectThing& object) {
    std::shared_ptr<const FunctionThing> function;
    double threshold = 0;
    bool open = false;
    Container within;
    for (;;) {
        if (in.at("function")) {
            function = in.read_function();
        } else if (in.accept("contained_by")) {
            within = read_container(in);
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
    set_surface(object, "isosurface", [function, threshold, open, within](int cells) {
        const Inside inside = [&](std::span<const DVec3> points, double* values) {
            function->evaluate_all(points, values);
            for (const DVec3& p : points) {
                const double own = *values - threshold;
                *values++ = open ? own : std::max(own, within.beyond(p));
            }
        };
        const DVec3 margin = (open ? 0. : .02) * within.box.size();
        return level_surface(inside, {within.box.low - margin, within.box.high + margin}, cells);
    });
}

void PovReader::read_parametric(Interpreter& in, ObjectThing& object) {
    std::array<std::shared_ptr<const FunctionThing>, 3> functions;
    for (auto& own : functions) {
        if (!in.at("function")) in.expected("'function'");
        own = in.read_function();
        if (own->arguments > 3 || own->results != 1) in.fail("a function of u and v expected, with one result");
        in.skip_comma();
    }
    const auto first = in.read_uv();
    in.skip_comma();
    const auto last = in.read_uv();
    Container within;
    for (;;) {
        in.skip_comma();
        if (in.accept("contained_by")) {
            within = read_container(in);
        } else if (in.accept("accuracy") || in.accept("max_gradient")) {
            in.read_number();
        } else if (in.accept("precompute")) {
            in.read_number();
            while (in.accept(',') || in.accept("x") || in.accept("y") || in.accept("z")) {
            }
        } else {
            break;
        }
    }
    set_surface(object, "parametric", [=](int cells) {
        const auto point = [&](double u, double v) {
            const double given[3]{u, v, 0};
            DVec3 p;
            for (int i = 0; i < 3; ++i) functions[std::size_t(i)]->evaluate(given, &p[i]);
            return p;
        };
        const double du = last[0] - first[0], dv = last[1] - first[1];
        constexpr double step = 1e-5;
        const auto at = [&](double a, double b) {
            const double u = first[0] + a * du, v = first[1] + b * dv;
            DVec3 p = point(u, v);
            if (within.beyond(p) > 1e-6 * length(within.box.size())) p = DVec3(NAN);
            const DVec3 normal = cross_product(point(u + step * du, v) - point(u - step * du, v),
                                               point(u, v + step * dv) - point(u, v - step * dv));
            return std::pair(p, std::isfinite(dot_product(normal, normal)) ? normal : DVec3(0));
        };
        return patch(2 * cells, at, [&](const std::array<double, 2>& own) {
            return std::array{first[0] + own[0] * du, first[1] + own[1] * dv};
        });
    });
}

/// Reads the arguments of a body that a function defines; reads nothing and returns false for all others.
bool PovReader::read_implicit(Interpreter& in, std::uint16_t code, ObjectThing& object) {
    switch (code) {
        case word("blob"):
            return read_blob(in, object), true;
        case word("isosurface"):
            return read_isosurface(in, object), true;
        case word("parametric"):
            return read_parametric(in, object), true;
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
    if (order == 4 && set_quartic(object, coefficients)) return;
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

// Reads bodies that become meshes, or other bodies.
#include "pov/things/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "files/error.h"
#include "files/words.h"
#include "num/decimal.h"
#include "num/vec_math.h"
#include "pov/reading/reader.h"
#include "pov/things/letters.h"
#include "pov/things/pictures.h"
#include "pov/things/prisms.h"

namespace strahl::pov {
namespace {

/// Takes the word of a kind of spline, if one comes.
SplineKind read_spline_kind(Interpreter& in) {
    if (in.accept("quadratic_spline")) return SplineKind::quadratic;
    if (in.accept("cubic_spline")) return SplineKind::cubic;
    if (in.accept("bezier_spline")) return SplineKind::bezier;
    in.accept("linear_spline");
    return SplineKind::linear;
}

std::vector<Point2> read_points(Interpreter& in) {
    const int count = in.read_integer();
    std::vector<Point2> points;
    for (int i = 0; i < count; ++i) in.skip_comma(), points.push_back(in.read_uv());
    in.skip_comma();
    return points;
}

void set_mesh(ObjectThing& object, std::shared_ptr<const MeshData> mesh) {
    if (mesh->triangles.empty()) return;
    object.kind = ObjectKind::shape;
    object.shape = Mesh{std::move(mesh), ""};
}
void set_mesh(ObjectThing& object, MeshData mesh) {
    set_mesh(object, std::make_shared<const MeshData>(std::move(mesh)));
}

/// Makes a lathe of contours, which is hollow up to this radius if it is open.
void set_lathe(ObjectThing& object, std::vector<Contour> contours, double inner = HUGE_VAL) {
    const auto data = std::make_shared<ContourData>(std::move(contours), true);
    data->inner = std::min(data->inner, inner);
    object.kind = ObjectKind::shape;
    object.shape = Lathe{data};
}

void set_places(ObjectThing& object, Moves moves) {
    object.places = std::make_shared<const PlaceMoves>(PlaceMoves{std::move(moves)});
}

std::shared_ptr<const ObjectThing> part_of(const ObjectThing& whole, const Shape& shape, Steps steps = {}) {
    auto part = std::make_shared<ObjectThing>();
    part->kind = ObjectKind::shape, part->place = whole.place, part->shape = shape, part->steps = std::move(steps);
    return part;
}

/// Joins lines to closed outlines.
std::vector<Outline> outlines_of(const std::vector<std::vector<Point2>>& lines) {
    std::vector<Outline> all(1);
    for (const std::vector<Point2>& line : lines) {
        Outline& own = all.back();
        own.insert(own.end(), line.begin() + (own.empty() ? 0 : 1), line.end());
        if (std::hypot(own.back()[0] - own[0][0], own.back()[1] - own[0][1]) > 1e-9) continue;
        own.pop_back();
        all.emplace_back();
    }
    std::erase_if(all, [](const auto& own) { return own.size() < 3; });
    return all;
}

/// A quadric whose axes are those of space, as a ball, a cylinder or a cone; false if it is none of these.
bool set_quadric(ObjectThing& object, const DVec3& squares, const DVec3& products, const DVec3& linear,
                 double constant) {
    if (products != DVec3(0)) return false;
    DVec3 centre(0), a = squares;
    double rest = constant;
    int flat = -1, positive = 0, negative = -1;
    for (int i = 0; i < 3; ++i) {
        if (a[i] == 0) {
            if (flat >= 0 || linear[i] != 0) return false;
            flat = i;
            continue;
        }
        centre[i] = -linear[i] / (2 * a[i]);
        rest -= linear[i] * linear[i] / (4 * a[i]);
        a[i] > 0 ? void(++positive) : void(negative = i);
    }
    if (flat < 0 && positive == 3 && rest < 0) {
        object.shape = Sphere{DVec3(0), 1};
        object.steps = {Scale{{std::sqrt(-rest / a.x), std::sqrt(-rest / a.y), std::sqrt(-rest / a.z)}}};
    } else if (flat >= 0 && positive == 2 && rest < 0) {
        DVec3 end(0), factors(1);
        end[flat] = endless;
        for (int i = 0; i < 3; ++i)
            if (i != flat) factors[i] = std::sqrt(-rest / a[i]);
        object.shape = Cylinder{-end, end, 1};
        object.steps = {Scale{factors}};
    } else if (flat < 0 && positive == 2 && std::fabs(rest) < 1e-12) {
        DVec3 end(0), factors(1);
        end[negative] = endless;
        for (int i = 0; i < 3; ++i)
            if (i != negative) factors[i] = std::sqrt(-a[negative] / a[i]);
        object.kind = ObjectKind::merge;
        for (const double side : {-1., 1.})
            object.parts.push_back(part_of(object, Cone{DVec3(0), 0, side * end, endless}));
        object.steps = {Scale{factors}, Translate{centre}};
        return true;
    } else {
        return false;
    }
    object.kind = ObjectKind::shape;
    if (centre != DVec3(0)) object.steps.push_back(Translate{centre});
    return true;
}

/// A paraboloid or hyperboloid whose axis is one of those of space, and that is solid around it, as a lathe that is
/// scaled; false if it is none.
bool set_turned_quadric(ObjectThing& object, const DVec3& squares, const DVec3& linear, double constant) {
    for (int k = 0; k < 3; ++k) {
        DVec3 centre(0), factors(1);
        double rest = constant;
        bool round = squares[k] < 0 || (squares[k] == 0 && linear[k] != 0);
        for (const int i : {(k + 1) % 3, (k + 2) % 3}) {
            round &= squares[i] > 0;
            centre[i] = -linear[i] / (2 * squares[i]), rest += linear[i] * centre[i] / 2;
            factors[i] = 1 / std::sqrt(squares[i]);
        }
        if (!round) continue;
        set_lathe(object, contours_of_quadric(-squares[k], -linear[k], -rest));
        object.steps = {Scale{factors}, Translate{centre}};
        if (k != 1) object.steps.insert(object.steps.begin(), Rotate{k == 0 ? DVec3(0, 0, -90) : DVec3(90, 0, 0)});
        return true;
    }
    return false;
}

void check_size(const std::array<int, 2>& size) {
    constexpr int most = 2048;
    if (std::ranges::min(size) < 2 || std::ranges::max(size) > most)
        throw FileError("it has too few pixels, or too many");
}

/// Returns the bytes of a colour.
std::array<int, 3> codes_of(const float* color) {
    std::array<int, 3> codes{};
    for (std::size_t c = 0; c < 3; ++c) codes[c] = static_cast<int>(std::lround(std::clamp(color[c], 0.f, 1.f) * 255));
    return codes;
}

/// Returns the heights that a picture's pixels mean, from its lowest row on: the numbers of their colours in 256ths, or
/// else their brightness, or red and green as the high and the low byte. Brightness, red and green are decoded by a
/// gamma if the scene gives one.
std::vector<double> heights_of(const FilePixels& pixels, std::optional<double> gamma) {
    check_size({pixels.width, pixels.height});
    const auto light = [&](float value) { return gamma ? decoded(decimal(value), *gamma) : decimal(value); };
    const auto height_of = [&](const float* own) {
        const std::array<int, 3> color = codes_of(own);
        if (!pixels.palette.empty())
            return double(std::ranges::find(pixels.palette, color) - pixels.palette.begin()) / 256;
        if (own[0] == own[1] && own[0] == own[2]) return light(own[0]) * 65535 / 65536;
        if (pixels.more_bits)
            return (.297 * light(own[0]) + .589 * light(own[1]) + .114 * light(own[2])) * 65535 / 65536;
        return (light(own[0]) * 255 * 256 + light(own[1]) * 255) / 65536;
    };
    std::vector<double> heights;
    for (int j = pixels.height; j-- > 0;)
        for (int i = 0; i < pixels.width; ++i)
            heights.push_back(
                height_of(&pixels.values[3 * (std::size_t(j) * std::size_t(pixels.width) + std::size_t(i))]));
    return heights;
}

/// Returns the heights that a function gives over x and y from 0 to 1, where y = 1 is the lowest row. As in POV-Ray,
/// values outside of 0 to 1 are repeated there, and heights are whole 65536ths.
std::vector<double> heights_of(const FunctionThing& function, const std::array<int, 2>& size) {
    check_size(size);
    std::vector<double> heights;
    for (int j = size[1]; j-- > 0;)
        for (int i = 0; i < size[0]; ++i) {
            const double given[3]{i / (size[0] - 1.), j / (size[1] - 1.), 0};
            double result[5]{};
            function.evaluate(given, result);
            double value = function.results == 1 ? result[0] : .297 * result[0] + .589 * result[1] + .114 * result[2];
            if (!(value >= 0 && value <= 1)) value -= value > 1 ? std::ceil(value) - 1 : std::floor(value);
            heights.push_back(std::isfinite(value) ? std::trunc(65535 * value) / 65536 : 0);
        }
    return heights;
}

}  // namespace

/// Reads a body of these sorts after its '{'; reads nothing and returns false for others.
bool PovReader::read_surface(Interpreter& in, std::uint16_t code, ObjectThing& object) {
    const std::string mesh = "' is a mesh of flat pieces";
    switch (code) {
        case word("lathe"): {
            const SplineKind kind = read_spline_kind(in);
            const std::vector<Point2> points = read_points(in);
            // POV-Ray takes Bezier's control points for points of the curve.
            const bool controls = kind == SplineKind::bezier && !points.empty();
            set_lathe(object, contours_of(kind, points, true), controls ? std::ranges::min(points)[0] : HUGE_VAL);
            set_places(object, places_of_lathe(kind, points));
            return true;
        }
        case word("sor"): {
            const std::vector<Point2> points = read_points(in);
            set_lathe(object, {contour_of_sor(points, in.accept("open"))}, 0);
            set_places(object, places_of_sor(points));
            return true;
        }
        case word("ovus"): {
            const double bottom = in.read_number();
            in.skip_comma();
            const double top = in.read_number();
            if (bottom < 0 || top < 0) in.fail("a radius of an ovus is below 0");
            set_lathe(object, {contour_of_ovus(bottom, top)});
            const DVec3 middle(0, top / 2, 0);
            set_places(object, {glm::inverse(matrix_of(Steps{Translate{middle}})),
                                Warp(RoundWarp{.shape = RoundWarp::Shape::ball})});
            return true;
        }
        case word("prism"): {
            SplineKind kind = SplineKind::linear;
            bool conic = false;
            for (;;) {
                if (in.accept("conic_sweep"))
                    conic = true;
                else if (in.at("linear_spline") || in.at("quadratic_spline") || in.at("cubic_spline") ||
                         in.at("bezier_spline"))
                    kind = read_spline_kind(in);
                else if (!in.accept("linear_sweep"))
                    break;
            }
            double low = in.read_number();
            in.skip_comma();
            double high = in.read_number();
            in.skip_comma();
            if (low > high) std::swap(low, high);
            const std::vector<Point2> points = read_points(in);
            const bool open = in.accept("open");
            if (!conic && !open) {
                std::vector<Contour> contours = contours_of(kind, points);
                // The body is turned up: y becomes z, and z becomes -y.
                const auto turn = [](Point2& p) { p[1] = -p[1]; };
                for (Contour& own : contours) {
                    turn(own.start);
                    for (auto& [control, end, second] : own.strokes) {
                        turn(control), turn(end);
                        if (second) turn(*second);
                    }
                }
                object.kind = ObjectKind::shape;
                object.shape = Prism{low, high, std::make_shared<const ContourData>(std::move(contours))};
                object.steps = {Rotate{{-90, 0, 0}}};
                object.turned_surface = kind != SplineKind::bezier;
                return true;
            }
            std::vector<Outline> outlines;
            if (kind == SplineKind::linear) {
                Outline own;
                for (const Point2& p : points) {
                    if (own.size() > 2 && p == own[0])
                        outlines.push_back(std::exchange(own, {}));
                    else
                        own.push_back(p);
                }
                if (own.size() > 2) outlines.push_back(own);
            } else {
                outlines = outlines_of(lines_of(kind, points));
                object.approximated("'prism" + mesh);
            }
            set_mesh(
                object,
                swept(std::move(outlines),
                      {.low = low, .high = high, .conic = conic, .caps = !open, .smooth = kind != SplineKind::linear}));
            return true;
        }
        case word("superellipsoid"): {
            const Point2 exponents = in.read_uv();
            const Superellipsoid exact{exponents[0], exponents[1]};
            if (!exact.fault()) {
                object.kind = ObjectKind::shape, object.shape = exact;
                return true;
            }
            std::shared_ptr<const LevelSurface>& known = superellipsoids[exponents];
            set_surface(object, "superellipsoid",
                        [exponents](int cells) { return superellipsoid(exponents[0], exponents[1], cells); });
            if (known) object.surface = known;
            known = object.surface;
            return true;
        }
        case word("bicubic_patch"): {
            BicubicPatch patch;
            if (in.at_expression() && !in.at('<')) {  // an old form, whose flatness only types 2 and 3 give
                const int type = in.read_integer();
                in.skip_comma();
                patch.flatness = .1;
                if (type == 2 || type == 3) patch.flatness = in.read_number(), in.skip_comma();
                for (int& own : patch.steps) own = in.read_integer(), in.skip_comma();
            }
            for (;;) {
                if (in.accept("type") || in.accept("accuracy"))
                    in.read_number();
                else if (in.accept("flatness"))
                    patch.flatness = in.read_number();
                else if (in.accept("u_steps"))
                    patch.steps[0] = in.read_integer();
                else if (in.accept("v_steps"))
                    patch.steps[1] = in.read_integer();
                else if (in.accept("uv_vectors"))
                    for (MeshData::Place& place : patch.places) place = in.read_uv(), in.skip_comma();
                else
                    break;
                in.skip_comma();
            }
            for (DVec3& p : patch.points) in.skip_comma(), p = in.read_vector();
            std::optional<MeshData> made = patch.mesh();
            if (!made) in.fail("a bicubic_patch is divided into more than a million triangles: its steps are too many");
            in.count_bytes(made->triangles.size() * bytes_of_triangle, in.last_place());
            set_mesh(object, std::move(*made));
            object.patch = std::make_shared<const BicubicPatch>(patch);
            object.turned_surface = true;
            return true;
        }
        case word("quadric"): {
            const DVec3 squares = in.read_vector();
            in.skip_comma();
            const DVec3 products = in.read_vector();
            in.skip_comma();
            const DVec3 linear = in.read_vector();
            in.skip_comma();
            const double number = in.read_number();
            if (set_quadric(object, squares, products, linear, number)) return true;
            if (products == DVec3(0) && set_turned_quadric(object, squares, linear, number)) return true;
            set_polynomial(object, 2,
                           {squares.x, products.x, products.y, linear.x, squares.y, products.z, linear.y, squares.z,
                            linear.z, number});
            return true;
        }
        case word("sphere_sweep"): {
            const bool through = in.accept("cubic_spline"), linear = !through && !in.accept("b_spline");
            if (linear) in.accept("linear_spline");
            in.skip_comma();
            const int count = in.read_integer();
            std::vector<SweptBall> balls;
            for (int i = 0; i < count; ++i) {
                in.skip_comma();
                const DVec3 centre = in.read_vector();
                in.skip_comma();
                balls.push_back({centre, in.read_number(), through});
            }
            if (in.accept("tolerance")) in.read_number();
            if (!linear) {
                const SphereSweep sweep{std::make_shared<const SweepData>(std::move(balls))};
                if (const char* const fault = sweep.fault())
                    object.left_out(std::string("a sphere_sweep: ") + fault);
                else
                    object.kind = ObjectKind::shape, object.shape = sweep;
                return true;
            }
            object.kind = ObjectKind::merge;
            for (std::size_t i = 0; i < balls.size(); ++i) {
                const DVec3& centre = balls[i].centre;
                const double radius = balls[i].radius;
                if (radius > 0) object.parts.push_back(part_of(object, Sphere{centre, radius}));
                if (i == 0) continue;
                const DVec3& before = balls[i - 1].centre;
                const double first = balls[i - 1].radius, away = length(centre - before),
                             sine = (first - radius) / away;
                if (!(std::fabs(sine) < 1) || std::max(first, radius) == 0) continue;
                // The cone touches both balls where its sides are at right angles to their radii.
                const double cosine = std::sqrt(1 - sine * sine);
                const DVec3 axis = (centre - before) / away;
                object.parts.push_back(part_of(object, Cone{before + first * sine * axis, first * cosine,
                                                            centre + radius * sine * axis, radius * cosine}));
            }
            return true;
        }
        case word("julia_fractal"): {
            JuliaFractal own;
            const auto read_four = [&](DVec3& three, double& fourth) {
                const Components all = in.read_components();
                const auto at = [&](std::size_t i) { return all.value[all.count == 1 ? 0 : i]; };
                three = {at(0), at(1), at(2)}, fourth = at(3);
            };
            read_four(own.constant, own.fourth);
            for (;;) {
                if (in.accept("max_iteration")) {
                    own.iterations = std::max(std::floor(in.read_number()), 1.);
                } else if (in.accept("precision")) {
                    own.precision = std::max(in.read_number(), 1.);
                } else if (in.accept("slice")) {
                    read_four(own.slice, own.slice_fourth);
                    in.skip_comma();
                    own.distance = in.read_number();
                } else if (in.accept("pwr")) {
                    own.step = JuliaStep::power;
                    in.expect('(');
                    own.exponent = in.read_number();
                    in.skip_comma();
                    own.imaginary = in.read_number();
                    in.expect(')');
                } else {
                    const std::string name = name_of_code(in.code());  // in quotes
                    if (name.size() < 2 || !own.take_word(name.substr(1, name.size() - 2))) break;
                    in.take();
                }
            }
            if (const char* const fault = own.fault()) {
                object.left_out(std::string("a julia_fractal: ") + fault);
                return true;
            }
            object.kind = ObjectKind::shape, object.shape = own;
            if (own.step > JuliaStep::reciprocal)
                object.approximated(
                    "the light on a 'julia_fractal' by a function, whose normals POV-Ray makes of what "
                    "the last point left");
            return true;
        }
        case word("height_field"):
            read_height_field(in, object);
            return true;
        case word("text"):
            read_text_body(in, object);
            return true;
        default:
            return false;
    }
}

/// Reads text { ttf "font" "line" depth, offset }: its letters stand in the plane of x and y, and are deep in z.
void PovReader::read_text_body(Interpreter& in, ObjectThing& object) {
    static constexpr const char* internal_fonts[]{"timrom.ttf", "cyrvetic.ttf", "crystal.ttf", "povlogo.ttf"};
    std::string font;
    if (in.accept("internal")) {
        font = internal_fonts[std::clamp(in.read_integer(), 1, 4) - 1];
        in.skip_comma();
    } else {
        in.accept("ttf");
        font = in.read_file_name();
        in.skip_comma();
    }
    const std::string line = in.read_string();
    in.skip_comma();
    const double depth = in.read_number();
    in.skip_comma();
    DVec3 offset = in.read_vector();
    offset.z = 0;  // POV-Ray moves letters right and up alone
    std::string path = in.find_file(font, {".ttf", ".TTF"}, false);
    if (path.empty()) {
        path = in.find_file(internal_fonts[0], {}, false);
        if (path.empty())
            return object.left_out("a text: cannot find its font " + strahl::quoted(font) +
                                   "; on Debian: apt install povray-includes");
        object.approximated("letters of timrom.ttf are in place of those of " + strahl::quoted(font) +
                            ", which is not there");
    }
    try {
        object.kind = ObjectKind::unite;
        for (int i = 0; const Letter& letter : letters_of(path, line, utf8)) {
            const Steps moved{Translate{DVec3(letter.x, 0, 0) + double(i++) * offset}};
            const Prism prism{0, depth, letter.contours};
            if (!prism.fault()) object.parts.push_back(part_of(object, prism, moved));
        }
        object.steps = {Rotate{DVec3(.001)}};  // as POV-Ray turns it, so that rays hardly meet its edges
    } catch (const FileError& error) {
        object.left_out(std::string("a text: ") + error.what());
    }
}

void PovReader::read_height_field(Interpreter& in, ObjectThing& object) {
    std::string path;
    std::shared_ptr<const FunctionThing> function;
    std::array<int, 2> size{};
    double water = 0;
    std::optional<double> gamma;
    bool smooth = false;
    for (;;) {
        if (in.at_string())
            path = in.find_file(in.read_file_name());
        else if (in.accept("water_level"))
            water = in.read_number();
        else if (in.accept("smooth"))
            smooth = in.read_flag();
        else if (in.at("function"))
            function = in.read_function(&size);
        else if (in.accept("gamma"))
            gamma = in.accept("srgb") ? 0 : in.read_number();
        else if (in.accept("premultiplied"))
            in.read_flag();
        else if (in.at("gif") || in.at("tga") || in.at("pot") || in.at("png") || in.at("pgm") || in.at("ppm") ||
                 in.at("jpeg") || in.at("tiff") || in.at("sys") || in.at("bmp") || in.at("exr") || in.at("hdr"))
            in.take();
        else
            break;
    }
    try {
        std::vector<double> heights;
        if (function) {
            heights = heights_of(*function, size);
        } else {
            if (path.empty() || !pictures.read_pixels) throw FileError("it has no picture");
            auto file = std::make_shared<const FilePixels>(pictures.read_pixels(path));
            if (file->grey_png) {
                ImageThing image;
                image.pixels = std::move(file), image.encoding = gamma, image.working = 1;
                file = grey_values_of(image), gamma.reset();
            }
            const FilePixels& pixels = *file;
            size = {pixels.width, pixels.height};
            heights = heights_of(pixels, gamma);
            const auto twice = [&](const auto& color) { return std::ranges::count(pixels.palette, color) > 1; };
            if (std::ranges::any_of(pixels.palette, twice))
                object.approximated("of equal colours in the palette of a height_field's picture each is the first");
        }
        set_mesh(object, height_field(size[0], size[1], heights, water, smooth));
        if (smooth) object.approximated("normals of a smooth height_field bend between three corners, not four");
    } catch (const FileError& error) {
        object.left_out(std::string("a height_field: ") + error.what());
    }
}

}  // namespace strahl::pov

// Makes primitives of POV-Ray's bodies.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <unordered_map>

#include "num/vec_math.h"
#include "pov/meaning/mesh_planes.h"
#include "pov/meaning/open_mesh.h"
#include "pov/meaning/scene_maker.h"
#include "pov/things/prisms.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "text/reading/parameter.h"

namespace strahl::pov {
namespace {

void turn(DVec3& v) { v.z = -v.z; }
struct Mirroring {
    void operator()(Sphere& own) const { turn(own.centre); }
    void operator()(Plane& own) const { turn(own.a), turn(own.b), turn(own.c), std::swap(own.b, own.c); }
    void operator()(Cylinder& own) const { turn(own.base), turn(own.cap); }
    void operator()(Cone& own) const { turn(own.base), turn(own.cap); }
    void operator()(Cuboid& own) const { turn(own.corner), turn(own.opposite); }
    void operator()(Disc& own) const { turn(own.centre), turn(own.normal); }
    void operator()(Torus& own) const { turn(own.centre), turn(own.axis); }
    void operator()(Prism& own) const { own.base = -own.base, own.top = -own.top, own.caps = -own.caps; }
    void operator()(Triangle& own) const { turn(own.a), turn(own.b), turn(own.c); }
    void operator()(SmoothTriangle& own) const {
        for (DVec3* const v : {&own.a, &own.b, &own.c, &own.normal_a, &own.normal_b, &own.normal_c}) turn(*v);
    }
    void operator()(Mesh& own) const {
        auto data = std::make_shared<MeshData>(*own.data);
        std::ranges::for_each(data->points, turn);
        std::ranges::for_each(data->normals, turn);
        own.data = std::move(data);
    }
    void operator()(Blob& own) const {
        std::vector<Lump> lumps = own.data->lumps;
        for (Lump& lump : lumps) {
            for (DVec3* const v : {&lump.from, &lump.to, &lump.x, &lump.y, &lump.z}) turn(*v);
            lump.z = -lump.z;
        }
        own.data = std::make_shared<const BlobData>(std::move(lumps));
    }
    void operator()(SphereSweep& own) const {
        std::vector<SweptBall> balls = own.data->balls;
        for (SweptBall& ball : balls) turn(ball.centre);
        own.data = std::make_shared<const SweepData>(std::move(balls));
    }
    template <class Kind>
    void operator()(Kind&) const {}
};

/// Returns a simple body mirrored in z.
Shape mirrored_shape(Shape shape) {
    std::visit(Mirroring(), shape);
    return shape;
}

/// A body that is moved as a whole needs no transformation if its arguments can say so, and a prism that was turned up
/// and down again stays as it is. Returns the steps that were taken away.
Steps fold_matrix(Shape& shape, Steps& steps) {
    const auto take = [&](std::ptrdiff_t count) {
        const Steps taken(steps.begin(), steps.begin() + count);
        steps.erase(steps.begin(), steps.begin() + count);
        return taken;
    };
    const auto turns = [&](std::size_t i, double degrees) {
        const auto* const rotate = i < steps.size() ? std::get_if<Rotate>(&steps[i]) : nullptr;
        return rotate && rotate->degrees == DVec3(degrees, 0, 0);
    };
    if (std::holds_alternative<Prism>(shape) && turns(0, -90) && turns(1, 90)) return take(2);
    auto* const torus = std::get_if<Torus>(&shape);
    const auto* const step = steps.empty() ? nullptr : std::get_if<MatrixStep>(&steps[0]);
    if (!torus || !step) return {};
    const glm::dmat3 m(step->m()), squares = glm::transpose(m) * m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (std::fabs(squares[i][j] - (i == j)) > 1e-14) return {};
    torus->centre = transform_point(step->m(), torus->centre), torus->axis = m * torus->axis;
    return take(1);
}

/// Moves a smooth triangle to where its last uneven scaling puts it: as in POV-Ray its normals have length 1 from then
/// on, not from its own space on. Returns the steps that were taken away, of which some are among those `after` it.
Steps fold_scalings(SmoothTriangle& own, Steps& steps, const Steps& after) {
    Steps all = steps;
    append(all, after);
    const auto is_uneven = [](const Step& step) {
        const auto* const scale = std::get_if<Scale>(&step);
        const DVec3 squares = scale ? scale->by * scale->by : DVec3(1);
        return squares != DVec3(squares.x);
    };
    const auto end = std::find_if(all.rbegin(), all.rend(), is_uneven).base();
    const Steps taken(all.begin(), end);
    if (taken.empty()) return taken;
    const glm::dmat4 m = matrix_of(taken);
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(m)));
    for (DVec3* const point : {&own.a, &own.b, &own.c}) *point = transform_point(m, *point);
    for (DVec3* const normal : {&own.normal_a, &own.normal_b, &own.normal_c}) *normal = turn * *normal;
    if (taken.size() <= steps.size()) {
        steps.erase(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(taken.size()));
    } else {
        steps.assign(end, all.end());
        append(steps, inverse(after));
    }
    return taken;
}

/// Why scene text could not hold the body, or null.
const char* fault_of(const Shape& shape) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> const char* {
            bool fits = true;
            const auto check = [&](const auto& field) {
                const auto range = argument_range(field.range);
                if constexpr (std::is_same_v<std::remove_cvref_t<decltype(kind.*field.member)>, double>)
                    fits &= range.contains(kind.*field.member);
                else
                    for (int i = 0; i < 3; ++i) fits &= range.contains((kind.*field.member)[i]);
            };
            std::apply([&](const auto&... field) { (check(field), ...); }, Kind::fields);
            return fits ? kind.fault() : "a number of it is out of range";
        },
        shape);
}

template <class Kind>
Shape composite(std::vector<Primitive> parts) {
    Kind kind;
    kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
    return kind;
}

/// Makes the body that all solid bodies share, without the hollow ones; or the union of these if there are none.
Shape share_of(std::vector<Primitive> solid, std::vector<Primitive> hollow) {
    if (solid.empty()) return composite<Union>(std::move(hollow));
    if (hollow.empty()) return composite<Intersection>(std::move(solid));
    if (solid.size() > 1) {
        const int material = solid[0].material;
        Primitive shared{composite<Intersection>(std::move(solid)), material, {}};
        solid = {std::move(shared)};
    }
    hollow.insert(hollow.begin(), std::move(solid[0]));
    return composite<Difference>(std::move(hollow));
}

/// Returns -1 for each axis along which a box is turned over before it is moved in any other way than along the axes:
/// POV-Ray counts its faces anew then.
DVec3 turned_factors(const Steps& steps) {
    DVec3 factors(1);
    for (const Step& step : steps)
        if (const auto* const scale = std::get_if<Scale>(&step))
            for (int i = 0; i < 3; ++i) factors[i] = std::copysign(factors[i], factors[i] * scale->by[i]);
        else if (!std::holds_alternative<Translate>(step))
            break;
    return factors;
}

/// Returns the moves from a simple body's own space to its places by uv, as POV-Ray finds them; none for a flat box.
Moves moves_by_uv(const ObjectThing& object, const Steps& to_scene) {
    const auto back = [](const Steps& steps) { return glm::inverse(matrix_of(steps)); };
    switch (object.word) {
        case word("sphere"):
            return {back({Translate{std::get<Sphere>(*object.shape).centre}}),
                    Warp(RoundWarp{.shape = RoundWarp::Shape::ball})};
        case word("torus"):
            return {back({Scale{{-1, 1, 1}}}), Warp(RoundWarp{.shape = RoundWarp::Shape::torus,
                                                              .major_radius = std::get<Torus>(*object.shape).major})};
        case word("box"): {
            const auto* const box = std::get_if<Cuboid>(&*object.shape);
            if (!box) return {};
            const DVec3 half = turned_factors(to_scene) * abs(box->opposite - box->corner) / 2.;
            return {back({Scale{half}, Translate{(box->corner + box->opposite) / 2.}}), Warp(CubicWarp{})};
        }
        case word("mesh"):
        case word("mesh2"):
            return {glm::dmat4(0)};  // all places are 0
        default:
            if (object.places) return object.places->list;

            return {matrix_of(to_scene)};  // x and y of the scene
    }
}

const Primitive& first_leaf(const Primitive& primitive) {
    const Primitive* first = nullptr;
    for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) { first = first ? first : &leaf; });
    return *first;
}

/// Closes an open lathe: what lies between it and its axis is inside, but not what is nearer to the axis than all of
/// it. It has no surfaces there and where it ends, but one looks into it: it is made longer, and cylinders of the
/// material `unseen` take away its ends and its middle. Endless ones are left as they are.
void close_lathe(Primitive& body, int unseen) {
    using Point = Contour::Point;
    const ContourData& open = *std::get<Lathe>(body.shape).data;
    const auto to_axis = [](Contour own, const Point& first, const Point& last) {
        const Point from = own.start, to = own.strokes.back().end;
        if (from == to) return own;
        own.start = {0, first[1]};
        own.strokes.insert(own.strokes.begin(), {{first, first}, {from, from}});
        own.strokes.insert(own.strokes.end(), {{last, last}, {{0, last[1]}, {0, last[1]}}});
        return own;
    };
    std::vector<Contour> contours;
    for (const Contour& own : open.contours) contours.push_back(to_axis(own, own.start, own.strokes.back().end));
    const Lathe solid{std::make_shared<const ContourData>(std::move(contours), true)};
    contours.clear();
    std::vector<Primitive> parts(1);
    const double more = 1e-3 * open.unit;
    const bool ends = open.unit <= endless / 4;
    const auto lengthened = [&](const Point& end) {
        if (end[0] == 0 || !ends) return end;
        const double side = solid.contains({.999 * end[0], end[1] + 1e-6 * open.unit, 0}) ? -1 : 1;
        parts.push_back({Cylinder{{0, end[1], 0}, {0, end[1] + 2 * side * more, 0}, end[0] + more}, unseen, {}});
        return Point{end[0], end[1] + side * more};
    };
    if (open.inner > 0 && ends) {
        const double middle = open.centre[1], reach = open.half[1] + 2 * more;
        parts.push_back({Cylinder{{0, middle - reach, 0}, {0, middle + reach, 0}, open.inner}, unseen, {}});
    }
    for (const Contour& own : open.contours) {
        const Point &from = own.start, &to = own.strokes.back().end;
        contours.push_back(from == to ? own : to_axis(own, lengthened(from), lengthened(to)));
    }
    parts[0] = {Lathe{std::make_shared<const ContourData>(std::move(contours), true)}, body.material, {}};
    if (parts.size() == 1)
        body.shape = parts[0].shape;
    else
        body.shape = composite<Difference>(std::move(parts));
}

}  // namespace

/// Sets what a body takes over from those around it, but for transformations.
void SceneMaker::take_over(const ObjectThing& object, const Around& around, Looks& own) {
    const auto inside = own.texture ? own.texture->inside : nullptr;
    if (object.texture) own.texture = object.texture->texture;
    if (object.texture && inside && !own.texture->inside) {
        // Only its other side looks as those around it.
        Steps way = object.steps;
        append(way, around.to_owner);
        way = inverse(way);
        append(way, to_owner(object, around));
        auto both = std::make_shared<TextureThing>(*own.texture);
        both->inside = moved(*inside, way);
        own.texture = std::move(both);
    }
    if (object.interior) own.interior = object.interior;
    if (object.texture || object.interior) own.shared = nullptr;
    own.no_shadow |= object.no_shadow.value_or(false);
    own.no_image |= object.no_image.value_or(false);
    own.no_reflection |= object.no_reflection.value_or(false);
    own.both_sides |= object.both_sides.value_or(false);
    own.hollow |= object.hollow;
    if (object.both_sides) own.shared = nullptr;
}

/// Returns the steps from an object's own space into that of its texture.
Steps SceneMaker::to_owner(const ObjectThing& object, const Around& around) {
    if (object.texture)
        return {object.steps.begin(), object.steps.end() - static_cast<std::ptrdiff_t>(object.texture->steps.size())};
    Steps way = object.steps;
    append(way, around.to_owner);
    return way;
}

SceneMaker::Around SceneMaker::inside(const ObjectThing& object, const Around& around) {
    Around own{around,
               object.steps,
               {},
               to_owner(object, around),
               around.clips,
               around.turned != object.inverse,
               around.merges || object.inverse,
               around.turned_last};
    append(own.after, around.after);
    if (object.inverse && own.after.empty()) own.turned_last = !own.turned_last;
    own.moves = transformations_of(own.after, mirrored);
    take_over(object, around, own);
    if (object.interior || own.space == 0) own.space = ++spaces;
    if (object.global_lights) {
        if (around.group > 0)
            notes.approximated(object.place, "lights of the outer light_group do not shine on the inner one");
        own.group = ++light_groups, own.common = *object.global_lights, own.shared = nullptr;
    }
    return own;
}

int SceneMaker::number_of(Shared& shared) {
    if (!shared.number) shared.number = number_of(*shared.within, {}, [&] { return inverse(shared.within->to_owner); });
    return *shared.number;
}
/// Is what the scene takes for the outer side of a body POV-Ray's inner one? `steps` lead from its own space to that of
/// the scene.
bool SceneMaker::shows_inside(const ObjectThing& object, const Shape& shape, const Around& around,
                              const Steps& steps) const {
    const auto facing = [](const DVec3& a, const DVec3& b, const DVec3& c, const DVec3& normal) {
        return dot_product(cross_product(b - a, c - a), normal) > 0;
    };
    const bool mirrors = glm::determinant(glm::dmat3(matrix_of(steps))) < 0;
    if (std::holds_alternative<Triangle>(shape)) {
        if (!object.steps.empty())
            notes.approximated(object.place, "the inside of a triangle that is moved: its corners' order decides");
        return !mirrored;
    }
    if (const auto* const own = std::get_if<SmoothTriangle>(&shape))
        return facing(own->a, own->b, own->c, own->normal_a + own->normal_b + own->normal_c) == mirrors;
    const bool prism = std::holds_alternative<Prism>(shape);
    if ((prism && notes.in.options.as_text) || std::holds_alternative<SphereSweep>(shape))
        notes.approximated(object.place, "which sides of its faces are inside");
    // A quadric that is turned inside out gets normals on its other side, and is turned once more by its flag.
    const bool turned = around.turned != object.inverse && object.word != word("quadric");
    if (prism) return turned != object.turned_surface;
    const auto* const mesh = std::get_if<Mesh>(&shape);
    if (!mesh) return turned;
    if (object.word == word("prism") && !mesh->open())  // both caps of POV-Ray's face up
        notes.approximated(object.place, "which sides of its faces are inside");
    const bool flat_faces_back = mirrored == object.turned_surface;
    // Polygons and patches have no inside that could be turned out; a patch gets its normals where it was moved to.
    if (object.word == word("polygon")) return flat_faces_back != mirrors;
    if (object.word == word("bicubic_patch")) return !flat_faces_back;
    const MeshData& data = *mesh->data;
    std::size_t ahead = 0;
    for (std::size_t i = 0; i < data.triangles.size(); ++i) {
        const auto [a, b, c] = data.triangles[i];
        const auto at = [](const std::vector<DVec3>& list, std::int32_t n) { return list[std::size_t(n)]; };
        DVec3 normal(0, 1, 0);
        if (object.word != word("height_field")) {
            if (data.corner_normals.empty()) return (flat_faces_back != mirrors) != turned;
            for (const std::int32_t n : data.corner_normals[i]) normal = normal + at(data.normals, n);
        }
        ahead += facing(at(data.points, a), at(data.points, b), at(data.points, c), normal);
    }
    if (ahead > 0 && ahead < data.triangles.size())
        notes.approximated(object.place, "triangles whose normals are on their other side show their texture there");
    return (2 * ahead < data.triangles.size()) != (mirrors != turned);
}

/// Returns the number of a material; `way()` leads from its texture's space into that where it holds.
template <class Way>
int SceneMaker::number_of(const Looks& own, const UvMapping& uv, const Way& way) {
    const MaterialUse use{.uv = uv,
                          .shadow_only = own.no_image && own.no_reflection,
                          .no_shadow = own.no_shadow,
                          .both_sides = own.both_sides,
                          .group = own.group,
                          .common = own.common};
    // POV-Ray looks for media in hollow bodies alone.
    if (own.hollow && own.interior && own.interior->media && !use.shadow_only)
        notes.left_out(own.interior->place, "media");
    const int number = materials.number(own.texture, own.interior, use, way);
    return materials.within(number, own.space, own.hollow && !contents.fogs.empty());
}

/// Returns how a simple body finds places by uv; `mapped` says that it is a mesh with uv_vectors. Its first steps,
/// `folded`, are in its arguments.
UvMapping SceneMaker::uv_of(const ObjectThing& object, const Around& around, bool mapped, const Steps& folded) {
    UvMapping::Places found{.moves = {}, .to_scene = object.steps, .ball_centre = {}};
    append(found.to_scene, around.after);
    if (!mapped) {
        found.moves = moves_by_uv(object, found.to_scene);
        if (found.moves.empty()) return {};
        if (!folded.empty()) found.moves.insert(found.moves.begin(), matrix_of(inverse(folded)));
        if (object.word == word("sphere")) found.ball_centre = std::get<Sphere>(*object.shape).centre;
    }
    found.to_scene.erase(found.to_scene.begin(), found.to_scene.begin() + std::ptrdiff_t(folded.size()));
    return {.mesh = mapped, .found = std::make_shared<const UvMapping::Places>(std::move(found))};
}

/// Returns the number of an object's material, whose pattern is in the object's own space or, if the material is that
/// of the composites around it, in the space of the outermost of these. `folded` leads from the object's space into
/// that of the body.
int SceneMaker::material_of(const ObjectThing& object, const Around& around, bool mapped, const Steps& folded) {
    if (around.clips) return materials.nothing();
    Looks own = around;
    take_over(object, around, own);
    if (object.interior && own.space > 0) own.space = ++spaces;
    if (object.lump_textures) {
        const auto& blob = std::get<Blob>(*object.shape);
        const Steps way = inverse(to_owner(object, around));
        if (const auto mixed = materials.blended(blob, *object.lump_textures, *own.texture, way)) {
            auto both = std::make_shared<TextureThing>(*mixed);
            if (own.texture->inside) both->inside = moved(*own.texture->inside, way);
            own.texture = std::move(both);
            return number_of(own, {}, [] { return Steps(); });
        }
        notes.approximated(object.place, "the parts of a blob have the texture of the whole");
    }
    const auto way = [&] {
        Steps own = to_owner(object, around);
        const bool both =
            own.size() >= folded.size() && std::ranges::equal(folded, std::span(own).first(folded.size()));
        if (both) own.erase(own.begin(), own.begin() + std::ptrdiff_t(folded.size()));
        Steps back = inverse(own);
        if (!both) append(back, folded);
        return back;
    };
    if (materials.by_uv(own.texture)) return number_of(own, uv_of(object, around, mapped, folded), way);
    if (own.shared) return number_of(*own.shared);
    const int number = number_of(own, {.mesh = mapped, .found = nullptr}, way);
    const bool doubtful = around.shared && materials[number].patterned() && number == number_of(*around.shared);
    return doubtful ? materials.apart(number) : number;
}

/// Returns into how many cells the box around a surface is divided to make it a mesh: the fewer the more surfaces there
/// are and, of one that is used often, the smaller it looks. Each use has triangles of its own.
int SceneMaker::cells_of(const ObjectThing& object, const Around& around) {
    SurfaceUse& use = surface_uses[object.surface.get()];
    if (use.cells == 0) use.cells = surfaces_made < 8 ? 64 : surfaces_made < 64 ? 32 : 16, ++surfaces_made;
    if (use.count < 64) return use.cells;
    Steps steps = object.steps;
    append(steps, around.after);
    const Box box = Mesh{object.surface->mesh(16), ""}.bounds(matrix_of(steps));
    const DVec3 sides = box.size();
    const double area = std::max({sides.x * sides.y, sides.y * sides.z, sides.z * sides.x});
    const double size = std::sqrt(area) / length(box.centre() - axes.location);  // seen from the camera
    return std::max(size > .1 ? use.cells : size > .03 ? use.cells / 2 : use.cells / 4, 16);
}

/// Divides a patch that is turned or scaled in the world, as POV-Ray does. Its mesh is moved back from there, since the
/// objects around it move it. Returns the steps that were taken away; none if the patch stays as it is.
Steps SceneMaker::fold_into_patch(const ObjectThing& object, const Around& around, Shape& shape, Steps& steps) {
    Steps to_world = steps;
    append(to_world, around.after);
    const glm::dmat4 matrix = matrix_of(to_world);
    if (glm::dmat3(matrix) == glm::dmat3(1)) return {};
    BicubicPatch moved = *object.patch;
    for (DVec3& p : moved.points) p = transform_point(matrix, p);
    std::optional<MeshData> made = moved.mesh();
    if (!made) return {};
    in.count_bytes(made->triangles.size() * bytes_of_triangle, object.place);
    shape = Mesh{std::make_shared<const MeshData>(std::move(*made)), ""};
    steps = inverse(around.after);
    return to_world;
}

std::optional<SceneMaker::Part> SceneMaker::build(const ObjectThing& object, const Around& around) {
    if (!mirrored || !object.shape || !std::holds_alternative<JuliaFractal>(*object.shape))
        return build_turned(object, around);
    // Not all Julia sets have a mirror image among them: it is turned back in its own space.
    ObjectThing turned = object;
    turned.steps.insert(turned.steps.begin(), Scale{{1, 1, -1}});
    return build_turned(turned, around);
}
std::optional<SceneMaker::Part> SceneMaker::build_turned(const ObjectThing& object, const Around& around) {
    tell_notes(object);
    // The box around it, where rays look for it, is turned inside out; around what is taken away rays do not look for
    // one.
    if (object.negative && !around.turned)
        notes.approximated(object.place, "a sphere of a negative radius, which is not seen before it is moved");
    std::optional<Part> part;
    if (object.kind == ObjectKind::shape) {
        in.count_bytes(4 * sizeof(Primitive), object.place);  // unions of unions make many bodies of few words
        Shape shape = *object.shape;
        if (object.surface) shape = Mesh{object.surface->mesh(cells_of(object, around)), ""};
        Steps steps = object.steps;
        auto* const smooth = std::get_if<SmoothTriangle>(&shape);
        const Steps folded = object.patch ? fold_into_patch(object, around, shape, steps)
                             : smooth     ? fold_scalings(*smooth, steps, around.after)
                                          : fold_matrix(shape, steps);
        if (mirrored) {
            std::shared_ptr<const void> shared;
            if (const auto* const own = std::get_if<Mesh>(&shape)) shared = own->data;
            if (const auto* const own = std::get_if<Blob>(&shape)) shared = own->data;
            if (const auto* const own = std::get_if<SphereSweep>(&shape)) shared = own->data;
            if (!shared) {
                shape = mirrored_shape(shape);
            } else {
                const auto [known, is_new] = mirrored_shapes.try_emplace(shared);
                if (is_new) known->second = mirrored_shape(shape);
                shape = known->second;
            }
        }
        // A division by zero is very large, and boxes then reach as far as anything is seen.
        if (auto* const box = std::get_if<Cuboid>(&shape))
            for (DVec3* const corner : {&box->corner, &box->opposite})
                *corner = max(min(*corner, DVec3(largest_coordinate)), DVec3(-largest_coordinate));
        if (const char* const fault = fault_of(shape)) {
            notes.left_out(object.place, std::string("a body: ") + fault);
            return std::nullopt;
        }
        const auto* const mesh = std::get_if<Mesh>(&shape);
        const bool mapped = mesh && !mesh->data->places.empty();
        int material = material_of(object, around, mapped, folded);
        if (materials[material].has_sides()) {
            Steps to_scene = smooth ? steps : object.steps;
            append(to_scene, around.after);
            if (shows_inside(object, shape, around, to_scene)) material = materials.turned(material);
            if (auto* const prism = std::get_if<Prism>(&shape); prism && object.word == word("prism"))
                prism->caps = object.turned_surface == mirrored ? 1 : -1;
        }
        // As in POV-Ray a Julia set that is moved is no longer turned inside out.
        const bool last = around.turned_last != (object.inverse && around.after.empty());
        const bool negated = std::holds_alternative<JuliaFractal>(shape) ? around.turned != last : object.inverse;
        part = Part{{std::move(shape), material, transformations_of(steps, mirrored)}, negated};
    } else if (object.kind != ObjectKind::light && object.kind != ObjectKind::nothing) {
        part = build_parts(object, around);
    }
    if (part && !object.clips.empty()) part = clipped(object, around, std::move(*part));
    return part;
}

/// Tells what differs in a body that one looks into where it is cut.
void SceneMaker::tell_of_cuts(const Primitive& body, TextPlace place) const {
    bool clear = false, glass = false;
    for_each_leaf(body, [&](const Primitive& leaf, const glm::dmat4&) {
        const Material& own = materials[leaf.material];
        const bool is_there = own.transmits() && !shows_nothing(own);
        clear |= is_there && !own.hollow, glass |= is_there && own.ior != 1;
    });
    if (glass) notes.approximated(place, "light enters a clipped body of glass where it is clipped");
    if (clear && !contents.fogs.empty())
        notes.approximated(place, "there is no fog inside a clipped body that is clear");
}

namespace {

bool boxes_meet(const Box& a, const Box& b) {
    bool all = true;
    for (int c = 0; c < 3; ++c) all &= a.low[c] <= b.high[c] && b.low[c] <= a.high[c];
    return all;
}
/// Does POV-Ray show visibly less of a body, because rays see nothing from 1e7 on? Of one that is near the eye as well
/// it hides what is at the horizon.
bool ends_in_sight(const Primitive& body, const DVec3& eye) {
    constexpr double farthest = 1e7, near = 1e4;
    if (const auto plane = half_space(body))
        return std::fabs(dot_product(normalize(plane->normal), eye - plane->point)) >= farthest;
    const Box box = world_bounds(body);
    if (!box.finite()) return false;
    double reach = 0, outside = 0, inside = farthest;
    for (int c = 0; c < 3; ++c) {
        const double below = eye[c] - box.low[c], above = box.high[c] - eye[c];
        reach = std::max({reach, std::fabs(below), std::fabs(above)});
        outside = std::max({outside, -below, -above}), inside = std::min({inside, below, above});
    }
    return reach >= farthest && (outside >= near || inside >= near);
}
/// Do two of the boxes meet? Of very many it is taken for granted.
bool any_meet(const std::vector<Box>& boxes) {
    constexpr std::size_t most = 2000;
    bool any = boxes.size() > most;
    for (std::size_t i = 0; i < boxes.size() && !any; ++i)
        for (std::size_t k = 0; k < i; ++k) any |= boxes_meet(boxes[i], boxes[k]);
    return any;
}

}  // namespace

/// Does light go through a surface of the body? `bends`: and does what is inside it matter to the light?
bool SceneMaker::clear(const Primitive& body, bool bends) const {
    bool any = false;
    for_each_leaf(body, [&](const Primitive& leaf, const glm::dmat4&) {
        const Material& own = materials[leaf.material];
        any |= own.transmits() && (!bends || own.ior != 1 || own.fades() || !contents.fogs.empty());
    });
    return any;
}

/// Lets a union in a composite keep the surfaces inside it. Tells of them in scene text, which has none, and where the
/// union is of parts that are turned inside out.
void SceneMaker::keep_surfaces(Primitive& whole, const Around& around, bool turned, TextPlace place) const {
    auto* const own = std::get_if<Union>(&whole.shape);
    std::vector<Box> boxes;
    each_part(whole, [&](const Primitive& part) { boxes.push_back(world_bounds(part)); });
    if (!any_meet(boxes)) return;
    if (own && !turned && !in.options.as_text) {
        own->keeps = true;
        return;
    }
    Primitive seen = whole;
    seen.transformations.insert(seen.transformations.end(), around.moves.begin(), around.moves.end());
    if (clear(whole) || strahl::contains(seen, scene.camera.position))
        notes.approximated(place, "a union in a composite has no surfaces inside it");
}

/// Makes a body fit to be a part: a disc becomes the half-space behind it, and an open lathe is closed. Returns false
/// if it cannot be one.
bool SceneMaker::close(Primitive& body, TextPlace place) {
    if (const auto* const lathe = std::get_if<Lathe>(&body.shape); lathe && lathe->open()) {
        tell_of_cuts(body, place);
        close_lathe(body, materials.nothing());
    }
    if (const auto* const disc = std::get_if<Disc>(&body.shape)) {
        const DVec3 n = normalize(disc->normal);
        const DVec3 u = normalize(cross_product(std::fabs(n.x) < .5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0), n));
        const DVec3 centre = disc->centre;
        body.shape = Plane{centre, centre + u, centre + cross_product(n, u)};
    }
    return fits_composite(body.shape);
}

/// Gives an open mesh the inside that its inside_vector says, which always has the same direction in the scene.
void SceneMaker::close_mesh(const ObjectThing& object, const Around& around, bool takes_away, Primitive& body) {
    const auto* const mesh = std::get_if<Mesh>(&body.shape);
    if (!mesh || !mesh->open() || in.options.as_text) return;
    Steps steps = object.steps;
    append(steps, around.after);
    const DVec3 own = glm::inverse(glm::dmat3(matrix_of(steps))) * *object.inside_vector;
    const auto closed = closed_along(*mesh->data, mirror(own, mirrored));
    if (!closed) return;
    const int material = body.material, nothing = materials.nothing();
    std::vector<Primitive> parts{{closed->first, material, {}}, {closed->second, nothing, {}}};
    if (!takes_away) {
        // POV-Ray looks for it only where rays meet the box around it.
        const Box box = mesh->bounds(matrix(transformations_of(steps, mirrored)));
        parts.push_back({Cuboid{box.low, box.high}, nothing, transformations_of(inverse(steps), mirrored)});
        notes.approximated(object.place, "an open mesh in an intersection ends at the box around it");
    }
    body.shape = composite<Intersection>(std::move(parts));
}

/// Makes a composite of an object's parts. Bodies that are turned inside out are subtracted instead.
namespace {

/// Do boxes of Julia sets that are taken away, which POV-Ray takes for boxes around the whole body, leave out some of
/// it?
bool ends_at_fractal(const std::vector<Primitive>& solid, const std::vector<Primitive>& hollow) {
    Box body;
    for (int c = 0; c < 3; ++c) {
        constexpr double far = std::numeric_limits<double>::infinity();
        body.low[c] = -far, body.high[c] = far;
        for (const Primitive& part : solid) {
            const Box own = world_bounds(part);
            body.low[c] = std::max(body.low[c], own.low[c]), body.high[c] = std::min(body.high[c], own.high[c]);
        }
    }
    return std::ranges::any_of(hollow, [&](const Primitive& part) {
        bool fractal = false, around = true;
        for_each_leaf(part, [&](const Primitive& leaf, const glm::dmat4&) {
            fractal |= std::holds_alternative<JuliaFractal>(leaf.shape);
        });
        const Box own = world_bounds(part);
        for (int c = 0; c < 3; ++c) around &= own.low[c] <= body.low[c] && own.high[c] >= body.high[c];
        return fractal && !around;
    });
}

}  // namespace

std::optional<SceneMaker::Part> SceneMaker::build_parts(const ObjectThing& object, const Around& around) {
    Around within = inside(object, around);
    Shared own{&within, {}};
    if (!within.shared && object.parts.size() > 1) within.shared = &own;
    std::vector<Primitive> solid, hollow;
    bool first = true;
    const ObjectThing* sheet = nullptr;
    const bool unites = object.kind == ObjectKind::unite || object.kind == ObjectKind::merge;
    for (const auto& each : object.parts) {
        if (each->kind == ObjectKind::light) {
            add_light(*each, within);
            continue;
        }
        Around own_around = within;
        own_around.turned = within.turned != (object.kind == ObjectKind::subtract && !first);
        if (object.kind == ObjectKind::subtract && !first && within.after.empty())
            own_around.turned_last = !within.turned_last;
        own_around.merges = within.merges || (object.kind == ObjectKind::subtract && !first);
        std::optional<Part> part = build(*each, own_around);
        if (each->thin && !unites && object.kind == ObjectKind::intersect) return std::nullopt;
        // Notes a part without extent that is taken away: it is seen as a sheet inside a clear body, and nowhere else.
        if (each->thin && object.kind == ObjectKind::subtract && each->word != word("sphere")) sheet = each.get();
        if (part && each->inside_vector)
            close_mesh(*each, own_around, own_around.turned != within.turned, part->primitive);
        if (part && !close(part->primitive, each->place)) {
            notes.left_out(each->place, "an open body in a composite");
            part.reset();
        }
        if (!part && !unites && !(object.kind == ObjectKind::subtract && !first && each->thin)) {
            // An intersection without this part would be larger, and a difference without its first part another body.
            if (!each->thin) notes.left_out(object.place, "a body that a part is missing of");
            return std::nullopt;
        }
        const bool negated = part && part->negated != (object.kind == ObjectKind::subtract && !first);
        first = false;
        if (part) (negated ? hollow : solid).push_back(std::move(part->primitive));
    }
    if (solid.empty() && hollow.empty()) return std::nullopt;
    if (!unites && ends_at_fractal(solid, hollow))
        notes.approximated(object.place,
                           "a body that a julia_fractal is taken away of: in POV-Ray it ends at the "
                           "fractal's box");
    bool negated = object.inverse;
    if (unites) std::swap(solid, hollow);  // a union is what is not outside of all its parts
    if (unites != solid.empty()) negated = !negated;
    const auto more = transformations_of(object.steps, mirrored);
    if (object.parts.size() == 1) {
        Primitive only = std::move((solid.empty() ? hollow : solid)[0]);
        only.transformations.insert(only.transformations.end(), more.begin(), more.end());
        return Part{std::move(only), negated};
    }
    const bool turns = unites && !solid.empty();
    Primitive whole{.shape = share_of(std::move(solid), std::move(hollow)), .material = 0, .transformations = more};
    if (sheet && clear(whole)) notes.left_out(sheet->place, "a body without extent in a composite");
    if (object.kind == ObjectKind::unite && !within.merges) keep_surfaces(whole, around, turns, object.place);
    if (within.shared->number)
        whole.material = *within.shared->number;
    else  // all parts have materials of their own: the composite gets that of the first one, without its patterns
        whole.material = materials.within(materials.without_patterns(first_leaf(whole).material), within.space,
                                          within.hollow && !contents.fogs.empty());
    if (const char* const fault = fault_of(whole.shape)) {
        notes.left_out(object.place, std::string("a composite: ") + fault);
        return std::nullopt;
    }
    return Part{std::move(whole), negated};
}

/// Cuts a body off where it is outside of the bodies that clip it, whose own surfaces are not seen: through them one
/// looks into the body.
std::optional<SceneMaker::Part> SceneMaker::clipped(const ObjectThing& object, const Around& around, Part part) {
    const bool disc = std::holds_alternative<Disc>(part.primitive.shape);  // it would become the half-space behind it
    if (part.negated || disc || !close(part.primitive, object.place)) {
        notes.left_out(object.place, "clipped_by of an open body");
        return part;
    }
    const int material = part.primitive.material;
    tell_of_cuts(part.primitive, object.place);
    // The composite has the body's space, in which the patterns of its texture are.
    const std::vector<Transformation> own = std::exchange(part.primitive.transformations, {});
    const bool as_read = own == transformations_of(object.steps, mirrored);  // those of a lone part come before
    const std::vector<Transformation> back =
        as_read ? transformations_of(inverse(object.steps), mirrored)
                : transformations_of(Steps{MatrixStep(glm::inverse(matrix(own)))}, false);
    std::vector<Primitive> solid, hollow;
    solid.push_back(std::move(part.primitive));
    Around bare = around;
    bare.clips = true;
    for (const auto& clip : object.clips) {
        std::optional<Part> cut = build(*clip, bare);
        if (!cut || !close(cut->primitive, clip->place)) {
            notes.left_out(object.place, "a body that an open one clips");
            return std::nullopt;
        }
        cut->primitive.transformations.insert(cut->primitive.transformations.end(), back.begin(), back.end());
        (cut->negated ? hollow : solid).push_back(std::move(cut->primitive));
    }
    return Part{{.shape = share_of(std::move(solid), std::move(hollow)), .material = material, .transformations = own},
                false};
}

/// Gives an opaque mesh the planes of POV-Ray's meshes, if its material shows where they are.
void SceneMaker::set_single_planes(Primitive& body, TextPlace place) {
    auto* const mesh = std::get_if<Mesh>(&body.shape);
    const Material& own = materials[body.material];
    if (!mesh || !own.patterned() || own.transmits() || in.options.as_text) return;
    const auto [known, is_new] = single_planes.try_emplace(mesh->data);
    if (is_new) {
        in.count_bytes(3 * sizeof(DVec3) * mesh->data->triangles.size(), place);
        known->second = std::make_shared<const MeshData>(in_single_planes(*mesh->data));
    }
    mesh->data = known->second;
}

/// Makes a body of the space around a composite, so that rays start in it: what that leaves of a half-space whose face
/// is further away than anything is seen.
void SceneMaker::fill_around(Primitive& whole) {
    constexpr double far = 1e8;
    const int material = whole.material;
    Primitive space{Plane{{0, 0, far}, {1, 0, far}, {0, 1, far}}, materials.nothing(), {}};
    whole = {.shape = composite<Difference>({std::move(space), std::move(whole)}),
             .material = material,
             .transformations = {}};
}

void SceneMaker::push(Part part, const ObjectThing& object, const Around& around) {
    std::vector<Transformation>& own = part.primitive.transformations;
    own.insert(own.end(), around.moves.begin(), around.moves.end());
    const bool cuts = object.kind == ObjectKind::intersect || object.kind == ObjectKind::subtract;
    if (part.negated && cuts && !object.inverse && object.parts.size() > 1 && clear(part.primitive, true))
        fill_around(part.primitive);
    Looks flags = around;
    take_over(object, around, flags);
    if (object.word == word("mesh") || object.word == word("mesh2")) set_single_planes(part.primitive, object.place);
    if (in.options.as_text && ends_in_sight(part.primitive, scene.camera.position))
        notes.approximated(object.place, "a body is seen further away than 1e7");
    shown.push_back({flags.no_shadow, flags.no_image, flags.no_reflection, object.place, part.negated});
    scene.primitives.push_back(std::move(part.primitive));
}

/// Counts how often each surface will be a mesh, in the first million objects: unions of unions may hold far more.
void SceneMaker::count_surfaces(const ObjectThing& object) {
    if (++objects_counted > 1'000'000) return;
    if (object.surface) ++surface_uses[object.surface.get()].count;
    for (const auto* const inner : {&object.parts, &object.clips})
        for (const auto& each : *inner) count_surfaces(*each);
}

void SceneMaker::tell_notes(const ObjectThing& object) const {
    for (const auto& [kind, text] : object.notes) in.remark(kind, object.place, text);
    if (object.photon_target && contents.photons) in.remark(Remark::Kind::left_out, object.place, "photons");
}

namespace {

/// Returns objects that are together a union, the smallest ones.
std::vector<ObjectThing> pieces_of(const ObjectThing& object) {
    if (object.kind != ObjectKind::unite) return {object};
    std::vector<ObjectThing> all;
    for (const auto& part : object.parts)
        for (const ObjectThing& piece : pieces_of(*part)) {
            all.push_back(object);
            all.back().parts = {std::make_shared<const ObjectThing>(piece)};
        }
    return all;
}

}  // namespace

/// Is this a sweep of balls that no light comes through? All its parts have its material.
bool SceneMaker::is_opaque_sweep(const ObjectThing& object, const Around& around) {
    if (object.word != word("sphere_sweep") || object.kind != ObjectKind::merge) return false;
    if (object.parts.size() < 2 || !object.clips.empty()) return false;
    const std::optional<Part> part = build(*object.parts[0], inside(object, around));
    return part && !clear(part->primitive);
}

/// Adds an object of the scene, or of a union, whose parts keep the surfaces inside it unless it is turned inside out.
void SceneMaker::add(const ObjectThing& object, const Around& around) {
    if (object.kind == ObjectKind::light) {
        add_light(object, around);
    } else if (object.kind == ObjectKind::unite && object.clips.empty() && !object.inverse) {
        const Around within = inside(object, around);
        tell_notes(object);
        for (const auto& part : object.parts) add(*part, within);
    } else if (is_opaque_sweep(object, around)) {
        ObjectThing parts = object;  // nobody sees what is inside of it, and a union is traced faster
        parts.kind = ObjectKind::unite;
        add(parts, around);
    } else if (object.kind == ObjectKind::unite && !object.clips.empty() && object.parts.size() > 1) {
        for (const ObjectThing& piece : pieces_of(object)) add(piece, around);
    } else if (std::optional<Part> part = build(object, around)) {
        push(std::move(*part), object, around);
    }
}

/// Forgets interiors that no two bodies in one place share, and no parts of one body divide.
void SceneMaker::settle_spaces() {
    struct InteriorUse {
        std::vector<Box> boxes{};
        bool matters = false, needed = false;
        TextPlace place{};
    };
    std::unordered_map<int, InteriorUse> uses;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const Primitive& body = scene.primitives[i];
        std::set<int> own;
        bool matters = !contents.fogs.empty();
        for_each_leaf(body, [&](const Primitive& leaf, const glm::dmat4&) {
            const Material& material = materials[leaf.material];
            if (!material.transmits()) return;
            own.insert(material.interior);
            matters |= material.ior != 1 || material.fades();
        });
        for (const int number : own) {
            if (number == 0) continue;
            InteriorUse& use = uses[number];
            use.matters |= matters, use.needed |= own.size() > 1;
            use.boxes.push_back(world_bounds(body)), use.place = shown[i].place;
        }
    }
    for (auto& [number, use] : uses) use.needed = use.matters && (use.needed || any_meet(use.boxes));
    const auto settle = [&](const auto& self, Primitive& body) -> void {
        const Material& own = materials[body.material];
        const auto use = uses.find(own.interior);
        if (own.interior > 0 && (use == uses.end() || !use->second.needed))
            body.material = materials.within(body.material, 0, own.hollow);
        change_parts(body, [&](Primitive& part) { self(self, part); });
    };
    if (spaces > 0)
        for (Primitive& body : scene.primitives) settle(settle, body);
    constexpr int deep = 20;  // enough for rays through nine clear bodies
    if (contents.max_trace_level < deep && !in.options.as_text) clear_overlapping();
    for (const auto& [number, use] : uses)
        if (use.needed && in.options.as_text)
            notes.approximated(use.place, "bodies that share an interior, or whose parts have their own");
}

/// Lets rays go on straight without a new generation, as in POV-Ray, where clear bodies overlap or have several
/// interiors.
void SceneMaker::clear_overlapping() {
    constexpr std::size_t most = 2000;  // bodies; of more none are looked at
    std::vector<std::pair<Primitive*, Box>> bodies;
    for (Primitive& body : scene.primitives)
        if (clear(body)) bodies.emplace_back(&body, world_bounds(body));
    if (bodies.size() > most) return;
    const auto change = [&](const auto& self, Primitive& body) -> void {
        body.material = materials.clear_by_color(body.material);
        change_parts(body, [&](Primitive& part) { self(self, part); });
    };
    for (auto& [body, box] : bodies) {
        bool overlaps = false;
        for_each_leaf(*body, [&](const Primitive& leaf, const glm::dmat4&) {
            overlaps |= materials[leaf.material].interior > 0;
        });
        for (const auto& [other, place] : bodies) overlaps |= other != body && boxes_meet(box, place);
        if (overlaps) change(change, *body);
    }
}

/// Gives a body and its parts materials without a shadow, or that are not seen or not mirrored.
void SceneMaker::take(double Material::*part, Primitive& body) {
    body.material = materials.without(part, body.material);
    change_parts(body, [&](Primitive& own) { take(part, own); });
}

namespace {

/// Hashes what a body is and where: equal ones have equal hashes.
std::size_t place_of(const Primitive& body) {
    std::size_t hash = body.shape.index();
    const auto add = [&](const DVec3& v) {
        for (int i = 0; i < 3; ++i)
            hash = (hash ^ std::bit_cast<std::uint64_t>(v[i] + 0.)) * 0x9E3779B97F4A7C15u;  // -0 becomes 0
    };
    const Box own = std::visit([](const auto& shape) { return shape.bounds(); }, body.shape);
    add(own.low), add(own.high);
    for (const Transformation& step : body.transformations) {
        if (const auto* const turn = std::get_if<Rotate>(&step)) add(turn->degrees);
        if (const auto* const move = std::get_if<Translate>(&step)) add(move->by);
        if (const auto* const scale = std::get_if<Scale>(&step)) add(scale->by);
    }
    return hash ^ hash >> 32;
}

Primitive without_materials(Primitive body) {
    body.material = 0;
    change_parts(body, [](Primitive& part) { part = without_materials(part); });
    return body;
}

}  // namespace

/// Finds pairs of one body of which one is only seen and the other only casts a shadow, as `strahl pov` writes them,
/// and makes each pair one body again. Tells of all others that cast no shadow or are not seen.
void SceneMaker::drop_shadow_copies() {
    std::vector<bool> gone(shown.size());
    const auto is_copy = [&](std::size_t i) { return shown[i].no_image && shown[i].no_reflection; };
    // The bodies that may be the same as one that not all rays see, by a hash of shape and place.
    std::unordered_map<std::size_t, std::vector<std::size_t>> places;
    std::set<std::pair<std::size_t, std::size_t>> forms;  // their kinds and numbers of steps, which tell most apart
    const auto form_of = [](const Primitive& body) {
        return std::pair(body.shape.index(), body.transformations.size());
    };
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (shown[i].no_image || shown[i].no_reflection)
            places[place_of(scene.primitives[i])], forms.insert(form_of(scene.primitives[i]));
    const auto bodies_beside = [&](const Primitive& body) {
        const auto known = forms.contains(form_of(body)) ? places.find(place_of(body)) : places.end();
        return known == places.end() ? nullptr : &known->second;
    };
    for (std::size_t i = 0; i < shown.size() && !places.empty(); ++i)
        if (auto* const beside = bodies_beside(scene.primitives[i])) beside->push_back(i);
    for (std::size_t i = 0; i < shown.size() && !places.empty(); ++i) {
        if (!shown[i].no_shadow || is_copy(i)) continue;
        const Primitive& seen = scene.primitives[i];
        const auto* const beside = bodies_beside(seen);
        if (!beside) continue;
        const auto same = std::ranges::find_if(*beside, [&](std::size_t n) {
            if (!is_copy(n) || gone[n]) return false;
            Primitive copy = scene.primitives[n];
            copy.material = seen.material;
            const Material &own = materials[seen.material], &shadow = materials[scene.primitives[n].material];
            return copy == seen && std::fabs(own.refraction * max_of(own.rgb.color) -
                                             shadow.refraction * max_of(shadow.rgb.color)) < 1e-6;
        });
        if (same == beside->end()) continue;
        gone[*same] = true, shown[i].no_shadow = false;
    }
    for (std::size_t i = 0; i < shown.size(); ++i) {
        Seen& own = shown[i];
        if (gone[i] || !(own.no_image || own.no_reflection)) continue;
        const Primitive bare = without_materials(scene.primitives[i]);
        std::size_t same = 0;
        for (const std::size_t n : places.at(place_of(scene.primitives[i])))
            same += without_materials(scene.primitives[n]) == bare;
        if (same == 1) continue;
        // Leaves it out: rays meet only the first of several bodies in one place.
        notes.left_out(own.place, "a body that not all rays see, in the place of another");
        gone[i] = own.no_image, own.no_reflection = false;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (gone[i]) continue;
        Primitive& own = scene.primitives[kept];
        if (kept++ != i) own = std::move(scene.primitives[i]);
        const auto& [no_shadow, no_image, no_reflection, place, negated] = shown[i];
        if (no_shadow) take(&Material::shadow, own);
        if (no_image) take(&Material::seen, own);
        if (no_reflection) take(&Material::mirrored, own);
        kept_places.push_back(place);
    }
    scene.primitives.resize(kept);
}

}  // namespace strahl::pov

// Chooses values within the parser's own bounds.
#include "tests/attack/renderer/wild_scene.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "num/vec_math.h"
#include "scene/overlap.h"
#include "tests/attack/renderer/wild_materials.h"
#include "tests/referee/random_places.h"
#include "text/blocks/blocks.h"
#include "text/blocks/bodies.h"
#include "text/blocks/materials.h"

namespace strahl {
namespace {

class Wild : WildMaterials {
  public:
    using WildMaterials::WildMaterials;
    WildScene make();

  private:
    template <class... Kinds>
    Shape shape(std::type_identity<std::variant<Kinds...>>);
    template <class Kind>
    Kind body();
    int new_material() { return palette.push_back(material()), static_cast<int>(palette.size()) - 1; }
    void trim(Primitive& primitive);
    Primitive body_of(int material, int levels);
    std::shared_ptr<const std::vector<Primitive>> parts(int material, int levels);
    void settle(Primitive& primitive, Materials& materials);
    void add_body();
    void repeat_body();
    void add_bodies();
    Camera camera();
    bool look_at_body(Camera& camera);
    int depth();

    Scene scene;
    std::vector<Material> palette;  // by which primitives number theirs until all are there
};

template <class Kind>
Kind Wild::body() {
    Kind body;
    const auto fill = [&](auto& value, Range range) {
        if constexpr (std::is_same_v<decltype(value), DVec3&>)
            value = point();
        else
            value = number(argument_range(range));
    };
    do std::apply([&](const auto&... field) { (fill(body.*field.member, field.range), ...); }, Kind::fields);
    while (body.fault());
    return body;
}
template <class... Kinds>
Shape Wild::shape(std::type_identity<std::variant<Kinds...>>) {
    // Blobs and sweeps take turns with superellipsoids: scenes with none of these are as they were before.
    constexpr auto listed = []<class Kind>(Kind) {
        return !std::is_same_v<Kind, Blob> && !std::is_same_v<Kind, SphereSweep> && !std::is_same_v<Kind, JuliaFractal>;
    };
    const int wanted = dice.upto(sizeof...(Kinds) - 4);
    int number = 0;
    Shape shape;
    ((listed(Kinds{}) && number++ == wanted ? void(shape = body<Kinds>()) : void()), ...);
    if (std::holds_alternative<Superellipsoid>(shape) && dice.chance(.5))
        dice.chance(.5) ? void(shape = body<Blob>()) : void(shape = body<SphereSweep>());
    if (std::holds_alternative<SphereSweep>(shape) && dice.chance(.3)) {
        // Most of those that are allowed take minutes for a picture.
        auto own = body<JuliaFractal>();
        own.iterations = std::floor(std::min(own.iterations, 20.)), own.precision = std::min(own.precision, 100.);
        shape = own;
    }
    return shape;
}

/// Keeps as many of its transformations as are allowed.
void Wild::trim(Primitive& primitive) {
    const auto allowed = [&](const auto& shape) {
        return transformed_fault(shape, matrix(primitive.transformations)).empty();
    };
    while (!primitive.transformations.empty() && !std::visit(allowed, primitive.shape))
        primitive.transformations.pop_back();
}

/// A body with the number of its material in the palette. `levels` is how deep bodies may be in it.
Primitive Wild::body_of(int material, int levels) {
    Primitive primitive{shape(std::type_identity<Shape>{}), material, {}};
    if (Mesh* const mesh = std::get_if<Mesh>(&primitive.shape); mesh && dice.chance(.5)) {
        give_places(*mesh, dice);
        map_by_uv(palette[static_cast<std::size_t>(primitive.material = new_material())]);
    }
    const auto add_parts = [&]<class Kind>(Kind& kind) {
        if constexpr (is_composite<Kind>)
            if (levels >= 0) kind.parts = parts(material, levels);
    };
    std::visit(add_parts, primitive.shape);
    if (dice.chance(.4))
        for (int i = dice.upto(2); i >= 0; --i) primitive.transformations.push_back(step());
    trim(primitive);
    return primitive;
}
/// 1 to 5, of the material of the whole or of others, which may lie on each other.
std::shared_ptr<const std::vector<Primitive>> Wild::parts(int material, int levels) {
    std::vector<Primitive> list;
    for (int i = dice.upto(4); i >= 0;) {
        Primitive part = !list.empty() && dice.chance(.2)
                             ? list.back()
                             : body_of(dice.chance(.6) ? material : new_material(), levels - 1);
        const auto fits = [&]<class Kind>(const Kind&) { return levels > 0 || !is_composite<Kind>; };
        if (!fits_composite(part.shape) || !std::visit(fits, part.shape)) continue;
        list.push_back(std::move(part));
        --i;
    }
    return std::make_shared<const std::vector<Primitive>>(std::move(list));
}

void Wild::add_body() { scene.primitives.push_back(body_of(new_material(), 1)); }

/// Repeats a body: in the same place, a little aside, or somewhere else.
void Wild::repeat_body() {
    const int number = dice.upto(static_cast<int>(scene.primitives.size()) - 1);
    Primitive copy = scene.primitives[number];
    if (dice.chance(.85)) {
        const double distance = dice.chance(wildness) ? this->number(lengths) : dice.in(0, 8);
        copy.transformations.push_back(Translate{dice.vector(-1, 1) * std::min(distance, largest_coordinate)});
    }
    if (dice.chance(.3)) copy.material = new_material();
    trim(copy);
    scene.primitives.push_back(std::move(copy));
}

void Wild::add_bodies() {
    const int form = dice.upto(19);
    if (form < 15) {  // few
        for (int i = dice.upto(5); i >= 0; --i)
            if (!scene.primitives.empty() && dice.chance(.2))
                repeat_body();
            else
                add_body();
        return;
    }
    // Many, for a hierarchy. Bodies without bounds would hide it.
    const int count = form < 19 ? 8 + dice.upto(30) : 100 + dice.upto(300), different = 1 + dice.upto(6);
    const auto bounded = [](const Shape& shape) { return std::visit([](const auto& s) { return s.bounded; }, shape); };
    while (static_cast<int>(scene.primitives.size()) < count)
        if (static_cast<int>(scene.primitives.size()) < different) {
            add_body();
            if (!bounded(scene.primitives.back().shape) && !dice.chance(.1)) scene.primitives.pop_back();
        } else {
            repeat_body();
        }
}

/// Points the camera at a body, from a few times its size away or from inside.
bool Wild::look_at_body(Camera& camera) {
    const auto number = dice.upto(static_cast<int>(scene.primitives.size()) - 1);
    const Box box = world_bounds(scene.primitives[number]);
    if (!box.finite()) return false;
    const double size = length(box.size());
    camera.look_at = box.centre();
    const double distance = dice.chance(.2) ? dice.in(0, .5) : dice.in(.5, 4);
    camera.position = camera.look_at + size * distance * dice.direction();
    return true;
}

Camera Wild::camera() {
    Camera camera;
    const auto seen = [](const DVec3& p) {
        return coordinates.contains(p.x) && coordinates.contains(p.y) && coordinates.contains(p.z);
    };
    do {
        camera.position = dice.chance(.5) ? dice.arrow(4, 9) : point();
        camera.look_at = dice.chance(.5) ? dice.vector(-1, 1) : point();
        if (dice.chance(.6)) look_at_body(camera);
        camera.up = dice.chance(.5) ? dice.direction() : point();
        camera.fov = usual_or(half_angles, 5, 60);
        camera.aspectratio.reset();
        if (dice.chance(.1)) camera.aspectratio = number(positive);
    } while (degenerate(camera) || !seen(camera.position) || !seen(camera.look_at) ||
             !half_angles.contains(camera.fov));
    return camera;
}

/// Chooses the depth. If no surface both reflects and transmits, rays do not multiply and many generations cost little.
int Wild::depth() {
    const bool branches = std::any_of(palette.begin(), palette.end(),
                                      [](const Material& m) { return m.reflection > 0 && m.refraction > 0; });
    if (!branches && dice.chance(.05)) return 256;
    return 1 + dice.upto(branches ? 5 : 19);
}

/// Numbers its material, and then those of its parts, as the scene does.
void Wild::settle(Primitive& primitive, Materials& materials) {
    primitive.material = materials.number(palette[primitive.material]);
    const auto settle_parts = [&]<class Kind>(Kind& kind) {
        if constexpr (is_composite<Kind>) {
            std::vector<Primitive> list = *kind.parts;
            for (Primitive& part : list) settle(part, materials);
            kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(list));
        }
    };
    std::visit(settle_parts, primitive.shape);
}

WildScene Wild::make() {
    add_bodies();
    for (int i = dice.upto(3); i > 0; --i) {
        const DVec3 position = dice.chance(.6) ? dice.arrow(2, 9) : point();
        scene.lights.push_back({position, color()});
        Light& light = scene.lights.back();
        if (dice.chance(.2)) {
            Spot spot{point(), number(quarter_turns), number(quarter_turns), usual_or(not_negative, 0, 20)};
            if (spot.falloff < spot.radius) std::swap(spot.radius, spot.falloff);
            if (spot.look_at != light.position) light.spot = spot;
        } else if (dice.chance(.2) && position != DVec3(0)) {
            light.direction = position, light.position = DVec3(0);
        } else if (dice.chance(.2)) {
            light.area = Area{{number(lengths), 0, 0}, {0, 0, number(lengths)}};
            if (dice.chance(.5)) light.area->columns = 1 + dice.upto(6), light.area->rows = 1 + dice.upto(6);
        }
    }
    scene.camera = camera();
    if (dice.chance(.1)) scene.fog = Fog{usual_or(lengths, 1, 30), color()};
    if (scene.fog && dice.chance(.5)) {
        scene.fog->altitude = usual_or(lengths, .1, 10), scene.fog->offset = dice.in(-2, 2);
        scene.fog->up = dice.direction(), scene.fog->transmit = dice.in(0, 1);
        if (dice.chance(.3)) scene.fog->filter = dice.in(0, 1);
    }
    scene.background = dice.chance(.2) ? Pigment(pattern()) : Pigment(color());
    scene.settings.ambient_light = color();
    scene.settings.max_trace_level = depth();
    if (dice.chance(.3)) scene.settings.assumed_gamma = dice.chance(.5) ? 1 : dice.in(1, 5);
    Materials materials;
    for (Primitive& primitive : scene.primitives) settle(primitive, materials);
    scene.materials = std::move(materials.list);
    View view{.camera = scene.camera,
              .width = 3 + dice.upto(29),
              .height = 3 + dice.upto(21),
              .depth = scene.settings.max_trace_level};
    if (dice.chance(.1)) view.shift_x = dice.in(-.5, .5), view.shift_y = dice.in(-.5, .5);
    if (dice.chance(.3)) view.error = std::pow(10, dice.in(-6, 0));
    return {std::move(scene), view};
}

}  // namespace

WildScene wild_scene(std::uint64_t seed) { return Wild(seed).make(); }

}  // namespace strahl

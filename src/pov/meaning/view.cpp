// Makes the camera, the background and the settings of a scene.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "num/decimal.h"
#include "num/vec_math.h"
#include "pov/meaning/coincident.h"
#include "pov/meaning/crowds.h"
#include "pov/meaning/scene_maker.h"
#include "pov/meaning/shared_faces.h"
#include "scene/leave_faces.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "scene/tangent.h"

namespace strahl::pov {
namespace {

/// Returns the angle of 0 to 90 degrees with this tangent. Of all angles that give it up to rounding, this one has the
/// fewest digits.
double angle_of(double tan) {
    const double angle = std::atan(tan) * 180 / std::numbers::pi;
    for (double unit = 1; unit < 1e14; unit *= 10) {
        const double rounded = std::round(angle * unit) / unit;
        if (std::fabs(tangent(rounded) - tan) <= 8e-16 * tan) return rounded;
    }
    return angle;
}

/// Returns a camera's projection; perspective in place of projections that scenes do not have.
Projection projection_of(const CameraThing& camera) {
    const auto known = std::ranges::find(projection_words, camera.projection, find_word);
    if (known == projection_words.end()) return Projection::perspective;
    const bool numbered = camera.projection == word("cylinder") && camera.cylinder >= 1 && camera.cylinder <= 4;
    return static_cast<Projection>(known - projection_words.begin() + (numbered ? camera.cylinder - 1 : 0));
}

}  // namespace

bool CameraAxes::left_handed() const { return dot_product(cross_product(up, direction), right) > 0; }

CameraAxes axes_of(const CameraThing& camera) {
    CameraAxes axes{camera.location, camera.direction, camera.right, camera.up, camera.up};
    const bool flat = camera.projection == word("perspective") || camera.projection == word("orthographic");
    if (camera.angle.value_or(0) > 0 && flat) {  // angle 0 keeps the direction's length
        const double width = length(camera.right), angle = std::clamp(*camera.angle, 1e-6, 179.999);
        axes.direction = width / (2 * tangent(angle / 2)) * normalize(camera.direction);
        if (camera.steps.empty()) axes.angle = angle;
    }
    if (camera.has_look_at && camera.look_at != camera.location) {
        const bool turned = axes.left_handed();
        const DVec3 ahead = normalize(camera.look_at - camera.location);
        const DVec3 across = cross_product(camera.sky, ahead);
        const double size = length(axes.direction);
        axes.direction = size * ahead;
        const bool level = std::max({std::fabs(across.x), std::fabs(across.y), std::fabs(across.z)}) >= 1e-10;
        const DVec3 right = normalize(level ? across : axes.right);  // of its own if it looks up or down
        axes.up = length(axes.up) * normalize(cross_product(ahead, right));
        axes.right = (turned ? 1 : -1) * length(axes.right) * right;
        axes.sky = level ? camera.sky : axes.up;
    }
    if (camera.projection == word("orthographic") && (!camera.has_axes || camera.angle)) {
        const double size = length(camera.look_at - camera.location) / length(axes.direction);
        axes.right = size * axes.right, axes.up = size * axes.up;
    }
    const glm::dmat4 m = matrix_of(camera.steps);
    const glm::dmat3 turn(m);
    axes.location = transform_point(m, axes.location);
    axes.direction = turn * axes.direction, axes.right = turn * axes.right, axes.up = turn * axes.up;
    axes.sky = turn * axes.sky;
    return axes;
}

void SceneMaker::set_camera() {
    const CameraThing own = contents.camera.value_or(CameraThing());
    const auto approximated = [&](bool applies, const char* text) {
        if (applies) notes.approximated(own.place, text);
    };
    Camera& camera = scene.camera;
    // POV-Ray turns spherical rays about the axes, so that a right-handed camera shows them upside down.
    const bool upside_down = own.projection == word("spherical") && !axes.left_handed();
    const DVec3 right = mirror(axes.right, mirrored), up = mirror(axes.up, mirrored);
    const DVec3 ahead = mirror(axes.direction, mirrored);
    camera.position = mirror(axes.location, mirrored);
    const double distance = own.has_look_at && own.steps.empty() ? length(own.look_at - own.location) : length(ahead);
    camera.look_at = own.has_look_at && own.steps.empty() && distance > 0
                         ? mirror(own.look_at, mirrored)
                         : camera.position + std::max(length(axes.location), 1.) / length(ahead) * ahead;
    camera.up = (upside_down ? 1. : -1.) * mirror(axes.sky, mirrored);  // so keys of flights are level
    const double width = length(right), height = length(up), depth = length(ahead);
    if (!(width > 0 && height > 0 && depth > 0 && std::isfinite(width + height + depth)))
        in.fail(own.place, "the camera sees nothing: its right, up or direction is 0");
    camera.projection = projection_of(own);
    const bool curved = angular(camera.projection);
    double tan_x = width / 2 / depth, ratio = width / height;
    if (camera.projection == Projection::orthographic)
        tan_x = width / 2 / length(camera.look_at - camera.position);
    else if (own.projection != word("perspective") && camera.projection == Projection::perspective) {
        notes.approximated(own.place, "a camera of another projection is a perspective one");
        tan_x = tangent(std::clamp(own.angle.value_or(90), 1., 120.) / 2);
    }
    const bool spherical = camera.projection == Projection::spherical;
    double half_angle = std::max(own.angle.value_or(spherical ? 360 : 90) / 2, 1e-6);
    if (spherical) ratio = own.vertical_angle ? 2 * half_angle / std::max(*own.vertical_angle, 1e-6) : 2;
    const double radians = 2 * half_angle * std::numbers::pi / 180;
    const auto is = [&](Projection projection) { return camera.projection == projection; };
    if (is(Projection::cylinder) || is(Projection::cylinder3)) ratio = radians / height;
    if (is(Projection::cylinder2) || is(Projection::cylinder4)) ratio = width / radians;
    if (camera.projection == Projection::fisheye) {
        half_angle *= width;
        approximated(std::fabs(height - 1) > 1e-6, "the circle of a fisheye touches the picture's top and bottom");
    }
    const auto slant = [&](const DVec3& a, const DVec3& b) {
        return std::fabs(dot_product(normalize(a), normalize(b))) > 1e-6;
    };
    approximated(slant(right, up) || slant(right, ahead) || slant(up, ahead), "the camera's axes are at right angles");
    // Samples lie within half of a radius that is half the aperture (render/tracepixel.cpp of 3.7).
    if (own.aperture != 0 && own.blur_samples > 0 && is(Projection::perspective)) {
        camera.aperture = std::clamp(std::fabs(own.aperture) / 4, 1e-9, 1e9);
        const double sharp = own.focal_point ? length(*own.focal_point - own.location) : length(axes.direction);
        camera.focus = std::clamp(sharp > 0 ? sharp : 1, 1e-9, 1e9);
        notes.approximated(own.place, "'blur_samples': the whole lens is averaged, without grain");
        approximated(own.bokeh, "'bokeh': the lens is an even disc");
    }
    approximated(own.bent, "the camera's normal bends nothing");
    const bool as_given = own.projection == word("perspective") ||
                          (own.projection == word("orthographic") && own.has_look_at && own.steps.empty());
    const double flat = axes.angle > 0 && as_given ? axes.angle / 2 : angle_of(tan_x);
    camera.fov = std::clamp(curved ? half_angle : flat, 1e-6, curved ? 360 : 90 - 1e-14);
    camera.aspectratio = std::clamp(tidy(ratio), 1e-9, 1e9);
    if (const char* const fault = degenerate(camera)) in.fail(own.place, std::string("invalid camera: ") + fault);
}

namespace {

/// Multiplies the colours of a pattern and of a pigment.
Pattern brightened(Pattern pattern, const Color& by) {
    for (ColorStop& stop : pattern.colors) {
        stop.color = stop.color * by;
        if (stop.pattern) stop.pattern = std::make_shared<const Pattern>(brightened(*stop.pattern, by));
    }
    return pattern;
}
Pigment brightened(const Pigment& pigment, const Color& by) {
    Pigment own = pigment;
    own.color = own.color * by;
    if (own.pattern) own.pattern = std::make_shared<const Pattern>(brightened(*own.pattern, by));
    return own;
}

}  // namespace

void SceneMaker::set_background() {
    const Color& color = contents.background;
    scene.background = Pigment(in.options.as_text ? max(color, Color(0)) : color);
    if (contents.sky && !contents.sky->pigments.empty()) {
        const std::vector<PigmentThing>& pigments = contents.sky->pigments;
        std::vector<Look> looks;
        for (const PigmentThing& pigment : pigments)
            looks.push_back(materials.pigment_maker().look_of(pigment, {}, {}));
        if (const Color emission = max(contents.sky->emission, Color(0)); emission != Color(1))
            for (Look& look : looks) {
                const Pigment& own = look.pigment;
                if (look.filter > 0 || (own.pattern && std::holds_alternative<ImagePattern>(own.pattern->kind)))
                    notes.approximated(contents.sky->place, "'emission' of a sky with pictures, or that filters light");
                look.pigment = brightened(own, emission);
            }
        // The lowest layer that hides everything takes the place of the background.
        const auto clear = [](const Look& look) { return look.filter + look.transmit > 0 || look.clear().clear(); };
        std::size_t first = 0;
        for (std::size_t i = 0; i < looks.size(); ++i)
            if (!clear(looks[i])) scene.background = looks[i].pigment, first = i + 1;
        constexpr std::size_t most_coats = 7;
        if (looks.size() - first > most_coats) {
            notes.approximated(contents.sky->place, "of the layers of the sky the upper seven are shown");
            first = looks.size() - most_coats;
        }
        for (std::size_t i = first; i < looks.size(); ++i) {
            if (looks[i].pigment.pattern && !looks[i].pigment.clear())
                notes.approximated(contents.sky->place, "a picture of the sky that lets light through is opaque");
            scene.background_coats.push_back(looks[i].clear());
        }
        const double version = in.version_given() ? in.version() : 3.62;
        const auto filters = [](const Pigment& coat) { return coat.filter > 0; };
        if (version < 3.7 && pigments.size() > 1 && std::ranges::any_of(scene.background_coats, filters))
            notes.approximated(contents.sky->place, "layers of the sky are as in version 3.7");
    }
    for (const FogThing& fog : contents.fogs) {
        const bool ground = fog.type != 1, lies = !ground || (fog.altitude > 0 && length(fog.up) > 0);
        if (!(fog.distance > 0) || scene.fog || !lies) {
            if (fog.distance != 0) notes.left_out(fog.place, scene.fog ? "a second fog" : "fog without a direction");
            continue;
        }
        scene.fog = Fog{.distance = std::clamp(fog.distance, 1e-9, 1e9),
                        .color = color_of(fog.color),
                        .filter = std::clamp(decimal(fog.color.filter), 0., 1.),
                        .transmit = std::clamp(decimal(fog.color.transmit), 0., 1.)};
        if (ground) {
            scene.fog->altitude = std::clamp(fog.altitude, 1e-9, 1e9);
            scene.fog->offset = std::clamp(fog.offset, -1e9, 1e9);
            scene.fog->up = mirror(fog.up, mirrored);
        }
        if (fog.turbulence != DVec3(0)) {
            scene.fog->turbulence = mirror(fog.turbulence, mirrored);
            scene.fog->octaves = std::clamp(fog.octaves, 1., 10.);
            scene.fog->omega = decimal(static_cast<float>(fog.omega));
            scene.fog->lambda = decimal(static_cast<float>(fog.lambda));
            scene.fog->depth = fog.depth, scene.fog->generator = std::clamp(in.noise_generator, 1, 3);
        }
    }
}

void SceneMaker::set_settings() {
    Settings& settings = scene.settings;
    const double version = in.version_given() ? in.version() : 3.62;
    if (!contents.assumes_srgb) settings.assumed_gamma = in.assumed_gamma.value_or(version >= 3.7 ? 1 : 0);
    if (const double gamma = settings.assumed_gamma; gamma != 0 && !(gamma >= 1 && gamma <= 5)) {
        settings.assumed_gamma = gamma > 5 ? 5 : 1;
        notes.approximated(contents.gamma_place,
                           "assumed_gamma " + text_of(gamma) + " is " + text_of(settings.assumed_gamma));
    }
    settings.ambient_light = ambient_light_of(contents);
    settings.max_trace_level = std::clamp(contents.max_trace_level, 1, 256);
}

SceneMaker::SceneMaker(Interpreter& in, const PovContents& contents, std::optional<bool> turned)
    : in(in),
      contents(contents),
      axes(axes_of(contents.camera.value_or(CameraThing()))),
      mirrored(turned.value_or(axes.left_handed())),
      notes{in},
      materials(notes, contents, mirrored) {}

/// Keeps the materials that are used, in the order in which they are.
void SceneMaker::settle_materials() {
    std::vector<int> numbers(materials.materials.list.size(), -1);
    const auto settle = [&](const auto& self, Primitive& primitive) -> void {
        int& number = numbers[static_cast<std::size_t>(primitive.material)];
        if (number < 0) {
            number = static_cast<int>(scene.materials.size());
            scene.materials.push_back(materials[primitive.material]);
        }
        primitive.material = number;
        change_parts(primitive, [&](Primitive& part) { self(self, part); });
    };
    scene.materials.clear();
    for (Primitive& primitive : scene.primitives) settle(settle, primitive);
}

std::vector<SceneMaker::Part> SceneMaker::bodies_of(const ObjectThing& object) {
    Around around;
    around.texture = std::make_shared<const TextureThing>();
    add(object, around);
    std::vector<Part> all;
    for (std::size_t i = 0; i < shown.size(); ++i) all.push_back({std::move(scene.primitives[i]), shown[i].negated});
    return all;
}

/// Parallel light comes from infinitely far away if nothing is behind the plane from which it comes, or that is further
/// off than POV-Ray looks.
void SceneMaker::set_planes() {
    constexpr double reach = 1e7;
    for (Light& light : scene.lights) {
        if (!light.from || light.beam > 0) continue;
        const auto is_behind = [&](const Primitive& body) {
            const Box box = world_bounds(body);
            if (!box.finite()) return true;
            double least = 0;
            for (int c = 0; c < 3; ++c) {
                const double d = (*light.direction)[c];
                least += std::min(d * (box.low[c] - (*light.from)[c]), d * (box.high[c] - (*light.from)[c]));
            }
            return least < 0;
        };
        const bool far = length(*light.from - scene.camera.position) >= reach;
        if (far || (!light.fades() && std::ranges::none_of(scene.primitives, is_behind))) light.from.reset();
    }
}

/// Tells of lights that lie on a surface of a body that casts shadows: once it has done so, rounding decides for each
/// of POV-Ray's next shadow rays whether they meet that surface. Faces of boxes that are not moved, on which a light
/// lies exactly, are found without rounding.
/// Bodies around the eye, such as rooms, are taken to cast no shadows that are seen.
void SceneMaker::tell_of_lights_on_surfaces(SeenPlaces& sight) const {
    constexpr double close = 1e-9;  // as a share of the light's coordinates
    const auto is_in = [](const DVec3& p, const Box& box, double hair, const auto& before) {
        bool in = true;
        for (int c = 0; c < 3; ++c) in &= before(box.low[c] - hair, p[c]) && before(p[c], box.high[c] + hair);
        return in;
    };
    std::vector<Box> boxes(scene.primitives.size());
    std::ranges::transform(scene.primitives, boxes.begin(), world_bounds);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (light.direction || light.area || light.shadowless) continue;
        const DVec3 at = light.position;
        const double hair = close * (1 + std::fabs(at.x) + std::fabs(at.y) + std::fabs(at.z));
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            const Primitive& body = scene.primitives[k];
            if (!is_in(at, boxes[k], hair, std::less_equal())) continue;
            if (is_in(scene.camera.position, boxes[k], 0, std::less_equal())) continue;
            const bool exact = std::holds_alternative<Cuboid>(body.shape) && body.transformations.empty();
            if (exact && !is_in(at, boxes[k], 0, std::less())) continue;
            bool around = false;
            for (const DVec3& step : {DVec3(hair, 0, 0), DVec3(0, hair, 0), DVec3(0, 0, hair)})
                around |= contains(body, at + step) != contains(body, at - step);
            if (!around || scene.materials[body.material].shadow == 0) continue;
            if (!sight.counts(sight.reached_by(at, hair))) break;
            notes.approximated(light_places[i],
                               "a light on a surface shines away from it, without the speckles that "
                               "rounding makes in POV-Ray");
            break;
        }
    }
}

/// Tells of parallel light that fades with a power to which numbers below 0 cannot be raised, or become negative, where
/// places behind the plane from which it starts are seen.
void SceneMaker::tell_of_light_behind_planes(SeenPlaces& sight) const {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (!light.from || light.beam > 0 || !light.fades() || light.fade_power == 2) continue;
        const auto is_behind = [&](const SeenPlaces::Place& place) {
            return dot_product(place.p - *light.from, *light.direction) < 0;
        };
        if (sight.counts(static_cast<std::size_t>(std::ranges::count_if(sight.places(), is_behind))))
            notes.approximated(light_places[i],
                               "parallel light does not fade behind the plane from which it starts, where POV-Ray's "
                               "formula fails");
    }
}

/// Tells of fog behind surfaces that are not there: a least share or a filter counts anew there, and where a camera is
/// in such a body that is not hollow POV-Ray has no fog on any way out of it.
void SceneMaker::tell_of_fog_in_pieces() const {
    if (!scene.fog) return;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const Primitive& body = scene.primitives[i];
        bool open = false, hidden = false;
        for_each_leaf(body, [&](const Primitive& leaf, const glm::dmat4&) {
            const Material& own = scene.materials[static_cast<std::size_t>(leaf.material)];
            open |= shows_nothing(own), hidden |= own.seen == 0 || own.mirrored == 0;
        });
        if (scene.fog->transmit > 0 ? open || hidden : scene.fog->filter > 0 && open)
            notes.approximated(kept_places[i],
                               "fog that lets light through is thicker behind an open end, or behind what is not seen");
        if (open && !scene.materials[static_cast<std::size_t>(body.material)].hollow &&
            contains(body, scene.camera.position))
            notes.approximated(kept_places[i], "fog is seen from an open body that is not hollow");
    }
}

/// Rays that bring too little are black, which shows in scenes with mirrors or glass.
void SceneMaker::set_bailout() {
    const double bailout = std::clamp(contents.adc_bailout, 0., 1.);
    const auto ends = [&](const Material& own) {
        const double most = own.reflection + own.refraction;
        return most > 0 && std::pow(most, scene.settings.max_trace_level - 1) < bailout;
    };
    if (scene.finished() || std::ranges::any_of(scene.materials, ends)) scene.settings.adc_bailout = bailout;
}

Scene SceneMaker::make() {
    set_settings();
    set_camera();
    set_background();
    for (const PlacedObject& each : contents.objects) count_surfaces(*each.object);
    for (const PlacedObject& each : contents.objects) {
        Around around;
        around.texture = each.fallback;
        add(*each.object, around);
    }
    drop_shadow_copies();
    settle_spaces();
    settle_materials();
    for (std::size_t i = 0; i < scene.primitives.size(); ++i)
        if (limit_crowd(scene.primitives[i], scene.materials))
            notes.left_out(kept_places[i],
                           "bodies of a composite beyond " + std::to_string(most_leaves) + " that are connected");
    SeenPlaces sight(scene);
    if (!in.options.as_text) {
        for (const std::size_t i : shared_by_parts(scene, sight))
            notes.approximated(kept_places[i],
                               "faces of parts in one place: POV-Ray's rounding speckles them, which are whole here");
        const std::vector<SeenPlaces::Place> shared = places_of_two_bodies(scene, sight);
        for (const std::size_t i : clear_bodies_on_planes(scene, sight, shared))
            notes.approximated(kept_places[i],
                               "a clear body's face in a plane: POV-Ray's rounding speckles it, which is whole here");
        for (Primitive& body : scene.primitives) keep_faces(body);
        settle_faces(scene);
        for (const std::size_t i : bodies_in_one_place(scene, sight, shared, settle_slanted_faces(scene)))
            notes.approximated(kept_places[i],
                               "a face in the place of another body's: rounding speckles it, in POV-Ray otherwise");
        scene.settings.passed_over = 1e-4, scene.settings.farthest = 1e7;
        // What is nearer to the eye is not seen.
        scene.camera.position = off_faces(scene, scene.camera, scene.settings.passed_over);
    }
    set_planes();
    tell_of_lights_on_surfaces(sight);
    tell_of_light_behind_planes(sight);
    tell_of_fog_in_pieces();
    set_bailout();
    return std::move(scene);
}

}  // namespace strahl::pov

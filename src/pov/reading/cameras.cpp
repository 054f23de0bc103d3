// Reads cameras, fog and the sky.
#include <array>

#include "pov/reading/reader.h"
#include "pov/reading/values.h"
#include "pov/things/numbers.h"

namespace strahl::pov {
namespace {

constexpr std::array fog_values{
    value_word<FogThing, &FogThing::distance>("distance"),     value_word<FogThing, &FogThing::type>("fog_type"),
    value_word<FogThing, &FogThing::turbulence>("turbulence"), value_word<FogThing, &FogThing::up>("up"),
    value_word<FogThing, &FogThing::offset>("fog_offset"),     value_word<FogThing, &FogThing::altitude>("fog_alt"),
    value_word<FogThing, &FogThing::depth>("turb_depth"),      value_word<FogThing, &FogThing::octaves>("octaves"),
    value_word<FogThing, &FogThing::omega>("omega"),           value_word<FogThing, &FogThing::lambda>("lambda"),
};

}  // namespace

/// Reads a camera from '{' to '}'.
CameraThing PovReader::read_camera(Interpreter& in) {
    CameraThing camera = default_camera;
    in.begin_block();
    camera.place = in.last_place();
    TextPlace aim = camera.place, wide = camera.place;
    if (const auto known = in.accept_thing<CameraThing>(ValueKind::camera)) camera = *known;
    while (!in.at('}')) {
        if (read_step(in, camera.steps)) continue;
        const std::uint16_t code = in.code();
        in.take();
        switch (code) {
            case word("location"):
                camera.location = in.read_vector();
                break;
            case word("direction"):
                camera.direction = in.read_vector(), camera.has_direction = true;
                break;
            case word("right"):
                camera.right = in.read_vector(), camera.has_axes = true;
                break;
            case word("up"):
                camera.up = in.read_vector(), camera.has_axes = true;
                break;
            case word("sky"):
                camera.sky = in.read_vector();
                break;
            case word("look_at"):
                aim = in.last_place();
                camera.look_at = in.read_vector(), camera.has_look_at = true;
                break;
            case word("angle"):
                wide = in.last_place(), camera.angle = in.read_number();
                if (in.accept(',') || in.at_expression()) camera.vertical_angle = in.read_number();
                break;
            case word("perspective"):
            case word("orthographic"):
            case word("fisheye"):
            case word("ultra_wide_angle"):
            case word("panoramic"):
            case word("spherical"):
            case word("omnimax"):
                camera.projection = code;
                break;
            case word("cylinder"):
                camera.projection = code;
                camera.cylinder = in.read_integer();
                break;
            case word("mesh_camera"):
                camera.projection = code;
                in.skip_block();
                break;
            case word("aperture"):
                camera.aperture = in.read_number();
                break;
            case word("blur_samples"):  // one number is the most, of two the second
                camera.blur_samples = in.read_number(), in.skip_comma();
                camera.blur_samples = in.read_number_or(camera.blur_samples);
                break;
            case word("focal_point"):
                camera.focal_point = in.read_vector();
                break;
            case word("confidence"):
            case word("variance"):
                in.read_number();
                break;
            case word("normal"):
            case word("bokeh"):
                camera.bent |= code == word("normal"), camera.bokeh |= code == word("bokeh");
                in.skip_block();
                break;
            default:
                in.misplaced();
        }
        in.skip_comma();
    }
    in.end_block();
    if (camera.has_look_at && camera.look_at == camera.location)
        in.fail(aim, "the camera looks at the place where it is: 'look_at' and 'location' must differ");
    if (camera.projection == word("perspective") && camera.angle.value_or(0) >= 180)
        in.fail(wide, "the angle of a perspective camera must be smaller than 180 degrees");
    return camera;
}

/// Reads fog from '{' to '}'.
FogThing PovReader::read_fog(Interpreter& in) {
    FogThing fog;
    in.begin_block();
    fog.place = in.last_place();
    if (const auto known = in.accept_thing<FogThing>(ValueKind::fog)) fog = *known;
    while (!in.at('}')) {
        if (Steps steps; read_step(in, steps)) continue;
        if (in.at_color()) {
            fog.color = in.read_color();
            continue;
        }
        if (in.at_expression()) {  // an old form
            fog.distance = in.read_number();
            continue;
        }
        if (!accept_value(in, fog_values, fog)) in.misplaced();
        in.skip_comma();
    }
    in.end_block();
    return fog;
}

/// Reads a sky_sphere from '{' to '}'.
SkyThing PovReader::read_sky(Interpreter& in) {
    SkyThing sky;
    in.begin_block();
    sky.place = in.last_place();
    if (const auto known = in.accept_thing<SkyThing>(ValueKind::sky_sphere)) sky = *known;
    for (;;) {
        if (in.accept("pigment")) {
            PigmentThing pigment = default_texture->layers.back().pigment;
            read_pigment(in, pigment);
            sky.pigments.push_back(std::move(pigment));
        } else if (in.accept("emission")) {
            sky.emission = color_of(in.read_color());
        } else if (Steps steps; read_step(in, steps)) {
            for (PigmentThing& pigment : sky.pigments) append(pigment.blend.steps, steps);
        } else {
            break;
        }
    }
    in.end_block();
    return sky;
}

}  // namespace strahl::pov

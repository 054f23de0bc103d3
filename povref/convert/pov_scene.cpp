#include "povref/convert/pov_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "files/error.h"
#include "files/output_file.h"
#include "num/decimal.h"
#include "num/vec_math.h"
#include "povref/convert/bodies.h"
#include "povref/convert/ini.h"
#include "povref/convert/layout.h"
#include "povref/convert/materials.h"
#include "povref/convert/motions.h"
#include "povref/convert/pigments.h"
#include "povref/convert/scale.h"
#include "scene/leaves.h"
#include "scene/moving_scene.h"
#include "scene/overlap.h"
#include "text/reading/messages.h"

namespace strahl {
namespace {

/// Properties of the scene that decide how it is written, and which comments and warnings it gets.
struct Plan {
    PovScale scale{};
    std::vector<PovMaterial> materials;
    bool scaled = false;          // Unit is declared
    bool inside = false;          // a camera is in a transparent body
    bool keyword = false;         // some material uses `refraction`
    bool shadow_copies = false;   // some body has a copy that casts its shadow
    bool bodies_overlap = false;  // transparent ones share space
    bool uneven = false;          // parts of a transparent composite send different shares of light on
    bool rectangles = false;      // some light is a rectangle without a grid
    bool near_one = false;        // some ior of 1 is written as a larger number
    bool lost_shares = false;     // some material mixes others by several patterns
    bool old_opacity = false;     // some material has it
    bool mixed_groups = false;    // some body has parts of different groups
    bool normal_maps = false;     // some material has one
    bool bumps_by_uv = false;     // some material has a bump by uv
    bool wraps = false;           // some picture is clamped or mirrored
    bool moves = false;           // bodies or lights do, in an animation
    bool sharp_lens = false;      // a lens that POV-Ray has not
    bool shutter = false;
    bool stereo = false;  // two eyes
};

Plan plan_for(const Scene& scene, const PovRequest& request) {
    Plan plan;
    SceneSizes sizes;
    const auto look = [&](const Scene& moment, const std::vector<Camera>& cameras) {
        sizes.add(moment, cameras);
        plan.bodies_overlap |= transparent_bodies_overlap(moment);
        for (const Primitive& primitive : moment.primitives)
            if (transparent(moment, primitive)) {
                for (const Camera& camera : cameras) plan.inside |= contains(primitive, camera.position);
                plan.uneven |= weighs_unevenly(moment, primitive);
            }
    };
    plan.moves = Movers(scene).any();
    for (std::size_t n = 0; plan.moves && n < request.cameras.size(); ++n)
        look(at(scene, static_cast<double>(n) / request.fps), {request.cameras[n]});
    if (!plan.moves) look(scene, request.cameras);
    const Camera& camera = request.cameras[0];
    plan.sharp_lens = has_lens(camera) && (camera.blades || camera.projection != Projection::perspective);
    plan.shutter = camera.shutter > 0;
    plan.stereo = camera.stereo != Stereo::none;
    plan.scale = scale_for(sizes);
    plan.scaled = plan.scale.factor != 1;
    plan.materials = pov_materials(scene, request.depth, plan.scaled);
    for (const PovMaterial& material : plan.materials) {
        plan.keyword |= !material.weight.empty();
        plan.shadow_copies |= material.own_shadow;
        plan.near_one |= material.near_one;
        plan.lost_shares |= material.lost_shares;
    }
    for (const Material& material : scene.materials) {
        plan.old_opacity |=
            std::ranges::any_of(material.coats, [](const Material& own) { return own.old_opacity > 0; }) ||
            material.old_opacity > 0;
        plan.normal_maps |= material.normal.pattern != nullptr;
        plan.bumps_by_uv |= material.bump.pattern && material.bump.pattern->by_uv;
        material.each_pattern([&](const Pattern& pattern) {
            each_nested(pattern, [&](const Pattern& own) {
                const auto* const image = std::get_if<ImagePattern>(&own.kind);
                plan.wraps |= image && !image->once && image->wrap != ImagePattern().wrap;
            });
        });
    }
    for (const Light& light : scene.lights) plan.rectangles |= light.area && light.area->columns == 0;
    for (const Primitive& primitive : scene.primitives)
        for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
            const Material &own = scene.materials[leaf.material], &whole = scene.materials[primitive.material];
            plan.mixed_groups |= own.group != whole.group || own.common != whole.common;
        });
    return plan;
}

std::vector<std::string> warnings_of(const Plan& plan) {
    const std::pair<bool, std::string> all[]{
        {!plan.scale.fault.empty(), plan.scale.fault},
        {plan.near_one,
         "POV-Ray does not count an unrefracted ray as a generation; transparent bodies of ior 1 get an ior of "
         "1.00000012 instead, which refracts by less than can be seen"},
        {plan.uneven,
         "POV-Ray has one share for all light that is reflected totally in a transparent body made of bodies, here "
         "that of its own material; parts with another sum of reflection and refraction have the wrong one"},
        {plan.rectangles,
         "POV-Ray makes grids of lights with an area, here of 16 by 16 points, and multiplies the mean of their light "
         "by the mean of their shadows; with `grid` each point becomes a light of its own, and the pictures are equal"},
        {plan.lost_shares,
         "POV-Ray mixes textures by one pattern; of shares by several or by a picture the first is shown"},
        {plan.old_opacity, "POV-Ray has `old_opacity` only in scenes of versions before 3.7"},
        {plan.mixed_groups, "POV-Ray's groups of lights shine on whole bodies; parts have the group of their body"},
        {plan.normal_maps, "POV-Ray has no pictures of normals; materials with a `normal` are smooth there"},
        {plan.bumps_by_uv,
         "POV-Ray bends normals by uv as if u and v grew along x and y; the picture is right only for meshes on which "
         "they do"},
        {plan.wraps,
         "POV-Ray's pictures repeat: beyond a clamped picture it shows the picture again, and within half a pixel of "
         "the "
         "edges of a mirrored one the colours of the opposite edge"},
        {plan.sharp_lens, "POV-Ray has round lenses of perspective cameras alone"},
        {plan.shutter, "POV-Ray has no shutter; what moves is sharp, as it is in the middle of the time it is open"},
        {plan.stereo, "POV-Ray has no pictures for two eyes; this one is seen from between them"},
        {plan.bodies_overlap,
         "transparent bodies may share space; where a ray leaves one that it did not enter last, it continues "
         "unrefracted, which POV-Ray does not count as a generation: this shows only at the depth limit"}};
    std::vector<std::string> warnings;
    for (const auto& [applies, warning] : all)
        if (applies) warnings.push_back(warning);
    return warnings;
}

std::string scaled(const std::string& text, const Plan& plan) { return plan.scaled ? text + " * Unit" : text; }

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size() + 1), ' ');
    return text;
}

std::string gamma_text(double gamma) {
    if (gamma == 0) return "  assumed_gamma srgb    // values go straight to the file, which is sRGB as well\n";
    if (gamma == 1) return "  assumed_gamma 1.0     // the values are linear light\n";
    return "  assumed_gamma " + padded(text_of(gamma), 8) + "// a value to the power of this is linear light\n";
}

std::string top(const Scene& scene, const PovRequest& request, const Plan& plan) {
    std::string text = comment(request.title + " for POV-Ray 3.7, converted by strahl.");
    for (const std::string& warning : warnings_of(plan)) text += comment("Not exact: " + warning + ".");
    text += std::string("\n#version 3.7;\n\nglobal_settings {\n") + gamma_text(scene.settings.assumed_gamma) +
            "  ambient_light rgb " + text_of(scene.settings.ambient_light) + "\n  max_trace_level " +
            padded(std::to_string(request.depth), 6) + "// generations of rays, the camera's being the first\n" +
            (scene.settings.adc_bailout == 0 ? "  adc_bailout 0         // follow even the weakest ray\n}\n"
                                             : "  adc_bailout " + text_of(scene.settings.adc_bailout) +
                                                   "    // rays of less weight are black\n}\n");
    if (!scene.background.pattern) text += "\nbackground { " + pigment_text(scene.background) + " }\n";
    if (plan.scaled)
        text += "\n" +
                comment(
                    "POV-Ray's tolerances are lengths (no shadow over less than 0.001, no hit beyond 10000000), so "
                    "the scene is built with this many of its units to one of strahl's.") +
                "#declare Unit = " + text_of(plan.scale.factor) + ";\n";
    return text;
}

/// The camera's vectors for POV-Ray: the ray through (x, y) in [-1/2, 1/2]^2, y up, is direction + x right + y up in
/// perspective. If the picture's sides are angles, these are in degrees, and only the ratio of `right` and `up` counts.
struct PovCamera {
    DVec3 location, right, up, direction, angles;
    DVec3 focus{0}, lens{0};  // a point in focus, and the aperture
};
PovCamera axes_of(Camera camera, double aspect, bool left_handed = false) {
    camera.stereo = Stereo::none;
    const CameraFrame frame = frame_of(camera, aspect);
    const double ratio = frame.tan_x / frame.tan_y;
    const DVec3 angles(2 * camera.fov, 2 * camera.fov / ratio, 0), up = -2 * frame.tan_y * frame.down;
    if (!angular(camera.projection))
        return {camera.position,
                2 * frame.tan_x * frame.right,
                up,
                frame.forward,
                angles,
                camera.position + focal_distance(camera) * frame.forward,
                DVec3(4 * camera.aperture)};
    PovCamera axes{camera.position, ratio * frame.right, DVec3(0) - frame.down, frame.forward, angles};
    if (camera.projection == Projection::fisheye) axes.angles.x /= ratio;
    if (camera.projection == Projection::cylinder || camera.projection == Projection::cylinder3) axes.up = up;
    if (camera.projection == Projection::cylinder2 || camera.projection == Projection::cylinder4)
        axes.right = 2 * frame.tan_x * frame.right;
    // The rays of a spherical camera are turned about its axes; right-handed ones would turn the picture upside down.
    if (camera.projection == Projection::spherical && !left_handed) axes.right = -axes.right, axes.up = -axes.up;
    return axes;
}

std::string array(const std::string& name, const std::vector<PovCamera>& cameras, DVec3 PovCamera::*member) {
    std::string text = "#declare " + name + " = array[" + std::to_string(cameras.size()) + "] {\n";
    for (std::size_t i = 0; i < cameras.size(); ++i)
        text += "  " + text_of(cameras[i].*member) + (i + 1 < cameras.size() ? ",\n" : "\n");
    return text + "}\n";
}

/// Writes a camera from the text of each of its vectors.
template <class Text>
std::string camera_block(Projection projection, bool lens, const Text& text) {
    std::string angle;
    if (lens)  // samples lie within a quarter of the aperture
        angle = "\n  aperture  " + text("Lens", &PovCamera::lens) + "\n  focal_point " +
                text("Focus", &PovCamera::focus) + "\n  blur_samples 400, 400  variance 0";
    if (angular(projection)) angle = "\n  angle     " + text("Angles", &PovCamera::angles) + ".x";
    if (projection == Projection::spherical) angle += ", " + text("Angles", &PovCamera::angles) + ".y";
    std::string word(word_of(projection));
    if (projection >= Projection::cylinder)
        word = "cylinder " + std::to_string(1 + int(projection) - int(Projection::cylinder));
    return "camera {\n  " + word + "\n  location  " + text("Eye", &PovCamera::location) + "\n  right     " +
           text("Right", &PovCamera::right) + "\n  up        " + text("Up", &PovCamera::up) + "\n  direction " +
           text("Direction", &PovCamera::direction) + angle + "\n}\n";
}

std::string camera_section(const PovRequest& request, const Plan& plan) {
    std::vector<PovCamera> cameras;
    for (const Camera& camera : request.cameras)
        cameras.push_back(axes_of(camera, double(request.width) / request.height));
    const Projection projection = request.cameras[0].projection;
    const bool animated = request.fps > 0;
    const bool lens = has_lens(request.cameras[0]) && projection == Projection::perspective;
    std::string text =
        heading("Camera") + comment(
                                "The picture's axes in full: `right` and `up` are its width and height at distance 1. "
                                "Nothing else decides whether the world is right- or left-handed; this one is "
                                "right-handed.");
    if (animated)
        text += comment("One entry per frame, " + text_of(request.fps) + " frames a second; frame_number chooses.") +
                array("Eye", cameras, &PovCamera::location) + array("Right", cameras, &PovCamera::right) +
                array("Up", cameras, &PovCamera::up) + array("Direction", cameras, &PovCamera::direction) +
                (angular(projection) ? array("Angles", cameras, &PovCamera::angles) : "") +
                (lens ? array("Focus", cameras, &PovCamera::focus) + array("Lens", cameras, &PovCamera::lens) : "");
    return text + camera_block(projection, lens, [&](const char* name, DVec3 PovCamera::*member) {
               const bool number = member == &PovCamera::lens;
               const DVec3& first = cameras[0].*member;
               const std::string value = animated ? name + std::string(number ? "[frame_number].x" : "[frame_number]")
                                         : number ? text_of(first.x)
                                                  : text_of(first);
               const bool across = member == &PovCamera::right || member == &PovCamera::up;
               const bool of_lens = member == &PovCamera::focus || member == &PovCamera::lens;
               const bool length = member == &PovCamera::location || of_lens || (across && starts_apart(projection));
               return length ? scaled(value, plan) : value;
           });
}

/// Returns a place for a parallel light, since every light of POV-Ray needs one. Bodies behind it cast no shadow, so it
/// is as far behind all that the cameras see as POV-Ray looks.
DVec3 place_of_parallel(const DVec3& direction, const std::vector<Camera>& cameras, const Plan& plan) {
    constexpr double far = 1e7;
    double off = 0;
    for (const Camera& camera : cameras) off = std::max(off, length(camera.position));
    return -(2 * far / plan.scale.factor + off) * normalize(direction);
}

/// Writes the lights. Grids are written as single points: POV-Ray's own grids multiply the mean of the points' light by
/// the mean of their shadows, even with area_illumination.
std::string light_section(const Scene& scene, const std::vector<Camera>& cameras, const Plan& plan,
                          PovMotions& motions) {
    if (scene.lights.empty()) return "";
    std::string text = heading("Lights");
    std::map<double, std::string> groups;
    for (const Light& light : points_of(scene.lights)) {
        const DVec3 place = light.from        ? *light.from
                            : light.direction ? place_of_parallel(*light.direction, cameras, plan)
                                              : light.position;
        const auto placed = [&](const DVec3& p) { return light.motion ? text_of(p) : scaled(text_of(p), plan); };
        std::vector<std::string> items{placed(place) + ", rgb " + text_of(light.color)};
        if (light.shadowless) items.push_back("shadowless");
        if (light.fades())
            items.push_back("fade_distance " + scaled(text_of(light.fade_distance), plan) + " fade_power " +
                            text_of(light.fade_power));
        if (light.direction)
            items.insert(items.end(),
                         {"parallel", "point_at " + (light.from ? placed(*light.from + *light.direction) : "0")});
        if (light.beam > 0)
            items.push_back("cylinder radius " + scaled(text_of(light.core), plan) + " falloff " +
                            scaled(text_of(light.beam), plan) + " tightness " + text_of(light.tightness));
        if (light.area) {
            const auto [u, v, columns, rows] = *light.area;
            const std::string size = columns == 0 ? "16, 16" : std::to_string(columns) + ", " + std::to_string(rows);
            items.push_back("area_light " + placed(u) + ", " + placed(v) + ", " + size);
            if (!light.soft) items.push_back("area_illumination on");
            if (light.adaptive != Light{}.adaptive) items.push_back("adaptive " + text_of(light.adaptive));
            if (light.circular) items.push_back("circular");
            if (light.orient) items.push_back("orient");
            if (light.jitter) items.push_back("jitter");
        }
        if (light.spot) {
            items.insert(items.end(), {"spotlight", "point_at " + placed(light.spot->look_at)});
            for (const auto& [word, value] :
                 {std::pair("radius ", light.spot->radius), std::pair("falloff ", light.spot->falloff),
                  std::pair("tightness ", light.spot->tightness)})
                items.push_back(word + text_of(value));
        }
        if (light.motion) items.push_back(motions.use(*light.motion));
        if (light.motion && plan.scaled) items.push_back("scale Unit");
        (light.group > 0 ? groups[light.group] : text) += block("light_source {", items);
    }
    for (const auto& [number, lights] : groups) text += "#macro " + group_name(number) + "()\n" + lights + "#end\n";
    return text;
}

std::string material_section(const Plan& plan) {
    if (plan.materials.empty()) return "";
    std::string text = heading("Materials");
    if (std::any_of(plan.materials.begin(), plan.materials.end(), [](const auto& m) { return m.transparent; }))
        text += comment(
            "POV-Ray dims ambient and diffuse light by the pigment's opacity, which is divided out where a "
            "material is transparent.");
    if (plan.keyword)
        text += comment(
            "`refraction` is an old keyword without a successor: the weight of all light that was "
            "transmitted or totally reflected.");
    if (std::any_of(plan.materials.begin(), plan.materials.end(), [](const auto& m) { return m.layered; }))
        text += comment(
            "POV-Ray does not light a pigment that is wholly clear; such a material has a clear layer that lets twice "
            "the light through, and on it one that is half opaque.");
    for (const PovMaterial& material : plan.materials) text += "\n" + material.declaration;
    return text;
}

/// Writes a background with a pattern.
std::string sky_section(const Scene& scene) {
    if (!scene.background.pattern && scene.background_coats.empty()) return "";
    std::string text = heading("Background") + "sky_sphere {";
    if (scene.background.pattern) text += " pigment { " + pigment_text(scene.background) + " }";
    for (const Pigment& coat : scene.background_coats) text += " pigment { " + pigment_text(coat) + " }";
    return text + " }\n";
}

std::string fog_section(const Scene& scene, const Plan& plan) {
    if (!scene.fog) return "";
    const Fog& fog = *scene.fog;
    std::string more;
    if (fog.filter != 0) more += " filter " + text_of(fog.filter);
    if (fog.transmit != 0) more += " transmit " + text_of(fog.transmit);
    if (fog.altitude > 0)
        more += " fog_type 2 fog_alt " + scaled(text_of(fog.altitude), plan) + " fog_offset " +
                scaled(text_of(fog.offset), plan) + " up " + text_of(fog.up);
    if (fog.turbulence != DVec3(0))
        more += " turbulence " + text_of(fog.turbulence) + (plan.scaled ? " / Unit" : "") + " octaves " +
                text_of(fog.octaves) + " omega " + text_of(fog.omega) + " lambda " + text_of(fog.lambda) +
                " turb_depth " + text_of(fog.depth);
    if (fog.turbulence != DVec3(0) && fog.generator != 2)
        more += " /* not exact: the noise is of noise_generator " + text_of(fog.generator) + " */";
    return heading("Fog") + comment("Opaque bodies are hollow: only transparent ones keep it out.") +
           "fog { distance " + scaled(text_of(fog.distance), plan) + " color rgb " + text_of(fog.color) + more + " }\n";
}

}  // namespace

PovFiles write_pov(const Scene& whole, const PovRequest& request) {
    const bool animated = request.fps > 0;
    const Scene still = animated ? Scene{} : at(whole, request.time);
    const Scene& scene = animated ? whole : still;
    const Plan plan = plan_for(scene, request);
    PovMotions motions;
    const std::string lights = light_section(scene, request.cameras, plan, motions);
    const std::string bodies =
        body_sections(scene, {plan.materials, plan.shadow_copies, plan.scaled, scene.fog.has_value(), motions});
    std::vector<PovPicture> pictures = pictures_of(scene);
    return {top(scene, request, plan) + camera_section(request, plan) + motions.section() + lights +
                function_section(scene) + sky_section(scene) + fog_section(scene, plan) + material_section(plan) +
                bodies,
            ini_of(scene, request, {plan.inside, plan.keyword, plan.moves, !pictures.empty()}), warnings_of(plan),
            std::move(pictures)};
}

std::string pov_camera(const Camera& camera, double aspect, bool mirrored) {
    const PovCamera axes = axes_of(camera, aspect, mirrored);
    return camera_block(camera.projection, false, [&](const char*, DVec3 PovCamera::*member) {
        const DVec3& v = axes.*member;
        return text_of(mirrored ? DVec3(v.x, v.y, 0 - v.z) : v);
    });
}

void write(const PovFiles& files, const std::string& pov_path) {
    const std::filesystem::path path(pov_path);
    write_file(pov_path, files.pov);
    write_file(ini_beside(pov_path), files.ini);
    for (const PovPicture& own : files.pictures)
        write_picture(own.picture, (path.parent_path() / own.name).string(), {own.picture.bits, false});
}

}  // namespace strahl

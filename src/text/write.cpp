#include "text/write.h"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "num/decimal.h"
#include "text/blocks/blocks.h"
#include "text/blocks/follow_text.h"
#include "text/blocks/materials.h"
#include "text/blocks/pigment.h"
#include "text/blocks/transformations.h"

namespace strahl {
namespace {

/// The parameters of `material` that differ from `base`.
std::string parameters(const Material& material, const Material& base) {
    std::string text;
    const auto value = [&]<class T>(const char* name, const T& own) {
        if constexpr (std::is_same_v<T, Pigment>)
            return own.pattern || own.clear() ? text_of(own) : text_of(own.color, material.follows, name);
        else if constexpr (std::is_base_of_v<Relief, T>)
            return text_of(own);
        else
            return text_of(own, material.follows, name);
    };
    const auto follows = [](const Material& of, const char* name) {
        std::vector<Follow> own = of.follows;
        std::erase_if(own, [=](const Follow& f) { return f.parameter != name; });
        return own;
    };
    const auto add = [&](const auto& field) {
        const bool same = material.*field.member == base.*field.member;
        if (same && follows(material, field.name) == follows(base, field.name)) return;
        text += (text.empty() ? "" : "  ") + std::string(field.name) + " " + value(field.name, material.*field.member);
    };
    std::apply([&](const auto&... field) { (add(field), ...); }, Material::fields);
    if (material.coats == base.coats) return text;
    const auto put = [&](const std::string& coat) { text += (text.empty() ? "coat " : "  coat ") + coat; };
    if (material.coats.empty()) put("none");
    for (const Material& coat : material.coats) put("{ " + parameters(coat, coat_base()) + " }");
    return text;
}

/// A word and the arguments after its opening brace. Those that may be left out are, up to the last that is needed.
template <class Kind>
std::string arguments_text(std::string_view word, const Kind& shape) {
    std::string arguments, optional;
    const auto add = [&](const auto& field) {
        optional += (arguments.empty() && optional.empty() ? "" : ", ") + text_of(shape.*field.member);
        if (field.given == Given::optional && shape.*field.member == Kind{}.*field.member) return;
        arguments += std::exchange(optional, "");
    };
    std::apply([&](const auto&... field) { (add(field), ...); }, Kind::fields);
    return std::string(word) + " { " + arguments;
}
/// A body without its closing brace.
template <class Kind>
std::string shape_text(const Kind& shape) {
    return arguments_text(Kind::name, shape);
}
std::string places_text(const MeshData& mesh, std::size_t triangle) {
    const MeshData::Corners* const numbers = mesh.place_numbers();
    std::string text;
    for (int k = 0; numbers && k < 3; ++k) {
        const auto& [u, v] = mesh.places[numbers[triangle][k]];
        text += (k == 0 ? "  uv_vectors <" : ", <") + text_of(u) + ", " + text_of(v) + ">";
    }
    return text;
}
std::string contours_text(const ContourData& data) {
    const auto point = [](const Contour::Point& p) { return "<" + text_of(p[0]) + ", " + text_of(p[1]) + ">"; };
    std::string text;
    for (const Contour& own : data.contours) {
        text += "\n  contour { " + point(own.start);
        for (const Contour::Stroke& step : own.strokes) {
            text += step.straight() ? "  line " : "  curve " + point(step.control) + ", ";
            if (step.second) text += point(*step.second) + ", ";
            text += point(step.end);
        }
        text += " }";
    }
    return text;
}
std::string shape_text(const Prism& prism) {
    return std::string(Prism::name) + " { " + text_of(prism.base) + ", " + text_of(prism.top) +
           contours_text(*prism.data);
}
std::string shape_text(const Lathe& lathe) { return std::string(Lathe::name) + " {" + contours_text(*lathe.data); }
std::string shape_text(const Blob& blob) {
    std::string text = std::string(Blob::name) + " { " + text_of(blob.threshold);
    for (const Lump& own : blob.data->lumps) text += "\n  " + arguments_text(blob_words[0], own) + " }";
    return text;
}
std::string shape_text(const SphereSweep& sweep) {
    std::string text = std::string(SphereSweep::name) + " {";
    for (const SweptBall& own : sweep.data->balls)
        text += "\n  " + arguments_text(sweep_words[own.through ? 0 : 1], own) + " }";
    return text;
}
std::string shape_text(const JuliaFractal& own) { return arguments_text(JuliaFractal::name, own) + "  " + own.words(); }
std::string shape_text(const Mesh& mesh) {
    if (!mesh.file.empty()) return std::string(Mesh::name) + " { file \"" + mesh.file + "\"";
    std::string text(Mesh::name);
    text += " {";
    const auto &points = mesh.data->points, &normals = mesh.data->normals;
    const auto &triangles = mesh.data->triangles, &corner_normals = mesh.data->corner_normals;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto point = [&](int k) { return points[triangles[i][k]]; };
        const auto normal = [&](int k) { return normals[corner_normals[i][k]]; };
        text += "\n  " +
                (corner_normals.empty()
                     ? shape_text(Triangle{point(0), point(1), point(2)})
                     : shape_text(SmoothTriangle{point(0), point(1), point(2), normal(0), normal(1), normal(2)})) +
                places_text(*mesh.data, i) + " }";
    }
    return text;
}

std::string primitive_text(const Primitive& primitive, const std::vector<Material>& materials, const Material& base,
                           const std::string& indent);

/// A composite without its closing brace, each part on a line of its own.
template <Operation operation>
std::string shape_text(const Composite<operation>& composite, const std::vector<Material>& materials,
                       const Material& own, const std::string& indent) {
    std::string text(composite.name);
    text += " {";
    for (const Primitive& part : *composite.parts)
        text.append("\n").append(indent).append("  ").append(primitive_text(part, materials, own, indent + "  "));
    return text;
}

/// `base` is the material that it has if its text gives none: the default in force, or that of the composite around it.
std::string primitive_text(const Primitive& primitive, const std::vector<Material>& materials, const Material& base,
                           const std::string& indent) {
    const Material& own = materials[primitive.material];
    bool lines = false;
    std::string text = std::visit(
        [&]<class Kind>(const Kind& shape) {
            if constexpr (is_composite<Kind>)
                return lines = true, shape_text(shape, materials, own, indent);
            else
                return shape_text(shape);
        },
        primitive.shape);
    const std::string new_line = std::string("\n").append(indent);
    std::vector<std::string> items;
    for (const Transformation& step : primitive.transformations) {
        const Motion* const motion = std::get_if<Motion>(&step);
        lines |= motion && motion->keys.size() > 1;
        items.push_back(motion ? text_of(*motion, new_line + "  ") : text_of(step));
    }
    if (own != base) items.push_back("material { " + parameters(own, base) + " }");
    std::size_t length = text.size();
    for (const std::string& item : items) length += 2 + item.size();
    lines |= length > 100;
    for (const std::string& item : items) text.append(lines ? new_line : "").append("  ").append(item);
    return text.append(lines ? new_line : " ").append("}");
}

/// The parameters of a field table that are not as usual, each after two spaces.
template <class Struct>
std::string fields_text(const Struct& own, const std::vector<Follow>& follows) {
    std::string text;
    const auto add = [&](const auto& field) {
        const auto& value = own.*field.member;
        if (value == Struct{}.*field.member && !any_follows(follows, field.name)) return;
        text.append("  ").append(field.name);
        if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, bool>)
            text.append(" ").append(text_of(value, follows, field.name));
    };
    std::apply([&](const auto&... field) { (add(field), ...); }, Struct::fields);
    return text;
}

std::string light_text(const Light& light) {
    const auto& follows = light.follows;
    std::string text = light.direction ? "light { direction " + text_of(*light.direction, follows, "direction")
                                       : "light { position " + text_of(light.position, follows, "position");
    if (light.from) text += "  from " + text_of(*light.from);
    text += "  color " + text_of(light.color, follows, "color");
    if (light.area) text += "  edges " + text_of(light.area->u) + ", " + text_of(light.area->v);
    if (light.area && light.area->columns > 0)
        text += "  grid " + std::to_string(light.area->columns) + ", " + std::to_string(light.area->rows);
    if (light.spot)
        text += "  spot { look_at " + text_of(light.spot->look_at, follows, "look_at") +
                fields_text(*light.spot, follows) + " }";
    std::vector<Follow> own = follows;
    if (light.spot) std::erase_if(own, [](const Follow& f) { return f.parameter == "tightness"; });  // the spot's
    text += fields_text(light, own);
    if (light.motion) return text + "\n  " + text_of(*light.motion, "\n  ") + "\n}\n";
    return text + " }\n";
}

std::string settings_text(const Settings& settings) {
    const Settings usual;
    std::string text;
    if (settings.ambient_light != usual.ambient_light)
        text += "  ambient_light " + text_of(settings.ambient_light) + "\n";
    if (settings.max_trace_level != usual.max_trace_level)
        text += "  max_trace_level " + std::to_string(settings.max_trace_level) + "\n";
    if (settings.assumed_gamma != 0) text += "  assumed_gamma " + text_of(settings.assumed_gamma) + "\n";
    if (settings.adc_bailout != usual.adc_bailout) text += "  adc_bailout " + text_of(settings.adc_bailout) + "\n";
    return text.empty() ? text : "global_settings {\n" + text + "}\n";
}

std::string fog_text(const Fog& fog) {
    return "fog { distance " + text_of(fog.distance, fog.follows, "distance") + "  color " +
           text_of(fog.color, fog.follows, "color") + fields_text(fog, fog.follows) + " }\n";
}

std::string primitives_text(const std::vector<Primitive>& primitives, const std::vector<Material>& materials) {
    std::string text;
    Material in_force;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Material& own = materials[primitives[i].material];
        // A single primitive that differs gets a material of its own; for a run of them the default changes.
        const bool same = own == in_force;
        const bool alone = i + 1 == primitives.size() || materials[primitives[i + 1].material] != own;
        if (!same && !alone) {
            if (!text.empty()) text += '\n';
            text.append("defaultmaterial { ").append(parameters(own, in_force)).append(" }\n");
            in_force = own;
        }
        text += primitive_text(primitives[i], materials, in_force, "") + "\n";
    }
    return text;
}

}  // namespace

std::string write_camera(const Camera& camera, const std::vector<Follow>& follows, EyeWords words) {
    const auto is_times = [&](const char* parameter, double factor) {
        return std::ranges::any_of(follows,
                                   [=](const Follow& f) { return f.parameter == parameter && f.factor == factor; });
    };
    const bool sky = words.sky || is_times("up", -1), angle = words.angle || is_times("fov", .5);
    std::string text = "camera {\n  position " + text_of(camera.position, follows, "position") + "\n  look_at " +
                       text_of(camera.look_at, follows, "look_at") + (sky ? "\n  sky " : "\n  up ") +
                       text_of(sky ? DVec3(0) - camera.up : camera.up, follows, "up") + "\n  ";
    const std::string projection(word_of(camera.projection));
    if (camera.projection != Projection::perspective) text += projection + (angular(camera.projection) ? " " : "\n  ");
    if (angular(camera.projection))
        text += text_of(2 * camera.fov, follows, "fov") + "\n";
    else
        text += (angle ? "angle " : "fov ") + text_of(angle ? 2 * camera.fov : camera.fov, follows, "fov") + "\n";
    if (camera.aspectratio) text += "  aspectratio " + text_of(*camera.aspectratio, follows, "aspectratio") + "\n";
    const bool lens =
        has_lens(camera) || any_follows(follows, "aperture") || camera.focus || camera.focus_on || camera.blades;
    if (lens) text += "  aperture " + text_of(camera.aperture, follows, "aperture");
    if (camera.focus) text += "  focus " + text_of(*camera.focus, follows, "focus");
    if (camera.focus_on) text += "  focus_on " + text_of(*camera.focus_on, follows, "focus_on");
    if (camera.blades) text += "  blades " + text_of(*camera.blades, follows, "blades");
    if (lens) text += "\n";
    if (camera.shutter > 0 || camera.shutter_in_frames || any_follows(follows, "shutter"))
        text += (camera.shutter_in_frames ? "  shutter_share " : "  shutter ") +
                text_of(camera.shutter, follows, "shutter") + "\n";
    if (camera.stereo != Stereo::none)
        text.append("  ").append(stereo_words[std::size_t(camera.stereo)]) +=
            " " + text_of(camera.eye_distance, follows, "eyes") + "\n";
    if (camera.convergence) text += "  convergence " + text_of(*camera.convergence, follows, "convergence") + "\n";
    return text + "}\n";
}

std::string write_key(const Keyframe& key, EyeWords words) {
    std::string text =
        "key { time " + text_of(key.time) + "  position " + text_of(key.position) + "  look_at " + text_of(key.look_at);
    if (key.up) text += words.sky ? "  sky " + text_of(DVec3(0) - *key.up) : "  up " + text_of(*key.up);
    if (key.fov) text += words.angle ? "  angle " + text_of(2 * *key.fov) : "  fov " + text_of(*key.fov);
    return text + (key.ease == 0 ? "" : "  ease " + text_of(key.ease)) + " }";
}

std::string write_flythrough(const Flythrough& path, EyeWords words) {
    std::string text = "flythrough {\n  duration " + text_of(path.duration) + "\n";
    if (path.loop) text += "  loop\n";
    for (const Keyframe& key : path.keys) text.append("  ").append(write_key(key, words)).append("\n");
    return text + "}\n";
}

std::string write_music(const Music& music) {
    return "music { bpm " + text_of(music.bpm) + "  rows " + text_of(music.rows) +
           (music.offset == 0 ? "" : "  offset " + text_of(music.offset)) +
           (music.sound.empty() ? "" : "  sound \"" + music.sound + "\"") + " }\n";
}

std::string write_scene(const Scene& scene) {
    std::string text = write_camera(scene.camera, scene.camera_follows) + settings_text(scene.settings);
    if (scene.music != Music{}) text += write_music(scene.music);
    std::string coats;
    for (const Pigment& coat : scene.background_coats) coats += "  coat " + text_of(coat);
    if (scene.background.pattern)
        text += "background { color " + text_of(scene.background) + coats + " }\n";
    else if (scene.background != Pigment(Color(0)) || !scene.background_follows.empty() || !coats.empty())
        text +=
            "background { color " + text_of(scene.background.color, scene.background_follows, "color") + coats + " }\n";
    if (scene.fog) text += fog_text(*scene.fog);
    if (!scene.lights.empty()) text += "\n";
    for (const Light& light : scene.lights) text += light_text(light);
    if (!scene.primitives.empty()) text.append("\n").append(primitives_text(scene.primitives, scene.materials));
    if (scene.flythrough && !scene.flythrough->keys.empty())
        text.append("\n").append(write_flythrough(*scene.flythrough));
    return text;
}

}  // namespace strahl

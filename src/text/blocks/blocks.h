// The words of the language: those of the top level, and the parameters of each block. The parser reads by these lists,
// and the manual's tables are made from them.
#pragma once
#include <algorithm>
#include <array>

#include "scene/scene.h"
#include "text/blocks/pigment.h"
#include "text/blocks/transformations.h"

namespace strahl {

/// Two arrays as one.
template <class T, std::size_t n, std::size_t m>
constexpr std::array<T, n + m> joined(const std::array<T, n>& first, const std::array<T, m>& second) {
    std::array<T, n + m> all;
    std::copy(second.begin(), second.end(), std::copy(first.begin(), first.end(), all.begin()));
    return all;
}

/// The words that may follow the arguments of a body.
inline constexpr auto shape_words = joined(std::array<std::string_view, 2>{"material", "motion"}, transformation_words);

/// The words that may stand in a mesh besides those.
inline constexpr std::array<std::string_view, 3> mesh_words{"file", Triangle::name, SmoothTriangle::name};

/// The words that may follow the corners of a triangle in a mesh.
inline constexpr std::array<std::string_view, 1> triangle_words{"uv_vectors"};

/// The word that may stand in a prism or a lathe besides those, and the words that may follow the start of a contour.
inline constexpr std::array<std::string_view, 1> figure_words{"contour"};
inline constexpr std::array<std::string_view, 2> contour_words{"line", "curve"};

/// The words that may stand in a blob, in a sweep and in a Julia set besides those.
inline constexpr std::array<std::string_view, 1> blob_words{"lump"};
inline constexpr std::array<std::string_view, 2> sweep_words{"through", "towards"};
inline constexpr auto julia_set_words =
    joined(std::array<std::string_view, 2>{"quaternion", "hypercomplex"}, julia_words);

/// The words that open the block of a body.
inline constexpr auto body_words = names_of(std::type_identity<Shape>{});

/// The words that may stand in a union, an intersection or a difference. Bodies that cannot be parts have an error of
/// their own.
inline constexpr auto composite_words = joined(shape_words, body_words);

/// The words that open a block of the top level.
inline constexpr auto block_words =
    joined(joined(std::array<std::string_view, 2>{"camera", "light"}, body_words),
           std::array<std::string_view, 7>{"defaultmaterial", "background", "fog", "global_settings", "flythrough",
                                           "define", "music"});

/// The parameters that `camera` and `key` have in common: the direction up and the angle of view in two ways each.
struct EyeText {
    DVec3 position{0}, look_at{0};
    std::optional<DVec3> up, sky;
    std::optional<double> fov, angle;

    std::optional<DVec3> down() const { return sky ? std::optional(DVec3(0) - *sky) : up; }
    std::optional<double> half_angle() const { return angle ? std::optional(*angle / 2) : fov; }
};
/// `otherwise` is the default of directions and angles in words.
inline std::array<Parameter, 6> eye_parameters(EyeText& eye, std::string_view otherwise) {
    return {{{"position", &eye.position, coordinates, "where the eye is", required},
             {"look_at", &eye.look_at, coordinates, "the point in the middle of the picture", required},
             {"up", &eye.up, coordinates, "the direction that points *down* the picture: `<0, 0, -1>` where z is up",
              otherwise, "sky"},
             {"sky", &eye.sky, coordinates, "the direction that points up the picture"},
             {"fov", &eye.fov, half_angles, "the angle between the middle of the picture and its left or right edge",
              otherwise, "angle"},
             {"angle", &eye.angle, angles, "the angle between its left and right edges: twice `fov`"}}};
}
/// The parameters of a camera besides those.
struct CameraText {
    EyeText eye;
    std::optional<double> aspectratio, fisheye, ultra_wide_angle, spherical, cylinder, cylinder2, cylinder3, cylinder4;
    bool orthographic = false, panoramic = false;
    std::optional<double> aperture, focus, blades, shutter, shutter_share, side_by_side, top_bottom, convergence;
    std::optional<DVec3> focus_on;
};
inline std::array<Parameter, 25> camera_parameters(CameraText& camera) {
    using enum Projection;
    const std::array<Parameter, 19> more{
        {{"aspectratio", &camera.aspectratio, positive, "width / height of what the camera sees", "the picture's"},
         {word_of(orthographic),
          &camera.orthographic,
          {},
          "parallel rays: bodies are as large as in perspective at the distance of `look_at`",
          "perspective"},
         {word_of(panoramic), &camera.panoramic, {}, "180 degrees wide, and as high, without end", "perspective"},
         {word_of(fisheye), &camera.fisheye, wide_angles,
          "in place of `angle`: its angle, the same along all lines through the middle, in a circle", "perspective"},
         {word_of(ultra_wide_angle), &camera.ultra_wide_angle, wide_angles,
          "in place of `angle`: its angle, of a picture without a circle", "perspective"},
         {word_of(spherical), &camera.spherical, wide_angles,
          "in place of `angle`: its angle; columns are longitudes, rows latitudes", "perspective"},
         {word_of(cylinder), &camera.cylinder, wide_angles,
          "in place of `angle`: its angle; columns are longitudes, rows heights on a cylinder", "perspective"},
         {word_of(cylinder2), &camera.cylinder2, wide_angles,
          "the same lying down, its angle that of the picture's height", "perspective"},
         {word_of(cylinder3), &camera.cylinder3, wide_angles,
          "as `cylinder`, but rows look level, from heights on its axis, as if it had the radius 1", "perspective"},
         {word_of(cylinder4), &camera.cylinder4, wide_angles,
          "the same lying down, its angle that of the picture's height", "perspective"},
         {"aperture", &camera.aperture, not_negative, "the radius of the lens; what is not in focus is blurred",
          "everything is sharp"},
         {"focus", &camera.focus, lengths, "the distance from the camera of the plane that is sharp",
          "that of `look_at`", "focus_on"},
         {"focus_on", &camera.focus_on, coordinates, "a point of that plane", "`look_at`"},
         {"blades", &camera.blades, blade_counts, "corners of a lens that is a regular polygon, one of them on top",
          "a round lens"},
         {"shutter", &camera.shutter, seconds, "for how many seconds it is open; what moves meanwhile is blurred",
          "a moment", "shutter_share"},
         {"shutter_share", &camera.shutter_share, not_negative,
          "the same as a share of the time from frame to frame of a film"},
         {stereo_words[1], &camera.side_by_side, not_negative,
          "the distance of two eyes, whose pictures are the left and the right half", "one eye", stereo_words[2]},
         {stereo_words[2], &camera.top_bottom, not_negative, "the same, in the upper and the lower half"},
         {"convergence", &camera.convergence, lengths,
          "the distance of what both eyes see in the same place of their pictures",
          "infinite: eyes look in parallel"}}};
    return joined(eye_parameters(camera.eye, required), more);
}
/// The time of a key: in seconds or, in place of that, in beats of the music.
struct TimeText {
    double time = 0;
    std::optional<double> beat;
};
inline std::array<Parameter, 2> time_parameters(TimeText& when, const char* help) {
    return {{{"time", &when.time, seconds, help, required, "beat"},
             {"beat", &when.beat, seconds, "the same in beats of the `music` above"}}};
}
inline std::array<Parameter, 1> ease_parameter(double& ease) {
    return {{{"ease", &ease, shares, "by what share the movement is slower at the key; with 1 it stops there"}}};
}
inline std::array<Parameter, 9> key_parameters(TimeText& when, EyeText& eye, double& ease) {
    return joined(
        joined(time_parameters(when, "when the camera is there, in seconds"), eye_parameters(eye, "the camera's")),
        ease_parameter(ease));
}
inline std::array<Parameter, 2> flythrough_parameters(Flythrough& path) {
    return {
        {{"duration", &path.duration, lengths, "duration of the flight in seconds", required},
         {"loop", &path.loop, {}, "closes the path: from the last key it continues to the first", "the path ends"}}};
}

/// The parameters of a motion's key.
struct MotionKeyText {
    TimeText when;
    Scale scale;
    DVec3 rotate{0}, translate{0};
    double ease = 0;
};
inline std::array<Parameter, 6> motion_parameters(MotionKeyText& key) {
    const std::array<Parameter, 3> place{
        {{"scale", &key.scale, anything, "factors; each keeps its sign from key to key", "`1`"},
         {"rotate", &key.rotate, anything, "degrees about x, then y, then z"},
         {"translate", &key.translate, coordinates, "by how much the body moves"}}};
    return joined(joined(time_parameters(key.when, "the time of the key in seconds"), place), ease_parameter(key.ease));
}

inline auto light_parameters(Light& light) {
    const std::array<Parameter, 4> place{
        {{"position", &light.position, coordinates, "where the light is", required, "direction"},
         {"direction", &light.direction, directions, "the direction in which parallel light shines"},
         {"from", &light.from, coordinates,
          "a point of the plane from which parallel light comes: bodies behind it cast no shadow",
          "infinitely far away"},
         {"color", &light.color, strengths, "its colour and strength; below 0 it takes light away", required}}};
    return joined(place, field_parameters(light));
}
inline constexpr std::array<std::string_view, 4> light_words{"spot", "edges", "grid", "motion"};
inline std::array<Parameter, 4> spot_parameters(Spot& spot) {
    const Parameter look_at{"look_at", &spot.look_at, coordinates, "a point on the axis of its cone", required};
    return joined(std::array{look_at}, field_parameters(spot));
}
inline std::array<Parameter, 1> background_parameters(Pigment& color) {
    return {{{"color", &color, not_negative, "the colour of rays that hit nothing", required}}};
}
inline auto fog_parameters(Fog& fog) {
    const std::array<Parameter, 2> needed{
        {{"distance", &fog.distance, lengths, "range of sight: over this distance 63 % of the light is lost", required},
         {"color", &fog.color, not_negative, "the colour of the fog", required}}};
    return joined(needed, field_parameters(fog));
}

inline std::array<Parameter, 3> music_parameters(Music& music) {
    return {{{"bpm", &music.bpm, positive, "beats per minute"},
             {"rows", &music.rows, row_counts, "rows of the tracks per beat"},
             {"offset", &music.offset, seconds, "when the first beat is, row 0, in seconds from the start"}}};
}

/// The words that may stand in `music` besides those.
inline constexpr std::array<std::string_view, 1> music_words{"sound"};

/// The numbers of `global_settings` before they are checked.
struct SettingsText {
    Color ambient_light = Settings{}.ambient_light;
    double max_trace_level = Settings{}.max_trace_level;
    std::optional<double> assumed_gamma;
    double adc_bailout = Settings{}.adc_bailout;
};
inline std::array<Parameter, 4> settings_parameters(SettingsText& settings) {
    return {
        {{"ambient_light", &settings.ambient_light, not_negative, "the ambient light, the same everywhere"},
         {"max_trace_level", &settings.max_trace_level, depths,
          "how many generations of rays are traced; camera rays are the first"},
         {"assumed_gamma", &settings.assumed_gamma, gammas,
          "declares that a value v is v^`assumed_gamma` of light, linear light with 1: the window and 8- and 16-bit "
          "files are then sRGB-encoded",
          "values are shown unchanged"},
         {"adc_bailout", &settings.adc_bailout, shares,
          "in scenes with shadowless or fading lights, or with materials' words from `blinn` on, rays of less "
          "weight than this are black"}}};
}

/// Calls visit(word, parameters) for all blocks but those of bodies.
template <class Visit>
void each_block(const Visit& visit) {
    CameraText camera;
    EyeText eye;
    TimeText when;
    double ease = 0;
    Flythrough path;
    MotionKeyText moment;
    Light light;
    Spot spot;
    Pigment background{Color(0)};
    Fog fog;
    SettingsText settings;
    Material material;
    Music music;
    visit("material", field_parameters(material));
    visit("light", light_parameters(light));
    visit("spot", spot_parameters(spot));
    visit("camera", camera_parameters(camera));
    visit("background", background_parameters(background));
    visit("fog", fog_parameters(fog));
    visit("global_settings", settings_parameters(settings));
    visit("flythrough", flythrough_parameters(path));
    visit("key", key_parameters(when, eye, ease));
    visit("motion", motion_parameters(moment));
    visit("music", music_parameters(music));
}

}  // namespace strahl

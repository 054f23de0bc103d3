// Reads scenes of Tachyon: camera, lights and settings; tachyon_bodies.cpp reads the bodies. What the words mean is
// taken from Tachyon's manual and its behaviour; see README.md.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "import/formats.h"
#include "import/tachyon_bodies.h"
#include "num/vec_math.h"
#include "text/reading/messages.h"
#include "text/reading/parameter.h"

namespace strahl {
namespace {

class TachyonReader {
  public:
    TachyonReader(WordReader& words, SceneBuilder& scene) : words(words), scene(scene), bodies(words, scene) {}

    void read() {
        words.expect("BEGIN_SCENE");
        words.expect("RESOLUTION");
        width = words.whole("RESOLUTION", 1, 1 << 20), height = words.whole("RESOLUTION", 1, 1 << 20);
        scene.size = {static_cast<int>(width), static_cast<int>(height)};
        while (!words.peek().empty() && !words.accept("END_SCENE")) read_declaration();
        if (!camera) words.fail_ahead("this scene has no camera: a block 'CAMERA' expected");
        for (Light& light : scene.scene.lights)
            for (int i = 0; i < 3; ++i)
                light.color[i] = std::min(tidy(light.color[i] * light_scale), not_negative.high);
        scene.change_materials([&](Material& m) {
            m.ambient = std::min(tidy(m.ambient + m.diffuse * sky), not_negative.high);
            if (!fading || m.refraction == 0) return;
            const double opacity = 1 - m.refraction;
            for (double* const share : {&m.ambient, &m.diffuse, &m.specular, &m.reflection})
                *share = tidy(*share * opacity);
        });
    }

  private:
    void read_declaration() {
        const std::string_view word = words.take("a declaration");
        const auto is = [&](std::string_view name) { return same_word(word, name); };
        if (bodies.read(word)) return;
        if (is("CAMERA")) return read_camera();
        if (is("BACKGROUND")) return void(scene.scene.background = words.color("BACKGROUND"));
        if (is("BACKGROUND_GRADIENT")) return read_gradient();
        if (is("LIGHT")) return read_light(false);
        if (is("SPOTLIGHT")) return read_light(true);
        if (is("DIRECTIONAL_LIGHT")) return read_directional_light();
        if (is("SKY_LIGHT")) return read_sky_light();
        if (is("SHADER_MODE")) return read_shader_mode();
        if (is("FOG")) return read_fog();
        if (is("START_CLIPGROUP")) return skip_clipping();
        if (is("END_CLIPGROUP")) return;
        if (is("INCLUDE")) return leave_out_file("INCLUDE");
        if (is("MGFFILE")) return leave_out_file("MGFFILE");
        words.fail("unknown declaration " + quoted(word));
    }

    void read_camera() {
        if (camera) words.fail("a second CAMERA: a scene has one");
        camera = true;
        std::string_view projection = "PERSPECTIVE";
        if (words.accept("PROJECTION"))
            projection = words.choose({"PERSPECTIVE", "PERSPECTIVE_DOF", "ORTHOGRAPHIC", "FISHEYE"});
        if (projection == "PERSPECTIVE_DOF") {
            words.number_after("FOCALLENGTH"), words.number_after("APERTURE");
            scene.warn("PERSPECTIVE_DOF: everything is in focus here");
        }
        const double zoom = words.number_after("ZOOM"), pixel = words.number_after("ASPECTRATIO");
        words.number_after("ANTIALIASING");  // an option of `render` here
        const double depth = words.number_after("RAYDEPTH");
        scene.scene.settings.max_trace_level = static_cast<int>(std::clamp(depth, 1., 256.));
        if (scene.scene.settings.max_trace_level != depth) scene.warn("RAYDEPTH is limited to the range from 1 to 256");
        read_eye();
        // Half the sizes of the picture plane at distance 1.
        double tan_y = .5 / zoom, tan_x = tan_y * static_cast<double>(width) / (static_cast<double>(height) * pixel);
        if (words.accept("FRUSTUM")) {
            const double left = words.number("FRUSTUM"), right = words.number("FRUSTUM"),
                         bottom = words.number("FRUSTUM"), top = words.number("FRUSTUM");
            tan_x = (right - left) / 2, tan_y = (top - bottom) / 2;
            if (std::fabs(right + left) > 1e-6 * tan_x || std::fabs(top + bottom) > 1e-6 * tan_y)
                scene.warn(
                    "FRUSTUM: the camera looks at the middle of the picture here, with the same width and height");
        }
        if (projection == "FISHEYE") {
            scene.warn("PROJECTION FISHEYE: a perspective view at most 120 degrees wide instead");
            const double most = std::sqrt(3.) / tan_x;
            if (most < 1) tan_x *= most, tan_y *= most;
        }
        if (projection == "ORTHOGRAPHIC") {  // the picture is as wide at any distance; a wide one looks far away
            eye.projection = Projection::orthographic;
            const DVec3 ahead = eye.look_at - eye.position;
            const double distance = std::max(length(ahead), tan_x);
            eye.look_at = eye.position + distance / length(ahead) * ahead;
            tan_x /= distance, tan_y /= distance;
        }
        set_view(tan_x, tan_y);
        words.expect("END_CAMERA");
    }
    void read_eye() {
        eye.position = bodies.vector_after("CENTER");
        const DVec3 ahead = eye.position + bodies.vector_after("VIEWDIR");
        eye.look_at = {tidy(ahead.x), tidy(ahead.y), tidy(ahead.z)};
        eye.up = -bodies.vector_after("UPDIR");
    }
    void set_view(double tan_x, double tan_y) {
        const double fov = std::atan(tan_x) * 180 / std::numbers::pi, ratio = tan_x / tan_y;
        if (!half_angles.contains(fov) || !(ratio > 1e-9 && ratio < 1e9))
            words.fail("invalid camera: its ZOOM, ASPECTRATIO or FRUSTUM is not greater than 0");
        eye.fov = std::clamp(std::round(fov * 1e6) / 1e6, 1e-6, 90 - 1e-6);
        if (std::fabs(ratio * static_cast<double>(height) / static_cast<double>(width) - 1) > 1e-6)
            eye.aspectratio = tidy(ratio);
        scene.set_camera(eye);
    }

    /// Reads a point light. In Tachyon it is seen as a ball, which casts no shadow.
    void read_light(bool spot) {
        Light light{.position = bodies.vector_after("CENTER"), .color = Color(1)};
        if (words.number_after("RAD") > 0) scene.warn("the lamp's ball is not shown: lights are points here");
        if (spot) {
            light.spot = Spot{.look_at = light.position + bodies.vector_after("DIRECTION")};
            light.spot->radius = words.number_after("FALLOFF_START");
            light.spot->falloff = words.number_after("FALLOFF_END");
        }
        if (words.accept("ATTENUATION")) {
            words.number_after("CONSTANT"), words.number_after("LINEAR"), words.number_after("QUADRATIC");
            scene.warn("ATTENUATION: light does not weaken with distance here");
        }
        light.color = words.color_after("COLOR");
        scene.add_light(light);
    }
    void read_directional_light() {
        Light light{.direction = bodies.vector_after("DIRECTION")};
        light.color = words.color_after("COLOR");
        scene.add_light(light);
    }

    /// Reads a background that goes from one colour to the other as the ray's direction turns along an axis.
    void read_gradient() {
        const bool sphere = words.choose({"SKY_SPHERE", "SKY_ORTHO_PLANE"}) == "SKY_SPHERE";
        const DVec3 up = bodies.vector_after("UPDIR");
        const double top_at = words.number_after("TOPVAL"), bottom_at = words.number_after("BOTTOMVAL");
        const Color top = words.color_after("TOPCOLOR"), bottom = words.color_after("BOTTOMCOLOR");
        constexpr double most = 1.5;  // gradients repeat: this one after 2 * most
        const double size = length(up);
        if (!sphere || !(size > 0 && std::isfinite(size)) ||
            !(-most <= bottom_at && bottom_at < top_at && top_at <= most)) {
            scene.scene.background = .5 * (top + bottom);
            return scene.warn("BACKGROUND_GRADIENT: the mean of both colours everywhere");
        }
        const auto stop_at = [&](double v) { return tidy((v + most) / (2 * most)); };
        const DVec3 axis = up / size;
        scene.scene.background = Pigment({.kind = Gradient{axis},
                                          .colors = {{stop_at(bottom_at), bottom}, {stop_at(top_at), top}},
                                          .transformations = {Scale{DVec3(2 * most)}, Translate{-most * axis}}});
    }
    /// Adds the light of the sky to the ambient light, from which nothing of the sky is hidden.
    void add_sky(const Color& color) {
        sky += (color.x + color.y + color.z) / 3;
        scene.warn("ambient occlusion: ambient light that no body blocks instead");
    }
    void read_sky_light() {
        words.number_after("NUMSAMPLES");
        add_sky(words.color_after("COLOR"));
    }
    void read_shader_mode() {
        const std::string_view mode = words.choose({"FULL", "MEDIUM", "LOWEST", "LOW"});
        if (mode != "FULL") scene.warn("SHADER_MODE " + std::string(mode) + ": there are shadows and all else here");
        for (;;) {
            const std::string_view word = words.take("END_SHADER_MODE");
            const auto is = [&](std::string_view name) { return same_word(word, name); };
            if (is("END_SHADER_MODE")) return;
            if (is("AMBIENT_OCCLUSION")) {
                const Color color = words.color_after("AMBIENT_COLOR");
                light_scale = words.number_after("RESCALE_DIRECT");
                if (!not_negative.contains(light_scale))
                    words.fail("RESCALE_DIRECT must be " + std::string(not_negative.words));
                words.number_after("SAMPLES");
                add_sky(color);
            } else if (is("TRANS_VMD")) {
                fading = true;
            } else if (is("TRANS_ORIG")) {
                fading = false;
            } else if (is("TRANS_MAX_SURFACES")) {
                words.number("TRANS_MAX_SURFACES");
                scene.warn("TRANS_MAX_SURFACES: all transparent bodies are seen here");
            } else if (is("SHADOW_FILTER_OFF") || is("TRANS_RASTER3D") || is("FOG_VMD")) {
                scene.warn(std::string(word) + " has no counterpart and is left out");
            } else if (!is("SHADOW_FILTER_ON")) {
                words.fail("unknown word " + quoted(word) + " in SHADER_MODE");
            }
        }
    }
    void read_fog() {
        const std::string kind(same_word(words.peek(), "START") ? "OFF"
                                                                : words.choose({"LINEAR", "EXP", "EXP2", "OFF"}));
        const double start = words.number_after("START");
        words.number_after("END");
        const double density = words.number_after("DENSITY");
        const Color color = words.color_after("COLOR");
        if (kind == "OFF" || density == 0) return;
        if (kind != "EXP") return scene.warn("FOG " + kind + " is left out: fog is EXP here");
        if (start > 0) scene.warn("FOG: it starts at the eye here");
        scene.set_fog({.distance = tidy(1 / density), .color = color});
    }
    void skip_clipping() {
        words.expect("NUMPLANES");
        const long numbers = 4 * words.whole("NUMPLANES", 0, 1'000'000'000);
        for (long i = 0; i < numbers; ++i) words.number("a clipping plane");
        scene.warn("START_CLIPGROUP: bodies are not clipped here");
    }
    void leave_out_file(const char* word) {
        const std::string name = quoted(words.take("a file"));
        scene.warn(std::string(word) + " " + name + " is left out; import that file by itself");
    }

    WordReader& words;
    SceneBuilder& scene;
    TachyonBodies bodies;
    Camera eye;
    long width = 1, height = 1;
    double light_scale = 1, sky = 0;
    bool camera = false, fading = false;
};

}  // namespace

bool is_tachyon(WordReader& words) { return same_word(words.peek(), "BEGIN_SCENE"); }

void read_tachyon(WordReader& words, SceneBuilder& scene) { TachyonReader(words, scene).read(); }

}  // namespace strahl

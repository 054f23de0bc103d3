// Reads the Neutral File Format, as E. Haines describes version 3.1; see README.md.
#include <cmath>
#include <vector>

#include "import/formats.h"
#include "text/reading/messages.h"
#include "text/reading/parameter.h"

namespace strahl {
namespace {

class NffReader {
  public:
    NffReader(WordReader& words, SceneBuilder& scene) : words(words), scene(scene) {}

    void read() {
        if (same_word(words.peek(), "nff"))
            words.fail_ahead("this is the NFF of the WorldToolKit, another format; E. Haines' NFF expected");
        while (!words.peek().empty()) read_entity();
        if (!camera) words.fail_ahead("this scene has no camera: an entity 'v' expected");
        light_evenly();
    }

  private:
    void read_entity() {
        const std::string_view entity = words.take("an entity");
        if (same_word(entity, "v")) return read_view();
        if (same_word(entity, "b")) return read_background();
        if (same_word(entity, "l")) return read_light();
        if (same_word(entity, "f")) return read_material();
        if (same_word(entity, "s")) return read_sphere();
        if (same_word(entity, "c")) return read_cone();
        if (same_word(entity, "p")) return read_polygon(false);
        if (same_word(entity, "pp")) return read_polygon(true);
        words.fail("unknown entity " + quoted(entity) +
                   "; NFF has v, b, l, f, s, c, p and pp. (A scene of Tachyon starts with BEGIN_SCENE.)");
    }

    void read_view() {
        if (camera) words.fail("a second 'v': a scene has one camera");
        camera = true;
        Camera view;
        double angle = 0;
        bool from = false, at = false, up = false;
        for (std::string_view word; !(word = words.peek()).empty();) {
            if (words.accept("from"))
                view.position = words.vector("'from'"), from = true;
            else if (words.accept("at"))
                view.look_at = words.vector("'at'"), at = true;
            else if (words.accept("up"))
                view.up = -words.vector("'up'"), up = true;
            else if (words.accept("angle"))
                angle = read_angle();
            else if (words.accept("hither"))
                read_clipping("hither", "nearer");
            else if (words.accept("yon"))
                read_clipping("yon", "further away");
            else if (words.accept("resolution"))
                read_resolution();
            else
                break;
        }
        if (!from || !at || !up || angle == 0) words.fail_ahead("'from', 'at', 'up' and 'angle' expected after 'v'");
        view.fov = angle / 2;
        scene.set_camera(view);
    }
    double read_angle() {
        const double angle = words.number("'angle'");
        if (!half_angles.contains(angle / 2)) words.fail("'angle' must be greater than 0 and less than 180 degrees");
        return angle;
    }
    void read_clipping(const char* word, const char* where) {
        if (words.number(word) > 0)
            scene.warn(std::string("'") + word + "': bodies that are " + where + " are shown too");
    }
    void read_resolution() {
        const auto width = static_cast<int>(words.whole("'resolution'", 1, 1 << 20));
        scene.size = {width, static_cast<int>(words.whole("'resolution'", 1, 1 << 20))};
    }

    void read_background() { scene.scene.background = words.color("the background"); }
    void read_light() {
        Light light;
        light.position = words.vector("the light's position");
        const std::size_t before = scene.scene.lights.size();
        const bool colored = words.number_in_line();
        if (colored) light.color = words.color("the light's colour");
        scene.add_light(light);
        if (!colored && scene.scene.lights.size() > before) even.push_back(before);
    }
    /// Gives lights without a colour the strength 1 / sqrt(number of lights), rounded to six digits.
    void light_evenly() {
        auto& lights = scene.scene.lights;
        for (const std::size_t i : even)
            lights[i].color = Color(std::round(1e6 / std::sqrt(static_cast<double>(lights.size()))) / 1e6);
    }

    void read_material() {
        Material m;
        m.rgb = words.vector("the colour");
        m.ambient = 0;
        m.diffuse = words.number("Kd");
        m.specular = m.reflection = words.number("Ks");
        m.pow = words.number("the shine");
        m.refraction = words.number("the transmittance");
        m.ior = words.number("the index of refraction");
        if (m.refraction == 0) m.ior = 1;  // opaque bodies often have 0, which means nothing
        scene.set_material(m);
        material = true;
    }
    void need_material() {
        if (material) return;
        scene.warn("no material: there is no 'f' before this body; it gets the default material");
        scene.set_material(Material());
        material = true;
    }
    /// Reads a radius. A negative one means that the body is seen from inside only.
    double read_radius(const char* what) {
        const double radius = words.number(what);
        if (radius < 0) scene.warn("a negative radius: bodies are seen from both sides");
        return std::fabs(radius);
    }
    void read_sphere() {
        const DVec3 centre = words.vector("the centre");
        const double radius = read_radius("the radius");
        need_material();
        scene.add(Sphere{centre, radius});
    }
    void read_cone() {
        const DVec3 base = words.vector("the base");
        const double base_radius = read_radius("the base's radius");
        const DVec3 apex = words.vector("the apex");
        const double apex_radius = read_radius("the apex's radius");
        need_material();
        scene.warn("cones and cylinders are open tubes in NFF; here they are closed");
        if (base_radius == apex_radius)
            scene.add(Cylinder{base, apex, base_radius});
        else
            scene.add(Cone{base, base_radius, apex, apex_radius});
    }
    void read_polygon(bool smooth) {
        const long count = words.whole("the number of corners", 3, 1'000'000'000);
        points.clear(), normals.clear();
        for (long i = 0; i < count; ++i) {
            points.push_back(words.vector("a corner"));
            if (smooth) normals.push_back(words.vector("a corner's normal"));
        }
        need_material();
        scene.add_polygon(points, normals);
    }

    WordReader& words;
    SceneBuilder& scene;
    bool camera = false, material = false;
    std::vector<std::size_t> even;  // numbers of the lights without a colour
    std::vector<DVec3> points, normals;
};

}  // namespace

void read_nff(WordReader& words, SceneBuilder& scene) { NffReader(words, scene).read(); }

}  // namespace strahl

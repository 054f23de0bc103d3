// Scenes of POV-Ray: those of the project beside POV-Ray's stored pictures, and scenes that are written for POV-Ray and
// read again.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "image/picture.h"
#include "num/vec_math.h"
#include "pov/open_scene.h"
#include "povref/convert/pov_scene.h"
#include "scene/leaves.h"
#include "scene/moving_scene.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/povref/agreement.h"
#include "tests/unit/scratch.h"
#include "text/parse.h"

using namespace strahl;

namespace {

/// Every .pov file in scenes/pov.
std::vector<std::filesystem::path> pov_scenes() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(STRAHL_SOURCE "/scenes/pov")) paths.push_back(entry);
    std::ranges::sort(paths);
    return paths;
}

/// Does POV-Ray's text say something of the scene in another way, which cannot be read back?
bool holds_more(const Scene& scene) {
    const auto shown_otherwise = [](const auto& own) {
        return own.pattern && !std::holds_alternative<Checker>(own.pattern->kind) &&
               !std::holds_alternative<Brick>(own.pattern->kind);
    };
    for (const Material& own : scene.materials)
        if (shown_otherwise(own.rgb) || own.bends()) return true;
    for (const Light& light : scene.lights)
        if (light.area && !(light.soft && light.area->columns > 0)) return true;
    return shown_otherwise(scene.background) || Movers(scene).any() || !scene.tracks.empty();
}

bool near(const DVec3& a, const DVec3& b) { return length(a - b) <= 1e-12 * std::max({1., length(a), length(b)}); }

/// Are two shapes the same body? Of planes and toruses POV-Ray's text has other numbers.
bool same_body(const Shape& a, const Shape& b) {
    if (a == b) return true;
    if (a.index() != b.index()) return false;
    if (const auto* const p = std::get_if<Plane>(&a)) {
        const Plane& q = std::get<Plane>(b);
        return near(p->normal(), q.normal()) &&
               std::fabs(dot_product(p->normal(), p->a) - dot_product(q.normal(), q.a)) < 1e-9;
    }
    if (const auto* const p = std::get_if<Torus>(&a)) {
        const Torus& q = std::get<Torus>(b);
        return near(p->centre, q.centre) && near(normalize(p->axis), normalize(q.axis)) && p->major == q.major &&
               p->minor == q.minor;
    }
    if (const auto* const p = std::get_if<Disc>(&a)) {
        const Disc& q = std::get<Disc>(b);
        return near(normalize(p->normal), normalize(q.normal)) && p->centre == q.centre && p->radius == q.radius;
    }
    if (const auto* const p = std::get_if<Cuboid>(&a)) {
        const Box m = p->bounds(), n = std::get<Cuboid>(b).bounds();
        return m.low == n.low && m.high == n.high;
    }
    if (const ContourData* const data = contours_of(a)) {
        const auto* const p = std::get_if<Prism>(&a);
        const auto* const q = std::get_if<Prism>(&b);
        if (p && std::minmax(p->base, p->top) != std::minmax(q->base, q->top)) return false;
        return std::ranges::equal(data->pieces, contours_of(b)->pieces, [](const auto& piece, const auto& again) {
            return std::hypot(piece.ax - again.ax, piece.ay - again.ay, piece.hx - again.hx) < 1e-9;
        });
    }
    if (const auto* const p = std::get_if<Mesh>(&a))
        return p->data->triangles.size() == std::get<Mesh>(b).data->triangles.size();
    return false;
}

}  // namespace

TEST_CASE("scenes of POV-Ray agree with its stored pictures") {
    int count = 0;
    for (const std::filesystem::path& path : pov_scenes()) {
        CAPTURE(path);
        const OpenedScene opened = open_scene(read_text(path), path, {}, read_pixels);
        CHECK(opened.summary == "opens whole");
        const View view{.camera = opened.scene.camera,
                        .width = picture_width,
                        .height = picture_height,
                        .depth = opened.scene.settings.max_trace_level};
        Tracer tracer(opened.scene, Precision::float64);
        const std::string name = path.stem().string();
        const Verdict verdict = judge(tracer, view, render(opened.scene, view),
                                      read_picture(STRAHL_SOURCE "/povref/reference/pov/" + name + ".png"));
        CHECK_MESSAGE(fault(verdict, {}).empty(), name, ": ", fault(verdict, {}));
        ++count;
    }
    CHECK(count >= 8);
}

TEST_CASE("scenes survive the way to POV-Ray's text and back") {
    const Scratch folder;
    int checked = 0;
    // POV-Ray keeps colours in single precision, which those of random scenes do not have.
    const auto check = [&](const std::string& name, Scene scene, bool random) {
        CAPTURE(name);
        if (holds_more(scene)) return;
        const PovFiles files = write_pov(scene, {.pov_path = "x.pov",
                                                 .picture_path = "x.png",
                                                 .cameras = {scene.camera},
                                                 .depth = scene.settings.max_trace_level});
        // Where POV-Ray's tolerances would be seen its scene is this many times as large.
        const std::string declared = "#declare Unit = ";
        const std::size_t at = files.pov.find(declared);
        const double unit = at == files.pov.npos ? 1 : std::stod(files.pov.substr(at + declared.size()));
        const Scene again = open_scene(files.pov, folder / "x.pov", {}, read_pixels).scene;
        ++checked;
        const auto same_color = [random](const Color& a, const Color& b) {
            return random ? length(a - b) < 1e-6 * (1 + length(a)) : a == b;
        };
        scene.settings.passed_over = 1e-4, scene.settings.farthest = 1e7;  // of POV-Ray's scenes
        if (!random) CHECK(again.settings == scene.settings);
        CHECK(same_color(again.background.color, scene.background.color));
        CHECK(again.background.pattern == scene.background.pattern);
        if (scene.fog) scene.fog->distance *= unit, scene.fog->altitude *= unit, scene.fog->offset *= unit;
        CHECK(again.fog == scene.fog);
        const CameraFrame a = frame_of(scene.camera, 4. / 3), b = frame_of(again.camera, 4. / 3);
        CHECK(near(again.camera.position, unit * scene.camera.position));
        CHECK(again.camera.fov == doctest::Approx(scene.camera.fov).epsilon(1e-12));
        CHECK((near(a.right, b.right) && near(a.down, b.down) && near(a.forward, b.forward)));
        REQUIRE(again.lights.size() == scene.lights.size());
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            Light own = scene.lights[i];
            own.position *= unit;
            if (own.spot) own.spot->look_at *= unit;
            if (own.area) own.area->u *= unit, own.area->v *= unit;
            if (own.from) CHECK((again.lights[i].from && near(*again.lights[i].from, unit * *own.from)));
            CHECK(same_color(again.lights[i].color, own.color));
            own.color = again.lights[i].color;
            if (!own.direction) CHECK(again.lights[i] == own);
        }
        // Opaque bodies come first in POV-Ray's text.
        std::ranges::stable_partition(scene.primitives, [&](const Primitive& own) { return !transparent(scene, own); });
        REQUIRE(again.primitives.size() == scene.primitives.size());
        for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
            CAPTURE(i);
            const Primitive &own = scene.primitives[i], &back = again.primitives[i];
            const bool composite = leaves_of(own.shape) > 1;
            const Torus* const torus = std::get_if<Torus>(&own.shape);
            const bool closed = torus && torus->major < torus->minor;  // becomes a union with a ball
            // The text has normals of length 1, and the materials of a composite at its parts.
            const bool smooth = std::holds_alternative<SmoothTriangle>(own.shape);
            if (random && smooth) continue;
            if (!composite && !closed) CHECK(same_body(own.shape, back.shape));
            // Closed toruses in random composites become unions as well.
            if (!random || !composite) CHECK(leaves_of(back.shape) == (closed ? 2 : leaves_of(own.shape)));
            std::vector<Transformation> steps = own.transformations;
            if (unit != 1) steps.push_back(Scale{DVec3(unit)});
            CHECK(back.transformations == steps);
            if (random && composite) continue;
            const Material &m = scene.materials[std::size_t(own.material)],
                           &n = again.materials[std::size_t(back.material)];
            // Without lights, which would give it a shadow, the colour of clear glass is seen nowhere.
            if (m.diffuse > 0 || m.ambient > 0 || !scene.lights.empty()) CHECK(same_color(n.rgb.color, m.rgb.color));
            CHECK(n.fade_distance == doctest::Approx(unit * m.fade_distance).epsilon(1e-6));
            CHECK(same_color(n.fade_color, m.fade_color));
            if (m.refraction > 0) CHECK(n.ior == doctest::Approx(m.ior).epsilon(1e-7));
            for (double Material::*const number : {&Material::reflection, &Material::refraction, &Material::diffuse,
                                                   &Material::ambient, &Material::specular, &Material::conserve,
                                                   &Material::seen, &Material::mirrored, &Material::fade_power})
                CHECK(n.*number == doctest::Approx(m.*number).epsilon(1e-6));
            if (m.specular > 0)
                CHECK_MESSAGE(std::fabs(n.pow - m.pow) <= (random ? 1e-5 * m.pow : 0), m.pow, " is ", n.pow);
        }
    };
    for (const std::string& name : scene_names()) check(name, read_scene(name), false);
    CHECK(checked > 40);
    for (std::uint64_t seed = 1; seed <= 200; ++seed)
        check("random scene " + std::to_string(seed), random_scene(seed, {.any_kind = .5, .levels = 2}), true);
    CHECK(checked > 240);
}

TEST_CASE("mixed materials, beams and light from behind survive that way as well") {
    const Scene scene = parse_scene(R"(
camera { position <0, -5, 3>  look_at <0, 0, 1>  sky <0, 0, 1>  angle 40 }
light { direction <0, 0, -1>  from <0, 0, 9>  color <1, 1, 1>  beam 4  core 3  tightness .5 }
defaultmaterial { specular 0  reflection 0 }
sphere { <0, 0, 1>, 1  material { rgb <.75, .5, .25>  share checker { <1, 1, 1>, <0, 0, 0> }  blinn .5
    coat { rgb <0, 1, 0>  reflection .5  share checker { <0, 0, 0>, checker { <1, 1, 1>, <0, 0, 0>  scale .5 } } }
    coat { rgb <1, 0, 0, 0, .5>  diffuse .25 }
    coat { rgb <0, 0, 1>  ambient 1  share checker { <0, 0, 0>, checker { <0, 0, 0>, <1, 1, 1>  scale .5 } } } } }
disc { <3, 0, 1>, <0, 0, 1>, 1  material { rgb <1, 1, 1>  diffuse .5  behind .25 } }
disc { <6, 0, 1>, <0, 0, 1>, 1  material { rgb <1, 1, 1>  both_sides 1 } }
sphere { <9, 0, 1>, 1  material { rgb <1, 0, 0>  inside 0  coat { rgb <0, 1, 0>  reflection .5  outside 0 } } }
sphere { <12, 0, 1>, 1  material { rgb <1, 0, 0>  group 5  common 0 } }
light { position <9, 0, 5>  color <-1, 0, .5>  group 5 }
)",
                                    "x");
    const PovFiles files = write_pov(scene, {.pov_path = "x.pov", .picture_path = "x.png", .cameras = {scene.camera}});
    const Scratch folder;
    const Scene again = open_scene(files.pov, folder / "x.pov", {}, read_pixels).scene;
    const auto material = [](const Scene& of, std::size_t i) {
        return of.materials[std::size_t(of.primitives.at(i).material)];
    };
    const Material mixed = material(scene, 0), back = material(again, 0);
    REQUIRE((mixed.coats.size() == 3 && back.coats.size() == 3));
    CHECK(back.share == mixed.share);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(back.coats[i].share == mixed.coats[i].share);
        CHECK(back.coats[i].rgb == mixed.coats[i].rgb);
        CHECK(back.coats[i].reflection == mixed.coats[i].reflection);
    }
    CHECK((material(again, 1).behind == .25 && material(again, 2).both_sides == 1));
    const Material grouped = material(again, 3), sides = material(again, 4);
    REQUIRE(sides.coats.size() == 1);
    CHECK((sides.outside == 1 && sides.inside == 0 && sides.coats[0].outside == 0 && sides.coats[0].reflection == .5));
    REQUIRE(again.lights.size() == 2);
    CHECK((again.lights[1].color == Color(-1, 0, .5) && again.lights[1].group > 0));
    CHECK((grouped.group == again.lights[1].group && grouped.common == 0));
    const Light& beam = again.lights[0];
    REQUIRE(beam.from);
    CHECK((beam.core == .75 * beam.beam && beam.from->z == 2.25 * beam.beam && beam.tightness == .5));
}

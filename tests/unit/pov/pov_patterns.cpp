// Patterns of POV-Ray's scenes that scene text has no words for. The expected values are what POV-Ray 3.7.0.10 prints
// by #debug str(F(...), 0, 9) for `#declare F = function { pattern { ... } }`.
#include "tests/referee/pattern.h"
#include "tests/unit/pov/opened.h"
#include "text/blocks/materials.h"

using namespace strahl;

namespace {

struct Row {
    const char* text;
    double near, far;  // at <.31, .42, .05> and at <-.7, 1.3, .6>
};
constexpr Row rows[]{
    {"checker warp{turbulence .3 octaves 3} scale .3", 1, 0},
    {"brick turbulence .2 scale .1", 1, 1},
    {"hexagon scale .2", 2, 2},
    {"bozo warp{repeat x*.5} scale .3", 0.663146132, 0.597218193},
    {"bozo warp{repeat x*.5 flip x offset <0,.2,.1>} rotate 20*z scale .4", 0.545446682, 0.680436958},
    {"wood warp{black_hole <.3,.2,0>,.5 strength 1.5} scale .5", 0.088041302, 0.094110776},
    {"wood warp{black_hole <.3,.2,0>,.5 strength 1.5 falloff 1 inverse}", 0.769967636, 0.952944612},
    {"gradient x warp{black_hole <.2,.2,.2>,.15 repeat <.5,.5,.5> turbulence <.1,.1,.1>} scale .5", 0.62, 0.60001},
    {"checker scale .1 warp{cylindrical}", 1, 1},
    {"checker scale .1 warp{spherical} rotate 30*x", 1, 0},
    {"checker scale .1 warp{toroidal orientation y dist_exp 1 major_radius .5}", 0, 0},
    {"checker scale .1 warp{planar y,.05}", 0, 1},
    {"checker scale .1 warp{cubic}", 0, 1},
    {"marble turbulence .5 warp{turbulence .4 lambda 1.5} scale .3", 0.217666767, 0.408476272},
    {"spiral1 3 scale .3", 0.206194534, 0.685265364},
    {"spiral2 2 turbulence .2 scale .3", 0.898345244, 0.695946925},
    {"mandel 50 scale .3 translate <.6,.5,0>", 0.42, 0},
    {"mandel 30 exponent 3 interior 1,.8 exterior 6,.3 scale .4 translate .5", 0.357940991, 0.511923947},
    {"julia <.3,.5>,40 scale .4 translate .5 exterior 3,.5", 0.245823817, 0.25005},
    {"magnet 1 mandel 40 scale .1 translate .5", 0.075, 0.025},
    {"magnet 1 julia <1.3,.8>,20 scale .2 translate .5 interior 1,1", 0.04400699, 0.1},
    {"magnet 2 mandel 30 scale .1 translate .5", 0.033333333, 0},
    {"magnet 2 julia <.6,.8>,20 scale .2 translate .5", 1, 1},
    {"function { x*x+sin(9*y) }", 0.500182776, 0.728016416},
    {"function { f_noise3d(4*x,5*y,z)*1.3 } triangle_wave frequency 3", 0.436405706, 0.024232752},
    {"crackle form <1,0,0> scale .2", 0.586940368, 0.563622153},
    {"crackle form <-1,.5,.5> metric 1 scale .2", 0.583679141, 0.243668447},
    {"crackle form <1,-.2,0> metric 3 offset .2 scale .2", 0.442501113, 0.383652539},
    {"crackle solid scale .2", 0.553402459, 0.596703487},
    {"object { sphere { 0, .3 } translate <.3, .4, 0> } scale 1.1", 1, 0},
    {"radial rotate 90*x translate .5", 0.563426817, 0.406416479},
    {"gradient x poly_wave 2", 0.0961, 0.09},
    {"agate agate_turb .3", 0.999957833, 0.262904077},
    {"agate agate_turb 2.5 octaves 4 scale .4", 0.905385951, 0.941737440},
    {"agate agate_turb 0 turbulence .2", 0.583880520, 0.375792165},
    {"marble poly_wave .5 turbulence .3 scale .3", 0.422670722, 0.135656621},
};

/// Returns a number that a scene computes.
double computed(const std::string& declarations, const std::string& number) {
    const std::string noise = "#declare f_noise3d = function { internal(76) } ";
    const std::string text = noise + declarations + " sphere { <" + number + ", 0, 0>, 1 }";
    return shape<Sphere>(whole(text)).centre.x;
}

}  // namespace

TEST_CASE("POV-Ray: values of warped patterns, fractals, functions and lists") {
    for (const Row& row : rows) {
        CAPTURE(row.text);
        const std::string function = std::string("#declare F = function { pattern { ") + row.text + " } }";
        CHECK(computed(function, "F(.31, .42, .05)") == doctest::Approx(row.near).epsilon(1e-7));
        CHECK(computed(function, "F(-.7, 1.3, .6)") == doctest::Approx(row.far).epsilon(1e-7));
    }
}

TEST_CASE("POV-Ray: entries of maps may be expressions that begin with a number") {
    const std::string text =
        "#declare C = rgb <1, .5, .2>; #declare P = function { pigment { gradient x color_map { [0 .5*C] [1 C*.2] } } "
        "}";
    CHECK(computed(text, "P(.25, 0, 0).red") == doctest::Approx(.425));
    CHECK(computed(text, "P(.25, 0, 0).blue") == doctest::Approx(.085));
}

TEST_CASE("POV-Ray: pigments in pigments have the colours of the same pigments as functions") {
    for (const std::string& pigment : std::vector<std::string>{
             "hexagon scale .2", "object { sphere { 0, 1 } rotate x rgb x, 0 } scale .5",
             "brick rgb x turbulence .3 scale .1", "cubic", "square rgb x, rgb y scale .3 rotate 20*x",
             "average pigment_map { [1 granite] [2 bozo scale .1 rotate 30*z] [.5 rgb x] }",
             "average pigment_map { [2 rgb x] } translate y",
             "average pigment_map { [1 agate] [1 wood scale .3] [2 leopard] [1 rgb y] [3 gradient y] } scale .7",
             "bozo pigment_map { [.3 wood scale .1] [.7 granite] } turbulence .5 scale .3",
             "checker pigment { leopard scale .05 } pigment { rgb x } warp { turbulence .5 } scale .3",
             "gradient x pigment_map { [0 average pigment_map { [1 bozo scale .1] [2 rgb z] }] [1 hexagon scale .1] } "
             "warp { spherical } rotate 20*y",
             "wood pigment_map { [0 checker pigment { radial turbulence .2 rotate 30*x } pigment { onion } scale .3] "
             "[1 marble turbulence .3] } scale .5 warp { repeat y*.7 flip y } translate .1"}) {
        CAPTURE(pigment);
        for (const bool mirrored : {false, true}) {
            const Scene scene = whole("sphere { 0, 1 pigment { " + pigment + " } }", !mirrored);
            const referee::Paint<double> paint(material(scene).rgb, glm::dmat4(1));
            for (const DVec3 point : {DVec3(.31, .42, .05), DVec3(-.7, 1.3, .6), DVec3(.11, -.62, -.83)}) {
                const DVec3 p(point.x, point.y, mirrored ? -point.z : point.z);
                const auto color = paint.at(referee::Vector<double>(p));
                const std::string declared = "#declare F = function { pigment { " + pigment + " } } #declare C = F(" +
                                             std::to_string(point.x) + ", " + std::to_string(point.y) + ", " +
                                             std::to_string(point.z) + ");";
                CHECK(color.x == doctest::Approx(computed(declared, "C.red")).epsilon(1e-6));
                CHECK(color.y == doctest::Approx(computed(declared, "C.green")).epsilon(1e-6));
                CHECK(color.z == doctest::Approx(computed(declared, "C.blue")).epsilon(1e-6));
            }
        }
    }
}

TEST_CASE("POV-Ray: patterns of textures are patterns of their pigments") {
    const Scene scene = whole(
        "sphere { 0, 1 texture { gradient x texture_map { [.3 pigment { rgb x }] "
        "[.7 pigment { rgb z }] } } }");
    const Pattern& pattern = *material(scene).rgb.pattern;
    CHECK(pattern.colors.at(0).color == Color(1, 0, 0));
    CHECK(pattern.colors.at(1).color == Color(0, 0, 1));
    // There are up to eight layers with finishes of their own.
    std::string many;
    for (int i = 1; i <= 9; ++i) many += "[." + std::to_string(i) + " finish { phong ." + std::to_string(i) + " }]";
    CHECK(says(notes_of("sphere { 0, 1 texture { gradient x texture_map { " + many + " } } }"),
               "the finish of a pattern of textures is that of one of them"));
}

TEST_CASE("POV-Ray: materials whose inner patterns differ have other hashes, so that thousands are told apart soon") {
    const auto same = [](const std::string& one, const std::string& other) {
        const auto ball = [](const std::string& inner) {
            return ", 1 pigment { checker pigment { " + inner + " } rgb 1 } } ";
        };
        const Scene scene = whole("sphere { 0" + ball(one) + "sphere { 3*x" + ball(other));
        return MaterialHash()(material(scene, 0)) == MaterialHash()(material(scene, 1));
    };
    CHECK(same("bozo scale .1", "bozo scale .1"));
    CHECK_FALSE(same("bozo scale .1", "bozo scale .2"));
    CHECK_FALSE(same("function { x }", "function { y }"));
}

TEST_CASE("POV-Ray: blended normals are those of their parts, each of length 1") {
    const DVec3 normal = normalize(DVec3(1, 2, -2));
    const auto bent = [&](const std::string& text) {
        const Bump bump = material(opened("sphere { 0, 1 normal { " + text + " } }").scene).bump;
        const auto& solid = std::get<SolidPattern>(bump.pattern->kind);
        return normalize(normal + bump.height * bend_at(solid, {.3, .4, .5}, normal));
    };
    // Bumps that are the same everywhere in a map are these bumps.
    const DVec3 one = bent("granite .3"), other = bent("bumps .8");
    CHECK(length(one - other) > .1);
    for (const char* const map : {"average normal_map { [1 granite .3] [2 granite .3] }",
                                  "checker normal { granite .3 } "
                                  "normal { granite .3 }",
                                  "bozo normal_map { [.2 granite .3] [.6 granite .3] }",
                                  "average normal_map { [1 average normal_map { [1 granite .3] }] }",
                                  "granite .3 slope_map { [0 <0, 1>] [1 <1, 1>] }"})
        CHECK(length(bent(map) - one) < 1e-7);
    CHECK(length(bent("average normal_map { [1 granite .3] [1 bumps 0] }") - normalize(one + normal)) < 1e-7);
    CHECK(length(bent("average normal_map { [1 granite .3] [3 bumps .8] }") - normalize(one + 3. * other)) < 1e-7);
    const DVec3 between = bent("gradient y normal_map { [.2 granite .3] [1 bumps .8] }");
    CHECK(length(between - normalize(.75 * one + .25 * other)) < 1e-6);
    // Steps of a part or before a warp move its points; the normal has length 1 in that space too.
    const DVec3 size(2, .1, -3), there = normalize(size * normal);
    const SolidPattern granite{.solid = Solid::granite, .wave = 0};
    const DVec3 moved = normalize((there + .3 * bend_at(granite, DVec3(.3, .4, .5) / size, there)) / size);
    CHECK(length(moved - one) > .1);
    for (const char* const text : {"average normal_map { [1 granite .3 scale <2, .1, -3>] }",
                                   "granite .3 scale <2, .1, -3> warp { repeat 100 * x }",
                                   "granite .3 slope_map { [0 <0, 1>] [1 <1, 1>] } scale <2, .1, -3> "
                                   "warp { repeat 100 * x }"})
        CHECK(length(bent(text) - moved) < 1e-6);
    // Turbulence moves the point, and not each of those whose heights make the slope.
    CHECK(length(bent("granite .3 turbulence .2 slope_map { [0 <0, 1>] [1 <1, 1>] }") -
                 bent("granite .3 turbulence .2")) < 1e-7);
    CHECK(notes_of("sphere { 0, 1 normal { average normal_map { [1 granite] } } }").empty());
    // Heights of a slope_map may be beyond 0 and 1.
    CHECK(length(bent("gradient y 1 slope_map { [0 <-1, 0>] [1 <2, 0>] }") -
                 bent("gradient y 3 slope_map { [0 <0, 0>] [1 <1, 0>] }")) < 1e-7);
}

TEST_CASE("POV-Ray: facets bend the normals of cells alike") {
    const auto bend = [](const std::string& text, const DVec3& point, const DVec3& normal) {
        const Material own = material(whole("sphere { 0, 1 normal { facets " + text + " } }"));
        CHECK(own.bump.height == 1);
        return bend_at(std::get<SolidPattern>(own.bump.pattern->kind), point, normal);
    };
    const DVec3 point(.31, .42, .05), normal = normalize(DVec3(1, 2, -2));
    // By directions, wherever the point is. The new normal is in the cell of the old one, or in one beside it.
    const DVec3 one = normalize(normal + bend("size .4", point, normal));
    CHECK(length(one - normalize(normal + bend("size .4", -point, normal))) < 1e-12);
    const DVec3 near = normalize(normal + DVec3(1e-6));
    CHECK(length(one - normalize(near + bend("size .4", point, near))) < 1e-12);
    CHECK(length(one - normal) < 1);
    CHECK(length(one - normalize(normal + bend("size .1", point, normal))) > 1e-3);
    // By points: along the surface, the same in a cell, and as far as coords says.
    const auto across = [&](const std::string& text, const DVec3& p) {
        const DVec3 bent = normal + bend(text, p, normal);
        return bent / dot_product(bent, normal) - normal;
    };
    const DVec3 moved = across("coords .5 size .4", point);
    CHECK(length(moved) > 1e-3);
    CHECK(length(moved - across("coords .5 size .4", point + DVec3(1e-6))) < 1e-12);
    CHECK(length(moved - across("coords .5 size .4", point + DVec3(2))) > 1e-3);
    CHECK(length(2. * moved - across("coords 1 size .4", point)) < 1e-12);
}

TEST_CASE("POV-Ray: all words of patterns that are not shown are read") {
    for (const char* const pattern :
         {"pavement", "pavement number_of_sides 6 number_of_tiles 3 pattern 2 exterior 1 interior 0 form 2", "tiling 3",
          "tiling 24 scale .2", "aoi", "slope y", "slope { y, 0, .5 altitude x, -1, 1 }",
          "slope { point_at <1, 2, 3> }"}) {
        CAPTURE(pattern);
        const std::string all = std::string(pattern) + " color_map { [0 rgb 0] [1 rgb 1] } turbulence .2";
        CHECK(says(notes_of("sphere { 0, 1 pigment { " + all + " } }"), "is its mean colour"));
        CHECK(says(notes_of(std::string("sphere { 0, 1 normal { ") + pattern + " } }"), "on the surface"));
    }
}

TEST_CASE("POV-Ray: places of maps may be in any order") {
    // Takes the entries as POV-Ray does: the last one from its place on, else the first that is not below a value.
    struct Entry {
        double at, red;
    };
    const auto expected = [](const std::vector<Entry>& map, double value) {
        if (value >= map.back().at) return map.back().red;
        std::size_t i = 0;
        while (value > map[i].at) ++i;
        if (i == 0 || value == map[i].at) return map[i].red;
        const Entry& before = map[i - 1];
        return before.red + (map[i].red - before.red) * (value - before.at) / (map[i].at - before.at);
    };
    unsigned dice = 1;
    const auto throw_dice = [&](int sides) { return int((dice = dice * 1664525 + 1013904223) >> 16) % sides; };
    for (int round = 0; round < 200; ++round) {
        std::vector<Entry> map;
        std::string colors, pigments;
        for (int i = throw_dice(6); i >= 0; --i) {
            map.push_back({(throw_dice(25) - 4) / 16., throw_dice(9) / 8.});
            const std::string at = "[" + std::to_string(map.back().at), red = std::to_string(map.back().red);
            colors += at + " rgb " + red + "*x]";
            pigments += at + " gradient y color_map { [0 rgb " + red + "*x] } ]";
        }
        for (const std::string& text : {"color_map { " + colors + " }", "pigment_map { " + pigments + " }"}) {
            CAPTURE(text);
            const Scene scene = whole("sphere { 0, 1 pigment { gradient x " + text + " } }");
            const referee::Paint<double> paint(material(scene).rgb, glm::dmat4(1));
            for (int k = 1; k < 16; ++k) {
                const double value = k / 16. + 1 / 64.;
                CHECK(paint.at(referee::Vector<double>(DVec3(value, .5, 0))).x ==
                      doctest::Approx(expected(map, value)).epsilon(1e-6));
            }
            const std::string declared = "#declare F = function { pigment { gradient x " + text + " } } ";
            CHECK(computed(declared, "F(.390625, .5, 0).red") == doctest::Approx(expected(map, .390625)).epsilon(1e-6));
            CHECK(computed(declared + "#declare G = function { F(x, y, z).grey } ", "G(.390625, .5, 0)") ==
                  doctest::Approx(.297 * expected(map, .390625)).epsilon(1e-6));
        }
    }
}

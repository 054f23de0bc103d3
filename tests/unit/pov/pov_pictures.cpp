// Pictures of POV-Ray's scenes. The expected colours are what POV-Ray 3.7.0.10 prints by #debug of the results of
// `#declare F = function { pigment { ... } }`.
#include "files/output_file.h"
#include "num/decimal.h"
#include "tests/referee/pattern.h"
#include "tests/unit/pov/opened.h"
#include "tests/unit/scratch.h"

using namespace strahl;

namespace {

struct PictureRow {
    const char* text;
    std::array<double, 5> near, far;  // at <.31, .42, .05> and at <-.7, 1.3, .6>
};
const PictureRow picture_rows[]{
    {R"(image_map { png "a.png" })", {.6, 1, 0, 0, 1}, {.6, 1, 0, 0, 1}},
    {R"(image_map { png "a.png" interpolate 2 } scale .3)",
     {.68, .636, .268, 0, .532},
     {.51667, .43333, .61667, 0, .23333}},
    {R"(image_map { png "a.png" interpolate 3 once } scale 2 translate -.8)",
     {.07695, .65781, .5572, 0, .57163},
     {1, 1, 1, 0, 1}},
    {R"(image_map { png "a.png" interpolate 4 map_type 1 })",
     {.71145, .26559, .42957, 0, .13244},
     {.26102, .61136, .37264, 0, .59318}},
    {R"(image_map { png "a.png" interpolate 2 map_type 2 } rotate 30*x)",
     {.65401, .59158, .43136, 0, .40365},
     {.28832, .42143, .65508, 0, .2794}},
    {R"(image_map { png "a.png" interpolate 2 map_type 5 filter all .25 })",
     {.66877, .38439, .4188, .25, .24248},
     {.34081, .52821, .33609, .25, .52568}},
    {R"(image_map { png "a.png" interpolate 2 once })", {.53304, .54992, .32428, 0, .49316}, {1, 1, 1, 0, 1}},
    {R"(image_map { png "a.png" interpolate 2 repeat <3, 2> offset <.3, .1> transmit all .125 })",
     {.08756, .63824, .6342, 0, .60636},
     {.29, .5, .63, 0, .465}},
    {R"(image_map { png "a.png" interpolate 2 } turbulence .3)",
     {.64644, .87904, .05287, 0, .86222},
     {.64568, .88381, .03219, 0, .8786}},
    {R"(image_map { png "a.png" interpolate 2 } warp { repeat .2*x flip x } scale .7)",
     {.69429, .35943, .39257, 0, .23314},
     {.83143, .26, .19, 0, .25571}},
    {"image_map { function 4, 5 { pigment { gradient x color_map { [0 rgb x] [1 rgbt <0, .5, 1, .75>] } rotate 30*z } "
     "} interpolate 2 }",
     {.48637, .2568, .51361, 0, .38522},
     {.42293, .28852, .57706, 0, .43281}},
    {R"(image_map { function 5, 3 { x*y } interpolate 2 })",
     {.16274, .16274, .16274, 0, 0},
     {.19999, .19999, .19999, 0, 0}},
    {R"(image_pattern { png "a.png" interpolate 2 } color_map { [0 rgb 0] [1 rgb <1, 2, 0>] })",
     {.51918, 1.03837, 0, 0, 0},
     {.57216, 1.14431, 0, 0, 0}},
    {R"(image_pattern { png "a.png" use_alpha } color_map { [0 rgb 0] [1 rgb <1, 2, 0>] })",
     {1, 2, 0, 0, 0},
     {1, 2, 0, 0, 0}},
    {R"(image_pattern { png "a.png" once } color_map { [0 rgb 0] [1 rgb <1, 2, 0>] } scale .5)",
     {.5168, 1.0336, 0, 0, 0},
     {0, 0, 0, 0, 0}},
};

/// The picture a.png.
FilePixels small_picture(const std::string&) {
    FilePixels pixels(Pixels{3, 2, false, {}, Color(1)});
    for (const int value : {255, 0, 51, 0, 204, 102, 51, 102, 255, 153, 255, 0, 102, 51, 204, 204, 153, 102})
        pixels.values.push_back(static_cast<float>(value) / 255);
    pixels.opacity = {1, .2f, 1, 0, 1, .6f};
    return pixels;
}

struct Opener {
    explicit Opener(const ReadPixels& read) : read(read) {
        options.file = folder / "x.pov";
        write_file(folder / "a.png", "");
    }
    pov::OpenedPov operator()(const std::string& text) const { return open_pov(text, options, read); }
    const Scratch folder;
    const ReadPixels read;
    pov::InterpreterOptions options;
};

/// Returns a pigment whose red and green are the filter and transmit of a pattern.
Pigment shares_of(Pattern pattern) {
    for (ColorStop& stop : pattern.colors) {
        stop.color = Color(stop.filter, stop.transmit, 0);
        if (stop.pattern) stop.pattern = shares_of(*stop.pattern).pattern;
    }
    return Pigment(std::move(pattern));
}

}  // namespace

TEST_CASE("POV-Ray: colours of pictures, of their transparent pixels, and of what is beside them") {
    const Opener open(small_picture);
    const std::string modern = "#version 3.7; global_settings { assumed_gamma srgb } ";
    for (const PictureRow& row : picture_rows) {
        CAPTURE(row.text);
        const std::string pigment = std::string("pigment { ") + row.text + " }";
        for (const auto& [point, expected] :
             {std::pair(DVec3(.31, .42, .05), row.near), std::pair(DVec3(-.7, 1.3, .6), row.far)}) {
            const auto agrees = [&, expected = expected](double red, double green, double blue, double f, double t) {
                const std::array<double, 5> found{red, green, blue, f, t};
                for (std::size_t i = 0; i < 5; ++i) CHECK(std::abs(found[i] - expected[i]) < 2e-5);
            };
            // Computed by the scene.
            const std::string at = "F(" + text_of(point.x) + ", " + text_of(point.y) + ", " + text_of(point.z) + ")";
            const Scene scene =
                open("camera { right -4/3*x } #declare F = function { " + pigment + " } #declare C = " + at +
                     "; sphere { <C.red, C.green, C.blue>, 1 } " + "sphere { <C.filter, C.transmit, 0>, 1 }")
                    .scene;
            const DVec3 color = shape<Sphere>(scene, 0).centre, clear = shape<Sphere>(scene, 1).centre;
            agrees(color.x, color.y, color.z, clear.x, clear.y);
            // Shown by a body.
            for (const bool mirrored : {false, true}) {
                const pov::OpenedPov shown =
                    open(modern + (mirrored ? "" : "camera { right -4/3*x } ") + ("sphere { 0, 1 " + pigment + " }"));
                CHECK(shown.notes.empty());
                const Pigment& own = material(shown.scene).rgb;
                const referee::Vector<double> p(DVec3(point.x, point.y, mirrored ? -point.z : point.z));
                const auto seen = referee::Paint<double>(own, glm::dmat4(1)).at(p);
                const auto through = referee::Paint<double>(shares_of(*own.pattern), glm::dmat4(1)).at(p);
                agrees(seen.x, seen.y, seen.z, through.x, through.y);
            }
        }
    }
}

TEST_CASE("POV-Ray: pictures that scenes have themselves stay pictures") {
    const Opener open([](const std::string&) { return Pixels{1, 1, false, {0, 0, 0}, Color(1)}; });
    const auto is_picture = [&](const std::string& before, const std::string& more) {
        const pov::OpenedPov shown =
            open(before + "sphere { 0, 1 pigment { image_map { png \"a.png\"" + more + " } } }");
        CHECK(shown.notes.empty());
        return std::holds_alternative<ImagePattern>(material(shown.scene).rgb.pattern->kind);
    };
    CHECK(is_picture("", ""));
    CHECK(is_picture("", " interpolate 2 map_type 1"));
    CHECK(is_picture("#version 3.7; global_settings { assumed_gamma 1 } ", ""));
    CHECK(is_picture("#version 3.7; global_settings { assumed_gamma 2.2 } ", ""));
    CHECK(is_picture("#version 3.7; global_settings { assumed_gamma srgb } ", ""));
    CHECK(!is_picture("", " once"));
}

TEST_CASE("POV-Ray: values of grey .png files are rounded down to whole 255ths") {
    const auto value_of = [](const std::string& before, int code, std::optional<double> gamma,
                             const std::string& kind = "image_map") {
        const Opener open([&](const std::string&) {
            const float value = static_cast<float>(code) / 255;
            FilePixels pixels(Pixels{1, 1, false, {value, value, value}, Color(1)});
            pixels.gamma = gamma, pixels.grey_png = true;
            return pixels;
        });
        const Scene scene = open(before + "sphere { 0, 1 pigment { " + kind + " { png \"a.png\" once } } }").scene;
        const referee::Paint<double> paint(material(scene).rgb, glm::dmat4(1));
        return 255 * double(paint.at(referee::Vector<double>(DVec3(.5, .5, 0))).x);
    };
    const auto near = [](double value) { return doctest::Approx(value).epsilon(1e-6); };
    CHECK(value_of("#version 3.7; global_settings { assumed_gamma 1 } ", 124, {}) == near(51));   // of 51.5
    CHECK(value_of("#version 3.7; global_settings { assumed_gamma 1 } ", 124, 2.2) == near(52));  // of 52.2
    // Rounded down although it is whole: .297 v + .589 v + .114 v is below v.
    CHECK(value_of("", 124, {}) == near(123));
    CHECK(value_of("", 125, {}) == near(125));
    CHECK(value_of("#version 3.7; global_settings { assumed_gamma 1 } ", 124, {}, "image_pattern") == near(123));
    CHECK(value_of("#version 3.7; global_settings { assumed_gamma 2.2 } ", 125, 1e5 / 45455) == near(125));
}

TEST_CASE("POV-Ray: pictures that are encoded in another way have the colours that POV-Ray decodes") {
    const auto shown = [](const std::string& before, const std::string& more, std::optional<double> gamma,
                          bool linear) {
        const Opener open([&](const std::string&) {
            FilePixels pixels(Pixels{1, 1, linear, {.5f, .5f, .5f}, Color(.5)});
            pixels.gamma = gamma;
            return pixels;
        });
        const Scene scene = open(before + "sphere { 0, 1 pigment { image_map { png \"a.png\"" + more + " } } }").scene;
        const Pixels& pixels = *std::get<ImagePattern>(material(scene).rgb.pattern->kind).pixels;
        const double value = static_cast<double>(pixels.values[0]), assumed = scene.settings.assumed_gamma;
        CHECK(pixels.largest == Color(value));
        if (assumed == 0) return value;
        return std::pow(linear ? value : std::pow((value + .055) / 1.055, 2.4), 1 / assumed);
    };
    const std::string modern = "#version 3.7; global_settings { assumed_gamma 1 } ";
    const double srgb = std::pow((.5 + .055) / 1.055, 2.4);
    const auto about = [](double value) { return doctest::Approx(value).epsilon(1e-6); };
    CHECK(shown(modern, "", {}, false) == about(srgb));
    CHECK(shown(modern, "", 0, false) == about(srgb));
    CHECK(shown(modern, "", 2.2, false) == about(std::pow(.5, 2.2)));
    CHECK(shown(modern, " gamma 1", 2.2, false) == about(.5));
    CHECK(shown(modern, " gamma 2", {}, true) == about(.25));
    CHECK(shown("#version 3.7; global_settings { assumed_gamma 2 } ", "", 1., false) == about(std::sqrt(.5)));
    // Before version 3.7 only what the file says counts, and nothing without an assumed_gamma.
    CHECK(shown("#version 3.6; global_settings { assumed_gamma 1 } ", "", {}, false) == about(.5));
    CHECK(shown("#version 3.6; global_settings { assumed_gamma 1 } ", "", 2.2, false) == about(std::pow(.5, 2.2)));
    CHECK(shown("", "", 2.2, false) == about(.5));
}

TEST_CASE("POV-Ray: a bump_map bends normals, by the size that it names itself") {
    const Opener open(small_picture);
    const auto bent = [&](const std::string& text) {
        const pov::OpenedPov shown = open("camera { right -4/3*x } sphere { 0, 1 normal { " + text + " } }");
        CHECK(shown.notes.empty());
        const Bump& bump = material(shown.scene).bump;
        const DVec3 normal = normalize(DVec3(1, 2, -2));
        return normalize(normal +
                         bump.height * bend_at(std::get<SolidPattern>(bump.pattern->kind), {.31, .42, .05}, normal));
    };
    const DVec3 some = bent("bump_map { png \"a.png\" interpolate 2 } bump_size 3");
    CHECK(length(some - DVec3(1, 2, -2) / 3.) > .1);
    CHECK(length(some - bent("bump_map { png \"a.png\" interpolate 2 bump_size 3 }")) < 1e-12);
    CHECK(length(some - bent("bump_map { png \"a.png\" interpolate 2 } 3")) < 1e-12);
}

TEST_CASE("POV-Ray: pictures of functions have sizes that are limited") {
    const Opener open(small_picture);
    const auto fault = [&](const std::string& size) {
        return fault_of([&] { open("sphere { 0, 1 pigment { image_map { function " + size + " { x } } } }"); });
    };
    CHECK(fault("1, 1") == "");
    for (const char* const size : {"0, 1", "1, 0", "-3, 2", "1e9, 1"})
        CHECK(says(fault(size), "the sides of a picture have 1 to 4096 pixels"));
}

TEST_CASE("POV-Ray: patterns nested more deeply than those of scenes have their colours too") {
    std::string pigment = "bozo color_map { [0 rgb x] [1 rgbt <0, 1, 0, .5>] }";
    for (int i = 0; i < 7; ++i) pigment = "gradient x pigment_map { [.2 " + pigment + " scale .9] [1 rgb z] }";
    const Opener open(small_picture);
    const pov::OpenedPov shown = open("camera { right -4/3*x } light_source { 2*y rgb 1 } sphere { 0, 1 pigment { " +
                                      pigment + " } } #declare F = function { pigment { " + pigment +
                                      " } } #declare C = F(.31, .42, .05); sphere { <C.red, C.green, C.blue>, 1 }");
    CHECK(shown.notes.empty());
    const Pigment& own = material(shown.scene).rgb;
    const referee::Vector<double> p(DVec3(.31, .42, .05));
    const auto seen = referee::Paint<double>(own, glm::dmat4(1)).at(p);
    const DVec3 expected = shape<Sphere>(shown.scene, 1).centre;
    CHECK(length(DVec3(seen.x, seen.y, seen.z) - expected) < 1e-6);
    CHECK(referee::Paint<double>(shares_of(*own.pattern), glm::dmat4(1)).at(p).y > .01);
}

TEST_CASE("POV-Ray: uv_mapping of a pigment, a texture or a body") {
    const Opener open(small_picture);
    const std::string mesh =
        "mesh2 { vertex_vectors { 3, 0, x, y } uv_vectors { 3, <0, 0>, <1, 0>, <0, 1> } face_indices { 1, <0, 1, 2> } ";
    const std::string picture = "pigment { bozo pigment_map { [0 image_map { png \"a.png\" }] [1 granite] } scale 2 ";
    const Scene first = open(mesh + "texture { " + picture + "uv_mapping } } }").scene;
    const Pattern& pattern = *material(first).rgb.pattern;
    CHECK(pattern.by_uv);
    CHECK(pattern.colors.at(0).pattern->by_uv);
    for (const std::string& texture :
         std::vector<std::string>{"texture { uv_mapping " + picture + "} }", "uv_mapping texture { " + picture + "} }",
                                  "uv_mapping " + picture + "}"}) {
        const pov::OpenedPov other = open(mesh + texture + " rotate 30*x }");
        CHECK(other.notes.empty());
        CHECK(material(other.scene).rgb.pattern->by_uv);
        CHECK(material(other.scene).rgb.pattern->transformations == pattern.transformations);
    }
}

TEST_CASE("POV-Ray: places by uv of bodies that are no meshes") {
    const Opener open([](const std::string&) { return Pixels{1, 1, false, {0, 0, 0}, Color(1)}; });
    const std::string picture = " pigment { uv_mapping image_map { png \"a.png\" } ";
    const auto pattern_of = [&](const std::string& text) {
        const pov::OpenedPov shown = open("camera { right -4/3*x } " + text);
        CHECK(shown.notes.empty());
        REQUIRE(material(shown.scene).rgb.pattern);
        return *material(shown.scene).rgb.pattern;
    };
    // Around a ball a picture stays one, unless it is moved by uv.
    const Pattern around = pattern_of("sphere { <1, 2, 3>, 1" + picture + "} rotate 20*y }");
    REQUIRE(std::holds_alternative<ImagePattern>(around.kind));
    CHECK(std::get<ImagePattern>(around.kind).map == ImageMap::spherical);
    CHECK(around.transformations.back() == Transformation(Translate{{1, 2, 3}}));
    CHECK_FALSE(around.by_uv);
    CHECK(std::holds_alternative<SolidPattern>(pattern_of("sphere { 0, 1" + picture + "scale .5 } }").kind));
    // Values of u and v, as the colours of ramps.
    const auto place_of = [&](const std::string& body, const DVec3& p) {
        DVec3 place(0);
        for (const int axis : {0, 1}) {
            const std::string way = axis == 0 ? "x" : "y";
            const Pattern own = pattern_of(body + " pigment { uv_mapping gradient " + way + " scale 4 } }");
            const auto seen = referee::Paint<double>(Pigment(own), glm::dmat4(1)).at(referee::Vector<double>(p));
            place[axis] = 4 * double(seen.x);
        }
        return place;
    };
    const auto near = [](const DVec3& a, const DVec3& b) { return length(a - b) < 1e-6; };
    CHECK(near(place_of("sphere { 0, 2", {0, 0, 2}), {.25, .5, 0}));
    CHECK(near(place_of("sphere { <0, 1, 0>, 2", {std::sqrt(2), 1 - std::sqrt(2), 0}), {0, .25, 0}));
    CHECK(near(place_of("box { 0, <1, 2, 4>", {1, 1, 1}), {11. / 16, .5, 0}));
    CHECK(near(place_of("box { 0, <1, 2, 4> scale <1, 1, -1>", {1, 1, 1}), {9. / 16, .5, 0}));
    CHECK(near(place_of("torus { 3, 1", {0, 1, 3}), {.25, .75, 0}));
    CHECK(near(place_of("cylinder { 0, y, 1", {.5, .25, 2}), {.5, .25, 0}));
    CHECK(near(place_of("mesh { triangle { 0, x, y }", {.5, .25, 0}), {0, 0, 0}));
    CHECK(near(place_of("lathe { linear_spline 3, <1, 0>, <2, 1>, <1, 3>", {0, 2, 1.5}), {.25, .75, 0}));
    CHECK(near(place_of("lathe { cubic_spline 5, <0, 0>, <1, 0>, <2, 1>, <1, 3>, <0, 3>", {-2, 1, 0}), {.5, .5, 0}));
    const std::string sor = "sor { 5, <1, -1>, <1, 0>, <1, 1>, <2, 3>, <2, 4>";
    CHECK(near(place_of(sor, {0, 2, -1.5}), {.75, .75, 0}));
    CHECK(near(place_of(sor, {1, 3, 0}), {0, 1.5, 0}));
    CHECK(near(place_of("ovus { 2, 1", {0, 2.5, 1}), {.25, .5 + std::atan(2) / std::numbers::pi, 0}));
    CHECK(notes_of("box { 0, <1, 1, 0> pigment { uv_mapping granite } }").find("by uv") != std::string::npos);
}

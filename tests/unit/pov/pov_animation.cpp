// Animations of POV-Ray: .ini files, the clock, and flights beside a scene.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "pov/animation.h"
#include "pov/flight_file.h"
#include "pov/ini_file.h"
#include "pov/open_scene.h"
#include "scene/moving_scene.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"
#include "text/write.h"

using namespace strahl;

namespace {

const std::string pov_eye = "camera { location -5*z look_at 0 } ";

void put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// Returns the place of the first body.
double place_of(const OpenedScene& opened) { return std::get<Sphere>(opened.scene.primitives.at(0).shape).centre.x; }

}  // namespace

TEST_CASE("an .ini file gives options, switches and sections; all else is read over by its name") {
    const pov::IniFile ini = pov::parse_ini(
        "; a comment\n\r\n# another\nWidth = 640 ; wide\nHEIGHT=480\nInput_File_Name=\"a b.pov\"\n"
        "+KFI1 +KFF10 +KI-1 +KF2.5 +KC +A0.3\nDeclare=Size=3\nDeclare=Name=wrong\nLibrary_Path=some folder \n"
        "Quality=9\nQuality=8\nPre_Scene_Command=touch x; rm y\nPost_Frame_Return=I\nWidth=wide\n"
        "[small]\nWidth=3\n[ other\nHeight=7\n",
        "x.ini");
    CHECK(ini.width == 640);
    CHECK(ini.height == 480);
    CHECK(ini.scene == "a b.pov");
    CHECK(ini.initial_frame == 1);
    CHECK(ini.final_frame == 10);
    CHECK(ini.initial_clock == -1);
    CHECK(ini.final_clock == 2.5);
    CHECK(ini.cyclic);
    CHECK(ini.antialias == true);
    CHECK(ini.declared == std::vector<std::pair<std::string, double>>{{"Size", 3}});
    CHECK(ini.library == std::vector<std::string>{"some folder"});
    CHECK(ini.notes == std::vector<std::string>{"x.ini: read over: Declare, Quality, Post_Frame_Return, Width; "
                                                "Pre_Scene_Command: commands are never run"});
    CHECK(pov::parse_ini("[a]\nWidth=3\n[B]\nWidth=4", "x.ini", "b").width == 4);
    CHECK(fault_of([] { pov::parse_ini("[a]", "x.ini", "c"); }) == "x.ini: there is no section 'c'");
    CHECK(pov::is_ini("x.ini[a]"));
    CHECK(!pov::is_ini("x.ini[a].pov"));
    CHECK(pov::parse_ini("+UA", "x.ini").alpha == true);
    CHECK(pov::parse_ini("Output_Alpha=on\n-UA", "x.ini").alpha == false);
    const pov::IniFile marked = pov::parse_ini("\xEF\xBB\xBFWidth=5\n", "x.ini");  // as editors of Windows save it
    CHECK(marked.width == 5);
    CHECK(marked.notes.empty());
}

TEST_CASE("the scene of an .ini file lies in its folder or below") {
    const Scratch folder;
    std::filesystem::create_directory(folder / "below");
    put(folder / "below/a.pov", pov_eye);
    put(folder / "b.pov", pov_eye);
    const auto read = [&](const std::string& name) {
        put(folder / "x.ini", "Input_File_Name=" + name + "\n[s]\nInput_File_Name=b.pov");
        return pov::read_ini(folder / "x.ini").scene;
    };
    CHECK(read("below\\a") == folder / "below/a.pov");
    CHECK(pov::read_ini(folder / "x.ini[s]").scene == folder / "b.pov");
    for (const std::string& name : std::vector<std::string>{"below/../b.pov", folder / "b.pov", "/etc/passwd", "c"})
        CHECK(says(fault_of([&] { read(name); }), "there is no scene"));
    CHECK(says(fault_of([&] { read(""); }), "no scene: 'Input_File_Name=FILE.pov' expected"));
}

TEST_CASE("the clock runs as POV-Ray has it") {
    // POV-Ray 3.7 with +KFI2 +KFF5 +KI1 +KF3, and +KC: frame_number, clock, clock_delta, final_frame.
    pov::IniFile ini;
    ini.initial_frame = 2, ini.final_frame = 5, ini.initial_clock = 1, ini.final_clock = 3;
    pov::Animation all = pov::Animation::of(ini, 100.);
    CHECK(all.seconds == 4 / 25.);
    CHECK(all.clock_at(0) == 1);
    CHECK(all.clock_at(1 / 25.) == doctest::Approx(1 + 2 / 3.));
    CHECK(all.clock_at(3 / 25.) == 3);
    CHECK(all.clock_at(9) == 3);
    CHECK(all.declared_at(2 / 25.).back() == std::pair<std::string, double>("frame_number", 4));
    ini.cyclic = true, ini.subset_start = 4, ini.subset_end = 5;
    all = pov::Animation::of(ini, {});
    CHECK(all.clock_at(1 / 25.) == doctest::Approx(1.5));
    CHECK(all.frames() == std::pair(2, 3));
    // A single frame is a film of one frame, at the first value of the clock, or at that which the file gives.
    ini = {};
    ini.initial_frame = ini.final_frame = 3, ini.initial_clock = 2, ini.final_clock = 7;
    all = pov::Animation::of(ini, {});
    CHECK(all.frames() == std::pair(0, 0));
    CHECK(all.seconds == 1 / 25.);
    CHECK(all.clock_at(0) == 2);
    CHECK(all.declared_at(0).front() == std::pair<std::string, double>("clock_delta", 5));
    CHECK(all.declared_at(0).back() == std::pair<std::string, double>("frame_number", 3));
    ini.clock = 4;
    CHECK(pov::Animation::of(ini, {}).clock_at(0) == 4);
    const pov::Animation plain = pov::Animation::of({}, 4.);
    CHECK(plain.clock_at(1) == .25);
    CHECK(pov::Animation::of({}, {}).seconds == 10);
    pov::IniFile none;
    none.final_clock = 2;
    CHECK(pov::Animation::of(none, 4.).clock_at(2) == 1);
}

TEST_CASE("a scene that uses its clock is read for a moment of its flight") {
    const Scratch folder;
    const std::string path = folder / "a.pov", text = pov_eye + "sphere { clock*x, 1 }";
    put(path, text);
    const auto at = [&](std::optional<double> time, const std::string& own) {
        OpeningOptions options;
        options.time = time;
        return open_scene(own, path, options, {});
    };
    CHECK(place_of(at({}, text)) == 0);
    CHECK(at({}, text).changes);
    CHECK(flight_of(at({}, text).scene)->duration == 10);
    CHECK(place_of(at(5, text)) == .5);
    CHECK(!at({}, pov_eye + "sphere { 0, 1 }").scene.flythrough);
    CHECK(write_scene(at({}, text).scene).find("flythrough") == std::string::npos);
    OpeningOptions fixed;
    fixed.clock = 7, fixed.time = 3;
    CHECK(place_of(open_scene(text, path, fixed, {})) == 7);
    CHECK(!open_scene(text, path, fixed, {}).changes);

    put(folder / "a.flight",
        "flythrough { duration 4  key { time 0 position <0,0,-5> look_at <0,0,0> }\n"
        "  key { time 4 position <5,0,-1> look_at <0,0,0> sky <0,1,0> angle 30 ease 1 } }");
    const OpenedScene flown = at(1, text);
    CHECK(place_of(flown) == .25);
    REQUIRE(flown.scene.flythrough);
    CHECK(flown.scene.flythrough->keys[0].position == DVec3(0, 0, 5));  // mirrored, as the scene is
    CHECK(flown.scene.flythrough->keys[1].fov == 15);
    CHECK(flown.scene.flythrough->keys[1].ease == 1);
    const std::string written = pov::with_flight("", flown.scene.flythrough, flown.mirrored);
    CHECK(says(written, "key { time 0  position <0, 0, -5>  look_at <0, 0, 0> }"));
    put(folder / "a.flight", written);
    CHECK(at({}, text).scene.flythrough == flown.scene.flythrough);
    // Keys without a sky have the camera's, not its picture's leaning up.
    const std::string above = "camera { location <0,4,-3> look_at 0 } sphere { 0, 1 }";
    CHECK(at(1, above).scene.camera.up == DVec3(0, -1, 0));
    CHECK(at({}, "camera { location <0,4,-3> sky <1,0,0> look_at 0 rotate 90*z }").scene.camera.up.y < -.999);
    const auto fault = [&](const std::string& flight) {
        put(folder / "a.flight", flight);
        return fault_of([&] { at({}, text); }, "no error");
    };
    const std::string plain =
        "flythrough { duration 4 key { time 0 position <0,0,-5> look_at <0,0,0> } "
        "key { time 4 position <0,5,0> look_at <0,0,0> } }";
    CHECK(says(fault("\nflythrough {"), "a.flight:2:1: '}' missing"));
    CHECK(says(fault(plain + "light { position <0,0,1> color <1,1,1> }"), "and nothing else"));
    CHECK(says(fault(plain), "a.flight: invalid camera at the key of 4 s: up is parallel"));
    CHECK(fault("// nothing yet") == "no error");

    // An .ini file gives frames; it may not open other folders, nor be that of another scene.
    put(folder / "a.flight", "");
    put(folder / "a.ini", "Final_Frame=11\nFinal_Clock=100\nLibrary_Path=/etc\nDeclare=Far=2\n");
    const std::string far = pov_eye + "sphere { (clock + Far + 1000*frame_number)*x, 1 }";
    const OpenedScene by_ini = at(.2, far);
    CHECK(place_of(by_ini) == doctest::Approx(6052));
    CHECK(by_ini.frames == std::pair(0, 10));
    CHECK(says(by_ini.notes.at(0).told(), "Library_Path is not read; --library '/etc' allows it"));
    CHECK(says(fault_of([&] { at(0, pov_eye + "#include \"passwd\""); }), "cannot find 'passwd'"));
    put(folder / "a.ini", "Input_File_Name=b.pov\nFinal_Frame=11");
    CHECK(!at({}, text).frames);
}

TEST_CASE("POV-Ray: a still has the frame 0 and no steps of the clock") {
    const Scene scene = whole("sphere { <frame_number + initial_frame, final_frame + final_clock, clock_delta>, 1 }");
    CHECK(shape<Sphere>(scene).centre == DVec3(0));
}

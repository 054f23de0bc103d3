// Tests the layout of the panels over the picture, without a display.
#include "show/panels/panels.h"

#include <doctest/doctest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <array>
#include <string>
#include <utility>

#include "show/info.h"
#include "show/timeline/number_fields.h"
#include "show/welcome/help_panel.h"
#include "show/window/overlay.h"
#include "tests/unit/show/show_scene.h"

using namespace strahl;

namespace {

/// ImGui for a window of this size, with its own font.
struct PanelLayout {
    PanelLayout(float width, float height) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr, io.DisplaySize = {width, height};
        unsigned char* pixels = nullptr;
        int columns = 0, rows = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &columns, &rows);
    }
    ~PanelLayout() { ImGui::DestroyContext(); }

    /// Draws it until all sizes are known.
    void draw(const Overlay& overlay) {
        for (int i = 0; i < 4; ++i) ImGui::NewFrame(), draw_overlay(overlay), ImGui::Render();
    }
    void draw_help(const std::string& typed) {
        for (int i = 0; i < 4; ++i) ImGui::NewFrame(), strahl::draw_help(KeyMap(), typed), ImGui::Render();
    }
    static const ImGuiWindow& window(const char* name) {
        const ImGuiWindow* const found = ImGui::FindWindowByName(name);
        REQUIRE(found);
        return *found;
    }
};

/// Tells ImGui of keys and of the pointer: as events, or as states where its version has no queue of events.
class InputEvents {
  public:
#if IMGUI_VERSION_NUM >= 18900
    explicit InputEvents(ImGuiIO& io) : io(io) { io.ConfigInputTrickleEventQueue = false; }
    void key(ImGuiKey key, bool down) const { io.AddKeyEvent(key, down); }
    void control(bool down) const { io.AddKeyEvent(ImGuiMod_Ctrl, down); }
    void move(float x, float y) const { io.AddMousePosEvent(x, y); }
    void button(bool down) const { io.AddMouseButtonEvent(0, down); }
#else
    explicit InputEvents(ImGuiIO& io) : io(io) {
        for (const ImGuiKey key : {ImGuiKey_Tab, ImGuiKey_Enter, ImGuiKey_Escape}) io.KeyMap[key] = key;
    }
    void key(ImGuiKey key, bool down) const { io.KeysDown[key] = down; }
    void control(bool down) const { io.KeyCtrl = down; }
    void move(float x, float y) const { io.MousePos = {x, y}; }
    void button(bool down) const { io.MouseDown[0] = down; }
#endif

  private:
    ImGuiIO& io;
};

std::string moving_line(const Session& session, const Pace& pace, const WindowPicture& picture) {
    for (const auto& [name, value] : info_lines(session, pace, picture))
        if (name == "moving") return value;
    return "";
}

}  // namespace

TEST_CASE("panels do not cover each other") {
    Overlay overlay;
    for (int i = 0; i < 13; ++i) overlay.info.emplace_back("position", "<-7.2603, -15, 6>");
    overlay.notes = {{"the path is not written: F2 writes it into scene.rt; Esc again quits"}, {"no sound", true}};
    overlay.fault_title = "The scene file has an error; this is the previous picture";
    overlay.fault = "scene.rt:6:1: unknown word 'shpere'; did you mean 'sphere'?\n    shpere {\n    ^~~~~~";
    for (const auto& [width, height] : {std::pair(960.f, 720.f), {1920.f, 1080.f}, {960.f, 540.f}}) {
        CAPTURE(height);
        PanelLayout layout(width, height);
        layout.draw(overlay);
        const char* const names[] = {"info", "notes", "fault"};
        for (const char* const one : names)
            for (const char* const other : names) {
                CAPTURE(one);
                CAPTURE(other);
                const bool same = one == other;
                CHECK(same == PanelLayout::window(one).Rect().Overlaps(PanelLayout::window(other).Rect()));
            }
    }
    for (const float size : {1.f, 13.f, 100.f}) PanelLayout(size, size).draw(overlay);  // too small to read
}

TEST_CASE("panels without room beside each other: the one asked for last is seen, and the others once it is closed") {
    const std::string more =
        R"(sphere { <0,0,0>, 1 translate <0,0,track "a" 1> } sphere { <0,0,0>, 1 translate <0,0,track "b" 1> })";
    for (const auto& [width, height] : {std::pair(640.f, 330.f), {960.f, 540.f}, {1920.f, 1080.f}}) {
        CAPTURE(width);
        const PanelLayout layout(width, height);
        Pace pace(Pace::Clock::now(), 60);
        Panels panels(pace, false, false);
        const Session session(shown_scene(more));
        BodyEditor editor;
        editor.open(scene_text + more);
        const auto draw = [&] {
            for (int i = 0; i < 6; ++i) {
                ImGui::NewFrame();
                panels.arrange(editor);
                panels.draw_timeline(session, {}, true, false);
                panels.draw_body(editor, "test.rt");
                panels.draw_add();
                panels.draw_outline(session, editor, {}, {});
                ImGui::Render();
            }
        };
        const auto seen = [](const char* name) {
            const ImGuiWindow* const found = ImGui::FindWindowByName(name);
            return found && found->Active;
        };
        const auto check_apart = [&] {
            const char* const names[] = {"timeline", "outline", "add", "body"};
            for (const char* const one : names)
                for (const char* const other : names) {
                    if (one == other || !seen(one) || !seen(other)) continue;
                    CAPTURE(one);
                    CAPTURE(other);
                    CHECK(!PanelLayout::window(one).Rect().Overlaps(PanelLayout::window(other).Rect()));
                }
        };
        for (const auto& [action, name] :
             {std::pair(Action::timeline, "timeline"), {Action::outline, "outline"}, {Action::add_block, "add"}}) {
            panels.toggle(action), draw();
            CHECK(seen(name));
            check_apart();
        }
        editor.choose(0, DVec3(0), *session.scene), draw();
        CHECK(seen("body"));
        CHECK(seen("timeline") == (height > 500));
        CHECK(seen("outline") == (width > 900));
        check_apart();
        panels.toggle(Action::timeline), draw();  // is closed, or shown in place of the others
        CHECK(seen("timeline") == (height < 500));
        CHECK(seen("body") == (height > 500));
        check_apart();
        panels.prefer_body(), draw();
        CHECK(seen("body"));
        check_apart();
        editor.close(), draw();
        CHECK(!seen("body"));
        while (panels.step_back()) draw(), check_apart();
        for (const char* const name : {"timeline", "outline", "add"}) CHECK(!seen(name));
    }
}

TEST_CASE("the help is a whole page in readable letters, also in a small window") {
    for (const auto& [width, height] : {std::pair(960.f, 720.f), {1920.f, 1080.f}, {960.f, 540.f}, {640.f, 480.f}}) {
        CAPTURE(height);
        PanelLayout layout(width, height);
        for (const char* const typed : {"", "camera", "xyzzy"}) {
            layout.draw_help(typed);
            const ImGuiWindow& help = PanelLayout::window("help");
            CHECK(help.ContentSize.x + help.WindowPadding.x <= help.Size.x + 1);
            CHECK(help.ContentSize.y + help.WindowPadding.y <= help.Size.y + 1);
            CHECK(help.Pos.x >= 0);
            CHECK(help.FontWindowScale > (height >= 720 ? .95f : .6f));
            CHECK(help.Pos.y + help.Size.y <= height);
        }
    }
    for (const float size : {1.f, 13.f, 100.f}) PanelLayout(size, size).draw_help("");  // too small to read
}

TEST_CASE("the information says what moves the camera") {
    Pace pace(Pace::Clock::now(), 60);
    Notes notes(pace, false);
    const WindowPicture picture(1, notes, pace, [] {});
    Session around(shown_scene());
    CHECK(moving_line(around, pace, picture).starts_with("free flight, speed "));
    around.perform({Action::play}, 0);
    CHECK(moving_line(around, pace, picture) == "around the scene");
    around.change_speed(.5, 0);
    CHECK(moving_line(around, pace, picture) == "around the scene, 0.5 times its speed");
    around.steer({.right = .1}, 1);
    around.perform({Action::change_style}, 1);
    CHECK(moving_line(around, pace, picture).starts_with("orbit, "));
    Session along(
        shown_scene("flythrough { duration 2 key { time 0 position <0,-9,2> look_at <0,0,0> }"
                    " key { time 2 position <1,-9,2> look_at <0,0,0> } }"));
    along.perform({Action::play}, 0);
    CHECK(moving_line(along, pace, picture) == "along the path");
}

TEST_CASE("what is typed for a number is one in its range, also with a comma; else the reason is told") {
    std::string why;
    CHECK(typed_number(" 1,5 ", coordinates, why) == 1.5);
    CHECK(typed_number("-2e3", coordinates, why) == -2000);
    CHECK(why == "");
    CHECK(!typed_number("1.2.3", coordinates, why));
    CHECK(why == "'1.2.3' is no number");
    CHECK(!typed_number("inf", coordinates, why));
    CHECK(!typed_number("-1", lengths, why));
    CHECK(why == "has to be greater than 0 and at most 1e9");
    CHECK(!typed_number("2.5", {1, 9, "from 1 to 9", true}, why));
    CHECK(why == "has to be from 1 to 9, and whole");
}

TEST_CASE("typed numbers apply at Enter, Tab and when the field is left, and not after Escape") {
    const PanelLayout layout(400, 300);
    ImGuiIO& io = ImGui::GetIO();
    const InputEvents events(io);
    NumberFields fields;
    std::array<double, 3> numbers{1, 2, 3};
    const auto frame = [&] {
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::Begin("fields", nullptr, ImGuiWindowFlags_NoDecoration);
        fields.begin();
        fields.draw("vector", numbers, lengths, 300);
        ImGui::End();
        ImGui::Render();
    };
    const auto press = [&](ImGuiKey key) {
        events.key(key, true), frame();
        events.key(key, false), frame();
    };
    const auto click = [&](float x, bool control) {
        events.move(x, 15), frame();
        events.control(control), events.button(true), frame();
        events.control(false), events.button(false), frame();
    };
    const auto type = [&](const char* text) { io.AddInputCharactersUTF8(text), frame(); };
    frame();
    click(30, true), type("1,5");
    CHECK(numbers[0] == 1);  // not before it is typed whole
    press(ImGuiKey_Tab), type("7"), press(ImGuiKey_Tab), type("8"), press(ImGuiKey_Enter);
    CHECK(numbers == std::array{1.5, 7., 8.});
    click(30, true), type("9"), press(ImGuiKey_Escape);
    CHECK(numbers[0] == 1.5);
    click(30, true), type("-4"), events.key(ImGuiKey_Enter, true), frame();
    CHECK(numbers[0] == 1.5);
    CHECK(fields.reason() != "");
    events.key(ImGuiKey_Enter, false), frame();
    click(30, true), type("4"), click(390, false);
    CHECK(numbers == std::array{4., 7., 8.});
}

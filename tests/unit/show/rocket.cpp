// The connection to a GNU Rocket editor, tested with a small one on a loopback socket.
#include "show/work/rocket.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <thread>

#include "files/error.h"
#include "show/session/session.h"
#include "show/work/notes.h"
#include "show/work/reload.h"
#include "show/work/track_editor.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"
#include "tests/unit/show/rocket_editor.h"
#include "tests/unit/show/show_scene.h"
#include "text/reading/tracks_file.h"

using namespace strahl;

namespace {

/// Connects to an editor that sends this greeting.
std::unique_ptr<Rocket> client_of(Editor& editor, const std::string& greeting = "hello, demo!") {
    auto client = std::async(std::launch::async, [&] { return std::make_unique<Rocket>(editor.port); });
    CHECK(editor.accept(greeting));
    return client.get();
}
/// Takes news until some are enough; false after ten seconds.
bool soon(Rocket& rocket, const std::function<bool(const RocketNews&)>& enough) {
    for (int i = 0; i < 10000; ++i) {
        if (enough(rocket.take())) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

}  // namespace

TEST_CASE("commands are the same however they are cut into packets") {
    const std::string bytes = key_bytes(0x01020304, 7, -1.5f, 2) + row_bytes(99) + pause_bytes(true) +
                              delete_bytes(3, 8) + save_bytes + pause_bytes(false) +
                              key_bytes(0, 1'000'000'000, 1e30f, 3);
    using Kind = RocketCommand::Kind;
    for (std::size_t size = 1; size <= bytes.size(); ++size) {
        RocketDecoder decoder;
        std::vector<RocketCommand> commands;
        for (std::size_t at = 0; at < bytes.size(); at += size)
            REQUIRE(decoder.feed(std::string_view(bytes).substr(at, size), commands));
        REQUIRE(commands.size() == 7);
        const Kind kinds[] = {Kind::set_key, Kind::set_row, Kind::pause,  Kind::delete_key,
                              Kind::save,    Kind::pause,   Kind::set_key};
        for (int i = 0; i < 7; ++i) CHECK(commands[std::size_t(i)].kind == kinds[i]);
        CHECK(commands[0].track == 0x01020304);
        CHECK(commands[0].key == TrackKey{7, -1.5, Interpolation::smooth});
        CHECK(commands[1].key.row == 99);
        CHECK(commands[2].paused);
        CHECK((commands[3].track == 3 && commands[3].key.row == 8));
        CHECK(!commands[5].paused);
        CHECK(commands[6].key == TrackKey{1'000'000'000, 1e9, Interpolation::ramp});
    }
}

TEST_CASE("garbage is noticed, and values that are not numbers are ignored") {
    const auto fed = [](const std::string& bytes, std::size_t expected) {
        RocketDecoder decoder;
        std::vector<RocketCommand> commands;
        const bool well = decoder.feed(bytes, commands);
        CHECK(commands.size() == expected);
        CHECK(decoder.feed(row_bytes(1), commands) == well);
        return well;
    };
    for (const char command : {'\2', '\6', 'h', '\xFF'}) CHECK(!fed(row_bytes(1) + command + row_bytes(2), 1));
    CHECK(!fed(key_bytes(0, 1, 1, 4), 0));
    CHECK(fed(key_bytes(0, 1, std::numeric_limits<float>::quiet_NaN(), 0), 0));
    CHECK(fed(key_bytes(0, 1, -std::numeric_limits<float>::infinity(), 0), 0));
    CHECK(fed(key_bytes(0, 0xFFFFFFFF, 1, 0) + delete_bytes(0, 0xFFFFFFFF) + row_bytes(0xFFFFFFFF), 1));
}

TEST_CASE("an editor sets and deletes keys, moves and pauses") {
    Editor editor;
    const auto rocket = client_of(editor);
    std::atomic<int> heard = 0;
    rocket->listen([&] { ++heard; });
    rocket->ask({"a:b", "second"});
    rocket->ask({"second", "third"});
    const auto question = [](const std::string& name) { return "\2" + big_endian(std::uint32_t(name.size())) + name; };
    CHECK(editor.read(29) == question("a:b") + question("second") + question("third"));
    CHECK(editor.send(key_bytes(1, 8, 2.5f, 1).substr(0, 5)));  // in two packets
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(!rocket->take().keys);
    CHECK(editor.send(key_bytes(1, 8, 2.5f, 1).substr(5) + key_bytes(1, 4, 1, 0) + key_bytes(0, 0, 7, 3)));
    REQUIRE(soon(*rocket, [&](const RocketNews&) { return !rocket->tracks()[0].keys.empty(); }));
    CHECK(heard > 0);
    CHECK(rocket->tracks() ==
          std::vector<Track>{{"a:b", {{0, 7, Interpolation::ramp}}},
                             {"second", {{4, 1, Interpolation::step}, {8, 2.5, Interpolation::linear}}},
                             {"third", {}}});
    CHECK(editor.send(delete_bytes(1, 4) + row_bytes(12) + row_bytes(13) + pause_bytes(true) + save_bytes));
    RocketNews news;
    REQUIRE(soon(*rocket, [&](const RocketNews& more) {
        if (more.row) news.row = more.row;
        if (more.paused) news.paused = more.paused;
        return more.save;
    }));
    CHECK(news.row == 13);
    CHECK(news.paused == true);
    CHECK(rocket->tracks()[1].keys.size() == 1);
    rocket->tell_row(13), rocket->tell_row(13), rocket->tell_row(14);
    CHECK(editor.read(10) == row_bytes(13) + row_bytes(14));
    editor.end();
    std::string lost;
    REQUIRE(soon(*rocket, [&](const RocketNews& more) { return !(lost = more.lost).empty(); }));
    CHECK(lost == "it has ended the connection");
    rocket->tell_row(15), rocket->ask({"fourth"});  // has no effect
}

TEST_CASE("an editor that sends nonsense is disconnected") {
    for (const std::string& bytes : {std::string("GET / HTTP/1.0"), key_bytes(1, 0, 0, 0), delete_bytes(7, 0)}) {
        Editor editor;
        const auto rocket = client_of(editor);
        rocket->listen([] {});
        rocket->ask({"x"});
        CHECK(editor.send(bytes));
        CHECK(soon(*rocket, [](const RocketNews& news) { return !news.lost.empty(); }));
        CHECK(rocket->tracks() == std::vector<Track>{{"x", {}}});
    }
}

TEST_CASE("without an editor there is a clear error") {
    int port = 0;
    {
        Editor none;
        port = none.port;
    }
    CHECK(fault_of([&] { Rocket rocket(port); }) ==
          "no GNU Rocket editor at 127.0.0.1:" + std::to_string(port) + ": Connection refused");
    Editor other;
    CHECK(fault_of([&] { client_of(other, "SSH-2.0-OpenSSH"); }) ==
          "127.0.0.1:" + std::to_string(other.port) + " is not a GNU Rocket editor: it greets with 'SSH-2.0-Open'");
    Editor silent;
    CHECK(fault_of([&] { client_of(silent, ""); }).ends_with(" is not a GNU Rocket editor: it sends no greeting"));
}

TEST_CASE("an editor is waited for, and again when it is gone") {
    auto editor = std::make_unique<Editor>();
    const int port = editor->port;
    editor.reset();
    Session session(std::make_shared<const Scene>(
        parse_scene("camera { position <5,-20,18> look_at <0,0,0> up <0,0,-1> fov track \"zoom\" 12 }", "test")));
    Pace pace(Pace::Clock::now(), 60);
    Notes notes(pace, false);
    TrackEditor tracks(port, session, notes, pace, [] {});
    const auto soon = [&](const std::function<bool()>& done) {
        for (int i = 0; i < 10000 && !done(); ++i) {
            tracks.follow();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return done();
    };
    const auto told = [&](const std::string& text) {
        return std::ranges::any_of(notes.shown(), [&](const Note& n) { return n.text.starts_with(text); });
    };
    CHECK(soon([&] { return told("no GNU Rocket editor at"); }));
    CHECK(tracks.wanted());
    for (int times = 0; times < 2; ++times) {
        editor = std::make_unique<Editor>(10, port);
        REQUIRE(editor->accept());
        CHECK(soon([&] { return session.flight.driven; }));
        CHECK(editor->read(9) == "\2" + big_endian(4) + "zoom");
        editor.reset();
        CHECK(soon([&] { return !session.flight.driven; }));
        CHECK(told("the Rocket editor is gone: "));
    }
}

TEST_CASE("a flight that an editor drives follows tracks, and does not end") {
    const auto scene = std::make_shared<const Scene>(parse_scene(
        "camera { position <5,-20,18> look_at <0,0,0> up <0,0,-1> fov track \"zoom\" 12 } music { bpm 60 rows 1 }"
        " sphere { <0,0,2>, 2 }",
        "test"));
    Session session(scene);
    session.flight.driven = true;
    session.tracks = std::make_shared<const std::vector<Track>>(
        std::vector<Track>{{"zoom", {{0, 10, Interpolation::linear}, {8, 18, {}}}}});
    CHECK(session.go_to(4, 10));
    CHECK(session.camera.fov == 14);
    CHECK(session.path_to_fly()->duration == 8);
    CHECK(session.go_to(600, 10));
    CHECK(session.time == 600);
    CHECK(session.camera.fov == 18);
    session.perform({Action::pause}, 11);
    CHECK(session.flight.under_way());
    CHECK(!session.follow(1e6));
    session.go_to(2, 1e6);
    session.tracks = nullptr;
    session.follow(1e6);
    CHECK(session.camera.fov == 12);
    session.steer({.right = .1}, 1e6);
    CHECK(!session.flight.flying());
    session.tracks = std::make_shared<const std::vector<Track>>();
    session.replace(scene, true);
    CHECK(!session.tracks);  // those of another scene do not stay
}

TEST_CASE("tracks are saved beside the scene, with a copy of the file as it was") {
    const Scratch folder;
    const std::string path = folder / "scene.rt", file = folder / "scene.tracks";
    std::ofstream(path) << scene_text;
    std::ofstream(file) << "// mine\n";
    Reload reload(path);
    REQUIRE(reload.take(10));
    const auto save = [&](const std::vector<Track>& tracks) {
        reload.write(tracks);
        for (int i = 0; i < 1000; ++i) {
            if (auto written = reload.take_written()) return *written;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        FAIL("nothing was written");
        return Written{};
    };
    const std::vector<Track> first{{"x", {{0, 1, Interpolation::ramp}}}}, second{{"x", {}}, {"y", {{3, 4, {}}}}};
    Written written = save(first);
    CHECK(written.fault == "");
    CHECK(written.file == file);
    CHECK(written.copy == file + "~");
    CHECK(bytes_of(file + "~") == "// mine\n");
    CHECK(parse_tracks(bytes_of(file), file) == first);
    CHECK(bytes_of(file).starts_with("// mine\n"));  // only keys are written
    written = save(second);
    CHECK(written.copy == "");
    CHECK(bytes_of(file + "~") == "// mine\n");
    CHECK(parse_tracks(bytes_of(file), file) == std::vector{second[1]});
    std::ofstream(file) << "// theirs\n";
    CHECK(save(first).copy == file + "~");
    CHECK(bytes_of(file + "~") == "// theirs\n");
    CHECK(folder.files() == 3);
    std::filesystem::remove(path), std::filesystem::remove(file), std::filesystem::remove(file + "~");
    CHECK(save(first).copy == "");
    std::filesystem::remove(file);
    {
        Reload closing(path);
        closing.write(second);
    }
    CHECK(parse_tracks(bytes_of(file), file) == std::vector{second[1]});  // although it was closed at once
    CHECK(with_tracks(first, second) == second);
    CHECK(with_tracks(second, first) == std::vector<Track>{first[0], second[1]});
}

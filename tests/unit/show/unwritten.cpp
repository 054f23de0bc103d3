// Changes that are written, or not, without a window: each of these ways could lose some.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "show/panels/leaving.h"
#include "show/session/session.h"
#include "show/work/reload.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"
#include "tests/unit/show/show_scene.h"
#include "tests/unit/show/soon.h"
#include "text/write.h"

using namespace strahl;

TEST_CASE("nothing is written where nothing has changed; a file that is gone is written again") {
    const Scratch folder;
    const std::string path = folder / "scene.rt",
                      flight =
                          "\nflythrough { duration 4 key { time 0 position <1, 2, 3> look_at <0, 0, 0> }"
                          " key { time 4 position <3, 2, 1> look_at <0, 0, 0> } }\n";
    std::ofstream(path) << scene_text + flight;
    Reload reload(path);
    const auto first = reload.take(10);
    REQUIRE(first);
    CAPTURE(first->fault);
    REQUIRE(first->scene);
    std::optional<Written> written;
    const auto write = [&](ToWrite wanted) {
        reload.write(std::move(wanted));
        return soon([&] { return (written = reload.take_written()).has_value(); });
    };
    const std::optional<Flythrough> same = first->scene->flythrough;
    REQUIRE(write({.flythrough = same}));
    CHECK((written->unchanged && written->fault == ""));
    CHECK(folder.files() == 1);
    CHECK(!reload.take());
    // A path of one key keeps that of the file, and numbers are written beside it.
    EditOrder order;
    EditedText edited;
    edited.open(first->text);
    edited.change("// mine\n" + first->text, {order, "comment"});
    REQUIRE(write({.keeps_path = true, .changes = edited.changes()}));
    CHECK(bytes_of(path) == "// mine\n" + scene_text + flight);
    const auto after = reload.take();
    REQUIRE(after);
    CHECK(after->picture == first->scene);  // its picture goes on being refined
    CHECK(after->scene->flythrough == same);
    // Another path is the same picture, too.
    Flythrough longer = *same;
    longer.duration = 5;
    REQUIRE(write({.flythrough = longer}));
    const auto with_path = reload.take();
    REQUIRE(with_path);
    CHECK(with_path->picture == first->scene);
    CHECK(with_path->scene->flythrough == longer);
    std::filesystem::remove(path);
    REQUIRE(write({.flythrough = longer}));
    CHECK((written->was_gone && written->fault == "" && written->copy == ""));
    CHECK(parse_scene(bytes_of(path), "").flythrough == longer);
}

TEST_CASE("a file keeps its line ends, and the copy of it its permissions") {
    const Scratch folder;
    const std::string path = folder / "scene.rt", tracks = folder / "scene.tracks";
    const auto with_crlf = [](std::string text) {
        for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 2)) text.insert(at, "\r");
        return text;
    };
    std::ofstream(path) << with_crlf(scene_text);
    std::ofstream(tracks) << "track \"a\" {\r\n  0 1 linear\r\n}\r\n";
    std::filesystem::permissions(path, std::filesystem::perms(0600));
    Reload reload(path);
    const auto loaded = reload.take(10);
    REQUIRE(loaded);
    CHECK(loaded->text == scene_text);
    std::optional<Written> written;
    const auto done = [&] { return soon([&] { return (written = reload.take_written()).has_value(); }); };
    const Flythrough flight{4, false, {{0, {1, 2, 3}, {0, 0, 0}, {}, {}}, {4, {3, 2, 1}, {0, 0, 0}, {}, {}}}};
    reload.write({.flythrough = flight});
    REQUIRE(done());
    CHECK(bytes_of(path) == with_crlf(scene_text + "\n" + write_flythrough(flight)));
    CHECK(bytes_of(path + "~") == with_crlf(scene_text));
    CHECK(std::filesystem::status(path + "~").permissions() == std::filesystem::perms(0600));
    reload.write(std::vector{Track{"a", {{0, 2, Interpolation::linear}}}});
    REQUIRE(done());
    CHECK(written->tracks == "track \"a\" {\n  0 2 linear\n}\n");
    CHECK(bytes_of(tracks) == "track \"a\" {\r\n  0 2 linear\r\n}\r\n");
    // A file with both kinds of ends keeps each of them.
    std::ofstream(path, std::ios::app) << "// theirs\n";
    REQUIRE(soon([&] { return reload.take().has_value(); }));
}

TEST_CASE("tracks are read with the scene that was written, and do not lose what the window has") {
    const Scratch folder;
    const std::string path = folder / "scene.rt",
                      text = scene_text + "sphere { <0,0,1>, 1 translate <0, 0, track \"z\"> }\n",
                      keys = "track \"z\" {\n  0 1 linear\n  8 2 linear\n}\n";
    std::ofstream(path) << text;
    std::ofstream(folder / "scene.tracks") << keys;
    Reload reload(path);
    auto loaded = reload.take(10);
    REQUIRE(loaded);
    Session session(loaded->scene);
    CHECK(!session.take_tracks(loaded->tracks, true));
    session.change_track({"z", {{0, 3, Interpolation::linear}, {8, 2, Interpolation::linear}}}, false, 0);
    session.perform({Action::add_key}, 0), session.steer({.push = {1, 0, 0}}, 1), session.perform({Action::add_key}, 1);
    reload.write(session.track_keys.changes());
    reload.write({.flythrough = session.editor.path()});
    for (int i = 0; i < 2; ++i) {
        std::optional<Written> written;
        REQUIRE(soon([&] { return (written = reload.take_written()).has_value(); }));
        CHECK(written->fault == "");
        if (written->tracks) CHECK(!session.take_tracks(*written->tracks, false));
    }
    loaded = reload.take(10);
    REQUIRE(loaded);
    session.replace(loaded->scene, false, loaded->picture);
    CHECK(!session.take_tracks(loaded->tracks, false));
    CHECK((!session.track_keys.changed() && !session.editor.changed()));
    CHECK(session.track_keys.track("z").keys[0].value == 3);
    CHECK(session.pictured != session.scene);  // the earlier scene's picture goes on being refined
}

TEST_CASE("a scene is saved as another file, in another folder with its music, and is watched there") {
    const Scratch folder;
    std::filesystem::create_directory(folder / "old"), std::filesystem::create_directory(folder / "new");
    const std::string path = folder / "old/scene.rt", to = folder / "new/mine.rt",
                      text = scene_text +
                             "music { sound \"a.ogg\" }\n"
                             "sphere { <0,0,1>, 1 translate <0, 0, track \"a.ogg z\"> }\n";
    std::filesystem::copy(STRAHL_SOURCE "/tests/window/clicks.ogg", folder / "old/a.ogg");
    std::ofstream(path) << text;
    std::ofstream(folder / "old/scene.tracks") << "track \"a.ogg z\" {\n  0 1 linear\n}\n";
    std::ofstream(to) << "theirs";
    Reload reload(path);
    REQUIRE(reload.take(10));
    std::optional<Written> written;
    const auto save = [&](const std::string& as, const std::string& changed) {
        reload.write_as(as, changed, {}, {{"a.ogg z", {{0, 5, Interpolation::linear}}}});
        return soon([&] { return (written = reload.take_written()).has_value(); });
    };
    REQUIRE(save(folder / "missing/mine.rt", text));
    CHECK(written->refused);
    REQUIRE(save(path, text));
    CHECK(says(written->fault, "own file"));
    REQUIRE(save(to, "// mine\n" + text));
    CHECK(written->fault == "");
    const auto loaded = reload.take(10);
    REQUIRE(loaded);
    CHECK((loaded->renamed && !loaded->opened && loaded->path == to));
    CHECK(loaded->scene->music.sound == "../old/a.ogg");
    CHECK(says(bytes_of(to), "// mine\n"));
    CHECK(says(bytes_of(to), "track \"a.ogg z\""));
    CHECK(bytes_of(to + "~") == "theirs");
    CHECK(bytes_of(path) == text);
    CHECK(says(bytes_of(folder / "new/mine.tracks"), "0 5 linear"));
    std::ofstream(to, std::ios::app) << "sphere { <0,0,9>, 1 }\n";
    std::optional<Loaded> changed;
    REQUIRE(soon([&] { return (changed = reload.take()).has_value(); }));
    CHECK(changed->path == to);
}

TEST_CASE("a scene is left once it is written or dropped, and not if the user stays") {
    using Answer = Leaving::Decision;
    Leaving leaving;
    int left = 0;
    const auto ask = [&] { leaving.ask("a.rt", {"line 1"}, [&] { ++left; }); };
    ask();
    CHECK(leaving.asking());
    CHECK(!leaving.take(Answer::none));
    CHECK(!leaving.take(Answer::stay));
    leaving.follow(false);
    CHECK((!leaving.asking() && left == 0));
    ask();
    CHECK(!leaving.take(Answer::drop));
    CHECK((!leaving.asking() && left == 1));
    ask();
    leaving.follow(false);  // nothing was answered yet
    CHECK(leaving.asking());
    CHECK(leaving.take(Answer::write));
    leaving.follow(true);  // it cannot be written, or not yet
    CHECK((leaving.asking() && left == 1));
    leaving.follow(false);
    CHECK((!leaving.asking() && left == 2));
    ask();
    CHECK(!leaving.take(Answer::save_as));  // a dialog asks where first
    leaving.follow(true);
    CHECK((leaving.asking() && left == 2));
    leaving.follow(false);
    CHECK((!leaving.asking() && left == 3));
}

// The files of the window's threads: stills written in the background, and the scene file read again.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>

#include "image/picture.h"
#include "num/thread_pool.h"
#include "show/window/window_state.h"
#include "show/work/notes.h"
#include "show/work/reload.h"
#include "show/work/still_requests.h"
#include "show/work/stills.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"
#include "tests/unit/show/show_scene.h"
#include "tests/unit/show/soon.h"
#include "text/write.h"

using namespace strahl;

TEST_CASE("stills equal rendered pictures and replace no file") {
    const Scratch folder;
    const auto scene = shown_scene();
    const View view{.camera = scene->camera, .width = 20, .height = 15, .depth = 5};
    {
        std::ofstream(folder / "still.bmp") << "mine";
        Stills stills(2, [] {});
        for (int i = 0; i < 3; ++i) stills.add({scene, view, folder / "still"});
        stills.add({scene, view, folder / "still", ".png"});
        CHECK(stills.pending() > 0);
        REQUIRE(soon([&] { return stills.pending() == 0; }));
        std::set<std::string> paths;
        for (const auto& outcome : stills.outcomes()) {
            CHECK(outcome.fault == "");
            paths.insert(outcome.path);
        }
        CHECK(paths == std::set<std::string>{folder / "still-2.bmp", folder / "still-3.bmp", folder / "still-4.bmp",
                                             folder / "still.png"});
        CHECK(stills.outcomes().empty());
    }
    CHECK(bytes_of(folder / "still.bmp") == "mine");
    CHECK(folder.files() == 5);
    ThreadPool pool(2);
    Tracer tracer(*scene, Precision::float64);
    const std::vector<double> rgb = values_of(tracer, view, {.columns = 20, .rows = 15}, pool, Sampling{});
    write_picture({20, 15, 3, rgb}, folder / "reference.bmp", {});
    CHECK(bytes_of(folder / "still-2.bmp") == bytes_of(folder / "reference.bmp"));
}

TEST_CASE("unfinished stills are dropped by name and leave no file") {
    const Scratch folder;
    const auto scene = shown_scene();
    Stills stills(2, [] {});
    for (const char* name : {"a", "b"})
        stills.add({scene, {.camera = scene->camera, .width = 8000, .height = 6000}, folder / name});
    CHECK(stills.drop() == std::vector<std::string>{folder / "a", folder / "b"});
    CHECK(folder.files() == 0);
}

TEST_CASE("a still that cannot be written reports the reason") {
    const Scratch folder;
    const auto scene = shown_scene();
    Stills stills(1, [] {});
    stills.add({scene, {.camera = scene->camera, .width = 4, .height = 3}, folder / "missing/still"});
    REQUIRE(soon([&] { return stills.pending() == 0; }));
    const auto outcomes = stills.outcomes();
    REQUIRE(outcomes.size() == 1);
    CHECK(outcomes[0].fault.find("missing/still.bmp") != std::string::npos);
}

TEST_CASE("a still is named after its scene and the time") {
    const std::string name = still_name("some/where/article.rt", {});
    CHECK(name.starts_with("article-20"));
    CHECK(name.size() == std::string("article-20260131-235959").size());
    CHECK(still_name("-", {}).starts_with("scene-"));
    CHECK(still_name("-", 12.5).ends_with("-at-12.5s"));
}

TEST_CASE("a folder in which stills cannot be written is found before they are traced") {
    const Scratch folder;
    CHECK(folder_fault(folder / "") == "");
    CHECK(folder_fault("") == "");
    std::ofstream(folder / "file") << "mine";
    CHECK(folder_fault(folder / "file").ends_with("Not a directory"));
    const std::string fault = "stills cannot be written into '" + folder / "missing" + "': No such file or directory";
    CHECK(folder_fault(folder / "missing") == fault);
    Pace pace(Pace::Clock::now(), 60);
    Notes notes(pace, false);
    ViewOptions options;
    options.still_folder = folder / "missing";
    const StillRequests told(options, notes, pace, [] {});
    REQUIRE(notes.shown().size() == 1);
    CHECK(notes.shown()[0].text == fault);
    CHECK(notes.shown()[0].failure);
}

TEST_CASE("a changed scene file is read again, a broken one reported, a touched one ignored") {
    const Scratch folder;
    const std::string path = folder / "scene.rt";
    const auto put = [&](const std::string& content) {
        std::ofstream(folder / "new") << content;
        std::filesystem::rename(folder / "new", path);
    };
    put(scene_text);
    Reload reload(path);
    std::optional<Loaded> loaded;
    const auto next = [&] { return (loaded = reload.take(10)).has_value(); };
    REQUIRE(next());
    CHECK(loaded->scene);
    CHECK(loaded->opened);

    put(scene_text + "light { position <0,0,9> color <1,1,1> }");
    REQUIRE(next());
    REQUIRE(loaded->scene);
    CHECK(loaded->scene->lights.size() == 2);
    CHECK(!loaded->opened);

    put(scene_text + "lihgt { }");
    REQUIRE(next());
    CHECK(!loaded->scene);
    CHECK(loaded->fault.find("scene.rt:7:1") != std::string::npos);

    std::filesystem::remove(path);  // as some editors do for a moment
    put(scene_text + "lihgt { }");  // the same again: nothing new
    put(scene_text);
    REQUIRE(next());
    CHECK(loaded->scene);

    const std::string other = folder / "other.rt";
    std::ofstream(other) << "camera {";
    reload.open(other);
    REQUIRE(next());
    CHECK(loaded->opened);
    CHECK(!loaded->scene);
    reload.open(folder / "nothing.rt");
    REQUIRE(next());
    CHECK(loaded->fault.find("nothing.rt") != std::string::npos);
    reload.open("/dev/zero");
    REQUIRE(next());
    CHECK(loaded->fault == "cannot read '/dev/zero': it is not a regular file");
    put(scene_text + " ");  // still the one that is watched
    REQUIRE(next());
    CHECK(loaded->path == path);

    std::ofstream(other) << scene_text;
    reload.open(other);
    REQUIRE(next());
    CHECK(loaded->path == other);
    CHECK(loaded->scene);
    std::ofstream(other) << scene_text << "light { position <0,0,9> color <1,1,1> }";
    REQUIRE(next());
    CHECK(loaded->scene->lights.size() == 2);
}

TEST_CASE("a pipe is read when somebody writes into it, and never again; nobody waits for it") {
    const Scratch folder;
    const std::string path = folder / "pipe.rt";
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    {
        Reload reload(path);
        CHECK(!reload.take(.01));
        std::ofstream(path) << scene_text;
        const auto loaded = reload.take(10);
        REQUIRE(loaded);
        CHECK(loaded->scene);
        CHECK(::open(path.c_str(), O_WRONLY | O_NONBLOCK) == -1);  // has no reader
    }
    const auto began = std::chrono::steady_clock::now();
    {
        Reload reload(path);
        CHECK(!reload.take(.01));
    }
    CHECK(std::chrono::steady_clock::now() - began < std::chrono::seconds(4));
    // The thread that was left behind reads this, and ends.
    std::ofstream(path) << scene_text;
}

TEST_CASE("a path is written into the scene file, of which a copy stays; a file changed meanwhile is asked about") {
    const Scratch folder;
    const std::string path = folder / "scene.rt", comment = "// mine\n";
    const auto put = [&](const std::string& content) { std::ofstream(path) << content; };
    put(scene_text + comment);
    Reload reload(path);
    REQUIRE(reload.take(10));
    std::optional<Written> written;
    const auto write = [&](std::optional<Flythrough> flythrough, bool anyway) {
        reload.write({.flythrough = std::move(flythrough), .anyway = anyway});
        return soon([&] { return (written = reload.take_written()).has_value(); });
    };
    Flythrough flight{4, false, {{0, {1, 2, 3}, {0, 0, 0}, {}, {}}, {4, {3, 2, 1}, {0, 0, 0}, {}, {}}}};
    REQUIRE(write(flight, false));
    CHECK(written->fault == "");
    CHECK(written->copy == path + "~");
    CHECK(bytes_of(path + "~") == scene_text + comment);
    CHECK(bytes_of(path) == scene_text + comment + "\n" + write_flythrough(flight));
    const auto loaded = reload.take();
    REQUIRE(loaded);
    CHECK(loaded->scene->flythrough == flight);
    // Written again: the copy stays that of the file which others wrote.
    flight.duration = 5;
    REQUIRE(write(flight, false));
    CHECK(written->copy == "");
    CHECK(bytes_of(path + "~") == scene_text + comment);
    CHECK(parse_scene(bytes_of(path), "").flythrough == flight);

    const std::string other = scene_text + "// theirs\n";
    put(other);
    REQUIRE(write(flight, false));
    CHECK(written->asks);
    CHECK(bytes_of(path) == other);
    REQUIRE(write(flight, true));
    CHECK(bytes_of(path) == other + "\n" + write_flythrough(flight));
    CHECK(bytes_of(path + "~") == other);

    put("camera {");
    REQUIRE(write(flight, true));
    CHECK(written->fault.find("scene.rt:1:") != std::string::npos);
    CHECK(bytes_of(path) == "camera {");
}

TEST_CASE("the flight of a scene of POV-Ray is written beside it, in its coordinates") {
    const Scratch folder;
    const std::string path = folder / "scene.pov", text = "camera { location <0, 0, -5> } sphere { 0, 1 }";
    std::ofstream(path) << text;
    Reload reload(path);
    REQUIRE(reload.take(10));
    std::optional<Written> written;
    const auto write = [&](std::optional<Flythrough> flight) {
        reload.write({.flythrough = std::move(flight), .anyway = true});
        return soon([&] { return (written = reload.take_written()).has_value(); });
    };
    REQUIRE(write({}));
    CHECK(written->unchanged);
    CHECK(folder.files() == 1);
    Flythrough flight{4, false, {{0, {1, 2, 3}, {0, 0, 0}, {}, {}}, {4, {3, 2, 1}, {0, 0, 0}, {}, {}}}};
    REQUIRE(write(flight));
    CHECK(written->fault == "");
    CHECK(written->file == folder / "scene.flight");
    CHECK(says(bytes_of(folder / "scene.flight"), "key { time 0  position <1, 2, -3>  look_at <0, 0, 0> }"));
    CHECK(reload.take()->scene->flythrough == flight);
    // Comments stay, and a copy of a file that others have changed.
    const std::string theirs = "// mine\n" + bytes_of(folder / "scene.flight");
    std::ofstream(folder / "scene.flight") << theirs;
    flight.duration = 5;
    REQUIRE(write(flight));
    CHECK(bytes_of(folder / "scene.flight~") == theirs);
    CHECK(bytes_of(folder / "scene.flight").starts_with("// mine\n"));
    REQUIRE(write({}));
    CHECK(bytes_of(folder / "scene.flight") == "// mine\n");
    CHECK(bytes_of(path) == text);
    // Numbers are written into the scene itself, and a path with them into its own file.
    while (reload.take()) continue;
    EditOrder order;
    EditedText edited;
    edited.open(text);
    edited.change("camera { location <0, 0, -5> } sphere { 0, 2 }", {order, "radius"});
    reload.show(edited.text());
    std::optional<Loaded> shown;
    REQUIRE(soon([&] { return (shown = reload.take_shown()).has_value(); }));
    CHECK(shown->text == edited.text());
    CHECK(std::get<Sphere>(shown->scene->primitives[0].shape).radius == 2);
    reload.write({.flythrough = flight, .changes = edited.changes(), .anyway = true});
    REQUIRE(soon([&] { return (written = reload.take_written()).has_value(); }));
    CHECK(written->fault == "");
    CHECK(bytes_of(path) == edited.text());
    CHECK(bytes_of(folder / "scene.pov~") == text);
    CHECK(says(bytes_of(folder / "scene.flight"), "duration 5"));
}

TEST_CASE("a scene of POV-Ray is read again when a file changes that it includes, and for moments of its clock") {
    const Scratch folder;
    const std::string path = folder / "scene.pov", included = folder / "ball.inc";
    std::ofstream(path) << "camera { location -5*z } #include \"ball.inc\" sphere { Centre, 1 }";
    Reload reload(path);
    std::optional<Loaded> loaded;
    const auto next = [&] { return (loaded = reload.take(10)).has_value(); };
    REQUIRE(next());
    CHECK(says(loaded->fault, "cannot find 'ball.inc'"));
    std::ofstream(included) << "#declare Centre = );";
    std::ofstream(path, std::ios::app) << " ";
    REQUIRE(next());
    CHECK(says(loaded->fault, "ball.inc:1"));
    std::ofstream(included) << "#declare Centre = <3, 0, 0>;";  // it had an error, and is watched nevertheless
    REQUIRE(next());
    REQUIRE(loaded->scene);
    CHECK(std::get<Sphere>(loaded->scene->primitives[0].shape).centre.x == 3);
    CHECK(!loaded->changes);
    std::ofstream(included) << "#declare Centre = <10*clock, 0, 0>;";
    REQUIRE(next());
    CHECK(loaded->changes);
    CHECK(!loaded->moved);
    reload.move_to({5, 640, 480});
    REQUIRE(next());
    CHECK(loaded->moved);
    CHECK(std::get<Sphere>(loaded->scene->primitives[0].shape).centre.x == 5);
    std::ofstream(folder / "scene.ini") << "Final_Frame=251 Final_Clock=1\nFinal_Clock=3\n";
    REQUIRE(next());
    CHECK(std::get<Sphere>(loaded->scene->primitives[0].shape).centre.x == doctest::Approx(15));

    // A text that was changed is shown at the moment that is seen, and stays for other moments.
    const std::string text = bytes_of(path), changed = text.substr(0, text.find("1 }")) + "2 }";
    CHECK(loaded->text == text);
    reload.show(changed);
    REQUIRE(soon([&] { return (loaded = reload.take_shown()).has_value(); }));
    const auto ball = [&] { return std::get<Sphere>(loaded->scene->primitives[0].shape); };
    CHECK(ball().radius == 2);
    CHECK(ball().centre.x == doctest::Approx(15));
    reload.move_to({2.5, 640, 480});
    REQUIRE(next());
    CHECK(loaded->moved);
    CHECK(loaded->text == changed);
    CHECK(ball().radius == 2);
    CHECK(ball().centre.x == doctest::Approx(7.5));
    EditOrder order;
    EditedText edited;
    edited.open(text);
    edited.change(changed, {order, "change"});
    reload.write({.changes = edited.changes()});
    std::optional<Written> written;
    REQUIRE(soon([&] { return (written = reload.take_written()).has_value(); }));
    CHECK(written->fault == "");
    CHECK(bytes_of(path) == changed);
}

TEST_CASE("a scene that asks for the picture's size is read again for the size of the window") {
    const Scratch folder;
    const std::string path = folder / "scene.pov";
    std::ofstream(path) << "camera { location -6*z right x*image_width/image_height look_at 0 }\n"
                           "sphere { 0, image_height/1000 }\n";
    OpeningOptions first;
    first.size = {900, 600};
    Reload reload(path, first);
    std::optional<Loaded> loaded;
    const auto next = [&] { return soon([&] { return (loaded = reload.take()).has_value(); }); };
    const auto radius = [&] { return std::get<Sphere>(loaded->scene->primitives[0].shape).radius; };
    REQUIRE(next());
    REQUIRE(loaded->scene);
    CHECK((loaded->sized && !loaded->moved && radius() == .6 && !loaded->scene->camera.aspectratio));
    reload.move_to({0, 700, 300});
    REQUIRE(next());
    CHECK((loaded->sized && loaded->moved && radius() == .3 && !loaded->scene->camera.aspectratio));
    std::ofstream(path, std::ios::app) << "sphere { 3, 1 }\n";  // the file is read for the new size, too
    REQUIRE(next());
    CHECK((!loaded->moved && radius() == .3 && loaded->read_for.width == 700));
}

TEST_CASE("changed numbers are shown before they are written, and are written beside what others have changed") {
    const Scratch folder;
    const std::string path = folder / "scene.rt", color = "<1,.2,.2>";
    const auto with_color = [&](const std::string& other) {
        return std::string(scene_text).replace(scene_text.find(color), color.size(), other);
    };
    const auto put = [&](const std::string& content) { std::ofstream(path) << content; };
    put(scene_text);
    Reload reload(path);
    REQUIRE(reload.take(10));
    const std::string changed = with_color("<0,.2,.2>");
    reload.show(changed);
    std::optional<Loaded> shown;
    REQUIRE(soon([&] { return (shown = reload.take_shown()).has_value(); }));
    REQUIRE(shown->scene);
    CHECK(shown->text == changed);
    CHECK(shown->scene->materials[0].rgb.color.x == 0);
    CHECK(bytes_of(path) == scene_text);
    std::optional<Written> written;
    const auto write = [&] {
        EditOrder order;
        EditedText edited;
        edited.open(scene_text);
        edited.change(changed, {order, "change"});
        reload.write({.changes = edited.changes(), .anyway = true});
        return soon([&] { return (written = reload.take_written()).has_value(); });
    };
    put("// theirs\n" + scene_text);
    REQUIRE(write());
    CHECK(written->what == "changes");
    CHECK(bytes_of(path) == "// theirs\n" + changed);
    put(with_color("<.5,.2,.2>"));  // the same line
    REQUIRE(write());
    CHECK(written->fault.find("has changed in lines that were changed here") != std::string::npos);
    CHECK(bytes_of(path) == with_color("<.5,.2,.2>"));
}

TEST_CASE("the window's size and place are kept in the XDG state folder") {
    const Scratch folder;
    ::setenv("XDG_STATE_HOME", (folder / "new/state").c_str(), 1);
    CHECK(!read_window_state());
    write_window_state({-5, 20, 800, 600});
    CHECK(read_window_state() == WindowState{-5, 20, 800, 600});
    CHECK(bytes_of(folder / "new/state/strahl/window") == "-5 20 800 600\n");
    write_window_state({1, 2, 0, 0});
    CHECK(read_window_state() == WindowState{1, 2, 0, 0});
    for (const char* bad : {"", "1 2 3", "1 2 3 4", "1 2 90000 100", "1 2 800 -600", "a b c d"}) {
        std::ofstream(folder / "new/state/strahl/window") << bad;
        CHECK(!read_window_state());
    }
    std::ofstream(folder / "new/state/strahl/window") << "\xEF\xBB\xBF"
                                                         "1 2 300 400";
    CHECK(read_window_state() == WindowState{1, 2, 300, 400});
    CHECK(
        !window_state_in("\xFF\xFE"
                         "1"));
    ::setenv("XDG_STATE_HOME", "relative", 1);  // to be ignored, says the specification
    ::setenv("HOME", (folder / "home").c_str(), 1);
    CHECK(window_state_file() == folder / "home/.local/state/strahl/window");
    ::unsetenv("HOME");
    CHECK(window_state_file() == "");
    write_window_state({1, 2, 300, 400});  // nowhere, and no error
    CHECK(!read_window_state());
}

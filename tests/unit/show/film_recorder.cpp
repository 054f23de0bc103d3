// Films of the window's flight, by a program in place of ffmpeg whose film is the stream of frames.
#include "show/film_recorder.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "scene/moving_scene.h"
#include "tests/unit/scratch.h"
#include "tests/unit/show/show_scene.h"
#include "tests/unit/show/soon.h"

using namespace strahl;

namespace {

const std::string short_path =
    "flythrough { duration .2 key { time 0 position <0,-9,2> look_at <0,0,0> }"
    " key { time .2 position <1,-9,2> look_at <0,0,0> } }";

/// A recorder in a folder of its own.
struct FilmStudio {
    explicit FilmStudio(const std::string& script) : path_before(std::getenv("PATH")) {
        std::filesystem::create_directory(folder / "bin");
        std::ofstream(folder / "bin/ffmpeg") << "#!/bin/sh\n" << script;
        std::filesystem::permissions(folder / "bin/ffmpeg", std::filesystem::perms::owner_all);
        ::setenv("PATH", ((folder / "bin:") + path_before).c_str(), 1);
        options.still_folder = folder / "films", options.threads = 1;
        std::filesystem::create_directory(options.still_folder);
    }
    ~FilmStudio() { ::setenv("PATH", path_before.c_str(), 1); }
    void await_end() {
        CHECK(soon([this] { return recorder.tell_done(), !recorder.under_way(); }));
    }
    /// The only film; "" if there is none.
    std::string film() const {
        const std::filesystem::directory_iterator files(options.still_folder);
        return files == std::filesystem::directory_iterator() ? "" : files->path().string();
    }

    const Scratch folder;
    const std::string path_before;
    ViewOptions options;
    Pace pace{Pace::Clock::now(), 60};
    Notes notes{pace, false};
    FilmRecorder recorder{options, notes, pace, [] {}};
};
// ffmpeg's last argument is the film.
const std::string copies = "for file; do :; done\nexec cat >\"${file#file:}\"\n";

int frames_in(const std::string& file) {
    std::ostringstream read;
    read << std::ifstream(file, std::ios::binary).rdbuf();
    const std::string bytes = read.str();
    int count = 0;
    for (std::size_t at = 0; (at = bytes.find("FRAME\n", at)) != bytes.npos; ++at) ++count;
    return count;
}

}  // namespace

TEST_CASE("a film shows the flight as it is edited, from where the camera is if nothing moves that") {
    Session still(shown_scene());
    CHECK(!film_of(still, "a/scene.rt", 64, 48));
    Scene with_sound = *shown_scene(short_path);
    with_sound.music.sound = "m.ogg";
    Session session(std::make_shared<const Scene>(with_sound));
    Keyframe last = session.editor.path().keys[1];
    last.time = .5, last.position = {3, -9, 2};
    session.change_key(1, last, false, 0);
    const auto order = film_of(session, "a/scene.rt", 65, 49);
    REQUIRE(order);
    CHECK(order->view.width == 64);
    CHECK(order->view.height == 48);
    CHECK(order->scene.flythrough->keys.size() == 2);
    CHECK(camera_at(order->scene, .5).position.x > 1.5);
    REQUIRE(order->sound);
    CHECK(order->sound->file == "a/m.ogg");
    Session moving(shown_scene("sphere { <0,0,0>, 1 motion { key { time 0 } key { time 3 translate <1,0,0> } } }"));
    moving.steer({.right = 1}, 0);
    const auto seen = film_of(moving, "scene.rt", 64, 48);
    REQUIRE(seen);
    CHECK(camera_at(seen->scene, 1) == moving.camera);
    CHECK(!seen->sound);
}

TEST_CASE("a film is made in the background; ended early it keeps its first frames, and a failure leaves nothing") {
    const Session session(shown_scene(short_path));
    {
        FilmStudio studio(copies);
        studio.recorder.toggle(session, "scene.rt", 16, 12);
        CHECK(studio.recorder.under_way());
        CHECK(studio.recorder.progress_text().starts_with("A film: "));
        studio.await_end();
        CHECK(!studio.recorder.failed());
        CHECK(studio.recorder.progress_text().empty());
        CHECK(studio.film().ends_with(".mp4"));
        CHECK(frames_in(studio.film()) == 5);
    }
    std::string longer = short_path;
    longer.replace(longer.find("duration .2"), 11, "duration 9999");
    const Session endless(shown_scene(longer));
    {
        FilmStudio studio(copies);
        studio.recorder.toggle(endless, "scene.rt", 16, 12);
        CHECK(soon([&] { return studio.recorder.progress() > 0; }));
        studio.recorder.finish();  // waits
        CHECK(studio.recorder.progress_text().ends_with("Esc ends it"));
        studio.recorder.toggle(endless, "scene.rt", 16, 12);
        studio.await_end();
        CHECK(!studio.recorder.failed());
        if (!studio.film().empty()) CHECK(studio.film().ends_with(".part.mp4"));
    }
    {
        FilmStudio studio("echo no such codec >&2\nexit 1\n");
        studio.recorder.toggle(session, "scene.rt", 16, 12);
        studio.await_end();
        CHECK(studio.recorder.failed());
        CHECK(studio.film().empty());
    }
}

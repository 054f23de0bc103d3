// The gallery's contents, the files opened last, and new scenes, without a window.
#include <doctest/doctest.h>
#include <stdlib.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "files/error.h"
#include "num/thread_pool.h"
#include "show/welcome/gallery.h"
#include "show/welcome/gallery_reader.h"
#include "show/welcome/recent_files.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"
#include "tests/unit/show/show_scene.h"
#include "tests/unit/show/soon.h"

using namespace strahl;
using Paths = std::vector<std::string>;

TEST_CASE("the files opened last are kept, the last one first, and no more than some") {
    CHECK(recent_files_in("/a\n/b c\nrelative\n\n/d") == Paths{"/a", "/b c", "/d"});
    CHECK(recent_files_in("").empty());
    CHECK(recent_files_in(std::string("/a\0b\n/c\n", 8)) == Paths{"/c"});
    CHECK(with_recent({"/a", "/b"}, {"/b", "/c"}) == Paths{"/c", "/b", "/a"});
    CHECK(with_recent({"/a"}, {"-", "/x\ny", "/b/../a"}) == Paths{"/a"});
    CHECK(with_recent({}, {"scene.rt"}) == Paths{std::filesystem::absolute("scene.rt")});
    Paths many;
    for (int i = 0; i < 100; ++i) many.push_back("/" + std::to_string(i));
    CHECK(with_recent({"/a"}, many).size() == most_recent_files);
    CHECK(with_recent({"/a"}, many).front() == "/99");

    const Scratch folder;
    ::setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);
    CHECK(recent_files_file() == folder / "state/strahl/recent");
    CHECK(read_recent_files().empty());
    remember_recent_files({});
    CHECK(folder.files() == 0);
    remember_recent_files({"/a.rt", "/b.rt"});
    remember_recent_files({"/a.rt"});
    CHECK(read_recent_files() == Paths{"/a.rt", "/b.rt"});
    ::setenv("XDG_STATE_HOME", "relative", 1);  // is ignored
    ::setenv("HOME", (folder / "home").c_str(), 1);
    CHECK(recent_files_file() == folder / "home/.local/state/strahl/recent");
}

TEST_CASE("the gallery has templates, recent files that are still there, and the scenes of the folder") {
    const std::string scenes = STRAHL_SOURCE "/scenes";
    const Scratch folder;
    std::ofstream(folder / "my_own.rt") << scene_text;
    const auto sections = gallery_of(scenes, {folder / "gone.rt", folder / "my_own.rt", folder / "."});
    REQUIRE(sections.size() > 3);
    CHECK(sections[0].items.size() == 3);
    for (const GalleryItem& item : sections[0].items) CHECK(item.begins);
    CHECK(sections[1].items == std::vector<GalleryItem>{{"my own", folder / "my_own.rt"}});
    CHECK(sections[2].items[0] == GalleryItem{"article", scenes + "/article.rt"});
    std::set<std::string> paths;
    for (const GallerySection& section : sections)
        for (const GalleryItem& item : section.items) paths.insert(item.path);
    CHECK(paths.contains(scenes + "/kinds/torus.rt"));
    CHECK(!paths.contains(scenes + "/crosscheck/boxes.rt"));
    CHECK(gallery_of("", {}).empty());
    CHECK(gallery_of(folder / "missing", {}).empty());
}

TEST_CASE("arrows go from item to item, and from section to section") {
    std::vector<GallerySection> sections{
        {"a", std::vector<GalleryItem>(3)}, {"b", std::vector<GalleryItem>(6)}, {"c", std::vector<GalleryItem>(1)}};
    const auto go = [&](GalleryPlace from, int items, int rows) { return moved(sections, from, items, rows, 4); };
    CHECK(go({0, 0}, 1, 0) == GalleryPlace{0, 1});
    CHECK(go({0, 2}, 1, 0) == GalleryPlace{1, 0});
    CHECK(go({1, 0}, -1, 0) == GalleryPlace{0, 2});
    CHECK(go({0, 0}, -1, 0) == GalleryPlace{0, 0});
    CHECK(go({2, 0}, 1, 0) == GalleryPlace{2, 0});
    CHECK(go({0, 2}, 0, 1) == GalleryPlace{1, 2});
    CHECK(go({1, 2}, 0, 1) == GalleryPlace{1, 5});
    CHECK(go({1, 5}, 0, 1) == GalleryPlace{2, 0});
    CHECK(go({1, 3}, 0, -1) == GalleryPlace{0, 2});
    CHECK(go({2, 0}, 0, -1) == GalleryPlace{1, 4});
    CHECK(go({1, 5}, 0, -1) == GalleryPlace{1, 1});
    CHECK(go({0, 0}, 0, -1) == GalleryPlace{0, 0});
    CHECK(go({2, 0}, 0, 1) == GalleryPlace{2, 0});
    sections.clear();
    CHECK(go({}, 1, 1) == GalleryPlace{});
}

TEST_CASE("a new scene is a copy of its template and replaces no file") {
    const Scratch folder;
    const std::string floor = STRAHL_SOURCE "/scenes/templates/empty_floor.rt";
    CHECK(begin_scene(floor, folder / "mine") == folder / "mine.rt");
    CHECK(bytes_of(folder / "mine.rt") == bytes_of(floor));
    std::ofstream(folder / "mine.rt") << "mine";
    CHECK(fault_of([&] { begin_scene(floor, folder / "mine.rt"); }).find("exists") != std::string::npos);
    CHECK(bytes_of(folder / "mine.rt") == "mine");
    CHECK(fault_of([&] { begin_scene(floor, folder / "missing/mine.rt"); }) != "");
    CHECK(fault_of([&] { begin_scene(folder / "missing.rt", folder / "other.rt"); }) != "");
    CHECK(folder.files() == 1);
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder / ".");
    CHECK(begin_scene(floor, "") == "untitled.rt");
    CHECK(begin_scene(floor, "") == "untitled-2.rt");
    std::filesystem::current_path(before);
    CHECK(bytes_of(folder / "untitled-2.rt") == bytes_of(floor));
}

TEST_CASE("small pictures are made of what is wanted, and none of what cannot be read") {
    const Scratch folder;
    ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    std::ofstream(folder / "scene.rt") << scene_text;
    std::ofstream(folder / "broken.rt") << "sphere {";
    std::ofstream(folder / "endless.rt") << "#declare i = 0;\n#while (1)\n#declare i = i + 1;\n#end\n";
    ThreadPool pool(1);
    std::atomic<bool> stop = false;
    const ScreenImage picture = small_picture(folder / "scene.rt", 20, 15, pool, stop).image;
    CHECK(picture.width == 20);
    CHECK(std::set(picture.pixels.begin(), picture.pixels.end()).size() > 10);
    CHECK(small_picture(folder / "missing.rt", 20, 15, pool, stop).image.width == 0);

    std::vector<GalleryReader::GalleryNews> made;
    GalleryReader reader(1, [] {});
    const auto take = [&] {
        while (auto one = reader.take()) made.push_back(*std::move(one));
        return made.size();
    };
    reader.list();
    CHECK(soon([&] { return take() == 1; }));
    CHECK(made[0].listed.has_value());
    made.clear();
    reader.want({folder / "broken.rt", folder / "endless.rt", folder / "scene.rt"}, 20, 15);
    CHECK(soon([&] { return take() == 1; }));
    CHECK(made[0].picture.image.width == 0);
    CHECK(made[0].picture.fault.find("broken.rt:1:9") != std::string::npos);
    reader.want({folder / "scene.rt", folder / "broken.rt"}, 20, 15);  // the endless one is given up
    CHECK(soon([&] { return take() == 2; }));
    CHECK(made[1].path == folder / "scene.rt");
    CHECK(made[1].picture.image.pixels == picture.pixels);
    reader.want({folder / "endless.rt"}, 20, 15);  // the endless one is given up when the reader ends, too
    ::unsetenv("XDG_CACHE_HOME");
}

TEST_CASE("small pictures are kept until a file that was read for them changes") {
    const Scratch folder;
    ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    const std::string scene = folder / "scene.rt";
    std::ofstream(scene) << "#include \"ball.inc\"\n" << scene_text;
    const auto write_ball = [&](const char* color, int hours) {
        std::ofstream(folder / "ball.inc") << "sphere { <0,0,0>, 1 material { rgb " << color << " ambient 1 } }\n";
        std::filesystem::last_write_time(folder / "ball.inc",
                                         std::filesystem::file_time_type::clock::now() - std::chrono::hours(hours));
    };
    write_ball("<1,0,0>", 3);
    ThreadPool pool(1);
    std::atomic<bool> stop = false;
    CHECK(kept_picture(scene, 20, 15).width == 0);
    const ScreenImage red = small_picture(scene, 20, 15, pool, stop).image;
    REQUIRE(red.width == 20);
    CHECK(kept_picture(scene, 20, 15).pixels == red.pixels);
    CHECK(kept_picture(scene, 20, 16).width == 0);
    write_ball("<0,1,0>", 2);
    CHECK(kept_picture(scene, 20, 15).width == 0);
    const ScreenImage green = small_picture(scene, 20, 15, pool, stop).image;
    CHECK(green.pixels != red.pixels);
    CHECK(kept_picture(scene, 20, 15).pixels == green.pixels);
    for (const auto& file : std::filesystem::directory_iterator(folder / "cache/strahl/pictures"))
        std::filesystem::resize_file(file, 100);
    CHECK(kept_picture(scene, 20, 15).width == 0);
    ::unsetenv("XDG_CACHE_HOME");
}

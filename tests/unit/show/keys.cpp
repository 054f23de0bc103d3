// The keys of the window, the user's file of keys, and the help on them.
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "show/keys/key_file.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"

using namespace strahl;

namespace {

constexpr int ctrl = GLFW_MOD_CONTROL, shift = GLFW_MOD_SHIFT;

std::optional<Command> given(const KeyMap& keys, int key, int modifiers = 0) {
    return keys.command_of_key(key, 0, modifiers, false);
}

}  // namespace

TEST_CASE("each key has one usual meaning, and its name can be read again") {
    const KeyMap usual;
    std::set<std::string> names, words;
    for (std::size_t i = 0; i < command_helps.size(); ++i) {
        CAPTURE(command_helps[i].keys);
        if (*command_helps[i].word) CHECK(words.insert(command_helps[i].word).second);
        for (const KeyPress& key : usual.keys[i]) {
            CHECK(names.insert(text_of(key)).second);
            CHECK(key_press(text_of(key)) == key);
        }
        if (*command_helps[i].word) CHECK(text_of(usual.keys[i]) == command_helps[i].keys);
    }
    CHECK(key_press("ctrl+shift+z") == KeyPress{'Z', ctrl | shift});
    CHECK(key_press("Shift+Ctrl+z") == KeyPress{'Z', ctrl | shift});
    CHECK(key_press("f25") == KeyPress{GLFW_KEY_F25});
    for (const char* const wrong :
         {"", "Ctrl", "Ctrl+", "F0", "F26", "5", "Ctrl++", "Strg+S", "ab", "\x80", "Ctrl+[", "é"})
        CHECK(!key_press(wrong));
}

TEST_CASE("keys give commands, with Shift the same ones unless there are others") {
    const KeyMap keys;
    CHECK(given(keys, GLFW_KEY_F) == Command{Action::play});
    CHECK(given(keys, GLFW_KEY_F, shift) == Command{Action::play});
    CHECK(!given(keys, GLFW_KEY_F, ctrl));
    CHECK(given(keys, GLFW_KEY_C, shift) == Command{Action::copy_path});
    CHECK(given(keys, GLFW_KEY_Z, ctrl | shift) == Command{Action::redo});
    CHECK(given(keys, GLFW_KEY_RIGHT, shift) == Command{Action::step, 25});
    CHECK(given(keys, GLFW_KEY_4) == Command{Action::recall, 4});
    CHECK(given(keys, GLFW_KEY_KP_9, shift) == Command{Action::store, 9});
    CHECK(given(keys, GLFW_KEY_KP_8) == Command{Action::recall, 8});
    CHECK(given(keys, GLFW_KEY_KP_7) == Command{Action::turn_view, 7});
    CHECK(given(keys, GLFW_KEY_F12, ctrl) == Command{Action::film});
    CHECK(!given(keys, GLFW_KEY_TAB, GLFW_MOD_ALT));
    CHECK(!given(keys, GLFW_KEY_W));
    CHECK(!given(keys, GLFW_KEY_COMMA));  // known by its character, whatever key gives it
    CHECK(!keys.command_of_key(GLFW_KEY_G, 0, 0, true));
    CHECK(keys.command_of_character(',') == Command{Action::coarser});
    CHECK(!keys.command_of_character('f'));
    CHECK(keys.push_of_key(GLFW_KEY_W) == Push::forward);
    CHECK(!keys.push_of_key(GLFW_KEY_F));
}

TEST_CASE("a file gives commands other keys, and is written as it is read") {
    const KeysRead read = keys_in(
        "// mine\n\nwrite = Ctrl+W   // one\nplay = P Ctrl+Space\nadd-key = F\r\nforward = Up\nfewer =\nstore = "
        "Alt+1-9\nmore = #",
        "keys");
    CHECK(read.faults == "");
    CHECK(given(read.keys, GLFW_KEY_W, ctrl) == Command{Action::write_path});
    CHECK(!given(read.keys, GLFW_KEY_F2));
    CHECK(given(read.keys, GLFW_KEY_P) == Command{Action::play});
    CHECK(given(read.keys, GLFW_KEY_SPACE, ctrl) == Command{Action::play});
    CHECK(given(read.keys, GLFW_KEY_F) == Command{Action::add_key});
    CHECK(read.keys.push_of_key(GLFW_KEY_UP) == Push::forward);
    CHECK(!read.keys.push_of_key(GLFW_KEY_W));
    CHECK(!read.keys.command_of_character('['));
    CHECK(read.keys.command_of_character('#') == Command{Action::deeper});
    CHECK(given(read.keys, GLFW_KEY_2, GLFW_MOD_ALT) == Command{Action::store, 2});
    const KeysRead again = keys_in(write_keys(read.keys), "keys");
    CHECK(again.faults == "");
    CHECK(again.keys.keys == read.keys.keys);
    CHECK(keys_in("", "keys").keys.keys == KeyMap().keys);
}

TEST_CASE("errors in the file are told with their lines, and the usual keys stay") {
    const auto fault = [](const std::string& text) {
        const KeysRead read = keys_in(text + "\nhelp = F9", "keys");
        CHECK(given(read.keys, GLFW_KEY_F9) == Command{Action::help});  // other lines apply
        CHECK(given(read.keys, GLFW_KEY_S, ctrl) == Command{Action::write_path});
        return read.faults;
    };
    CHECK(says(fault("wirte = F3"), "keys:1:1: unknown command 'wirte'; did you mean 'write'?"));
    CHECK(says(fault("xyzzyx = F3"), "--list-keys"));
    CHECK(says(fault("write F3"), "expected '=' and keys, as in 'write = F2 Ctrl+S'"));
    CHECK(says(fault("write"), "expected '='"));
    CHECK(says(fault("play = F3\nwrite = F5 Strg+S"), "keys:2:12: unknown key 'Strg+S'"));
    CHECK(says(fault("recall = F3"), "cameras have the keys 1-9"));
    CHECK(says(fault("play = 1-9"), "'recall'"));
    CHECK(says(fault("left = Ctrl+A"), "movements"));
    CHECK(says(fault("left = +"), "movements"));
    CHECK(says(fault("play = F3\nplay = F4"), "has its keys in line 1"));
    CHECK(says(keys_in("\xff\xfe", "keys").faults, "UTF"));
    // Conflicts: of two lines the first one applies, and usual keys give way.
    CHECK(says(fault("play = F3\npause = F3 F4"), "keys:2:9: F3 is the key of 'play' in line 1 already"));
    const KeysRead taken = keys_in("play = F2", "keys");
    CHECK(says(taken.faults, "keys:1:8: F2 means 'write' no longer; say which keys that has now: 'write = Ctrl+S'"));
    CHECK(given(taken.keys, GLFW_KEY_F2) == Command{Action::play});
    CHECK(given(taken.keys, GLFW_KEY_S, ctrl) == Command{Action::write_path});
    CHECK(keys_in("play = F2\nwrite = Ctrl+S", "keys").faults == "");
    CHECK(says(keys_in("play = W", "keys").faults, "'forward'"));
    std::string many;
    for (int i = 0; i < 1000; ++i) many += "wrong = F3\n";
    CHECK(says(keys_in(many, "keys").faults, "keys:10:1"));
}

TEST_CASE("the user's file is found, and a missing one is none") {
    const Scratch folder;
    ::setenv("XDG_CONFIG_HOME", (folder / "config").c_str(), 1);
    CHECK(user_keys().faults == "");
    std::filesystem::create_directories(folder / "config/strahl");
    std::ofstream(keys_file()) << "play = F3\n";
    CHECK(given(user_keys().keys, GLFW_KEY_F3) == Command{Action::play});
    std::filesystem::remove(keys_file());
    std::filesystem::create_directory(keys_file());
    CHECK(user_keys().faults != "");
    ::unsetenv("XDG_CONFIG_HOME");
}

TEST_CASE("the help has the keys that apply, and finds words in any case") {
    const KeyMap keys = keys_in("write = F9\nfewer =", "keys").keys;
    const auto rows = help_rows(keys, "");
    CHECK(rows.size() == command_helps.size());
    CHECK(rows.front().meaning == "");
    const auto found = help_rows(keys, "WRITE bodies");
    REQUIRE(found.size() == 1);
    CHECK(found[0].keys == "F9");
    CHECK(help_rows(keys, "fewer")[0].keys == "(none)");
    CHECK(help_rows(keys, "f12").size() == 3);
    CHECK(help_rows(keys, "write xyzzy").empty());
}

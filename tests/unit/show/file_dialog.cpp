// The file dialog, with programs that take the place of zenity and kdialog.
#include "show/file_dialog.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "tests/unit/scratch.h"
#include "tests/unit/show/soon.h"

using namespace strahl;

namespace {

/// A folder that is all of PATH, with a program in it.
class OnlyProgram {
  public:
    OnlyProgram(const std::string& name, const std::string& script) {
        std::ofstream(folder / name) << "#!/bin/sh\n" << script << '\n';
        std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
        ::setenv("PATH", (folder / "").c_str(), 1);
    }
    ~OnlyProgram() { ::setenv("PATH", path.c_str(), 1); }

    Scratch folder;

  private:
    std::string path = ::getenv("PATH");
};

FileDialog::ChosenFile answer_of(FileDialog& dialog) {
    std::optional<FileDialog::ChosenFile> chosen;
    REQUIRE(soon([&] { return (chosen = dialog.take()).has_value(); }));
    return *chosen;
}

}  // namespace

TEST_CASE("a scene is chosen by zenity or kdialog, or none is") {
    for (const char* const name : {"zenity", "kdialog"}) {
        const OnlyProgram program(name, "echo \"$@\" >\"${0%/*}/words\"; printf '%s\\n' '/a b/it'\\''s.rt'");
        FileDialog dialog([] {});
        dialog.open("folder/scene.rt");
        dialog.open("folder/scene.rt");  // it is open already
        const FileDialog::ChosenFile chosen = answer_of(dialog);
        CHECK(chosen.path == "/a b/it's.rt");
        CHECK(chosen.fault == "");
        CHECK(bytes_of(program.folder / "words").find("folder/") != std::string::npos);
        CHECK(!dialog.take());
    }
    for (const auto& [name, word] : {std::pair("zenity", "--save"), {"kdialog", "--getsavefilename"}}) {
        const OnlyProgram program(name, "echo \"$@\" >\"${0%/*}/words\"; echo /new.rt");
        FileDialog dialog([] {});
        dialog.open("", "/template.rt");
        const FileDialog::ChosenFile chosen = answer_of(dialog);
        CHECK(chosen.path == "/new.rt");
        CHECK(chosen.from == "/template.rt");
        CHECK(bytes_of(program.folder / "words").find(word) != std::string::npos);
    }
    {
        const OnlyProgram program("zenity", "echo /ignored; exit 1");
        FileDialog dialog([] {});
        dialog.open("-");
        CHECK(answer_of(dialog).path == "");
    }
    const OnlyProgram program("other", "");
    FileDialog dialog([] {});
    dialog.open("scene.rt");
    CHECK(answer_of(dialog).fault.find("install zenity or kdialog") != std::string::npos);
}

TEST_CASE("a dialog that is open goes with the window") {
    const OnlyProgram program("zenity", "echo $$ >\"${0%/*}/process\"; exec /bin/sleep 1000");
    pid_t process = 0;
    {
        FileDialog dialog([] {});
        dialog.open("scene.rt");
        REQUIRE(soon([&] { return std::ifstream(program.folder / "process") >> process && process > 0; }));
        CHECK(::kill(process, 0) == 0);
    }
    CHECK(::kill(process, 0) != 0);
}

// ffmpeg is started with the film as its input, or not at all.
#include <doctest/doctest.h>
#include <spawn.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "files/error.h"
#include "image/film.h"
#include "tests/unit/scratch.h"

/// Replaces the C library's function: fails for lack of memory.
extern "C" int posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t*, int, int) noexcept { return ENOMEM; }

namespace strahl {

TEST_CASE("ffmpeg does not start where its input takes more memory than there is") {
    const Scratch folder;
    const std::string ffmpeg = folder / "ffmpeg";
    std::ofstream(ffmpeg) << "#!/bin/sh\ntouch '" << folder / "ran"
                          << "'\n";
    std::filesystem::permissions(ffmpeg, std::filesystem::perms::owner_all);
    const auto start = [&] { Film(ffmpeg, folder / "film.mp4", {}, {}).append("frames"); };
    CHECK_THROWS_WITH_AS(start(), doctest::Contains("Cannot allocate memory"), OutputError);
    CHECK(!std::filesystem::exists(folder / "ran"));
    CHECK(folder.files() == 1);
}

}  // namespace strahl

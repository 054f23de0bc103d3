// POV-Ray works in a folder of its own, and nothing of that stays, when memory runs out too.
#include <dirent.h>
#include <dlfcn.h>
#include <doctest/doctest.h>
#include <spawn.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <string_view>

#include "image/picture.h"
#include "povref/compare/run_povray.h"
#include "tests/unit/scratch.h"

namespace {

std::string_view starved;  // one of the functions below, which take the place of the C library's: it has no memory

template <class F>
F* real(const char* name) {
    return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int posix_spawn_file_actions_addchdir_np(posix_spawn_file_actions_t* actions, const char* path) {
    return starved == __func__ ? ENOMEM : real<decltype(posix_spawn_file_actions_addchdir_np)>(__func__)(actions, path);
}

extern "C" DIR* fdopendir(int folder) {
    return starved == __func__ ? (errno = ENOMEM, nullptr) : real<decltype(fdopendir)>(__func__)(folder);
}

namespace strahl {
namespace {

/// Replaces POV-Ray: copies a picture, and leaves a file beside itself as a sign.
struct StandIn {
    StandIn() {
        const std::string tool = tools / "povray", picture = tools / "picture.png";
        write_picture({4, 3, 3, std::vector<double>(36, .5), 16}, picture, {.bits = 16});
        std::ofstream(tool) << "#!/bin/sh\ntouch '" << tools / "ran"
                            << "'\nexec cp '" << picture << "' scene.ppm\n";
        std::filesystem::permissions(tool, std::filesystem::perms::owner_all);
        ::setenv("PATH", ((tools / "") + ":" + path).c_str(), 1);
        ::setenv("TMPDIR", (temporary / "").c_str(), 1);
    }
    ~StandIn() {
        starved = {};
        ::setenv("PATH", path.c_str(), 1);
        ::unsetenv("TMPDIR");
    }

    PovRun run() const { return run_povray({}, {.cameras = {Camera{}}, .width = 4, .height = 3}, 1); }
    bool has_run() const { return std::filesystem::exists(tools / "ran"); }

    const std::string path = ::getenv("PATH");
    const Scratch tools, temporary;
};

}  // namespace

TEST_CASE("POV-Ray does not start where the change to its folder takes more memory than there is") {
    const StandIn povray;
    starved = "posix_spawn_file_actions_addchdir_np";
    CHECK_THROWS_AS(povray.run(), std::bad_alloc);
    CHECK(!povray.has_run());
    CHECK(povray.temporary.files() == 0);
}

TEST_CASE("POV-Ray's folder goes where there is no memory to list it") {
    const StandIn povray;
    starved = "fdopendir";
    CHECK(povray.run().picture.width == 4);
    starved = {};
    CHECK(povray.has_run());
    CHECK(povray.temporary.files() == 0);
}

TEST_CASE("TMPDIR may be empty; one that is missing is named") {
    const StandIn povray;
    ::setenv("TMPDIR", "", 1);
    CHECK_NOTHROW(povray.run());
    CHECK(povray.has_run());
    ::setenv("TMPDIR", (povray.temporary / "missing").c_str(), 1);
    const std::string message =
        "cannot make a folder in '" + povray.temporary / "missing" + "', which TMPDIR names: No such file or directory";
    CHECK_THROWS_WITH(povray.run(), message.c_str());
}

}  // namespace strahl

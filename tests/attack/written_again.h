// Shared by the attacks on readers of scenes: what is wrong ends the program, and a scene must survive being written.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/referee/random_pattern.h"
#include "text/parse.h"
#include "text/write.h"

namespace strahl::attack {

[[noreturn]] inline void fail(const char* what, const std::string& detail) {
    std::fprintf(stderr, "%s\n%s\n", what, detail.c_str());
    std::abort();
}

/// Checks that the scene, written and parsed again, is the same one. Returns its text.
inline std::string written_again(const Scene& scene) {
    const std::string text = write_scene(scene);
    try {
        if (parse_scene(text, "written", {}, made_up_pixels) != scene)
            fail("written and parsed again it is another scene:", text);
    } catch (const FileError& error) {
        fail("what was written does not parse:", std::string(error.what()) + "\n" + text);
    }
    return text;
}

/// Checks that an error message begins with the file's name and is not longer than `most` bytes.
inline void check_message(const FileError& error, std::size_t most) {
    const std::string message = error.what();
    if (!message.starts_with("fuzz:") || message.size() > most) fail("a strange message:", message);
}

}  // namespace strahl::attack

// Checks the text of a scene, and says where in it each error and each warning is.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace strahl {

/// An error or a warning. `line` and `column`, in characters, are counted from 1, and 0 if they are not known.
struct Problem {
    bool warning;
    std::string file;  // empty if the message is about no file
    std::size_t line, column, length;
    std::string message;
    std::size_t caller = 0;  // the line of the scene from which an included file or a macro was reached
};

/// Finds the places in messages such as "scene.rt:13:1: unknown word ..." and in what follows them: the line with its
/// caret, and "included from scene.rt:2". `scene` is the path of the scene.
std::vector<Problem> problems_in(std::string_view messages, const std::string& scene, bool warning);

/// Checks a scene as `strahl check` does: returns up to ten errors, or else warnings. `files` becomes the list of files
/// that were read, unless there is an error.
std::vector<Problem> check_scene(const std::string& text, const std::string& path, std::vector<std::string>& files);

}  // namespace strahl

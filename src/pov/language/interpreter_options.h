// Options and limits for reading a POV-Ray scene.
#pragma once
#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace strahl::pov {

/// More than these is an error. A scene is a program, which may never end.
struct InterpreterLimits {
    std::size_t steps = 200'000'000;           // tokens that are read, those of loops and macros each time
    std::size_t bytes = std::size_t(4) << 30;  // of bodies, of values of identifiers, and of arrays and strings
    int nesting = 400;                         // of macro calls, loops, conditions, files, blocks and parentheses
};

struct InterpreterOptions {
    std::string file;                  // the path of the scene; files are looked for in its folder first
    std::vector<std::string> library;  // then in these, in order; nothing else may be read
    std::string write_folder;          // where `#fopen` may write; empty: nowhere
    /// Identifiers that are declared before the scene is read, with their numbers: frame_number and others.
    std::vector<std::pair<std::string, double>> declared;
    double clock = 0;
    bool clock_on = false;
    bool as_text = false;       // the scene becomes scene text: what that has no words for is approximated
    bool alpha = false;         // the picture has alpha: mirrors show a background that lets light through as it is
    int width = 0, height = 0;  // image_width and image_height
    std::function<void(const std::string&)> print;  // called with the text of #debug, #warning and #render
    const std::atomic<bool>* stop = nullptr;        // reading ends with `Interrupted` once it is true
    std::vector<std::string>* files = nullptr;      // receives the path of each file that is read or found
    InterpreterLimits limits;
};

/// Returns the folders where POV-Ray's package keeps its standard include files.
std::vector<std::string> standard_library();

/// Does the path lie in the folder, or below it, when links have been followed?
bool lies_in(const std::string& path, const std::string& folder);

}  // namespace strahl::pov

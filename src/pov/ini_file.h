// Reads .ini files of POV-Ray: the scene, its frames, and the options that Strahl has as well.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strahl::pov {

/// The options of an .ini file, or of one section of it.
struct IniFile {
    std::string path;   // of the file itself
    std::string scene;  // Input_File_Name, as it is written
    std::optional<int> width, height;
    std::optional<bool> antialias, alpha;
    std::optional<int> initial_frame, final_frame;
    std::optional<double> subset_start, subset_end;  // numbers of frames, or shares of them if between 0 and 1
    std::optional<double> clock, initial_clock, final_clock;
    bool cyclic = false;
    std::vector<std::string> library;                      // folders, as they are written
    std::vector<std::pair<std::string, double>> declared;  // numbers that the scene may use
    std::vector<std::string> notes;                        // messages about what is read over
};

/// Does the path end like an .ini file, or name a section of one, as in "film.ini[fast]"?
bool is_ini(std::string_view path);

/// Reads the text of an .ini file: lines such as `Width=640`, switches such as `+W640`, comments from ';' or '#' on,
/// and sections, of which only `section` is read, besides what stands before all of them. Each option that Strahl does
/// not have is read over and named once in the notes; commands are never run. (POV-Ray 3.7's reference, "INI Files".)
IniFile parse_ini(std::string_view text, const std::string& path, std::string_view section = {});

/// Reads the file of a path such as "film.ini" or "film.ini[fast]", and finds its scene, whose path becomes `scene`.
/// Throws FileError if there is no such section, or no scene in the file's own folder or below.
IniFile read_ini(const std::string& path);

/// Reads the file of the same name beside a scene; nothing if there is none, or if that is for another scene.
std::optional<IniFile> ini_beside(const std::string& scene);

/// Returns the path of a file beside a scene that differs in its ending only.
std::string beside(const std::string& scene, const char* ending);

}  // namespace strahl::pov

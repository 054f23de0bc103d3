#include "pov/language/file_search.h"

#include <algorithm>
#include <filesystem>

#include "files/os/system.h"
#include "files/shell.h"
#include "files/utf8.h"
#include "files/words.h"
#include "pov/language/interpreter_options.h"
#include "text/reading/messages.h"

namespace strahl::pov {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/// Does a path begin with all parts of another one?
bool begins(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Finds a file under a folder whose name differs in case only; empty if there is none.
fs::path regardless_of_case(fs::path folder, const fs::path& name) {
    for (const fs::path& part : name) {
        std::error_code error;
        fs::path found;
        if (part == ".." || part == "." || fs::exists(folder / part, error)) {
            found = folder / part;
        } else {
            for (const auto& entry : fs::directory_iterator(folder, error))
                if (same_word(entry.path().filename().string(), part.string())) found = entry.path();
        }
        if (found.empty()) return {};
        folder = found;
    }
    return folder;
}

/// Returns the file in these folders, or in the folder below one that a path names, whose name is most like the path's;
/// or nothing.
std::string similar_file(const std::vector<fs::path>& folders, const fs::path& path) {
    const std::string ending = path.extension().string();
    std::vector<std::string> files;
    for (const fs::path& folder : folders)
        for (const fs::path& below : {folder / path.parent_path(), folder}) {
            std::error_code error;
            for (const auto& entry : fs::directory_iterator(below, error))
                if (entry.path().extension() == ending) files.push_back(entry.path().filename().string());
        }
    std::ranges::sort(files);
    // Without their ending, which they have in common.
    std::vector<std::string_view> names(files.begin(), files.end());
    for (std::string_view& name : names) name.remove_suffix(ending.size());
    const std::string_view found = nearest(path.stem().string(), names);
    return found.empty() ? "" : std::string(found) + ending;
}

}  // namespace

std::vector<std::string> standard_library() {
    std::vector<std::string> folders;
    for (const fs::path& parent : os::shared_folders())
        for (const char* version : {"povray-3.7", "povray", "povray-3.8", "povray-3.6", "POV-Ray/v3.7"}) {
            const fs::path folder = parent / version / "include";
            std::error_code error;
            if (fs::is_directory(folder, error)) folders.push_back(folder.string());
        }
    return folders;
}

bool lies_in(const std::string& path, const std::string& folder) {
    std::error_code error, other_error;
    const fs::path real = fs::weakly_canonical(path, error), root = fs::weakly_canonical(folder, other_error);
    return !error && !other_error && begins(real, root);
}

FileSearch::FoundFile FileSearch::find(const std::string& name, const std::vector<std::string>& extensions) {
    std::string key = name;
    for (const std::string& extension : extensions) key += '\n' + extension;
    if (const auto known = found.find(key); known != found.end()) return {.path = known->second};
    if (name.empty()) return {.fault = "the name of a file is empty"};
    std::vector<fs::path> folders{fs::path(all[0]).parent_path()};
    if (folders[0].empty()) folders[0] = ".";
    folders.insert(folders.end(), library.begin(), library.end());

    // Windows' names are understood as well.
    std::string plain = name;
    std::ranges::replace(plain, '\\', '/');
    std::vector<std::string> names;
    const bool extended = fs::path(plain).has_extension();
    if (!extended)
        for (const std::string& extension : extensions) names.push_back(plain + extension);
    names.push_back(plain);

    const auto allowed = [&](const fs::path& path) {
        const bool inside = std::ranges::any_of(
            folders, [&](const fs::path& folder) { return lies_in(path.string(), folder.string()); });
        if (inside || std::ranges::find(path, fs::path("..")) != path.end()) return inside;
        // The fonts of POV-Ray's package are links to another folder.
        return std::ranges::any_of(standard_library(), [&](const fs::path& folder) { return begins(path, folder); });
    };
    const auto accepted = [&](const fs::path& path, const std::string& warning) -> FoundFile {
        if (std::error_code ignored; !allowed(path))
            return {{},
                    strahl::quoted(name) +
                        " lies outside of the scene's folder and of the library folders; --library " +
                        in_shell_quotes(printable(fs::weakly_canonical(path, ignored).parent_path().string())) +
                        " allows to read it",
                    warning};
        found[key] = path.string();
        if (std::ranges::find(all, path.string()) == all.end()) all.push_back(path.string());
        return {path.string(), {}, warning};
    };
    for (const fs::path& folder : folders)
        for (const std::string& each : names)
            if (const fs::path path = folder / each; is_file(path)) return accepted(path, {});
    for (const fs::path& folder : folders)
        for (const std::string& each : names)
            if (const fs::path path = regardless_of_case(folder, each); !path.empty() && is_file(path))
                return accepted(path, strahl::quoted(name) + " is read from " +
                                          strahl::quoted(path.filename().string()) + ", whose name has other case");
    std::string message = "cannot find " + strahl::quoted(name) + " in the scene's folder";
    const std::string similar = similar_file(folders, plain);
    const auto exists = [](const std::string& folder) {
        std::error_code error;
        return fs::is_directory(folder, error);
    };
    if (std::ranges::none_of(library, exists))
        message += "; POV-Ray's include files and fonts are not installed; on Debian: apt install povray-includes";
    else
        message += " and in " + listed(library);
    if (!similar.empty()) message += "; did you mean " + strahl::quoted(similar) + "?";
    return {.fault = message};
}

}  // namespace strahl::pov

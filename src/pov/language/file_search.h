// Finds the files that a scene names, in its folder and in those of the library.
#pragma once
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace strahl::pov {

class FileSearch {
  public:
    /// `scene` is the path of the scene, in whose folder files are looked for first, and then in these of the library.
    FileSearch(const std::string& scene, std::vector<std::string> library) : library(std::move(library)), all{scene} {}

    /// The path of a file, or why there is none; and in both cases perhaps a warning.
    struct FoundFile {
        std::string path{}, fault{}, warning{};
    };
    /// Finds a file, with one of these extensions added to its name if need be.
    FoundFile find(const std::string& name, const std::vector<std::string>& extensions);
    /// Returns the paths of the scene and of all files that were found, in this order.
    const std::vector<std::string>& paths() const { return all; }

  private:
    const std::vector<std::string> library;
    std::unordered_map<std::string, std::string> found;  // paths, by names and extensions
    std::vector<std::string> all;
};

}  // namespace strahl::pov

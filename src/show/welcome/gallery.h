// The gallery's contents: scenes to open and templates to begin from, in sections, and which of them is chosen.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace strahl {

struct GalleryItem {
    std::string name, path;
    bool begins = false;  // it is a template: a new scene is made of it
    bool operator==(const GalleryItem&) const = default;
};
struct GallerySection {
    std::string title;
    std::vector<GalleryItem> items;  // at least one
    bool operator==(const GallerySection&) const = default;
};

/// Returns the folder of the scenes that were installed with the program, or that it was built with; "" if there is
/// none.
std::string installed_scenes();
/// Does a scene belong to the program, because it lies in that folder?
bool installed(const std::string& path);
/// Says where it was looked for if there is none, in a sentence without its stop; else "".
std::string missing_scenes();

/// Returns the sections: templates, those recent files that are still there, and the other scenes in the folder and in
/// some below it.
std::vector<GallerySection> gallery_of(const std::string& scenes, const std::vector<std::string>& recent);

/// The item that the keys have chosen. Each section begins a new row.
struct GalleryPlace {
    std::size_t section = 0, item = 0;
    bool operator==(const GalleryPlace&) const = default;
};
/// Returns the place so many items further, and then so many rows further down, as far as there are any. A row has
/// `columns` items.
GalleryPlace moved(const std::vector<GallerySection>& sections, GalleryPlace from, int items, int rows, int columns);

/// Makes a scene of a template: as `path`, to which .rt is added if it lacks that; or, if that is empty, as
/// untitled.rt, untitled-2.rt ... in the current folder. An existing file is never changed. Returns the path of the new
/// one. Throws FileError.
std::string begin_scene(const std::string& from, std::string path);

}  // namespace strahl

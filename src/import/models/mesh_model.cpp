// Models of triangles: OBJ with its materials, PLY and STL.
#include <algorithm>
#include <filesystem>
#include <map>
#include <unordered_map>

#include "files/output_file.h"
#include "files/regular_file.h"
#include "files/utf8.h"
#include "files/words.h"
#include "import/models/corner_colors.h"
#include "import/models/formats.h"
#include "import/models/mtl.h"
#include "mesh/read_mesh.h"

namespace strahl {
namespace {

/// Takes some triangles of a mesh, with the points, normals and places that they use.
class MeshPicker {
  public:
    explicit MeshPicker(const MeshData& mesh)
        : mesh(mesh),
          points(mesh.points.size(), -1),
          normals(mesh.normals.size(), -1),
          places(mesh.places.size(), -1) {}

    MeshData pick(const std::vector<std::size_t>& triangles) {
        MeshData part;
        for (const std::size_t i : triangles) {
            part.triangles.push_back(numbers(mesh.triangles[i], mesh.points, points, part.points));
            if (!mesh.corner_normals.empty())
                part.corner_normals.push_back(numbers(mesh.corner_normals[i], mesh.normals, normals, part.normals));
            if (const MeshData::Corners* const all = mesh.place_numbers())
                part.corner_places.push_back(numbers(all[i], mesh.places, places, part.places));
        }
        for (const std::size_t i : triangles) {
            for (const std::int32_t k : mesh.triangles[i]) points[std::size_t(k)] = -1;
            if (!mesh.corner_normals.empty())
                for (const std::int32_t k : mesh.corner_normals[i]) normals[std::size_t(k)] = -1;
            if (const MeshData::Corners* const all = mesh.place_numbers())
                for (const std::int32_t k : all[i]) places[std::size_t(k)] = -1;
        }
        return part;
    }

  private:
    template <class Value>
    static MeshData::Corners numbers(const MeshData::Corners& old, const std::vector<Value>& all,
                                     std::vector<std::int32_t>& known, std::vector<Value>& some) {
        MeshData::Corners own;
        for (std::size_t k = 0; k < 3; ++k) {
            std::int32_t& number = known[std::size_t(old[k])];
            if (number < 0) number = static_cast<std::int32_t>(some.size()), some.push_back(all[std::size_t(old[k])]);
            own[k] = number;
        }
        return own;
    }

    const MeshData& mesh;
    std::vector<std::int32_t> points, normals, places;  // their numbers in the part; -1: not in it
};

/// Reads the files of materials that an OBJ file names.
std::vector<std::pair<MtlMaterial, std::string>> read_libraries(const MeshLook& look, Model& model) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(model.files[0]).parent_path();
    constexpr std::size_t most_bytes = 64 << 20, most_libraries = 1000;
    std::vector<std::pair<MtlMaterial, std::string>> list;
    std::vector<std::string> names;
    for (const std::string& line : look.libraries) {
        // A line may name several files, or one with blanks in its name.
        std::error_code error;
        if (fs::exists(folder / line, error)) {
            names.push_back(line);
            continue;
        }
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
            if (end > at) names.push_back(line.substr(at, end - at));
            at = end + 1;
        }
    }
    std::vector<std::string> done;
    for (std::string& name : names) {
        std::ranges::replace(name, '\\', '/');
        if (std::ranges::find(done, name) != done.end() || done.size() == most_libraries) continue;
        done.push_back(name);
        const std::string path = (folder / name).string();
        try {
            const RegularFile file(path);
            if (file.size() > most_bytes) throw FileError("'" + path + "' is larger than 64 MiB");
            const std::string bytes = file.bytes(0, file.size());
            for (MtlMaterial& own : parse_mtl(utf8_text(bytes, path), path, model.warnings))
                list.emplace_back(std::move(own), name);
            model.files.push_back(path);
        } catch (const FileError& error) {
            std::error_code ignored;
            if (fs::exists(path, ignored)) throw;
            model.warnings.push_back(model.files[0] + ": materials are left out: " + error.what());
        }
    }
    return list;
}

/// Adds a material for each name that the look has, and last the one for what has no name.
void add_materials(const MeshLook& look, const ReadPixels& read_pixels, Model& model) {
    namespace fs = std::filesystem;
    const auto libraries = read_libraries(look, model);
    std::unordered_map<std::string_view, std::size_t> known;
    for (std::size_t i = 0; i < libraries.size(); ++i) known.try_emplace(libraries[i].first.name, i);
    Textures textures(read_pixels, model.warnings);
    std::size_t unknown = 0;
    for (const std::string& name : look.materials) {
        const auto found = known.find(name);
        if (found == known.end()) {
            if (!libraries.empty() && ++unknown <= 10)
                model.warnings.push_back(model.files[0] + ": there is no material " + strahl::quoted(name));
            model.materials.push_back(plain_material());
            continue;
        }
        const auto& [own, library] = libraries[found->second];
        const std::string path = (fs::path(model.files[0]).parent_path() / library).string();
        model.materials.push_back(material_of(own, path, library, textures));
    }
    model.materials.push_back(plain_material());
    model.files.insert(model.files.end(), textures.files.begin(), textures.files.end());
}

/// Divides a mesh into parts of one name and one material each.
void add_parts(MeshData mesh, const MeshLook& look, Model& model) {
    constexpr std::size_t most_parts = 100'000;
    const auto none = static_cast<std::int32_t>(model.materials.size()) - 1;
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> numbers;
    std::vector<std::vector<std::size_t>> triangles;  // of each part
    for (std::size_t r = 0; r < look.runs.size(); ++r) {
        MeshLook::NamedRun run = look.runs[r];
        const std::size_t end = r + 1 < look.runs.size() ? look.runs[r + 1].first : mesh.triangles.size();
        if (run.first == end) continue;
        if (numbers.size() >= most_parts) run.name = -1;
        const auto [part, is_new] = numbers.try_emplace({run.name, run.material}, triangles.size());
        if (is_new) {
            triangles.emplace_back();
            model.parts.push_back({.name = run.name < 0 ? "" : look.names[std::size_t(run.name)],
                                   .mesh = nullptr,
                                   .material = run.material < 0 ? none : run.material});
        }
        for (std::size_t i = run.first; i < end; ++i) triangles[part->second].push_back(i);
    }
    if (triangles.size() <= 1) {
        if (triangles.empty()) model.parts.push_back({.name = "", .mesh = nullptr, .material = none});
        model.parts[0].mesh = std::make_shared<const MeshData>(std::move(mesh));
        model.whole = true;
        return;
    }
    MeshPicker picker(mesh);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        model.parts[i].mesh = std::make_shared<const MeshData>(picker.pick(triangles[i]));
}

}  // namespace

Model read_mesh_model(const std::string& path, const ReadPixels& read_pixels) {
    Model model;
    MeshLook look;
    model.files = {path};
    MeshData mesh = read_mesh(path, {}, &model.warnings, &look);
    if (ends_with_word(path, ".stl")) model.up = {0, 0, 1}, model.front = {0, -1, 0};
    add_materials(look, read_pixels, model);
    const bool by_triangle = !look.triangle_colors.empty();
    const bool pictured = std::ranges::any_of(model.materials, &Material::patterned);
    if (!pictured && (by_triangle || !look.point_colors.empty())) {
        Material own = plain_material();
        own.rgb = color_corners(
            mesh, {.colors = by_triangle ? look.triangle_colors : look.point_colors, .by_triangle = by_triangle});
        model.materials = {own};
        model.parts = {{.name = "", .mesh = std::make_shared<const MeshData>(std::move(mesh))}};
        return model;
    }
    add_parts(std::move(mesh), look, model);
    return model;
}

}  // namespace strahl

// Reads OBJ: points, normals, places in a texture and faces, a line each, and names of groups and materials. All other
// lines are about lines and curves.
// tinyobjloader would read these too, but of 90,000 numbers with six decimals it reads 42,262 as not the nearest
// double, and it takes 'x' for 0, 1e400 for infinity and index 4294967299 for 3.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "mesh/faces.h"
#include "mesh/source.h"

namespace strahl {
namespace {

/// Does a backslash join this line to the next? Not one in a comment, which ends with its line.
bool continues(std::string_view line) {
    while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
    if (!line.ends_with('\\')) return false;
    for (std::size_t hash = line.find('#'); hash != line.npos; hash = line.find('#', hash + 1))
        if (hash == 0 || is_blank(line[hash - 1])) return false;
    return true;
}

/// Says what a line is about, by its first word. All other lines are skipped.
enum class ObjLine { none, point, normal, place, face, name, material, library, surface };
ObjLine line_of(std::string_view word) {
    constexpr std::pair<std::string_view, ObjLine> known[]{
        {"v", ObjLine::point},         {"f", ObjLine::face},        {"vn", ObjLine::normal}, {"vt", ObjLine::place},
        {"g", ObjLine::name},          {"o", ObjLine::name},        {"fo", ObjLine::face},   {"surf", ObjLine::surface},
        {"usemtl", ObjLine::material}, {"mtllib", ObjLine::library}};
    for (const auto& [own, line] : known)
        if (own.size() == word.size() && own[0] == word[0] && (own.size() == 1 || own == word)) return line;
    return ObjLine::none;
}

class ObjReader {
  public:
    explicit ObjReader(const Source& source) : source(source), faces(source, mesh) {}

    MeshData read() {
        // Faces may name points that come after them.
        for_lines([&](ObjLine line, Words& words) {
            if (line == ObjLine::point) read_point(words);
            if (line == ObjLine::normal) mesh.normals.push_back(words.vector());
            if (line == ObjLine::place) read_place(words);
        });
        for_lines([&](ObjLine line, Words& words) {
            points += line == ObjLine::point, normals += line == ObjLine::normal, places += line == ObjLine::place;
            if (line == ObjLine::face) read_face(words);
            if (line == ObjLine::name || line == ObjLine::material || line == ObjLine::library) read_name(line, words);
            if (line == ObjLine::surface) source.lose({"skipped ", "curved surface", ""}, [&] { return words.line(); });
        });
        if (mesh.triangles.empty()) source.fail("there are no faces in this file; a mesh needs lines 'f'");
        faces.finish();
        if (mesh.corner_places.empty()) mesh.places = {};
        if (source.look && colored < mesh.points.size()) source.look->point_colors.clear();
        return std::move(mesh);
    }

  private:
    template <class Read>
    void for_lines(Read read);
    void read_point(Words& words);
    void read_place(Words& words);
    void read_face(Words& words);
    void read_name(ObjLine line, Words& words);
    void begin_run();
    void read_corner(std::string_view word, const Words& words);
    std::int32_t resolved(std::int64_t index, std::size_t all, std::size_t so_far, const char* noun,
                          const Words& words) const;

    const Source& source;
    MeshData mesh;
    Faces faces;
    std::size_t points = 0, normals = 0, places = 0;  // so far, for negative indices
    Face face;
    std::size_t colored = 0;  // points with a colour
    MeshLook::NamedRun run;   // of the next face
    using Numbers = std::unordered_map<std::string_view, std::int32_t>;
    Numbers names, materials;
};

/// Calls `read` with what each line is about and the words after the first.
template <class Read>
void ObjReader::for_lines(Read read) {
    const std::string_view bytes = source.bytes;
    // A file may end some of its lines in one way and some in another. One search for both characters would be slower.
    const auto end_of_line = [&](std::size_t start) {
        const std::size_t feed = bytes.find('\n', start), end = feed == bytes.npos ? bytes.size() : feed;
        const std::size_t carriage = bytes.substr(0, end).find('\r', start);
        return carriage == bytes.npos ? end : carriage;
    };
    for (std::size_t start = 0; start < bytes.size();) {
        std::size_t end = end_of_line(start);
        Words words(source, bytes.substr(start, end - start));
        if (const ObjLine line = line_of(words.next()); line != ObjLine::none) {
            const bool named = line == ObjLine::name || line == ObjLine::material;  // may end in a backslash
            while (!named && end < bytes.size() && continues(bytes.substr(start, end - start)))
                end = end_of_line(end + (bytes.substr(end, 2) == "\r\n" ? 2 : 1));
            words = Words(source, bytes.substr(start, end - start));
            words.next();
            read(line, words);
        }
        start = end + 1;
    }
}

/// Reads x, y, z. After them may stand a weight, which means nothing here, and a colour.
void ObjReader::read_point(Words& words) {
    const DVec3 point = words.vector();
    if (!Source::in_range(point)) words.fail("this point " + Source::fault(point));
    source.check_points(mesh.points.size() + 1);
    mesh.points.push_back(point);
    std::array<std::string_view, 4> more;
    std::size_t count = 0;
    for (std::string_view word = words.next(); !word.empty() && word[0] != '#'; word = words.next())
        more[std::min<std::size_t>(count++, 3)] = word;
    if (count < 3) return;
    if (!source.look) return source.lose({"ignored the colours of ", "point", ""}, [&] { return words.line(); });
    MeshLook::Rgb color;
    for (std::size_t c = 0; c < 3; ++c) {
        double value = 0;
        read_number(more[c + (count > 3)], value);
        color[c] = MeshLook::share(value, 0);
    }
    source.look->point_colors.resize(mesh.points.size(), color), ++colored;
}

/// Reads the name of a group, an object or a material, or of a file of materials.
void ObjReader::read_name(ObjLine line, Words& words) {
    if (!source.look) {
        if (line == ObjLine::library)
            source.lose({"read no materials: the mesh has that of the scene; ignored ", "line", " 'mtllib'"},
                        [&] { return words.line(); });
        return;
    }
    const std::string_view name = words.rest_of_line();
    const auto number_in = [&](std::vector<std::string>& list, Numbers& numbers) {
        const auto [known, is_new] = numbers.try_emplace(name, static_cast<std::int32_t>(list.size()));
        if (is_new) list.emplace_back(name);
        return known->second;
    };
    if (line == ObjLine::library)
        source.look->libraries.emplace_back(name);
    else if (line == ObjLine::material)
        run.material = name.empty() ? -1 : number_in(source.look->materials, materials);
    else
        run.name = name.empty() ? -1 : number_in(source.look->names, names);
}

/// Begins a run of faces if the next one has another name or material than the last.
void ObjReader::begin_run() {
    std::vector<MeshLook::NamedRun>& runs = source.look->runs;
    if (runs.empty() ? run.name < 0 && run.material < 0
                     : runs.back().name == run.name && runs.back().material == run.material)
        return;
    if (runs.empty() && !mesh.triangles.empty()) runs.push_back({});
    run.first = mesh.triangles.size();
    runs.push_back(run);
}

/// Reads one number or two; the third is for solid textures.
void ObjReader::read_place(Words& words) {
    const double u = words.number("a place in a texture");
    double v = 0;
    const std::string_view word = words.next();
    if (!word.empty() && word[0] != '#' && !read_number(word, v)) words.fail(quoted(word) + " is not a number");
    if (!Source::in_range({u, v, 0}) && !std::isnan(u + v)) words.fail("this place " + Source::fault({u, v, 0}));
    source.check_points(mesh.places.size() + 1);
    mesh.places.push_back({u, v});
}

void ObjReader::read_face(Words& words) {
    if (source.look) begin_run();
    face.clear();
    const char* const line = words.start();
    for (std::string_view word = words.next(); !word.empty() && word[0] != '#'; word = words.next())
        read_corner(word, words);
    faces.add(
        face, [&] { return source.line_at(line); },
        [&](const std::string& message) { words.fail("this face" + message); });
}

/// Reads a corner of a face: numbers of a point, a place in a texture and a normal, separated by slashes. The last two
/// may be left out, in all ways: 1, 1/, 1//, 1/2, 1/2/, 1//3, 1/2/3.
void ObjReader::read_corner(std::string_view word, const Words& words) {
    std::array<std::optional<std::int64_t>, 3> index;
    const char *at = word.data(), *const end = at + word.size();
    for (int i = 0; i < 3; ++i) {
        std::int64_t number = 0;
        const auto [stop, fault] = std::from_chars(at, end, number);
        if (fault == std::errc()) index[i] = number;
        at = stop;
        if (at == end || *at != '/' || i == 2) break;
        ++at;
    }
    if (at != end || !index[0])
        words.fail(quoted(word) + " is not a corner of a face, which has the form 1, 1/2, 1//3 or 1/2/3");
    face.points.push_back(resolved(*index[0], mesh.points.size(), points, "point", words));
    const auto other = [&](const auto& given, std::size_t all, std::size_t so_far, const char* noun) {
        if (!given) return Face::none;
        if (all > 0) return resolved(*given, all, so_far, noun, words);
        const bool normal = &given == &index[2];
        source.lose(normal ? Loss{"left out the normals of ", "corner", ": the file has none"}
                           : Loss{"left out the places of ", "corner", " in pictures: the file has none"},
                    [&] { return words.line(); });
        return Face::none;
    };
    face.places.push_back(other(index[1], mesh.places.size(), places, "place"));
    face.normals.push_back(other(index[2], mesh.normals.size(), normals, "normal"));
}

/// Returns an index that counts from 0. In the file indices count from 1, or back from the newest element, which is -1.
std::int32_t ObjReader::resolved(std::int64_t index, std::size_t all, std::size_t so_far, const char* noun,
                                 const Words& words) const {
    if (index > 0 && static_cast<std::uint64_t>(index) <= all) return static_cast<std::int32_t>(index - 1);
    if (index < 0 && index >= -static_cast<std::int64_t>(so_far))
        return static_cast<std::int32_t>(static_cast<std::int64_t>(so_far) + index);
    words.fail("this face names " + std::string(noun) + " " + std::to_string(index) +
               (index < 0 ? ", and before it come " : "; the file has ") + counted(index < 0 ? so_far : all, noun) +
               (index == 0 ? ", counted from 1" : ""));
}

}  // namespace

MeshData read_obj(const Source& source) { return ObjReader(source).read(); }

}  // namespace strahl

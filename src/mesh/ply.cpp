// Reads the values of a PLY file: the elements `vertex` and `face`, in the form that its header describes.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>

#include "mesh/faces.h"
#include "mesh/ply_header.h"
#include "num/decimal.h"

namespace strahl {
namespace {

/// A number that should be a whole one, as 1000000 and not 1e+06.
std::string count_text(double count) {
    return std::abs(count) < 1e15 && count == std::floor(count) ? std::to_string(static_cast<std::int64_t>(count))
                                                                : text_of(count);
}

/// Reads values as text, a line for each element.
class TextValues {
  public:
    TextValues(const Source& source, std::string_view text) : words(source, text) {}

    /// Reads the next value; false at the end of the line.
    bool read(PlyType, double& value) {
        const std::string_view word = starts_line ? words.next() : words.next_in_line();
        starts_line = false;
        if (word.empty()) return false;
        if (!read_number(word, value)) words.fail(quoted(word) + " is not a number");
        return true;
    }
    static bool read_triangle(const PlyProperty&, std::size_t, MeshData::Corners&) { return false; }
    std::string where(const std::string&) const { return words.line(); }
    /// How many more values the text has room for. Each has a blank before it.
    std::uint64_t room(PlyType) const { return words.left() / 2; }
    /// Ends the line of an element; false if there is more on it, which is skipped.
    bool end_element() {
        starts_line = true;
        const bool ended = words.next_in_line().empty();
        return words.skip_line(), ended;
    }
    bool ended() { return words.next().empty(); }
    [[noreturn]] void fail(const std::string& message) const { words.fail(message); }

  private:
    Words words;
    bool starts_line = true;
};

/// Reads binary values, in the byte order of the processor or in the other one.
template <bool swapped>
class BinaryValues {
  public:
    BinaryValues(const Source& source, std::string_view bytes)
        : source(&source), place(bytes.data()), end(place + bytes.size()) {}

    bool read(PlyType type, double& value) {
        switch (type) {
            case PlyType::int8:
                return get<std::int8_t>(value);
            case PlyType::uint8:
                return get<std::uint8_t>(value);
            case PlyType::int16:
                return get<std::int16_t>(value);
            case PlyType::uint16:
                return get<std::uint16_t>(value);
            case PlyType::int32:
                return get<std::int32_t>(value);
            case PlyType::uint32:
                return get<std::uint32_t>(value);
            case PlyType::float32:
                return get<float>(value);
            default:
                return get<double>(value);
        }
    }
    /// Reads a list of three numbers from 0 to below `limit`, in the form that nearly all files have. Reads nothing and
    /// returns false if something else comes next.
    bool read_triangle(const PlyProperty& list, std::size_t limit, MeshData::Corners& corners) {
        const bool usual =
            !swapped && list.count == PlyType::uint8 && (list.type == PlyType::int32 || list.type == PlyType::uint32);
        if (!usual || static_cast<std::size_t>(end - place) < 1 + sizeof corners || *place != 3) return false;
        std::memcpy(corners.data(), place + 1, sizeof corners);
        for (const std::int32_t corner : corners)
            if (static_cast<std::uint32_t>(corner) >= limit) return false;
        place += 1 + sizeof corners;
        return true;
    }
    static std::string where(const std::string& here) { return here; }
    std::uint64_t room(PlyType type) const { return static_cast<std::uint64_t>(end - place) / size_of(type); }
    static bool end_element() { return true; }
    bool ended() const { return place == end; }
    [[noreturn]] void fail(const std::string& message) const { source->fail(message); }

  private:
    template <class V>
    bool get(double& value) {
        if (static_cast<std::size_t>(end - place) < sizeof(V)) return false;
        char bytes[sizeof(V)];
        std::memcpy(bytes, place, sizeof(V));
        if constexpr (swapped) std::reverse(bytes, bytes + sizeof(V));
        V v;
        std::memcpy(&v, bytes, sizeof(V));
        value = v;
        place += sizeof(V);
        return true;
    }

    const Source* source;
    const char *place, *end;
};

/// The properties of an element that are its colour.
struct PlyColors {
    static constexpr std::array<std::string_view, 3> channels{"red", "green", "blue"};
    static constexpr std::size_t none = ~std::size_t(0);
    std::array<std::size_t, 3> columns{none, none, none};  // indices of red, green and blue
    double most = 0;                                       // the value of full colour; 0: colours are shares

    std::size_t first() const { return std::ranges::min(columns); }
    /// Takes the value of a property, if that is part of the colour.
    void take(std::size_t column, double value, MeshLook::Rgb& color) const {
        for (std::size_t c = 0; c < 3; ++c)
            if (columns[c] == column) color[c] = MeshLook::share(value, most);
    }
};

/// Reads the elements, whose values are text or binary.
template <class Values>
class PlyReader {
  public:
    PlyReader(const Source& source, const PlyHeader& header)
        : source(source), header(header), values(source, source.bytes.substr(header.size)), faces(source, mesh) {}

    MeshData read() {
        struct Waiting {
            const PlyElement& element;
            Values values;
        };
        std::vector<Waiting> waiting;  // faces that come before the vertices
        bool has_vertices = false;
        for (const PlyElement& next : header.elements) {
            begin(next);
            const bool is_faces = next.count > 0 && (next.name == "face" || next.name == "tristrips");
            if (next.name == "vertex")
                read_vertices(), has_vertices = true;
            else if (is_faces && has_vertices)
                read_faces();
            else if (is_faces)
                waiting.push_back({next, values}), skip_element();
            else
                skip_element();
        }
        if (!values.ended())
            source.fail("the file goes on after all that its header announces; its counts are wrong, so save it again");
        for (const Waiting& faces_before : waiting) {
            begin(faces_before.element);
            values = faces_before.values;
            read_faces();
        }
        if (!has_faces) source.fail("there are no faces in this file; a mesh needs an element 'face' or 'tristrips'");
        faces.finish();
        if (mesh.corner_places.empty() && (!places_of_points || gaps)) mesh.places = {};
        return std::move(mesh);
    }

  private:
    void begin(const PlyElement& next) { element = &next, number = 0; }
    /// "vertex 7 (counted from 0)"
    std::string here() const { return std::string(element->name) + " " + std::to_string(number) + " (counted from 0)"; }
    double value(PlyType type) {
        double v = 0;
        if (!values.read(type, v))
            values.fail("the values of " + here() +
                        " end too early; the file was cut off, its header announces too many, or, in a text, they "
                        "are not in a line of their own");
        return v;
    }
    void end_element() {
        if (!values.end_element())
            source.lose({"ignored what follows the values of ", "element", " in its line"},
                        [&] { return values.where(here()); });
        ++number;
    }
    /// Reads the length of a list; fails if the rest of the file has no room for it.
    std::uint64_t length(const PlyProperty& list) {
        const double count = value(*list.count);
        if (!(count >= 0) || count != std::floor(count))
            values.fail(here() + " has a list of " + count_text(count) + " entries");
        const std::uint64_t room = values.room(list.type);
        if (count > static_cast<double>(room))
            values.fail(here() + " has a list of " + count_text(count) +
                        " entries, but the rest of the file has room for at most " + std::to_string(room) +
                        "; it was cut off or changed, so get a new copy");
        return static_cast<std::uint64_t>(count);
    }
    void skip(const PlyProperty& property) {
        for (std::uint64_t left = property.count ? length(property) : 1; left > 0; --left) value(property.type);
    }
    /// Fails if a place in a picture is out of range. One that is not a number is left to Faces.
    MeshData::Place checked(const MeshData::Place& place) {
        const DVec3 point{place[0], place[1], 0};
        if (!Source::in_range(point) && !std::isnan(place[0] + place[1]))
            values.fail("in a picture, " + here() + " " + Source::fault(point));
        return place;
    }
    void skip_element() {
        if (element->properties.empty()) return;
        for (; number < element->count; ++number) {
            for (const PlyProperty& property : element->properties) skip(property);
            values.end_element();
        }
    }
    void read_vertices();
    void read_faces();
    void read_corners(const PlyProperty& list);
    void read_places(const PlyProperty& list);
    void add_places();
    void add_strips();
    void add_face();
    bool add_triangle();
    std::optional<PlyColors> find_colors() const;

    const Source& source;
    const PlyHeader& header;
    Values values;
    const PlyElement* element = nullptr;
    std::uint64_t number = 0;  // index of the element
    MeshData mesh;
    Faces faces;
    bool smooth = false, has_faces = false;
    bool places_of_points = false, gaps = false;  // the vertices have places; some of these are not numbers
    Face face;
    std::vector<MeshData::Place> face_places;
};

template <class Values>
void PlyReader<Values>::read_vertices() {
    constexpr std::string_view names[]{"x", "y", "z", "nx", "ny", "nz", "u", "v", "s", "t", "texture_u", "texture_v"};
    constexpr int others = 12;
    const std::optional<PlyColors> colors = find_colors();
    if (colors && source.look) source.look->point_colors.resize(element->count);
    std::vector<int> meanings;
    bool found[others + 1]{};
    for (const PlyProperty& property : element->properties) {
        const auto name = std::find(std::begin(names), std::end(names), property.name);
        meanings.push_back(property.count ? others : static_cast<int>(name - std::begin(names)));
        found[meanings.back()] = true;
    }
    if (!found[0] || !found[1] || !found[2]) source.fail("the vertices of this file lack one of x, y and z");
    smooth = found[3] && found[4] && found[5];
    int place = 6;  // index in the names of the first of a pair: u, v; s, t
    while (place < others && !(found[place] && found[place + 1])) place += 2;
    source.check_points(element->count);
    mesh.points.resize(element->count);
    if (smooth) mesh.normals.resize(element->count);
    if (place < others) mesh.places.resize(element->count);
    for (; number < element->count; end_element()) {
        double v[others + 1];
        for (std::size_t i = 0; i < meanings.size(); ++i) {
            if (element->properties[i].count)
                skip(element->properties[i]);
            else if (const double own = value(element->properties[i].type); meanings[i] < others)
                v[meanings[i]] = own;
            else if (colors && source.look)
                colors->take(i, own, source.look->point_colors[number]);
        }
        const DVec3 point{v[0], v[1], v[2]};
        if (!Source::in_range(point)) values.fail(here() + " " + Source::fault(point));
        mesh.points[number] = point;
        if (smooth) mesh.normals[number] = {v[3], v[4], v[5]};
        if (place < others) mesh.places[number] = checked({v[place], v[place + 1]});
    }
    places_of_points = place < others;
    gaps = std::ranges::any_of(mesh.places, [](const MeshData::Place& own) { return std::isnan(own[0] + own[1]); });
}

/// Finds the properties of the element that are its colour, and warns if nobody wants them.
template <class Values>
std::optional<PlyColors> PlyReader<Values>::find_colors() const {
    std::optional<PlyColors> colors;
    const auto& properties = element->properties;
    for (std::size_t i = 0; i < properties.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::string_view name = properties[i].name, channel = PlyColors::channels[c];
            if (properties[i].count || (name != channel && name != "diffuse_" + std::string(channel))) continue;
            if (!colors) colors.emplace();
            colors->columns[c] = i;
            colors->most = properties[i].type == PlyType::uint8    ? 255
                           : properties[i].type == PlyType::uint16 ? 65535
                                                                   : 0;
        }
    if (colors && !source.look)
        source.lose(
            {"ignored the colours of ", "element", ""},
            [&] { return source.line_at(properties[colors->first()].name.data()); }, element->count);
    return colors;
}

template <class Values>
void PlyReader<Values>::read_faces() {
    const auto& properties = element->properties;
    const auto is_corners = [](const PlyProperty& property) {
        return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
    };
    const auto is_places = [&](const PlyProperty& property) { return property.count && property.name == "texcoord"; };
    if (std::ranges::count_if(properties, is_corners) != 1)
        source.fail("element " + quoted(element->name) + " should have one list, vertex_indices or vertex_index");
    if (mesh.points.empty()) source.fail("there are no vertices in this file; a mesh needs an element 'vertex'");
    const bool strips = element->name == "tristrips", own_places = std::ranges::any_of(properties, is_places);
    if (own_places) places_of_points = false;
    if (own_places && mesh.corner_places.empty()) mesh.places.clear();
    const std::optional<PlyColors> colors = find_colors();
    MeshLook::Rgb color{};
    has_faces = true;
    if (!strips) {
        source.check_triangles(element->count);
        mesh.triangles.reserve(element->count);
        if (smooth) mesh.corner_normals.reserve(element->count);
    }
    const bool alone = !strips && properties.size() == 1 && !gaps && (!smooth || faces.all_directions());
    for (; number < element->count; end_element()) {
        if (alone && add_triangle()) continue;
        face.clear(), face_places.clear();
        for (const PlyProperty& property : properties)
            if (is_corners(property))
                read_corners(property);
            else if (is_places(property))
                read_places(property);
            else if (!property.count && colors && source.look)
                colors->take(std::size_t(&property - properties.data()), value(property.type), color);
            else
                skip(property);
        if (own_places)
            add_places();
        else if (places_of_points && gaps)
            face.places = face.points;
        if (strips)
            add_strips();
        else
            add_face();
        if (colors && source.look) source.look->triangle_colors.resize(mesh.triangles.size(), color);
    }
}

/// Reads the numbers of a face's points. Among those of strips may be -1, at which a strip ends.
template <class Values>
void PlyReader<Values>::read_corners(const PlyProperty& list) {
    face.points.resize(length(list));
    const double least = element->name == "tristrips" ? -1 : 0;
    for (std::int32_t& point : face.points) {
        const double index = value(list.type);
        if (!(index >= least && index < static_cast<double>(mesh.points.size()) && index == std::floor(index)))
            values.fail(here() + " names vertex " + count_text(index) + "; there are vertices 0 to " +
                        std::to_string(mesh.points.size() - 1));
        point = static_cast<std::int32_t>(index);
    }
}

/// Reads the places of a face's corners in a picture, u and v for each in turn.
template <class Values>
void PlyReader<Values>::read_places(const PlyProperty& list) {
    for (std::uint64_t left = length(list); left > 1; left -= 2) {
        const double u = value(list.type);
        face_places.push_back(checked({u, value(list.type)}));
        if (left == 3) value(list.type);
    }
}

template <class Values>
void PlyReader<Values>::add_places() {
    face.places.assign(face.points.size(), Face::none);
    if (face_places.size() != face.points.size()) {
        if (!face_places.empty())
            source.lose({"left out the places of ", "face", " in pictures, which are not as many as its corners"},
                        [&] { return values.where(here()); });
        return;
    }
    source.check_points(mesh.places.size() + face_places.size());
    std::iota(face.places.begin(), face.places.end(), static_cast<std::int32_t>(mesh.places.size()));
    mesh.places.insert(mesh.places.end(), face_places.begin(), face_places.end());
}

template <class Values>
void PlyReader<Values>::add_face() {
    if (smooth) face.normals = face.points;
    faces.add(
        face, [&] { return values.where(here()); }, [&](const std::string& message) { values.fail(here() + message); });
}

/// Adds the next face if it is a triangle whose corners are all that has to be read of it.
template <class Values>
bool PlyReader<Values>::add_triangle() {
    MeshData::Corners corners;
    if (!values.read_triangle(element->properties[0], mesh.points.size(), corners)) return false;
    mesh.triangles.push_back(corners);
    if (smooth) mesh.corner_normals.push_back(corners);
    return true;
}

/// Adds the triangles of strips: each three points in a row, of which every second triangle is turned.
template <class Values>
void PlyReader<Values>::add_strips() {
    const Face strips = face;
    std::size_t start = 0;  // of the strip
    for (std::size_t i = 0; i < strips.points.size(); ++i) {
        if (strips.points[i] < 0) start = i + 1;
        if (i < start + 2) continue;
        const std::size_t turned = (i - start) % 2;
        const auto three = [&](const std::vector<std::int32_t>& all, std::vector<std::int32_t>& some) {
            if (!all.empty()) some = {all[i - 2 + turned], all[i - 1 - turned], all[i]};
        };
        three(strips.points, face.points), three(strips.places, face.places);
        add_face();
    }
}

}  // namespace

MeshData read_ply(const Source& source) {
    const PlyHeader header = read_ply_header(source);
    constexpr bool little = std::endian::native == std::endian::little;
    switch (header.format) {
        case PlyFormat::ascii:
            return PlyReader<TextValues>(source, header).read();
        case PlyFormat::little_endian:
            return PlyReader<BinaryValues<!little>>(source, header).read();
        default:
            return PlyReader<BinaryValues<little>>(source, header).read();
    }
}

}  // namespace strahl

// Reads the values of a PLY file: the elements `vertex` and `face`, in the form that its header describes.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

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
    /// How many more values the text has room for. Each has a blank before it.
    std::uint64_t room(PlyType) const { return words.left() / 2; }
    /// Ends the line of an element; false if there is more on it.
    bool end_element() { return starts_line = true, words.next_in_line().empty(); }
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
        : source(source), place(bytes.data()), end(place + bytes.size()) {}

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
    std::uint64_t room(PlyType type) const { return static_cast<std::uint64_t>(end - place) / size_of(type); }
    static bool end_element() { return true; }
    bool ended() const { return place == end; }
    [[noreturn]] void fail(const std::string& message) const { source.fail(message); }

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

    const Source& source;
    const char *place, *end;
};

/// Reads the elements, whose values are text or binary.
template <class Values>
class PlyReader {
  public:
    PlyReader(const Source& source, const PlyHeader& header)
        : source(source), header(header), values(source, source.bytes.substr(header.size)) {}

    MeshData read() {
        for (const PlyElement& next : header.elements) {
            element = &next, number = 0;
            if (element->name == "vertex")
                read_vertices();
            else if (element->name == "face")
                read_faces();
            else if (!element->properties.empty())
                for (; number < element->count; end_element())
                    for (const PlyProperty& property : element->properties) skip(property);
        }
        if (!has_faces) source.fail("there are no faces in this file; a mesh needs an element 'face'");
        if (!values.ended())
            source.fail("the file goes on after all that its header announces; its counts are wrong, so save it again");
        return std::move(mesh);
    }

  private:
    /// "vertex 7 (counted from 0)"
    std::string here() const { return std::string(element->name) + " " + std::to_string(number) + " (counted from 0)"; }
    double value(PlyType type) {
        double v = 0;
        if (!values.read(type, v))
            values.fail("the values of " + here() +
                        " end too early; the file was cut off, or its header announces too many");
        return v;
    }
    void end_element() {
        if (!values.end_element()) values.fail(here() + " has more values than the header announces");
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
    void read_vertices();
    void read_faces();
    void read_corners(const PlyProperty& list);

    const Source& source;
    const PlyHeader& header;
    Values values;
    const PlyElement* element = nullptr;
    std::uint64_t number = 0;  // of the element
    MeshData mesh;
    bool smooth = false, has_faces = false;
    std::vector<std::int32_t> corners;
    FaceSplitter splitter;
};

template <class Values>
void PlyReader<Values>::read_vertices() {
    constexpr std::string_view names[]{"x", "y", "z", "nx", "ny", "nz", "u", "v", "s", "t", "texture_u", "texture_v"};
    constexpr int others = 12;
    std::vector<int> meanings;
    bool found[others + 1]{};
    for (const PlyProperty& property : element->properties) {
        const auto name = std::find(std::begin(names), std::end(names), property.name);
        meanings.push_back(property.count ? others : static_cast<int>(name - std::begin(names)));
        found[meanings.back()] = true;
    }
    if (!found[0] || !found[1] || !found[2]) source.fail("the vertices of this file lack one of x, y and z");
    smooth = found[3] && found[4] && found[5];
    int place = 6;  // the first of both names of a place
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
            else
                v[meanings[i]] = value(element->properties[i].type);
        }
        const DVec3 point{v[0], v[1], v[2]};
        if (const std::string fault = Source::fault(point); !fault.empty()) values.fail(here() + " " + fault);
        mesh.points[number] = point;
        if (smooth) mesh.normals[number] = {v[3], v[4], v[5]};
        if (place == others) continue;
        const std::string fault = Source::fault({v[place], v[place + 1], 0});
        if (!fault.empty()) values.fail("in a picture, " + here() + " " + fault);
        mesh.places[number] = {v[place], v[place + 1]};
    }
}

template <class Values>
void PlyReader<Values>::read_faces() {
    const auto is_corners = [](const PlyProperty& property) {
        return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
    };
    const auto& properties = element->properties;
    if (std::count_if(properties.begin(), properties.end(), is_corners) != 1)
        source.fail("the faces of this file should have one list, vertex_indices or vertex_index");
    if (mesh.points.empty()) source.fail("there are no vertices before the faces; put the element 'vertex' first");
    source.check_triangles(element->count);
    has_faces = true;
    mesh.triangles.reserve(element->count);
    if (smooth) mesh.corner_normals.reserve(element->count);
    for (; number < element->count; end_element())
        for (const PlyProperty& property : properties)
            if (is_corners(property))
                read_corners(property);
            else
                skip(property);
}

template <class Values>
void PlyReader<Values>::read_corners(const PlyProperty& list) {
    corners.resize(length(list));
    for (std::int32_t& corner : corners) {
        const double index = value(list.type);
        if (!(index >= 0 && index < static_cast<double>(mesh.points.size()) && index == std::floor(index)))
            values.fail(here() + " names vertex " + count_text(index) + "; there are vertices 0 to " +
                        std::to_string(mesh.points.size() - 1));
        corner = static_cast<std::int32_t>(index);
    }
    const std::size_t before = mesh.triangles.size();
    add_face(source, splitter, mesh, corners, [&](const std::string& message) { values.fail(here() + message); });
    if (smooth)
        mesh.corner_normals.insert(mesh.corner_normals.end(),
                                   mesh.triangles.begin() + static_cast<std::ptrdiff_t>(before), mesh.triangles.end());
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

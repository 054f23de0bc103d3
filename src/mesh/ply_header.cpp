// Reads the header of a PLY file, which is text whatever follows (G. Turk, "The PLY Polygon File Format").
#include "mesh/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace strahl {
namespace {

struct TypeName {
    std::string_view name, sized_name;
    PlyType type;
    std::size_t size;
};
constexpr std::array<TypeName, 8> types{{{"char", "int8", PlyType::int8, 1},
                                         {"uchar", "uint8", PlyType::uint8, 1},
                                         {"short", "int16", PlyType::int16, 2},
                                         {"ushort", "uint16", PlyType::uint16, 2},
                                         {"int", "int32", PlyType::int32, 4},
                                         {"uint", "uint32", PlyType::uint32, 4},
                                         {"float", "float32", PlyType::float32, 4},
                                         {"double", "float64", PlyType::float64, 8}}};

/// Reads the header line by line.
class PlyHeaderReader {
  public:
    explicit PlyHeaderReader(const Source& source) : source(source), words(source, source.bytes) {}

    PlyHeader read() {
        if (words.next() != "ply" || !words.next_in_line().empty() || words.left() == 0)
            source.fail("not a PLY file: its first line is not 'ply'");
        const std::string_view bytes = source.bytes;
        const std::size_t end = bytes.find_first_of("\r\n");
        pairs = bytes.substr(end, 1) == "\n" || bytes.substr(end, 2) == "\r\n";
        place = after_line(end);
        while (next_line()) continue;
        if (!has_format) source.fail("the header of this PLY file has no line 'format'");
        check_counts();
        return {format, std::move(elements), place};
    }

  private:
    /// Returns where the line after the one that ends at `end` begins.
    std::size_t after_line(std::size_t end) const {
        return end + (pairs && source.bytes.substr(end, 2) == "\r\n" ? 2 : 1);
    }
    bool next_line();
    void read_format();
    void read_element();
    void read_property();
    PlyType type();
    void check_counts() const;

    const Source& source;
    Words words;
    // May a carriage return and a line feed end a line together? Not where the first line ends in a lone carriage
    // return: then values may begin with the byte of a line feed.
    bool pairs = true;
    std::size_t place = 0;
    bool has_format = false;
    PlyFormat format{};
    std::vector<PlyElement> elements;
};

/// Reads a line; false after the last one.
bool PlyHeaderReader::next_line() {
    const std::size_t end = source.bytes.find_first_of("\r\n", place);
    if (end == source.bytes.npos)
        source.fail("the header of this PLY file has no end ('end_header'); the file was cut off, so get a new copy");
    words = Words(source, source.bytes.substr(place, end - place));
    place = after_line(end);
    const std::string_view word = words.next();
    if (word == "end_header") return false;
    if (word == "format")
        read_format();
    else if (word == "element")
        read_element();
    else if (word == "property")
        read_property();
    else if (!word.empty() && word != "comment" && word != "obj_info")
        source.lose({"ignored ", "line", " of the header that begins with no word of the PLY format"},
                    [&] { return words.line(); });
    return true;
}

void PlyHeaderReader::read_format() {
    const std::string_view word = words.next();
    if (word == "ascii")
        format = PlyFormat::ascii;
    else if (word == "binary_little_endian")
        format = PlyFormat::little_endian;
    else if (word == "binary_big_endian")
        format = PlyFormat::big_endian;
    else
        words.fail("the format should be ascii, binary_little_endian or binary_big_endian, and is " + quoted(word));
    has_format = true;
}

void PlyHeaderReader::read_element() {
    const std::string_view name = words.next(), count = words.next();
    std::uint64_t number = 0;
    const auto [stop, fault] = std::from_chars(count.data(), count.data() + count.size(), number);
    if (count.empty() || stop != count.data() + count.size() || fault != std::errc())
        words.fail("an element has a name and a count, as in 'element vertex 8'");
    for (const PlyElement& other : elements)
        if (other.name == name) words.fail("there are two elements " + quoted(name) + "; make one of them");
    // Many more kinds of elements would make the search among their names slow.
    if (elements.size() == 100) words.fail("this PLY file has more than 100 kinds of elements");
    elements.push_back({name, number, {}});
}

void PlyHeaderReader::read_property() {
    if (elements.empty()) words.fail("this property belongs to no element: a line 'element' must come first");
    PlyProperty property{};
    Words after = words;
    if (after.next() == "list") {
        words = after;
        property.count = type();
        if (*property.count >= PlyType::float32) words.fail("the length of a list must have an integer type");
    }
    property.type = type();
    property.name = words.next();
    if (property.name.empty()) words.fail("this property has no name");
    elements.back().properties.push_back(property);
}

PlyType PlyHeaderReader::type() {
    const std::string_view word = words.next();
    for (const TypeName& known : types)
        if (word == known.name || word == known.sized_name) return known.type;
    words.fail(quoted(word) +
               " is not a type; types are char, uchar, short, ushort, int, uint, float, double and int8 to float64");
}

/// Fails if the file is too short for the elements that are announced, before anything is allocated for them.
void PlyHeaderReader::check_counts() const {
    std::uint64_t left = source.bytes.size() - place;
    // The last number of a text needs no space behind it.
    if (format == PlyFormat::ascii) ++left;
    for (const PlyElement& element : elements) {
        std::uint64_t least = 0;
        for (const PlyProperty& property : element.properties)
            least += format == PlyFormat::ascii ? 2 : size_of(property.count.value_or(property.type));
        if (least == 0) continue;
        if (element.count > left / least)
            source.fail("the header announces " + std::to_string(element.count) + " of element " +
                        quoted(element.name) + ", but only " + counted(left, "byte") +
                        " are left for them; the file was cut off or changed, so get a new copy");
        left -= element.count * least;
    }
}

}  // namespace

std::size_t size_of(PlyType type) { return types[static_cast<std::size_t>(type)].size; }

PlyHeader read_ply_header(const Source& source) { return PlyHeaderReader(source).read(); }

}  // namespace strahl

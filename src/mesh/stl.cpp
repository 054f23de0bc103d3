// Reads STL: triangles with three points each, as text or as floats.
#include <algorithm>
#include <bit>

#include "files/bytes.h"
#include "mesh/join.h"
#include "mesh/source.h"

namespace strahl {
namespace {

constexpr std::size_t header_size = 84, triangle_size = 50;
constexpr std::uint32_t unknown_count = 0xffff'ffff;

/// Numbers points as PointJoiner does. Triangles that follow each other share points: a small table, which stays in the
/// cache, holds the numbers of those that came last.
class CornerJoiner {
  public:
    explicit CornerJoiner(std::size_t expected = 0) : joiner(expected) {}

    std::int32_t number_of(const DVec3& point) {
        const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
        const std::uint64_t mixed = ((bits(point.x) * 3 + bits(point.y)) * 5 + bits(point.z)) * 0x9E3779B97F4A7C15u;
        std::int32_t& late = recent[mixed >> (64 - index_bits)];
        const std::vector<DVec3>& known = joiner.points();
        if (static_cast<std::size_t>(late) < known.size() && known[late] == point) return late;
        return late = joiner.number_of(point);
    }
    std::vector<DVec3>& points() { return joiner.points(); }

  private:
    static constexpr int index_bits = 15;
    PointJoiner joiner;
    std::vector<std::int32_t> recent = std::vector<std::int32_t>(std::size_t(1) << index_bits);
};

/// The number of triangles in the header of a binary file.
std::uint64_t announced(std::string_view bytes) { return get_little<std::uint32_t>(bytes, header_size - 4); }

/// Returns how many triangles to read of a binary file. Some programs announce 0 or 2^32 - 1, because they do not know
/// yet, and some files go on after the last triangle.
std::uint64_t count_of(const Source& source) {
    const std::uint64_t size = source.bytes.size(), count = size < header_size ? 0 : announced(source.bytes);
    if (is_binary_stl(source.bytes)) return count;
    const std::uint64_t room = size < header_size ? 0 : (size - header_size) / triangle_size;
    const bool whole = room > 0 && size == header_size + triangle_size * room;
    const auto header = [] { return std::string("byte 80"); };
    if (whole && (count == 0 || count == unknown_count)) {
        source.lose({"read ", "triangle", ", as many as fit into the file: its header announces another number"},
                    header, room);
        return room;
    }
    if (count == 0 || count > room)
        source.fail("this STL file has " + counted(size, "byte") + ", and its header announces " +
                    counted(count, "triangle") + ", which take " + std::to_string(header_size + triangle_size * count) +
                    "; it was cut off or changed, so get a new copy");
    const std::uint64_t end = header_size + triangle_size * count;
    source.lose(
        {"ignored ", "byte", " after the triangles that the header announces"},
        [&] { return "from byte " + std::to_string(end) + " on"; }, size - end);
    return count;
}

/// Reads colours as Materialise Magics writes them: that of the whole body after "COLOR=", and those of triangles, in 5
/// bits for each of red, green and blue. The highest bit says that a triangle has that of the body.
void read_colors(const Source& source, std::uint64_t count) {
    const std::size_t at = std::min<std::size_t>(source.bytes.find("COLOR=") + 6, header_size - 4);
    MeshLook::Rgb body;
    for (std::size_t c = 0; c < 3; ++c)
        body[c] = MeshLook::share(static_cast<unsigned char>(source.bytes[at + c]), 255);
    source.look->triangle_colors.assign(count, body);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits =
            get_little<std::uint16_t>(source.bytes, header_size + triangle_size * (i + 1) - sizeof(std::uint16_t));
        if (bits >> 15) continue;
        for (unsigned c = 0; c < 3; ++c) source.look->triangle_colors[i][c] = MeshLook::share(bits >> (5 * c) & 31, 31);
    }
}

MeshData read_binary(const Source& source) {
    const std::string_view bytes = source.bytes;
    const std::uint64_t count = count_of(source);
    const bool colored = bytes.substr(0, header_size).find("COLOR=") != bytes.npos;
    if (colored && !source.look)
        source.lose(
            {"ignored the colours of ", "triangle", ""}, [] { return std::string("by 'COLOR=' at its start"); }, count);
    source.check_triangles(count);
    MeshData mesh;
    CornerJoiner points(count / 2);  // as many as a closed surface has
    mesh.triangles.resize(count);
    if (colored && source.look) read_colors(source, count);
    for (std::uint64_t i = 0; i < count; ++i) {
        std::size_t place = header_size + triangle_size * i + 12;  // after the normal
        for (std::int32_t& corner : mesh.triangles[i]) {
            DVec3 point;
            for (int c = 0; c < 3; ++c, place += 4)
                point[c] = std::bit_cast<float>(get_little<std::uint32_t>(bytes, place));
            if (!Source::in_range(point))
                source.fail("a corner of triangle " + std::to_string(i) + " (counted from 0) " + Source::fault(point));
            corner = points.number_of(point);
        }
    }
    mesh.points = std::move(points.points());
    source.check_points(mesh.points.size());
    return mesh;
}

/// Reads the text form. Some programs write its words in capitals, some write "end loop" for "endloop", and some write
/// comments.
class StlText {
  public:
    explicit StlText(const Source& source) : source(source), words(source, source.bytes) {}

    MeshData read() {
        expect("solid");
        while (true) {
            words.skip_line();  // a name
            std::string_view word = keyword();
            for (; same_word(word, "facet"); word = keyword()) read_facet();
            if (!same_word(word, "endsolid")) fail_at(word, "'facet' or 'endsolid'");
            words.skip_line();
            word = keyword();
            if (word.empty()) break;
            if (!same_word(word, "solid")) fail_at(word, "another 'solid' or the end");
        }
        mesh.points = std::move(points.points());
        return std::move(mesh);
    }

  private:
    [[noreturn]] void fail_at(std::string_view word, const std::string& expected) const {
        if (word.empty())
            words.fail("the file ends where " + expected + " should be; it was cut off, so get a new copy");
        words.fail("expected " + expected + ", found " + quoted(word));
    }
    /// Reads the next word. Skips comments, and joins "end" with the word after it.
    std::string_view keyword() {
        std::string_view word = words.next();
        for (; is_comment(word); word = words.next()) words.skip_line();
        if (!same_word(word, "end")) return word;
        joined = "end";
        return joined += words.next_in_line();
    }
    static bool is_comment(std::string_view word) {
        return word.starts_with('#') || word.starts_with(';') || word.starts_with("//");
    }
    void expect(std::string_view expected) {
        if (const std::string_view word = keyword(); !same_word(word, expected)) fail_at(word, quoted(expected));
    }
    void read_facet() {
        expect("normal");
        std::string_view word = keyword();
        for (int i = 0; i < 3 && !same_word(word, "outer"); ++i) word = keyword();
        if (!same_word(word, "outer")) fail_at(word, "'outer'");
        expect("loop");
        MeshData::Corners corners;
        for (std::int32_t& corner : corners) {
            expect("vertex");
            const DVec3 point = words.vector();
            if (!Source::in_range(point)) words.fail("this corner " + Source::fault(point));
            corner = points.number_of(point);
        }
        expect("endloop"), expect("endfacet");
        mesh.triangles.push_back(corners);
        source.check_triangles(mesh.triangles.size());
        source.check_points(points.points().size());
    }

    const Source& source;
    Words words;
    std::string joined;
    CornerJoiner points;
    MeshData mesh;
};

}  // namespace

bool is_binary_stl(std::string_view bytes) {
    return bytes.size() >= header_size && bytes.size() == header_size + triangle_size * announced(bytes);
}

MeshData read_stl(const Source& source) {
    // Many binary files begin with "solid" as well, but among their first bytes is a 0: in the number of triangles.
    const bool binary = is_binary_stl(source.bytes) || announced(source.bytes) == unknown_count ||
                        source.bytes.substr(0, header_size).find('\0') != source.bytes.npos;
    return binary ? read_binary(source) : StlText(source).read();
}

}  // namespace strahl

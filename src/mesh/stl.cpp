// Reads STL: triangles with three points each, as text or as floats.
#include <bit>

#include "files/bytes.h"
#include "mesh/join.h"
#include "mesh/source.h"

namespace strahl {
namespace {

constexpr std::size_t header_size = 84, triangle_size = 50;

/// The number of triangles in the header of a binary file.
std::uint64_t announced(std::string_view bytes) {
    return get_little<std::uint32_t>(bytes, header_size - 4);
}

MeshData read_binary(const Source& source) {
    const std::string_view bytes = source.bytes;
    const std::uint64_t count = bytes.size() < header_size ? 0 : announced(bytes);
    if (!is_binary_stl(bytes))
        source.fail("this STL file has " + counted(bytes.size(), "byte") + ", and its header announces " +
                    counted(count, "triangle") + ", which take " + std::to_string(header_size + triangle_size * count) +
                    "; it was cut off or changed, so get a new copy");
    source.check_triangles(count);
    MeshData mesh;
    PointJoiner points;
    mesh.triangles.resize(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        std::size_t place = header_size + triangle_size * i + 12;  // after the normal
        for (std::int32_t& corner : mesh.triangles[i]) {
            DVec3 point;
            for (int c = 0; c < 3; ++c, place += 4)
                point[c] = std::bit_cast<float>(get_little<std::uint32_t>(bytes, place));
            if (const std::string fault = Source::fault(point); !fault.empty())
                source.fail("a corner of triangle " + std::to_string(i) + " (counted from 0) " + fault);
            corner = points.number_of(point);
        }
    }
    mesh.points = std::move(points.points());
    source.check_points(mesh.points.size());
    return mesh;
}

/// Reads the text form. Some programs write its words in capitals.
class StlText {
  public:
    explicit StlText(const Source& source) : source(source), words(source, source.bytes) {}

    MeshData read() {
        expect("solid");
        while (true) {
            words.skip_line();  // a name
            std::string_view word = words.next();
            for (; same_word(word, "facet"); word = words.next()) read_facet();
            if (!same_word(word, "endsolid")) fail_at(word, "'facet' or 'endsolid'");
            words.skip_line();
            word = words.next();
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
    void expect(std::string_view expected) {
        if (const std::string_view word = words.next(); !same_word(word, expected)) fail_at(word, quoted(expected));
    }
    void read_facet() {
        expect("normal");
        for (int i = 0; i < 3; ++i) words.next();
        expect("outer"), expect("loop");
        MeshData::Corners corners;
        for (std::int32_t& corner : corners) {
            expect("vertex");
            const DVec3 point = words.vector();
            if (const std::string fault = Source::fault(point); !fault.empty()) words.fail("this corner " + fault);
            corner = points.number_of(point);
        }
        expect("endloop"), expect("endfacet");
        mesh.triangles.push_back(corners);
        source.check_triangles(mesh.triangles.size());
        source.check_points(points.points().size());
    }

    const Source& source;
    Words words;
    PointJoiner points;
    MeshData mesh;
};

}  // namespace

bool is_binary_stl(std::string_view bytes) {
    return bytes.size() >= header_size && bytes.size() == header_size + triangle_size * announced(bytes);
}

MeshData read_stl(const Source& source) {
    // Many binary files begin with "solid" as well.
    return source.bytes.starts_with("solid") && !is_binary_stl(source.bytes) ? StlText(source).read()
                                                                             : read_binary(source);
}

}  // namespace strahl

// Reads the bytes of a mesh file and the words of its text, and writes messages about both.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/words.h"
#include "mesh/read_mesh.h"
#include "mesh/split.h"

namespace strahl {

struct Source {
    std::string path;
    std::string_view bytes;
    MeshLimits limits;

    /// Throws FileError. `at` is a place in the bytes of a text; the message says in which line it is.
    [[noreturn]] void fail(const std::string& message, const char* at = nullptr) const;
    /// Why a point is invalid, or "".
    static std::string fault(const DVec3& point);
    /// Fail if there are more than the limits allow.
    void check_triangles(std::uint64_t count) const;
    void check_points(std::uint64_t count) const;
};

MeshData read_ply(const Source& source);
MeshData read_obj(const Source& source);
MeshData read_stl(const Source& source);
/// Is it a binary STL file? Only its length can tell.
bool is_binary_stl(std::string_view bytes);

/// "1 face" or "2 faces".
std::string counted(std::uint64_t count, const char* noun);

/// White space, or a backslash: OBJ joins lines by it, and no number or name that is read here contains it.
inline bool is_blank(char c) { return is_space(c) || c == '\\'; }

/// Reads a text word by word.
class Words {
  public:
    Words(const Source& source, std::string_view text)
        : source(&source), begin(text.data()), place(begin), end(begin + text.size()) {}

    /// The next word; empty at the end.
    std::string_view next() {
        while (place < end && is_blank(*place)) ++place;
        const char* const start = place;
        while (place < end && !is_blank(*place)) ++place;
        begin = start;
        return {start, static_cast<std::size_t>(place - start)};
    }
    /// The next word of the line; empty at its end.
    std::string_view next_in_line() {
        while (place < end && is_blank(*place) && !ends_line()) ++place;
        if (place < end && !ends_line()) return next();
        begin = place;
        return {};
    }
    void skip_line() {
        while (place < end && !ends_line()) ++place;
    }
    /// The next word as a number. Fails if it is not one; the message says that it should be `what`.
    double number(const char* what);
    /// The next three words as coordinates.
    DVec3 vector() {
        DVec3 v;
        for (int c = 0; c < 3; ++c) v[c] = number("a coordinate");
        return v;
    }

    /// Bytes that are left.
    std::size_t left() const { return static_cast<std::size_t>(end - place); }
    /// Fails at the word that was read last.
    [[noreturn]] void fail(const std::string& message) const { source->fail(message, begin); }

  private:
    bool ends_line() const { return *place == '\n' || *place == '\r'; }

    const Source* source;
    const char *begin, *place, *end;
};

/// Appends a face to the triangles of a mesh, and returns them as positions in `corners`; none if there are fewer than
/// three. Calls fail(message), which throws, if it cannot be split into triangles.
template <class Fail>
std::span<const FaceSplitter::Triangle> add_face(const Source& source, FaceSplitter& splitter, MeshData& mesh,
                                                 const std::vector<std::int32_t>& corners, const Fail& fail) {
    if (corners.size() < 3) return {};
    source.check_triangles(mesh.triangles.size() + corners.size() - 2);
    const std::span<const FaceSplitter::Triangle> triangles = splitter.split(mesh.points, corners);
    if (triangles.empty())
        fail(" has " + std::to_string(corners.size()) + " corners and is not convex; such a face may have at most " +
             std::to_string(FaceSplitter::most_concave) + " corners, so split it");
    for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({corners[a], corners[b], corners[c]});
    return triangles;
}

}  // namespace strahl

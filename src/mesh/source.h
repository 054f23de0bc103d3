// Reads the bytes of a mesh file and the words of its text, and writes messages about both.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "files/utf8.h"
#include "files/words.h"
#include "mesh/read_mesh.h"

namespace strahl {

/// A sentence about parts of a file that are not read as they stand: `did`, the number of `noun`s, `rest`.
struct Loss {
    const char *did, *noun, *rest;
    bool operator==(const Loss&) const = default;  // compares pointers: each sentence is one constant
};

/// Counts losses for warnings, as in "skipped 3 faces of fewer than three corners (first in line 12)".
class Losses {
  public:
    using Where = std::function<std::string()>;
    /// Calls `where` for the first of each sentence only: finding a line takes time.
    void add(const Loss& loss, std::uint64_t count, const Where& where);
    std::vector<std::string> warnings(const std::string& path) const;

  private:
    struct Counted {
        Loss loss;
        std::uint64_t count = 0, times = 0;
        std::string first{};
    };
    std::vector<Counted> list;
};

struct Source {
    using Where = Losses::Where;

    std::string path;
    std::string_view bytes;
    MeshLimits limits;
    Losses& losses;
    MeshLook* look;  // null if nobody wants colours and names

    /// Throws FileError. `at` is a place in the bytes of a text; the message says in which line it is.
    [[noreturn]] void fail(const std::string& message, const char* at = nullptr) const;
    void lose(const Loss& loss, const Where& where, std::uint64_t count = 1) const { losses.add(loss, count, where); }
    /// "in line 12"
    std::string line_at(const char* at) const;
    /// Are all coordinates as in scenes? False for NaN.
    static bool in_range(const DVec3& point) {
        const auto fine = [](double c) { return c >= -1e9 && c <= 1e9; };
        return fine(point.x) && fine(point.y) && fine(point.z);
    }
    /// Why a point that is not in range is invalid.
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
/// Does the text begin with this word, in capitals or not?
bool begins_with(std::string_view text, std::string_view word);

/// "1 face" or "2 faces".
std::string counted(std::uint64_t count, const char* noun);

/// White space; a backslash, by which OBJ joins lines; or a byte 0 or 26, with which some programs end a text. No
/// number or name that is read here contains any of them.
inline bool is_blank(char c) { return is_space(c) || c == '\\' || c == '\0' || c == '\x1a'; }

/// Reads a text word by word. Byte order marks are skipped wherever they are: files that were joined have several.
class Words {
  public:
    Words(const Source& source, std::string_view text)
        : source(&source), begin(text.data()), place(begin), end(begin + text.size()) {}

    /// The next word; empty at the end.
    std::string_view next() {
        skip_blanks([] { return false; });
        const char* const start = place;
        while (place < end && !is_blank(*place)) ++place;
        begin = start;
        return {start, static_cast<std::size_t>(place - start)};
    }
    /// The next word of the line; empty at its end.
    std::string_view next_in_line() {
        skip_blanks([this] { return ends_line(); });
        if (place < end && !ends_line()) return next();
        begin = place;
        return {};
    }
    /// The rest of the line, without blanks around it.
    std::string_view rest_of_line() {
        skip_blanks([this] { return ends_line(); });
        const char* const start = place;
        skip_line();
        std::string_view rest(start, place);
        while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
        return rest;
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

    /// Returns the place at which the word that was read last begins.
    const char* start() const { return begin; }
    /// Returns the line of that place: "in line 12".
    std::string line() const { return source->line_at(begin); }
    /// Bytes that are left.
    std::size_t left() const { return static_cast<std::size_t>(end - place); }
    /// Fails at the word that was read last.
    [[noreturn]] void fail(const std::string& message) const { source->fail(message, begin); }

  private:
    bool ends_line() const { return *place == '\n' || *place == '\r'; }
    template <class Stop>
    void skip_blanks(Stop stop) {
        while (place < end && !stop())
            if (is_blank(*place))
                ++place;
            else if (*place == byte_order_mark[0] && std::string_view(place, end).starts_with(byte_order_mark))
                place += byte_order_mark.size();
            else
                return;
    }

    const Source* source;
    const char *begin, *place, *end;
};

}  // namespace strahl

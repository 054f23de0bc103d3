// The header of a PLY file.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "mesh/source.h"

namespace strahl {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
/// Bytes of a value in a binary file.
std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string_view name;
    PlyType type;                  // of the value, or of a list's entries
    std::optional<PlyType> count;  // of a list's length; a property without one is a single value
};

struct PlyElement {
    std::string_view name;
    std::uint64_t count;
    std::vector<PlyProperty> properties;
};

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyHeader {
    PlyFormat format;
    std::vector<PlyElement> elements;  // each of them fits into the file, if its lists are empty
    std::size_t size;                  // values begin here
};

PlyHeader read_ply_header(const Source& source);

}  // namespace strahl

// Meshes as the bytes of PLY, OBJ and STL files, for tests of their readers.
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "num/decimal.h"
#include "scene/kinds/mesh_data.h"
#include "tests/unit/scratch.h"

namespace strahl {

/// Writes a file, and returns its path.
inline std::string put(const Scratch& folder, const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
}

struct PlyForm {
    std::string format = "ascii", number = "float", index = "int";
};

/// Appends a value of a PLY type, in a format.
inline void put_value(std::string& bytes, double value, const std::string& type, const std::string& format) {
    if (format == "ascii") {
        bytes += text_of(value) + " ";
        return;
    }
    const auto add = [&](auto v) {
        std::array<char, sizeof v> raw;
        std::memcpy(raw.data(), &v, sizeof v);
        if ((format == "binary_big_endian") == (std::endian::native == std::endian::little))
            for (std::size_t i = sizeof v; i-- > 0;) bytes += raw[i];
        else
            bytes.append(raw.data(), sizeof v);
    };
    if (type == "double") add(value);
    if (type == "float") add(static_cast<float>(value));
    if (type == "int") add(static_cast<std::int32_t>(value));
    if (type == "uint32") add(static_cast<std::uint32_t>(value));
    if (type == "ushort") add(static_cast<std::uint16_t>(value));
    if (type == "uchar") add(static_cast<std::uint8_t>(value));
    if (type == "int8") add(static_cast<std::int8_t>(value));
}

/// If it is smooth, each point must have one normal.
inline std::string ply_of(const MeshData& mesh, const PlyForm& form) {
    const auto line_end = [&](std::string& text) { text += form.format == "ascii" ? "\n" : ""; };
    std::string bytes = "ply\nformat " + form.format + " 1.0\nelement vertex " + std::to_string(mesh.points.size());
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
        if (name[0] != 'n' || !mesh.normals.empty()) bytes += "\nproperty " + form.number + " " + name;
    bytes += "\nelement face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar " + form.index +
             " vertex_indices\nend_header\n";
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        for (int c = 0; c < 3; ++c) put_value(bytes, mesh.points[i][c], form.number, form.format);
        for (int c = 0; c < 3 && !mesh.normals.empty(); ++c)
            put_value(bytes, mesh.normals[i][c], form.number, form.format);
        line_end(bytes);
    }
    for (const MeshData::Corners& corners : mesh.triangles) {
        put_value(bytes, 3, "uchar", form.format);
        for (const std::int32_t corner : corners) put_value(bytes, corner, form.index, form.format);
        line_end(bytes);
    }
    return bytes;
}

inline std::string obj_of(const MeshData& mesh) {
    std::string text;
    const auto vectors = [&](const char* keyword, const std::vector<DVec3>& all) {
        for (const DVec3& v : all)
            text += std::string(keyword) + " " + text_of(v.x) + " " + text_of(v.y) + " " + text_of(v.z) + "\n";
    };
    vectors("v", mesh.points);
    vectors("vn", mesh.normals);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        text += "f";
        for (int c = 0; c < 3; ++c) {
            text.append(" ").append(std::to_string(mesh.triangles[i][c] + 1));
            if (!mesh.corner_normals.empty()) text.append("//").append(std::to_string(mesh.corner_normals[i][c] + 1));
        }
        text += "\n";
    }
    return text;
}

inline std::string binary_stl(const std::vector<std::array<DVec3, 3>>& triangles) {
    std::string bytes(80, ' ');
    put_value(bytes, static_cast<double>(triangles.size()), "int", "binary_little_endian");
    for (const auto& corners : triangles) {
        bytes.append(12, '\0');
        for (const DVec3& p : corners)
            for (int c = 0; c < 3; ++c) put_value(bytes, p[c], "float", "binary_little_endian");
        bytes.append(2, '\0');
    }
    return bytes;
}

inline std::string ascii_stl(const std::vector<std::array<DVec3, 3>>& triangles) {
    std::string text = "solid facet of a name\n";
    for (const auto& corners : triangles) {
        text += "  facet normal 0 0 nan\n    outer loop\n";
        for (const DVec3& p : corners)
            text += "      vertex " + text_of(p.x) + " " + text_of(p.y) + (p.z == 0 && std::signbit(p.z) ? " -" : " ") +
                    text_of(p.z) + "\n";
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid\n";
}

/// A closed mesh of 2 * n * m triangles, with coordinates that floats can say.
inline MeshData large_torus(int n, int m) {
    MeshData mesh;
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            const double a = 6.283185307179586 * i / n, b = 6.283185307179586 * j / m, r = 3 + std::cos(a);
            mesh.points.push_back({float(r * std::cos(b)), float(r * std::sin(b)), float(std::sin(a))});
        }
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            const int k = (i + 1) % n, l = (j + 1) % m;
            mesh.triangles.push_back({j * n + i, j * n + k, l * n + k});
            mesh.triangles.push_back({j * n + i, l * n + k, l * n + i});
        }
    return mesh;
}

}  // namespace strahl

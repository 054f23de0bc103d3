// glTF files with one triangle, for tests of their reader.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <string>

namespace strahl::importing {

template <class V>
std::string bytes_of(std::initializer_list<V> values) {
    std::string bytes;
    for (const V value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    return bytes;
}

/// Data as a URI.
inline std::string uri_of(const std::string& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text = "data:application/octet-stream;base64,";
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
    }
    return text;
}

/// The points of a triangle, normalised bytes as places, and its corners in reverse.
inline const std::string data = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                                bytes_of<std::uint8_t>({0, 0, 255, 0, 0, 255, 0, 0}) +
                                bytes_of<std::uint16_t>({2, 1, 0, 0});

/// A file with this triangle. `nodes` are those of the scene, `more` members at the top.
inline std::string triangle(
    const std::string& nodes = R"({"mesh": 0})", const std::string& more = "",
    const std::string& primitive = R"("attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2)") {
    return R"({"asset": {"version": "2.0"}, "nodes": [)" + nodes + R"(], "meshes": [{"name": "tri", "primitives": [{)" +
           primitive + R"(}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
 {"bufferView": 0, "byteOffset": 36, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC2"},
 {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteLength": 44}, {"buffer": 0, "byteOffset": 44, "byteLength": 8}],
"buffers": [{"byteLength": 52, "uri": ")" +
           uri_of(data) + "\"}]" + (more.empty() ? "" : ",\n" + more) + "}";
}

/// A .glb of a text and the binary part.
inline std::string glb(std::string text, const std::string& binary, std::uint32_t version = 2) {
    while (text.size() % 4 != 0) text += ' ';
    const auto size = static_cast<std::uint32_t>(text.size()), rest = static_cast<std::uint32_t>(binary.size());
    return "glTF" + bytes_of<std::uint32_t>({version, 28 + size + rest, size}) + "JSON" + text +
           bytes_of<std::uint32_t>({rest}) + std::string("BIN\0", 4) + binary;
}

}  // namespace strahl::importing

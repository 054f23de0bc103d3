// The contents of a glTF file: its JSON text with checked access, and the numbers that it describes.
//
// The JSON library is the one that the language server uses. tinygltf (libtinygltf-dev) reads by it, too; what it adds
// are decoders of pictures without limits and a copy of each field, while sparse, normalised and quantized accessors
// are left to its user. cgltf and fastgltf are not in Debian 12.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "num/vec.h"

namespace strahl {

/// A value of the JSON text, or none, that knows where it stands: "meshes[2].primitives[0]".
class GltfValue {
  public:
    GltfValue(const nlohmann::ordered_json* value, std::string place, const std::string& path)
        : value(value), place_(std::move(place)), path(&path) {}

    explicit operator bool() const { return value != nullptr; }
    /// A member of an object; none if it is absent or this is none.
    GltfValue operator[](const char* key) const;
    /// An entry of a list. Fails if there is none.
    GltfValue at(std::size_t index) const;
    /// The number of entries of a list; 0 if this is none.
    std::size_t size() const;
    double number(double absent) const;
    bool truth(bool absent) const;
    std::string text(const std::string& absent = "") const;
    /// A whole number from 0 to below `limit`; -1 if this is none.
    std::int64_t index(std::size_t limit) const;
    /// A whole number from 0 to `most`.
    std::uint64_t count(std::uint64_t absent, std::uint64_t most = std::uint64_t(1) << 40) const;
    /// Returns the first numbers of a list; where it is too short, those of `absent`.
    template <int size, class Vector>
    Vector numbers(Vector absent) const {
        for (int i = 0; i < size && std::size_t(i) < this->size(); ++i) absent[i] = at(std::size_t(i)).number(0);
        return absent;
    }
    /// The members' names of an object.
    std::vector<std::string> keys() const;

    const std::string& place() const { return place_; }
    [[noreturn]] void fail(const std::string& message) const;

  private:
    const nlohmann::ordered_json* value;
    std::string place_;
    const std::string* path;
};

/// Numbers of an accessor: `width` for each of `count` elements.
struct GltfNumbers {
    std::size_t count = 0, width = 1;
    std::vector<double> values;
    double operator()(std::size_t i, std::size_t k) const { return values[width * i + k]; }
    DVec3 vector(std::size_t i) const { return {(*this)(i, 0), (*this)(i, 1), (*this)(i, 2)}; }
};

class GltfFile {
  public:
    /// Reads .gltf or .glb. Throws FileError.
    explicit GltfFile(const std::string& path);
    ~GltfFile();
    GltfFile(const GltfFile&) = delete;
    GltfFile& operator=(const GltfFile&) = delete;

    GltfValue root() const;
    /// An entry of a list at the top, such as "meshes", by an index that stands in the file.
    GltfValue entry(const char* list, const GltfValue& index) const;
    GltfValue entry(const char* list, std::size_t index) const { return root()[list].at(index); }
    /// Reads the numbers of an accessor, which must have so many for each element; normalised ones are from -1 to 1.
    GltfNumbers numbers(const GltfValue& index, std::size_t width);
    /// The bytes of a buffer view.
    std::string_view view(const GltfValue& index);
    /// The bytes of a data URI.
    static bool is_data(std::string_view uri) { return uri.starts_with("data:"); }
    static std::string decoded_data(const std::string& uri, const GltfValue& where);
    /// The name of a file that a URI gives, relative to the model.
    static std::string file_name(const std::string& uri, const GltfValue& where);

    const std::string path;
    std::vector<std::string> files;  // files that were read, this one first

  private:
    std::string_view buffer(std::size_t index);

    std::unique_ptr<nlohmann::ordered_json> json;
    std::string bytes;           // of the file
    std::string_view own_bytes;  // the binary part of a .glb
    std::map<std::size_t, std::string> buffers;
    std::uint64_t bytes_read = 0, numbers_read = 0;
};

}  // namespace strahl

#include "import/models/gltf_file.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "files/bytes.h"
#include "files/error.h"
#include "files/regular_file.h"
#include "files/utf8.h"
#include "files/words.h"

namespace strahl {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t most_text = 128 << 20;                // bytes of JSON
constexpr std::uint64_t most_bytes = std::uint64_t(4) << 30;  // of the file, and of all buffers together
constexpr std::uint64_t most_numbers = 1'000'000'000;         // that are read, those of accessors used twice each time
constexpr std::uint64_t most_elements = 60'000'000;           // of an accessor

std::string whole_file(const std::string& path, std::uint64_t most) {
    const RegularFile file(path);
    if (file.size() > most)
        throw FileError("'" + path + "' is larger than " + std::to_string(most) + " bytes; simplify the model");
    return file.bytes(0, file.size());
}

}  // namespace

void GltfValue::fail(const std::string& message) const { throw FileError(*path + ": " + place_ + ": " + message); }

GltfValue GltfValue::operator[](const char* key) const {
    const std::string inner = place_.empty() ? key : place_ + "." + key;
    if (!value) return {nullptr, inner, *path};
    if (!value->is_object()) fail("should be an object");
    const auto found = value->find(key);
    return {found == value->end() ? nullptr : &*found, inner, *path};
}

GltfValue GltfValue::at(std::size_t index) const {
    if (index >= size()) fail("has no entry " + std::to_string(index));
    return {&(*value)[index], place_ + "[" + std::to_string(index) + "]", *path};
}

std::size_t GltfValue::size() const {
    if (!value) return 0;
    if (!value->is_array()) fail("should be a list");
    return value->size();
}

double GltfValue::number(double absent) const {
    if (!value) return absent;
    if (!value->is_number()) fail("should be a number");
    const double number = value->get<double>();
    if (!(std::abs(number) <= 1e30)) fail("is too large");
    return number;
}

bool GltfValue::truth(bool absent) const {
    if (!value) return absent;
    if (!value->is_boolean()) fail("should be true or false");
    return value->get<bool>();
}

std::string GltfValue::text(const std::string& absent) const {
    if (!value) return absent;
    if (!value->is_string()) fail("should be a text");
    return value->get<std::string>();
}

std::uint64_t GltfValue::count(std::uint64_t absent, std::uint64_t most) const {
    if (!value) return absent;
    const double own = number(0);
    if (own != std::floor(own) || own < 0 || own > double(most))
        fail("should be a whole number from 0 to " + std::to_string(most));
    return static_cast<std::uint64_t>(own);
}

std::int64_t GltfValue::index(std::size_t limit) const {
    if (!value) return -1;
    const std::uint64_t own = count(0);
    if (own >= limit) fail("is " + std::to_string(own) + ", but there are only " + std::to_string(limit));
    return static_cast<std::int64_t>(own);
}

std::vector<std::string> GltfValue::keys() const {
    std::vector<std::string> keys;
    if (!value) return keys;
    if (!value->is_object()) fail("should be an object");
    for (const auto& [key, member] : value->items()) keys.push_back(key);
    return keys;
}

GltfFile::GltfFile(const std::string& own_path) : path(own_path), files{own_path} {
    bytes = whole_file(path, most_bytes);
    const auto fail = [&](const std::string& message) { throw FileError(path + ": " + message); };
    std::string_view text = bytes;
    std::size_t text_at = 0;
    if (text.starts_with("glTF")) {
        const auto number = [&](std::size_t at) {
            if (at + 4 > bytes.size()) fail("the file ends in the head of a part; it was cut off, so get a new copy");
            return std::uint64_t(get_little<std::uint32_t>(bytes, at));
        };
        if (number(4) != 2) fail("this is version " + std::to_string(number(4)) + " of glTF; only 2 is read");
        const auto part = [&](std::size_t at) {
            const std::uint64_t size = number(at);
            if (size > bytes.size() - at - 8)
                fail("a part of " + std::to_string(size) + " bytes at byte " + std::to_string(at) +
                     " is longer than the file; it was cut off, so get a new copy");
            return std::string_view(bytes).substr(at + 8, size);
        };
        number(16);
        if (number(16) != 0x4E4F534A) fail("its first part should be JSON");
        text = part(12), text_at = 20;
        const std::size_t next = 20 + (text.size() + 3) / 4 * 4;
        if (next + 8 <= bytes.size() && number(next + 4) == 0x004E4942) own_bytes = part(next);
    }
    if (text.size() > most_text) fail("it has more than 128 MiB of JSON");
    if (text.starts_with(byte_order_mark)) text.remove_prefix(3);
    try {
        json = std::make_unique<Json>(Json::parse(text));
    } catch (const Json::parse_error& error) {
        std::string why = error.what();
        const std::size_t from = why.find("syntax error");
        if (from != why.npos) why.erase(0, from);
        const std::size_t at = std::min<std::size_t>(error.byte, text.size());
        throw FileError(path + ":" +
                        (text_at > 0 ? " in its JSON, byte " + std::to_string(at)
                                     : std::to_string(line_number(text, at > 0 ? at - 1 : 0))) +
                        ": " + printable(why.substr(0, 300)));
    } catch (const Json::exception& error) {
        fail(printable(error.what()));
    }
    if (!json->is_object()) fail("this is no glTF: its text should be an object");
    const std::string version = root()["asset"]["version"].text();
    if (!version.starts_with("2")) fail("this is no glTF 2: asset.version is " + strahl::quoted(version));
}

GltfFile::~GltfFile() = default;

GltfValue GltfFile::root() const { return {json.get(), "", path}; }

GltfValue GltfFile::entry(const char* list, const GltfValue& index) const {
    const GltfValue all = root()[list];
    if (!index) index.fail("is missing");
    return all.at(static_cast<std::size_t>(index.index(all.size())));
}

std::string GltfFile::decoded_data(const std::string& uri, const GltfValue& where) {
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos || uri.substr(0, comma).find(";base64") == uri.npos) where.fail("its data are not base64");
    std::string data;
    data.reserve((uri.size() - comma) / 4 * 3);
    std::uint32_t held = 0;
    int bits = 0;
    for (std::size_t i = comma + 1; i < uri.size() && uri[i] != '='; ++i) {
        static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        if (is_space(uri[i])) continue;
        const std::size_t digit = digits.find(uri[i]);
        if (digit == digits.npos) where.fail("its data are not base64: character " + std::to_string(i));
        held = held << 6 | static_cast<std::uint32_t>(digit), bits += 6;
        if (bits >= 8) bits -= 8, data.push_back(static_cast<char>(held >> bits & 255));
    }
    return data;
}

std::string GltfFile::file_name(const std::string& uri, const GltfValue& where) {
    const std::size_t colon = uri.find(':');
    if (colon != uri.npos && uri.substr(colon, 3) == "://") where.fail("only files are read, no addresses");
    std::string name;
    const auto digit = [](char c) {
        return is_digit(c) ? c - '0' : lower(c) >= 'a' && lower(c) <= 'f' ? lower(c) - 'a' + 10 : -1;
    };
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool coded = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
        name.push_back(coded ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i]);
        if (coded) i += 2;
    }
    if (name.empty() || name.find('\0') != name.npos) where.fail("names no file");
    return name;
}

std::string_view GltfFile::buffer(std::size_t index) {
    const GltfValue own = entry("buffers", index);
    const std::uint64_t size = own["byteLength"].count(0);
    const GltfValue uri = own["uri"];
    std::string_view data;
    if (!uri) {
        if (index != 0 || own_bytes.empty()) own.fail("has no data");
        data = own_bytes;
    } else if (const auto known = buffers.find(index); known != buffers.end()) {
        data = known->second;
    } else {
        std::string read;
        const std::string text = uri.text();
        if (is_data(text)) {
            read = decoded_data(text, uri);
        } else {
            files.push_back((std::filesystem::path(path).parent_path() / file_name(text, uri)).string());
            read = whole_file(files.back(), most_bytes - bytes_read);
        }
        bytes_read += read.size();
        data = buffers[index] = std::move(read);
    }
    if (data.size() < size)
        own.fail("should have " + std::to_string(size) + " bytes and has " + std::to_string(data.size()));
    return data.substr(0, size);
}

std::string_view GltfFile::view(const GltfValue& index) {
    const GltfValue own = entry("bufferViews", index);
    if (own["extensions"]["EXT_meshopt_compression"]) own.fail("meshopt compression is not read; save it without");
    const GltfValue number = own["buffer"];
    if (!number) number.fail("is missing");
    const std::string_view data = buffer(static_cast<std::size_t>(number.index(root()["buffers"].size())));
    const std::uint64_t offset = own["byteOffset"].count(0), size = own["byteLength"].count(0);
    if (offset > data.size() || size > data.size() - offset)
        own.fail("reaches beyond its buffer of " + std::to_string(data.size()) + " bytes");
    return data.substr(offset, size);
}

namespace {

/// The type of a number in a buffer.
struct GltfType {
    std::size_t size;
    void (*read)(const char* at, std::size_t count, double* to);  // reads numbers one after the other
    double most;                                                  // the value that is 1 where numbers are normalised
};
template <class V>
void read_as(const char* at, std::size_t count, double* to) {
    for (std::size_t i = 0; i < count; ++i, at += sizeof(V)) {
        V v;
        std::memcpy(&v, at, sizeof v);
        to[i] = static_cast<double>(v);
    }
}
GltfType type_of(const GltfValue& code) {
    static_assert(std::endian::native == std::endian::little);
    switch (code.count(0)) {
        case 5120:
            return {1, read_as<std::int8_t>, 127};
        case 5121:
            return {1, read_as<std::uint8_t>, 255};
        case 5122:
            return {2, read_as<std::int16_t>, 32767};
        case 5123:
            return {2, read_as<std::uint16_t>, 65535};
        case 5125:
            return {4, read_as<std::uint32_t>, 4294967295.};
        case 5126:
            return {4, read_as<float>, 1};
        default:
            code.fail("is not a type of numbers");
    }
}

std::size_t width_of(const GltfValue& type) {
    const std::string name = type.text();
    constexpr std::pair<std::string_view, std::size_t> widths[]{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                                {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    for (const auto& [word, width] : widths)
        if (word == name) return width;
    type.fail("is not a type of elements");
}

/// Fails if elements reach beyond a view.
void check_room(const GltfValue& where, std::string_view view, std::uint64_t offset, std::uint64_t stride,
                std::uint64_t size, std::uint64_t count) {
    if (count > 0 && (offset > view.size() || size > view.size() - offset ||
                      (stride > 0 && count - 1 > (view.size() - offset - size) / stride)))
        where.fail(std::to_string(count) + " elements reach beyond their view of " + std::to_string(view.size()) +
                   " bytes");
}

}  // namespace

GltfNumbers GltfFile::numbers(const GltfValue& index, std::size_t width) {
    const GltfValue own = entry("accessors", index);
    const GltfType type = type_of(own["componentType"]);
    GltfNumbers result{static_cast<std::size_t>(own["count"].count(0, most_elements)), width_of(own["type"]), {}};
    const bool colors = width == 3 && result.width == 4;  // of colours with an alpha channel the first three are read
    if (result.width != width && !colors)
        own.fail("has elements of " + std::to_string(result.width) + " numbers; here are needed " +
                 std::to_string(width));
    const double factor = own["normalized"].truth(false) ? 1 / type.most : 1;
    if ((numbers_read += result.count * result.width) > most_numbers) own.fail("the model has too many numbers");
    const auto put = [&](std::size_t element, const char* at, std::size_t count = 1) {
        double* const to = result.values.data() + element * result.width;
        type.read(at, count * result.width, to);
        if (factor < 1)
            for (std::size_t k = 0; k < count * result.width; ++k) to[k] = std::max(factor * to[k], -1.);
    };
    const std::uint64_t size = type.size * result.width;
    if (const GltfValue number = own["bufferView"]) {
        const std::string_view data = view(number);
        const std::uint64_t offset = own["byteOffset"].count(0),
                            stride = entry("bufferViews", number)["byteStride"].count(size, 1 << 20);
        check_room(own, data, offset, stride, size, result.count);
        result.values.resize(result.count * result.width);
        if (stride == size && result.count > 0)
            put(0, data.data() + offset, result.count);
        else
            for (std::size_t i = 0; i < result.count; ++i) put(i, data.data() + offset + i * stride);
    } else {
        result.values.resize(result.count * result.width);
    }
    if (const GltfValue sparse = own["sparse"]) {
        const std::uint64_t count = sparse["count"].count(0, result.count);
        const GltfValue indices = sparse["indices"], values = sparse["values"];
        const GltfType index_type = type_of(indices["componentType"]);
        const std::string_view places = view(indices["bufferView"]), data = view(values["bufferView"]);
        const std::uint64_t from = indices["byteOffset"].count(0), at = values["byteOffset"].count(0);
        check_room(indices, places, from, index_type.size, index_type.size, count);
        check_room(values, data, at, size, size, count);
        for (std::uint64_t i = 0; i < count; ++i) {
            double element = 0;
            index_type.read(places.data() + from + i * index_type.size, 1, &element);
            if (!(element >= 0 && element < double(result.count)))
                indices.fail("index " + std::to_string(i) + " is beyond the accessor");
            put(static_cast<std::size_t>(element), data.data() + at + i * size);
        }
    }
    return result;
}

}  // namespace strahl

#include "image/band_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <system_error>

#include "files/bytes.h"
#include "files/output_file.h"
#include "files/streams.h"

namespace strahl {
namespace {

constexpr std::string_view magic = "strahl bands 1\n";

/// Before each band stand its number, the sizes of its note and its bytes, and a hash of all these.
constexpr std::size_t start_bytes = 8 + 8 + 8 + 8;

std::uint64_t hash_of(std::string_view text) { return std::hash<std::string_view>()(text); }

/// A band as it stands in the file.
std::string record_of(int band, const EncodedBand& encoded) {
    std::string start;
    for (const std::size_t value : {std::size_t(band), encoded.note.size(), encoded.bytes.size()})
        put_little(start, std::uint64_t(value));
    put_little(start, hash_of(start) ^ hash_of(encoded.note) ^ 3 * hash_of(encoded.bytes));
    return start + encoded.note + encoded.bytes;
}

[[noreturn]] void fail(const std::string& path, int error) {
    throw OutputError("cannot write '" + path + "': " + std::generic_category().message(error));
}

const char* name(Compression compression) { return compression == Compression::small ? "small" : "fast"; }

std::array<std::pair<const char*, std::string>, 8> lines_of(const BandHeader& header) {
    const Layout& layout = header.layout;
    TextStream file, part;
    std::string names, attributes;
    for (const std::string& name : layout.named.names) names += (names.empty() ? "" : " ") + name;
    for (const auto& [name, value] : layout.named.attributes) attributes.append(name).append(" ").append(value) += '\t';
    file << header.ending << ' ' << layout.width << ' ' << layout.height << ' ' << layout.channels << ' ' << layout.bits
         << ' ' << name(header.compression);
    part << header.part << ' ' << header.parts;
    return {{{"program", header.program},
             {"scene", header.scene},
             {"options", header.options},
             {"file", file.str()},
             {"channels", names},
             {"attributes", attributes},
             {"part", part.str()},
             {"", ""}}};
}

}  // namespace

std::string BandHeader::text() const {
    std::string text(magic);
    for (const auto& [key, value] : lines_of(*this)) text.append(key).append(*key ? " " : "").append(value) += '\n';
    return text;
}

std::string BandHeader::difference(const BandHeader& other) const {
    const auto mine = lines_of(*this), theirs = lines_of(other);
    for (std::size_t i = 0; i < mine.size(); ++i)
        if (mine[i].second != theirs[i].second) return mine[i].first;
    return "";
}

bool BandFile::is_at(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false;
    FileStream in(path);
    std::string start(magic.size(), '\0');
    return in.read(start.data(), static_cast<std::streamsize>(start.size())) && start == magic;
}

BandFile::BandFile(const std::string& path) : own_path(path) {
    const auto broken = [&](const char* why) { throw FileError("cannot read '" + path + "': " + why); };
    if (!is_at(path)) broken("it is not a file of bands written by strahl");
    FileStream in(path);
    std::string line, compression;
    BandHeader& h = own_header;
    for (std::getline(in, line); std::getline(in, line) && !line.empty();) {
        const std::size_t space = line.find(' ');
        const std::string key = line.substr(0, space), value = space == line.npos ? "" : line.substr(space + 1);
        WordStream words(value);
        if (key == "program") h.program = value;
        if (key == "scene") h.scene = value;
        if (key == "options") h.options = value;
        if (key == "file")
            words >> h.ending >> h.layout.width >> h.layout.height >> h.layout.channels >> h.layout.bits >> compression;
        if (key == "channels")
            for (std::string name; words >> name;) h.layout.named.names.push_back(name);
        for (std::size_t at = 0, tab; key == "attributes" && (tab = value.find('\t', at)) != value.npos; at = tab + 1) {
            const std::string own = value.substr(at, tab - at);
            const std::size_t blank = std::min(own.find(' '), own.size() - 1);
            h.layout.named.attributes.emplace_back(own.substr(0, blank), own.substr(blank + 1));
        }
        if (key == "part") words >> h.part >> h.parts;
    }
    h.compression = compression == "small" ? Compression::small : Compression::fast;
    if (!in || h.layout.width < 1 || h.layout.height < 1 || h.layout.channels < 1 ||
        h.layout.channels > std::max(4, static_cast<int>(h.layout.named.names.size())) || h.part < 1 ||
        h.parts < h.part || format_fault(h.ending, h.layout.bits) != "")
        broken("its first lines are damaged");
    end = static_cast<std::uint64_t>(in.tellg());
    const std::uint64_t size = std::filesystem::file_size(path);
    while (size - end >= start_bytes) {
        std::string start(start_bytes, '\0');
        in.seekg(static_cast<std::streamoff>(end));
        if (!in.read(start.data(), start_bytes)) break;
        const auto number = [&](std::size_t i) { return get_little<std::uint64_t>(start, 8 * i); };
        const std::uint64_t band = number(0), note_size = number(1), bytes_size = number(2);
        const std::uint64_t left = size - end - start_bytes;
        if (note_size > left || bytes_size > left - note_size || band > 1'000'000) break;
        EncodedBand encoded{std::string(bytes_size, '\0'), std::string(note_size, '\0')};
        in.read(encoded.note.data(), static_cast<std::streamsize>(note_size));
        in.read(encoded.bytes.data(), static_cast<std::streamsize>(bytes_size));
        if (!in || !record_of(static_cast<int>(band), encoded).starts_with(start)) break;
        records[static_cast<int>(band)] = {end + start_bytes + note_size, bytes_size, encoded.note};
        end += start_bytes + note_size + bytes_size;
    }
}

BandFile::BandFile(const std::string& path, const BandHeader& header) : own_path(path), own_header(header) {
    const std::string text = header.text();
    write_file(path, text);
    end = text.size();
    open_to_append();
}

std::string BandFile::bytes(int band) const {
    const Record& record = records.at(band);
    std::string bytes(record.size, '\0');
    FileStream in(own_path);
    in.seekg(static_cast<std::streamoff>(record.at));
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        throw FileError("cannot read '" + own_path + "': it has changed since it was opened");
    return bytes;
}

void BandFile::open_to_append() {
    if (file) return;
    file = os::OpenFile(own_path, os::OpenFile::OpenMode::overwrite);
    if (!file) fail(own_path, errno);
    if (file.lock() == EWOULDBLOCK)
        throw OutputError("'" + own_path + "' is being written by another strahl; wait for that to end");
    if (const int error = file.cut(end)) fail(own_path, error);
}

void BandFile::append(int band, const EncodedBand& encoded) {
    const std::string record = record_of(band, encoded);
    if (const int error = file.append(record)) fail(own_path, error);
    records[band] = {end + record.size() - encoded.bytes.size(), encoded.bytes.size(), encoded.note};
    end += record.size();
}

void BandFile::sync() {
    if (const int error = file.sync()) fail(own_path, error);
}

void BandFile::rename(const std::string& path) {
    int error = os::rename(own_path, path);
    if (!error) error = os::sync_folder(std::filesystem::path(path).parent_path());
    if (error) fail(path, error);
    own_path = path;
}

}  // namespace strahl

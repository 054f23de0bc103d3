#include "main/lsp/protocol.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <istream>
#include <ostream>
#include <string_view>

#include "files/error.h"
#include "files/words.h"

namespace strahl {
namespace {

constexpr const char* no_length =
    "standard input is not a message of an editor: 'Content-Length: N' expected, with N at most 268435456";
constexpr std::size_t most_bytes = std::size_t(256) << 20, longest_header = 4096;

/// Reads a line of a header without its end. Returns whether there was one.
bool read_line(std::istream& in, std::string& line) {
    line.clear();
    for (int c; (c = in.get()) != std::istream::traits_type::eof();) {
        if (c == '\n') return !line.empty() && line.back() == '\r' ? (line.pop_back(), true) : true;
        line += static_cast<char>(c);
        if (line.size() > longest_header) break;
    }
    if (line.empty()) return false;
    throw FileError(no_length);
}

}  // namespace

std::optional<std::string> read_frame(std::istream& in) {
    std::optional<std::size_t> length;
    std::string line;
    bool any = false;
    for (; read_line(in, line) && !line.empty(); any = true) {
        constexpr std::string_view name = "content-length:";
        if (!same_word(std::string_view(line).substr(0, name.size()), name)) continue;
        const char* const end = line.data() + line.size();
        const char* const digits = std::find_if_not<const char*>(line.data() + name.size(), end, is_space);
        std::size_t number = 0;
        const auto [stop, error] = std::from_chars(digits, end, number);
        if (error == std::errc() && stop == end && number <= most_bytes) length = number;
    }
    if (!any && !in) return {};
    if (!length) throw FileError(no_length);
    std::string content;
    while (content.size() < *length) {  // no more memory than bytes have come
        const std::size_t before = content.size();
        content.resize(std::min(*length, before + (1 << 16)));
        in.read(content.data() + before, static_cast<std::streamsize>(content.size() - before));
        if (!in) throw FileError("standard input ends in a message of the editor");
    }
    return content;
}

void write_frame(std::ostream& out, const std::string& content) {
    out << "Content-Length: " << content.size() << "\r\n\r\n" << content << std::flush;
    if (!out) throw OutputError("cannot write to the editor on 'standard output'");
}

std::string path_of_uri(const std::string& uri) {
    constexpr std::string_view scheme = "file://";
    const std::size_t start = uri.starts_with(scheme) ? uri.find('/', scheme.size()) : uri.npos;
    if (start == uri.npos) return uri;
    std::string path;
    for (std::size_t i = start; i < uri.size(); ++i) {
        unsigned char byte = 0;
        const char* const digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2)
            path += static_cast<char>(byte), i += 2;
        else
            path += uri[i];
    }
    // On Windows the path of file:///C:/a.rt begins with the drive.
    if (std::filesystem::path(path.substr(1)).has_root_name()) path.erase(0, 1);
    return path;
}

std::string uri_of_path(const std::string& path) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string uri = "file://";
    std::string whole = std::filesystem::absolute(path).lexically_normal().generic_string();
    if (!whole.starts_with('/')) whole.insert(0, 1, '/');
    for (const char c : whole) {
        const auto byte = static_cast<unsigned char>(c);
        if (plain.find(c) != plain.npos)
            uri += c;
        else
            (uri += '%').append({digits[byte / 16], digits[byte % 16]});
    }
    return uri;
}

}  // namespace strahl

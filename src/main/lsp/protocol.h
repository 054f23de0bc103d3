// The Language Server Protocol's frames, JSON behind a header with its length in bytes, and its names of files.
#pragma once
#include <iosfwd>
#include <optional>
#include <string>

namespace strahl {

/// Reads the content of a message, nothing at the end of the stream. Throws FileError if the header has no length or
/// one above 256 MiB, or if the stream ends in a message.
std::optional<std::string> read_frame(std::istream& in);
/// Throws OutputError.
void write_frame(std::ostream& out, const std::string& content);

/// Returns the path of a file's URI (RFC 8089), "file:///home/me/a%20b.rt". Other URIs, as of texts that are in no file
/// yet, are their own paths.
std::string path_of_uri(const std::string& uri);
std::string uri_of_path(const std::string& path);

}  // namespace strahl

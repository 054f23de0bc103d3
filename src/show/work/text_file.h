// Reads and writes the text files of a scene, which keep their line ends and permissions.
#pragma once
#include <set>
#include <string>

namespace strahl {

/// A text whose lines end in line feeds here, whatever ends them in the file.
struct TextOnDisk {
    std::string text;
    bool crlf = false;  // all lines of the file end in a carriage return and a line feed
};
/// Reads a file, or standard input for "-". Throws FileError.
TextOnDisk read_text_file(const std::string& path);
/// Writes a whole file. Throws OutputError.
void write_text_file(const std::string& path, const TextOnDisk& file);
/// Does nothing stand at this path, in a folder that can be searched?
bool is_gone(const std::string& path);

/// Makes FILE~ of FILE, with the same bytes and permissions. Returns its path. Throws FileError.
std::string back_up(const std::string& path);

/// Returns a text in which the names of these files, given relative to the folder of the scene `from`, are those
/// relative to the folder of the scene `to`.
std::string with_names_beside(const std::string& text, const std::string& from, const std::string& to,
                              const std::set<std::string>& files);

}  // namespace strahl

#include "show/work/text_file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "files/output_file.h"
#include "files/read_file.h"
#include "pov/open_scene.h"

namespace strahl {

TextOnDisk read_text_file(const std::string& path) {
    TextOnDisk file{read_scene_text(path)};
    std::string& text = file.text;
    if (text.find('\r') == text.npos) return file;
    std::size_t ends = 0;
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1), ++ends)
        if (at == 0 || text[at - 1] != '\r') return file;  // a text with both stays as it is
    if (std::size_t(std::ranges::count(text, '\r')) != ends) return file;
    std::erase(text, '\r');
    file.crlf = true;
    return file;
}

void write_text_file(const std::string& path, const TextOnDisk& file) {
    if (!file.crlf) return write_file(path, file.text);
    std::string bytes;
    for (const char c : file.text) bytes.append(c == '\n' ? "\r\n" : std::string(1, c));
    write_file(path, bytes);
}

bool is_gone(const std::string& path) {
    std::error_code error;
    return std::filesystem::status(path, error).type() == std::filesystem::file_type::not_found;
}

std::string back_up(const std::string& path) {
    const std::string bytes = read_text(path);
    OutputFile copy(path + "~");
    copy.take_permissions(path);
    copy.append(bytes);
    copy.finish();
    return path + "~";
}

std::string with_names_beside(const std::string& text, const std::string& from, const std::string& to,
                              const std::set<std::string>& files) {
    namespace fs = std::filesystem;
    std::error_code error;
    const auto whole = [&](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path, error), error); };
    const fs::path old_folder = whole(from).parent_path(), new_folder = whole(to).parent_path();
    if (old_folder == new_folder) return text;
    std::set<fs::path> named;
    for (const std::string& file : files) named.insert(whole(file));
    std::string changed;
    std::size_t done = 0;
    for (std::size_t begin = text.find('"'); begin != text.npos; begin = text.find('"', begin + 1)) {
        const std::size_t end = text.find_first_of("\"\n", begin + 1);
        if (end == text.npos) break;
        const fs::path name = text.substr(begin + 1, end - begin - 1), file = whole(old_folder / name);
        if (text[end] == '"' && name.is_relative() && named.contains(file)) {
            changed.append(text, done, begin + 1 - done).append(file.lexically_proximate(new_folder).generic_string());
            done = end;
        }
        begin = end;
    }
    return changed.append(text, done);
}

}  // namespace strahl

#include "files/read_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "files/error.h"

namespace strahl {

std::string read_text(const std::string& path, std::size_t limit) {
    const auto fail = [&](int error) -> void {
        const std::string name = path == "-" ? "standard input" : "'" + path + "'";
        throw FileError("cannot read " + name + ": " + std::strerror(error));
    };
    const auto close = [](std::FILE* file) {
        if (file != stdin) std::fclose(file);
    };
    const std::unique_ptr<std::FILE, decltype(close)> file(path == "-" ? stdin : std::fopen(path.c_str(), "rb"), close);
    if (!file) fail(errno);
    std::string text;
    std::vector<char> part(1 << 20);
    while (const std::size_t count = std::fread(part.data(), 1, part.size(), file.get())) {
        text.append(part.data(), count);
        if (text.size() > limit)
            throw FileError("'" + path + "' is larger than " + std::to_string(limit) + " bytes; is it a scene file?");
    }
    if (std::ferror(file.get())) fail(errno);
    return text;
}

}  // namespace strahl

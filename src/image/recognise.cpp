// Formats by their first bytes. Lengths in headers are held against the length of the file, because the libraries
// allocate what a header says before they find that it is not there.
#include "image/recognise.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>

#include "image/netpbm.h"

namespace strahl {
namespace {

/// A file that is read here and there.
class File {
  public:
    explicit File(const std::string& path)
        : file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)), failure(errno) {
        if (file >= 0) ::fstat(file, &status);
    }
    ~File() {
        if (file >= 0) ::close(file);
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    bool opened() const { return file >= 0; }
    int error() const { return failure; }
    mode_t mode() const { return status.st_mode; }
    std::uint64_t size() const { return static_cast<std::uint64_t>(status.st_size); }
    /// Up to `count` bytes.
    std::string bytes(std::uint64_t at, std::size_t count) const {
        std::string part(count, '\0');
        const ssize_t got = at < size() ? ::pread(file, part.data(), count, static_cast<off_t>(at)) : 0;
        part.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
        return part;
    }

  private:
    int file, failure;
    struct stat status {};
};

/// The header of a .bmp, but for the oldest, which has no run lengths.
struct BmpHeader {
    std::int32_t length = 0, width = 0, height = 0;
    std::uint16_t bits = 0;
    std::uint32_t compression = 0;

    explicit BmpHeader(std::string_view start) {
        const auto get = [&](auto& value, std::size_t at) {
            if (start.size() >= at + sizeof value) std::memcpy(&value, &start[at], sizeof value);
        };
        get(length, 14);
        if (length != 12) get(width, 18), get(height, 22), get(bits, 28), get(compression, 30);
    }
    std::uint64_t pixels() const {
        return std::uint64_t(std::abs(std::int64_t(width))) * std::uint64_t(std::abs(std::int64_t(height)));
    }
    /// Run lengths are of 8 or 4 bits; OpenImageIO unpacks them to that and then reads as many bits as `bits` says.
    bool consistent() const { return (compression != 1 || bits == 8) && (compression != 2 || bits == 4); }
};

/// Do the chunks of a .png lie inside the file, up to its end or to the first that is cut off?
bool png_chunks_fit(const File& file) {
    for (std::uint64_t at = 8; at + 8 <= file.size();) {
        const std::string head = file.bytes(at, 8);
        if (head.size() < 8 || head.ends_with("IDAT") || head.ends_with("IEND")) return true;
        std::uint64_t length = 0;
        for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(head[i]);
        at += 12 + length;
        if (at > file.size()) return false;
    }
    return true;
}

/// Do the attributes of an .exr, of its first part if it has several, lie inside the file?
bool exr_attributes_fit(const File& file) {
    constexpr std::size_t most_text = 256;  // a name or a type, with the 0 at its end
    for (std::uint64_t at = 8; at < file.size();) {
        const std::string head = file.bytes(at, 2 * most_text + 4);
        const std::size_t name = head.find('\0'), type = head.find('\0', name + 1);
        if (name == 0 || type == head.npos || head.size() < type + 5) return true;
        std::int32_t length;
        std::memcpy(&length, &head[type + 1], sizeof length);
        if (length < 0) return false;
        at += type + 5 + static_cast<std::uint64_t>(length);
        if (at > file.size()) return false;
    }
    return true;
}

}  // namespace

Recognised recognised(const std::string& path) {
    const auto fail = [&](const std::string& why) { throw FileError("cannot read '" + path + "': " + why); };
    const File file(path);
    if (!file.opened())
        fail(file.error() == ENOENT ? "there is no such file" : std::generic_category().message(file.error()));
    if (S_ISDIR(file.mode())) fail("it is a folder");
    if (!S_ISREG(file.mode())) fail("it is no regular file");
    const std::string start = file.bytes(0, 34);
    const std::string pieces = "its header speaks of more than is in the file";
    if (start.starts_with("BM")) {
        const std::uint64_t most = file.size() << 9;  // run lengths make 255 of two bytes, a palette three of each
        // OpenImageIO unpacks run lengths while it opens the file, before it could be asked.
        const BmpHeader header(start);
        if (header.pixels() > most) fail("it promises more pixels than fit into such a file");
        if (!header.consistent()) fail("its run lengths are not of as many bits as its pixels");
        return {"bmp", most};
    }
    const std::uint64_t most = file.size() << 15;  // deflate makes 1032 of one byte, a palette 24 values of each
    if (start.starts_with("\x89PNG\r\n\x1a\n")) {
        if (!png_chunks_fit(file)) fail(pieces);
        return {"png", most};
    }
    if (start.starts_with("\x76\x2f\x31\x01")) {
        if (!exr_attributes_fit(file)) fail(pieces);
        return {"openexr", most};
    }
    if (is_netpbm(start)) return {"netpbm", file.size()};
    throw FileError("cannot read '" + path + "' as a picture: it is no .bmp, .png, .exr, .ppm or .pfm file");
}

}  // namespace strahl

// Recognises formats by their first bytes. Lengths in headers are compared with the length of the file, because the
// libraries allocate what a header says before they find that it is not there.
#include "image/recognise.h"

#include <array>
#include <string_view>

#include "image/uncompressed.h"

namespace strahl {
namespace {

/// Do the chunks of a .png lie inside the file, up to its pixels or its end?
bool png_chunks_fit(const RegularFile& file) {
    for (std::uint64_t at = 8; at + 8 <= file.size();) {
        const std::string head = file.bytes(at, 8);
        if (head.size() < 8 || head.ends_with("IDAT") || head.ends_with("IEND")) return true;
        at += 12 + std::uint64_t(get_big<std::uint32_t>(head, 0));
        if (at > file.size()) return false;
    }
    return true;
}

/// Do the attributes of an .exr, of its first part if it has several, lie inside the file?
bool exr_attributes_fit(const RegularFile& file) {
    constexpr std::size_t most_text = 256;  // a name or a type, with the 0 at its end
    for (std::uint64_t at = 8; at < file.size();) {
        const std::string head = file.bytes(at, 2 * most_text + 4);
        const std::size_t name = head.find('\0'), type = head.find('\0', name + 1);
        if (name == 0 || type == head.npos || head.size() < type + 5) return true;
        const auto length = get_little<std::uint32_t>(head, type + 1);
        if (length > 0x7fff'ffff) return false;
        at += type + 5 + std::uint64_t(length);
        if (at > file.size()) return false;
    }
    return true;
}

}  // namespace

PictureFormat recognised(const RegularFile& file) {
    const auto fail = [&](const std::string& why) { throw FileError("cannot read '" + file.path() + "': " + why); };
    const std::string start = file.bytes(0, BmpHeader::size);
    const std::string pieces = "its header announces more than is in the file";
    if (is_uncompressed(start)) return {nullptr, file.size()};
    if (start.starts_with("BM")) {
        const std::uint64_t most = file.size() << 9;  // run lengths make 255 of two bytes, a palette three of each
        // OpenImageIO unpacks run lengths while it opens the file, before it could be asked for the size.
        const BmpHeader header(start);
        if (header.columns() * header.rows() > most) fail("its header announces more pixels than fit into such a file");
        // Run lengths are of 8 or 4 bits; OpenImageIO unpacks them to that and then reads as many bits as `bits` says.
        if ((header.compression == 1 && header.bits != 8) || (header.compression == 2 && header.bits != 4))
            fail("its run lengths do not have as many bits as its pixels");
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
    if (start.size() > 2 && start[0] == 'P' && start[1] >= '1' && start[1] <= '3')
        throw FileError("'" + file.path() + "' is a plain " +
                        std::array{".pbm", ".pgm", ".ppm"}[static_cast<std::size_t>(start[1] - '1')] +
                        " file, which has its values in decimals; save it in binary form, or as .png");
    throw FileError("'" + file.path() + "' is not a .bmp, .png, .exr, .ppm, .pgm or .pfm file");
}

}  // namespace strahl

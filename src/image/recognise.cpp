// Recognises formats by their first bytes. Lengths in headers are compared with the length of the file, because the
// libraries allocate what a header says before they find that it is not there.
#include "image/recognise.h"

#include <optional>

#include "image/compressed.h"
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

/// Returns the number of values that the frame of a .jpg announces, or none if it has no such header: the segments
/// after the first marker have two bytes of their own length, but for restarts and the like (ISO 10918-1, annex B).
std::optional<std::uint64_t> jpeg_values(const RegularFile& file) {
    for (std::uint64_t at = 2; at + 10 <= file.size();) {
        const std::string head = file.bytes(at, 10);
        const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(head[i]); };
        if (head.size() < 10 || byte(0) != 0xff) return {};
        const unsigned marker = byte(1);
        const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (frame) return std::uint64_t(byte(5) << 8 | byte(6)) * (byte(7) << 8 | byte(8)) * byte(9);
        at += marker == 0xff ? 1 : marker == 0x01 ? 2 : 2 + std::uint64_t(byte(2) << 8 | byte(3));
    }
    return {};
}

}  // namespace

PictureFormat recognised(const RegularFile& file) {
    const auto fail = [&](const std::string& why) { fail_reading(file.path(), why); };
    const std::string start = file.bytes(0, BmpHeader::size);
    const std::string pieces = "its header announces more than is in the file",
                      pixels = "its header announces more pixels than fit into such a file";
    if (is_uncompressed(start)) return {file.size(), read_uncompressed};
    if (start.starts_with("BM")) {
        const std::uint64_t most = file.size() << 9;  // run lengths make 255 of two bytes, a palette three of each
        // OpenImageIO unpacks run lengths while it opens the file, before it could be asked for the size.
        const BmpHeader header(start);
        if (header.columns() * header.rows() > most) fail(pixels);
        // Run lengths are of 8 or 4 bits; OpenImageIO unpacks them to that and then reads as many bits as `bits` says.
        if ((header.compression == 1 && header.bits != 8) || (header.compression == 2 && header.bits != 4))
            fail("its run lengths do not have as many bits as its pixels");
        return {most, nullptr, "bmp"};
    }
    if (start.starts_with("\xff\xd8\xff")) {
        const std::uint64_t most = file.size() << 12;  // a bit for a block of 64 values, up to 16 of which share theirs
        const auto values = jpeg_values(file);
        if (!values) fail("it has no size");
        if (*values > most) fail(pixels);
        return {most, read_jpeg};
    }
    if (start.starts_with("GIF87a") || start.starts_with("GIF89a")) {
        const std::uint64_t most = file.size() << 14;  // 12 bits make up to 4096 pixels, a palette 4 values of each
        const auto side = [&](std::size_t at) { return std::uint64_t(get_little<std::uint16_t>(start, at)); };
        if (start.size() < 10 || 4 * side(6) * side(8) > most) fail(pixels);
        return {most, nullptr, "gif"};
    }
    const std::uint64_t most = file.size() << 15;  // deflate makes 1032 of one byte, a palette 24 values of each
    if (start.starts_with("\x89PNG\r\n\x1a\n")) {
        if (!png_chunks_fit(file)) fail(pieces);
        return {most, read_png};
    }
    if (start.starts_with("\x76\x2f\x31\x01")) {
        if (!exr_attributes_fit(file)) fail(pieces);
        return {most, nullptr, "openexr"};
    }
    // Run lengths make up to 128 pixels of two bytes, a palette 4 values of each.
    if (TargaHeader(start).valid()) return {file.size() << 8, read_uncompressed};
    throw FileError("'" + file.path() + "' is not a .bmp, .png, .exr, .jpg, .gif, .tga, .ppm, .pgm or .pfm file");
}

}  // namespace strahl

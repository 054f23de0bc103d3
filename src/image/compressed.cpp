// Each library decodes a whole picture from the bytes of its file. Memory for the codes is not initialised, so that a
// file whose header promises more than it holds costs little before that is found.
#include "image/compressed.h"

#include <spng.h>
#include <turbojpeg.h>

#include <memory>
#include <string_view>

#include "files/os/memory.h"

namespace strahl {
namespace {

[[noreturn]] void fail(const RegularFile& file, std::string_view why) {
    throw FileError("cannot read '" + file.path() + "' as a picture: " + std::string(why));
}

template <class Code>
struct Codes {
    std::size_t count;
    std::unique_ptr<Code[]> codes = std::make_unique_for_overwrite<Code[]>(count);
    std::size_t bytes() const { return count * sizeof(Code); }
    /// Codes as values from 0 to 1.
    std::vector<double> values() const {
        std::vector<double> result(count);
        for (std::size_t i = 0; i < count; ++i) result[i] = double(codes[i]) / double(Code(-1));
        return result;
    }
};

/// How the pixels of a .png are unpacked: palettes to their colours, a colour that counts as clear to alpha, and less
/// than 8 bits to 8.
struct PngLayout {
    spng_format format = SPNG_FMT_PNG;  // as they are in the file
    int channels, bits;

    PngLayout(const spng_ihdr& header, bool clear_color) : bits(header.bit_depth > 8 ? 16 : 8) {
        const bool grey = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE;
        const bool palette = header.color_type == SPNG_COLOR_TYPE_INDEXED;
        channels = header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA   ? 4
                   : header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ? 2
                                                                          : (grey ? 1 : 3) + clear_color;
        if (clear_color)
            format = grey ? bits == 16 ? SPNG_FMT_GA16 : SPNG_FMT_GA8 : bits == 16 ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
        else if (palette)
            format = SPNG_FMT_RGB8;
        else if (header.bit_depth < 8)
            format = SPNG_FMT_G8;
    }
};

}  // namespace

std::string size_fault(std::uint64_t width, std::uint64_t height, unsigned channels, std::uint64_t most,
                       std::size_t bytes) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height) + " pixels";
    if (width * height > most / channels) return "its " + size + " are more than are read or than fit into such a file";
    const double needed = double(width * height) * channels * double(sizeof(double) + bytes);
    return needed > os::available_memory() ? "there is not enough memory for its " + size : "";
}

// Sizes, palettes and checks: W3C, "Portable Network Graphics (PNG) Specification", chapters 11 and 13.
Picture read_png(const RegularFile& file, std::uint64_t most) {
    const std::string bytes = file.bytes(0, file.size());
    const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(0), &spng_ctx_free);
    const auto check = [&](int error) {
        if (error) fail(file, spng_strerror(error));
    };
    if (!context) throw std::bad_alloc();
    check(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()));
    spng_ihdr header;
    check(spng_get_ihdr(context.get(), &header));
    spng_trns clear;
    const PngLayout layout(header, spng_get_trns(context.get(), &clear) == 0);
    const auto channels = static_cast<unsigned>(layout.channels);
    const std::string fault = size_fault(header.width, header.height, channels, most, unsigned(layout.bits) / 8);
    if (!fault.empty()) fail(file, fault);
    Picture picture{int(header.width), int(header.height), layout.channels, {}, layout.bits};
    const auto decode = [&]<class Code>(Codes<Code> codes) {
        check(spng_decode_image(context.get(), codes.codes.get(), codes.bytes(), layout.format, SPNG_DECODE_TRNS));
        picture.values = codes.values();
    };
    const std::size_t count = std::size_t(header.width) * header.height * channels;
    if (layout.bits == 16)
        decode(Codes<std::uint16_t>{count});
    else
        decode(Codes<std::uint8_t>{count});
    return picture;
}

Picture read_jpeg(const RegularFile& file, std::uint64_t most) {
    const std::string bytes = file.bytes(0, file.size());
    const auto* const coded = reinterpret_cast<const unsigned char*>(bytes.data());
    const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), &tjDestroy);
    if (!decoder) throw std::bad_alloc();
    // Some damage is told and passed over, as all readers do; but where the rest is missing it would become grey.
    const auto check = [&](int failed) {
        if (!failed) return;
        const std::string_view why = tjGetErrorStr2(decoder.get());
        if (tjGetErrorCode(decoder.get()) == TJERR_FATAL || why.find("Premature end") != why.npos) fail(file, why);
    };
    int width = 0, height = 0, sampling = 0, space = 0;
    check(tjDecompressHeader3(decoder.get(), coded, bytes.size(), &width, &height, &sampling, &space));
    const bool inks = space == TJCS_CMYK || space == TJCS_YCCK, grey = space == TJCS_GRAY;
    const unsigned stored = inks ? 4 : grey ? 1 : 3;
    const std::string fault = size_fault(unsigned(width), unsigned(height), stored, most, 1);
    if (!fault.empty()) fail(file, fault);
    Codes<std::uint8_t> codes{std::size_t(width) * unsigned(height) * stored};
    check(tjDecompress2(decoder.get(), coded, bytes.size(), codes.codes.get(), width, 0, height,
                        inks   ? TJPF_CMYK
                        : grey ? TJPF_GRAY
                               : TJPF_RGB,
                        0));
    Picture picture{width, height, inks ? 3 : int(stored), codes.values(), 8};
    if (!inks) return picture;
    // Four inks are stored as what they leave: red is what cyan and black let through.
    const std::size_t pixels = codes.count / 4;
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            picture.values[3 * i + c] = picture.values[4 * i + c] * picture.values[4 * i + 3];
    picture.values.resize(3 * pixels);
    return picture;
}

}  // namespace strahl

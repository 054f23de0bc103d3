// Each library decodes a whole picture from the bytes of its file. Memory for the codes is not initialised, so that a
// file whose header promises more than it holds costs little before that is found.
#include "image/compressed.h"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <memory>
#include <new>
#include <string_view>

#include "image/recognise.h"

namespace strahl {
namespace {

template <class Code>
struct Codes {
    std::size_t count;
    std::unique_ptr<Code[]> codes = std::make_unique_for_overwrite<Code[]>(count);
    /// Codes as values from 0 to 1.
    std::vector<double> values() const {
        std::vector<double> result(count);
        for (std::size_t i = 0; i < count; ++i) result[i] = double(codes[i]) / double(Code(-1));
        return result;
    }
};

/// A .png that is being read. libpng leaves its functions by longjmp, which must not pass over destructors: call them
/// in completes() only.
class PngFile {
  public:
    explicit PngFile(const std::string& bytes) : rest(bytes) {
        if (!png || !info) throw std::bad_alloc();
        png_set_read_fn(png, this, take);
    }
    ~PngFile() { png_destroy_read_struct(&png, &info, nullptr); }
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;

    /// Calls a function that has nothing to destroy. Returns false if libpng left it.
    template <class Work>
    bool completes(Work work) {
        if (setjmp(png_jmpbuf(png))) return false;
        work(png, info);
        return true;
    }
    const std::string& fault() const { return own_fault; }

  private:
    static void take(png_structp png, png_bytep to, std::size_t count) {
        PngFile& own = *static_cast<PngFile*>(png_get_io_ptr(png));
        if (count > own.rest.size()) png_error(png, "it is cut off");
        std::copy_n(own.rest.data(), count, reinterpret_cast<char*>(to));
        own.rest.remove_prefix(count);
    }
    static void fail(png_structp png, const char* why) {
        static_cast<PngFile*>(png_get_error_ptr(png))->own_fault = why;
        png_longjmp(png, 1);
    }
    static void ignore(png_structp, const char*) {}

    std::string_view rest;  // of the file
    std::string own_fault;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
    png_infop info = png_create_info_struct(png);
};

/// Reads the header. Palettes become their colours, a colour that counts as clear alpha, and less than 8 bits 8.
void read_header(png_structp png, png_infop info) {
    png_read_info(png, info);
    png_set_expand(png);
    if (std::endian::native == std::endian::little) png_set_swap(png);  // of 16 bits
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
}

}  // namespace

Picture read_png(const RegularFile& file, std::uint64_t most) {
    const std::string bytes = file.bytes(0, file.size());
    PngFile png(bytes);
    unsigned width = 0, height = 0, channels = 0, bits = 0;
    if (!png.completes([&](png_structp own, png_infop info) {
            read_header(own, info);
            width = png_get_image_width(own, info), height = png_get_image_height(own, info);
            channels = png_get_channels(own, info), bits = png_get_bit_depth(own, info);
        }))
        fail_reading(file.path(), png.fault());
    require_room(file.path(), {width, height, channels, bits / 8}, most);
    Picture picture{int(width), int(height), int(channels), {}, int(bits)};
    const auto decode = [&]<class Code>(Codes<Code> codes) {
        std::vector<png_bytep> rows(height);
        for (std::size_t y = 0; y < height; ++y)
            rows[y] = reinterpret_cast<png_bytep>(&codes.codes[y * width * channels]);
        if (!png.completes([&](png_structp own, png_infop) { png_read_image(own, rows.data()); }))
            fail_reading(file.path(), png.fault());
        picture.values = codes.values();
    };
    const std::size_t count = std::size_t(width) * height * channels;
    if (bits == 16)
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
        if (tjGetErrorCode(decoder.get()) == TJERR_FATAL || why.find("Premature end") != why.npos)
            fail_reading(file.path(), std::string(why));
    };
    int width = 0, height = 0, sampling = 0, space = 0;
    check(tjDecompressHeader3(decoder.get(), coded, bytes.size(), &width, &height, &sampling, &space));
    const bool inks = space == TJCS_CMYK || space == TJCS_YCCK, grey = space == TJCS_GRAY;
    const unsigned stored = inks ? 4 : grey ? 1 : 3;
    require_room(file.path(), {unsigned(width), unsigned(height), stored, 1}, most);
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

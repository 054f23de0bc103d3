// Picture files made of bands: each is encoded by itself, on any thread, and they are put together in order.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "image/picture.h"

namespace strahl {

/// The pixels of a file. Codes are uint8, uint16 or float by `bits`, `channels` per pixel.
struct Layout {
    int width = 0, height = 0, channels = 3, bits = 8;

    std::size_t row_bytes() const { return std::size_t(width) * unsigned(channels) * unsigned(bits / 8); }
};

/// A band is so many rows of the file, the last one what remains: enough that compressing them apart costs 1 % of size,
/// and few enough that the last ones keep nobody waiting. OpenEXR's chunks of 16 rows must divide it.
inline constexpr int band_rows = 64;

/// What encoding makes of a band. The note is what must be known of it before its turn comes.
struct EncodedBand {
    std::string bytes, note;
};

class Encoder {
  public:
    explicit Encoder(const Layout& own_layout) : layout(own_layout) {}
    virtual ~Encoder() = default;
    Encoder(const Encoder&) = delete;

    int bands() const { return (layout.height - 1) / band_rows + 1; }
    /// Rows of the band `i`; the first is i * band_rows. Rows are counted as they stand in the file.
    int rows(int i) const { return i + 1 < bands() ? band_rows : layout.height - i * band_rows; }
    /// Is the file's first row the bottom one?
    virtual bool bottom_up() const { return false; }

    /// From any thread.
    virtual EncodedBand encode(const std::byte* codes, int rows) const = 0;

    using Notes = std::vector<std::string>;
    using BytesOf = std::function<std::string(int band)>;  // each band's once, in order
    using Append = std::function<void(std::string_view)>;
    /// The whole file.
    virtual void assemble(const Notes& notes, const BytesOf& bytes_of, const Append& append) const = 0;

    const Layout layout;
};

/// For a file with this ending (".bmp", ".png" or ".exr", in lower case), or a picture of a stream (".ppm", ".y4m").
std::unique_ptr<Encoder> encoder_for(std::string_view ending, const Layout& layout, Compression compression);

std::unique_ptr<Encoder> png_encoder(const Layout& layout, Compression compression);
std::unique_ptr<Encoder> exr_encoder(const Layout& layout);
std::unique_ptr<Encoder> ppm_encoder(const Layout& layout);
std::unique_ptr<Encoder> y4m_encoder(const Layout& layout);

/// What precedes the first picture of a stream.
std::string stream_head(std::string_view ending, const Layout& layout, double fps);

}  // namespace strahl

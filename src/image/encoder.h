// Encodes picture files band by band: each band by itself, on any thread; then they are put together in order.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/frame_rate.h"
#include "image/picture.h"

namespace strahl {

/// The names of the channels of a .exr file, in the order of a pixel's values, and attributes of text. Without names
/// channels are red, green, blue and alpha, or grey and alpha.
struct ChannelNames {
    std::vector<std::string> names{};
    std::vector<std::pair<std::string, std::string>> attributes{};  // their names have at most 31 letters
};

/// The pixels of a file. Codes are uint8, uint16 or float by `bits`, `channels` per pixel.
struct Layout {
    int width = 0, height = 0, channels = 3, bits = 8;
    ChannelNames named{};

    std::size_t row_bytes() const { return std::size_t(width) * unsigned(channels) * unsigned(bits / 8); }
};

/// Rows of a band; the last band has the rest. Compressing bands of 64 rows apart costs 1 % of size, and the last bands
/// are encoded soon after the picture is traced. Must be a multiple of OpenEXR's chunks of 16 rows.
inline constexpr int band_rows = 64;

/// An encoded band. `note` is what the encoder must know about all bands before it puts them together.
struct EncodedBand {
    std::string bytes, note;
};

class Encoder {
  public:
    explicit Encoder(const Layout& own_layout) : layout(own_layout) {}
    virtual ~Encoder() = default;
    Encoder(const Encoder&) = delete;

    int bands() const { return (layout.height - 1) / band_rows + 1; }
    /// The number of rows of band `i`, which begins at row i * band_rows. Rows count in the order of the file.
    int rows(int i) const { return i + 1 < bands() ? band_rows : layout.height - i * band_rows; }
    /// Is the file's first row the bottom one?
    virtual bool bottom_up() const { return false; }

    /// Encodes a band; may be called from any thread.
    virtual EncodedBand encode(const std::byte* codes, int rows) const = 0;

    using Notes = std::vector<std::string>;
    using BytesOf = std::function<std::string(int band)>;  // called once for each band, in order
    using Append = std::function<void(std::string_view)>;
    /// Appends the whole file.
    virtual void assemble(const Notes& notes, const BytesOf& bytes_of, const Append& append) const = 0;

    const Layout layout;
};

/// The encoder of files with this ending (".bmp", ".png" or ".exr"), or of pictures in a stream (".ppm", ".y4m").
std::unique_ptr<Encoder> encoder_for(std::string_view ending, const Layout& layout, Compression compression);

std::unique_ptr<Encoder> png_encoder(const Layout& layout, Compression compression);
std::unique_ptr<Encoder> exr_encoder(const Layout& layout);
std::unique_ptr<Encoder> ppm_encoder(const Layout& layout);
std::unique_ptr<Encoder> y4m_encoder(const Layout& layout);

/// The bytes before the first picture of a stream.
std::string stream_head(std::string_view ending, const Layout& layout, const FrameRate& rate);

}  // namespace strahl

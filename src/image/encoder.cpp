// Chooses encoders, and encodes BMP: Windows bitmaps of 24 bits a pixel, bottom-up, blue first, rows of 4 n bytes
// (Microsoft, "Bitmap Storage").
#include "image/encoder.h"

#include <cassert>
#include <cstdint>

#include "files/bytes.h"

namespace strahl {
namespace {

class Bmp : public Encoder {
  public:
    using Encoder::Encoder;

    bool bottom_up() const override { return true; }

    EncodedBand encode(const std::byte* codes, int rows) const override {
        EncodedBand band;
        band.bytes.resize(stride() * unsigned(rows));
        const auto* from = reinterpret_cast<const char*>(codes);
        const std::size_t width = unsigned(layout.width);  // which writing bytes does not change
        for (std::size_t y = 0; y < unsigned(rows); ++y) {
            char* const to = &band.bytes[y * stride()];
            for (std::size_t x = 0; x < 3 * width; x += 3)
                to[x] = from[x + 2], to[x + 1] = from[x + 1], to[x + 2] = from[x];
            from += 3 * width;
        }
        return band;
    }

    void assemble(const Notes&, const BytesOf& bytes_of, const Append& append) const override {
        constexpr std::uint32_t header = 14 + 40, pixels_per_metre = 2835;  // 72 per inch
        const auto size = static_cast<std::uint32_t>(stride() * unsigned(layout.height));
        std::string head = "BM";
        const auto put32 = [&](auto value) { put_little<std::uint32_t>(head, static_cast<std::uint32_t>(value)); };
        put32(header + size), put32(0), put32(header);
        put32(40), put32(layout.width), put32(layout.height);
        put_little<std::uint16_t>(head, 1), put_little<std::uint16_t>(head, 24);
        put32(0), put32(size), put32(pixels_per_metre), put32(pixels_per_metre), put32(0), put32(0);
        append(head);
        for (int i = 0; i < bands(); ++i) append(bytes_of(i));
    }

  private:
    std::size_t stride() const { return (layout.row_bytes() + 3) / 4 * 4; }
};

}  // namespace

std::unique_ptr<Encoder> encoder_for(std::string_view ending, const Layout& layout, Compression compression) {
    if (ending == ".png") return png_encoder(layout, compression);
    if (ending == ".exr") return exr_encoder(layout);
    if (ending == ".ppm") return ppm_encoder(layout);
    if (ending == ".y4m") return y4m_encoder(layout);
    assert(ending == ".bmp");
    return std::make_unique<Bmp>(layout);
}

}  // namespace strahl

// Encodes the pictures of streams that other programs turn into films: PPM (netpbm.sourceforge.net/doc/ppm.html), one
// after the other, and YUV4MPEG2 (man 5 yuv4mpeg) without subsampling.
#include <cmath>
#include <cstdint>

#include "image/encoder.h"

namespace strahl {
namespace {

class Ppm : public Encoder {
  public:
    using Encoder::Encoder;

    EncodedBand encode(const std::byte* codes, int rows) const override {
        return {std::string(reinterpret_cast<const char*>(codes), layout.row_bytes() * unsigned(rows)), ""};
    }

    void assemble(const Notes&, const BytesOf& bytes_of, const Append& append) const override {
        append("P6\n" + std::to_string(layout.width) + " " + std::to_string(layout.height) + "\n255\n");
        for (int i = 0; i < bands(); ++i) append(bytes_of(i));
    }
};

/// Encodes by ITU-R BT.709: luma from 16 to 235, colour differences from 16 to 240. A band consists of three planes.
class Y4m : public Encoder {
  public:
    using Encoder::Encoder;

    EncodedBand encode(const std::byte* codes, int rows) const override {
        const std::size_t pixels = std::size_t(layout.width) * unsigned(rows);
        EncodedBand band{std::string(3 * pixels, '\0'), ""};
        const auto* rgb = reinterpret_cast<const std::uint8_t*>(codes);
        const auto code = [](double low, double range, double value) {
            return static_cast<char>(static_cast<int>(low + range / 255 * value + .5));
        };
        for (std::size_t i = 0; i < pixels; ++i, rgb += 3) {
            const double red = rgb[0], blue = rgb[2], luma = .2126 * red + .7152 * rgb[1] + .0722 * blue;
            band.bytes[i] = code(16, 219, luma);
            band.bytes[pixels + i] = code(128, 224, (blue - luma) / 1.8556);
            band.bytes[2 * pixels + i] = code(128, 224, (red - luma) / 1.5748);
        }
        return band;
    }

    void assemble(const Notes&, const BytesOf& bytes_of, const Append& append) const override {
        append("FRAME\n");
        std::vector<std::string> all;
        for (int i = 0; i < bands(); ++i) all.push_back(bytes_of(i));
        for (std::size_t plane = 0; plane < 3; ++plane)
            for (const std::string& band : all)
                append(std::string_view(band).substr(plane * band.size() / 3, band.size() / 3));
    }
};

}  // namespace

std::unique_ptr<Encoder> ppm_encoder(const Layout& layout) { return std::make_unique<Ppm>(layout); }
std::unique_ptr<Encoder> y4m_encoder(const Layout& layout) { return std::make_unique<Y4m>(layout); }

std::string stream_head(std::string_view ending, const Layout& layout, const FrameRate& rate) {
    if (ending != ".y4m") return "";
    return "YUV4MPEG2 W" + std::to_string(layout.width) + " H" + std::to_string(layout.height) + " F" + rate.text(':') +
           " Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
}

}  // namespace strahl

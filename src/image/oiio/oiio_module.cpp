// The only file that includes OpenImageIO: linking it costs 0.2 s at every start, so it is a module loaded when needed.
#include "image/oiio/module.h"

// One such file only: these headers compile the fmt library into whatever includes them.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace OIIO;

TypeDesc type_of(int bits) { return bits == 8 ? TypeDesc::UINT8 : bits == 16 ? TypeDesc::UINT16 : TypeDesc::FLOAT; }

bool encode(const strahl::Codes& codes, const char* ending, std::string& result) {
    const std::string name = std::string("picture") + ending;
    const auto output = ImageOutput::create(name);
    if (!output) return result = geterror(), false;
    ImageSpec spec(codes.width, codes.height, codes.channels, type_of(codes.bits));
    // Only names what the values are: OpenImageIO writes the matching chunk and leaves the values alone.
    spec.attribute("oiio:ColorSpace", codes.bits == 32 ? "Linear" : "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);  // else it would divide colours by alpha
    if (codes.bits == 32) spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // the same picture makes the same file
    std::vector<unsigned char> bytes;
    Filesystem::IOVecOutput memory(bytes);
    if (!output->set_ioproxy(&memory) || !output->open(name, spec) ||
        !output->write_image(type_of(codes.bits), codes.data) || !output->close())
        return result = output->geterror(), false;
    result.assign(bytes.begin(), bytes.end());
    return true;
}

/// Reads the values in the file's own type, so that no rounding but the division by `max` comes between.
template <class T>
bool read_values(ImageInput& input, TypeDesc type, double max, strahl::Picture& picture) {
    std::vector<T> codes(picture.values.size());
    if (!input.read_image(0, 0, 0, picture.channels, type, codes.data())) return false;
    for (std::size_t i = 0; i < codes.size(); ++i) picture.values[i] = static_cast<double>(codes[i]) / max;
    return true;
}

bool decode(const std::string& path, strahl::Picture& picture, std::string& reason) {
    ImageSpec as_it_is;
    as_it_is.attribute("oiio:UnassociatedAlpha", 1);
    as_it_is.attribute("oiio:RawColor", 1);
    const auto input = ImageInput::open(path, &as_it_is);
    if (!input) return reason = geterror(), false;
    const ImageSpec& spec = input->spec();
    constexpr std::uint64_t most_values = std::uint64_t(1) << 28;  // 2 GiB of doubles: what a forged header can cost
    if (spec.depth > 1 || spec.image_pixels() > most_values / static_cast<unsigned>(spec.nchannels))
        return reason = "it holds more than 2^28 values, or is no flat picture", false;
    if (spec.format == TypeDesc::UINT16 && input->format_name() == std::string("pnm"))
        return reason = "OpenImageIO reads 16-bit PNM wrong by one; convert it to .png", false;
    picture = {spec.width, spec.height, spec.nchannels, {}, 32};
    picture.values.resize(spec.image_pixels() * static_cast<unsigned>(spec.nchannels));
    bool whole = false;
    if (spec.format == TypeDesc::UINT8) {
        picture.bits = 8;
        whole = read_values<std::uint8_t>(*input, TypeDesc::UINT8, 255, picture);
    } else if (spec.format == TypeDesc::UINT16) {
        picture.bits = 16;
        whole = read_values<std::uint16_t>(*input, TypeDesc::UINT16, 65535, picture);
    } else if (spec.format == TypeDesc::DOUBLE) {
        whole = read_values<double>(*input, TypeDesc::DOUBLE, 1, picture);
    } else {
        whole = read_values<float>(*input, TypeDesc::FLOAT, 1, picture);
    }
    if (!whole) reason = input->geterror();
    return whole;
}

/// OpenImageIO, and the allocations around it, may throw; nothing may cross the module's border.
template <class Work>
bool guarded(std::string& reason, Work work) {
    try {
        const bool done = work();
        if (!done && reason.empty()) reason = "the picture library gives no reason";
        return done;
    } catch (const std::exception& error) {
        reason = error.what();
        return false;
    }
}

}  // namespace

bool strahl_encode_picture(const strahl::Codes& codes, const char* ending, std::string& result) {
    return guarded(result, [&] { return encode(codes, ending, result); });
}

bool strahl_decode_picture(const std::string& path, strahl::Picture& picture, std::string& reason) {
    return guarded(reason, [&] { return decode(path, picture, reason); });
}

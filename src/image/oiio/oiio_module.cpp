// The only file that includes OpenImageIO: linking it costs 0.2 s at every start, so it is a module loaded when needed.
#include "image/picture_module.h"

// In one file only: these headers compile the fmt library into every file that includes them.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

namespace {

using namespace OIIO;

/// Reads the values in the file's own type, so that only the division by `max` rounds. Reads a few rows at a time, so
/// that memory is written only for values that the file really holds, whatever its header promises.
template <class T>
bool read_values(ImageInput& input, const ImageSpec& spec, double max, strahl::Picture& picture) {
    const TypeDesc type = BaseTypeFromC<T>::value;
    const bool tiled = spec.tile_width > 0;
    const std::size_t row = std::size_t(picture.width) * static_cast<unsigned>(picture.channels);
    const int step = tiled ? spec.tile_height : static_cast<int>(std::max<std::size_t>(1, (1 << 20) / row));
    picture.values.reserve(row * static_cast<unsigned>(picture.height));
    std::vector<T> codes;
    for (int y = 0; y < picture.height;) {
        const int rows = std::min(step, picture.height - y), first = spec.y + y, x = spec.x;
        codes.resize(row * static_cast<unsigned>(rows));
        if (!(tiled ? input.read_tiles(0, 0, x, x + picture.width, first, first + rows, spec.z, spec.z + 1, 0,
                                       picture.channels, type, codes.data())
                    : input.read_scanlines(0, 0, first, first + rows, spec.z, 0, picture.channels, type, codes.data())))
            return false;
        for (const T code : codes) picture.values.push_back(static_cast<double>(code) / max);
        y += rows;
    }
    return true;
}

/// Why a picture cannot be read, or "", before anything is allocated for its values.
std::string objection(const ImageSpec& spec, const strahl::Wanted& wanted) {
    constexpr int most_channels = 64;
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.deep || spec.nchannels < 1 ||
        spec.nchannels > most_channels)
        return "it is not a flat picture of 1 to " + std::to_string(most_channels) + " channels";
    constexpr int farthest = 1 << 24;  // OpenImageIO counts rows from here, many at a time, and may count past INT_MAX
    if (std::max(spec.x, spec.y) > farthest || std::min(spec.x, spec.y) < -farthest)
        return "it lies too far from the corner of its page";
    const std::string size = std::to_string(spec.width) + "x" + std::to_string(spec.height) + " pixels";
    const auto pixels = std::uint64_t(spec.width) * std::uint64_t(spec.height);
    const auto channels = static_cast<unsigned>(spec.nchannels);
    const auto tile = std::uint64_t(std::max(1, spec.tile_width)) * std::uint64_t(std::max(1, spec.tile_height));
    if (std::max(pixels, tile) > wanted.most_values / channels)
        return "its " + size + ", or its tiles, are more than are read or than fit into such a file";
    const double needed = double(pixels) * channels * (sizeof(double) + spec.format.size());
    if (needed > wanted.memory) return "there is not enough memory for its " + size;
    return "";
}

bool decode(const strahl::Wanted& wanted, strahl::Picture& picture, std::string& reason) {
    ImageSpec as_it_is;
    as_it_is.attribute("oiio:UnassociatedAlpha", 1);
    as_it_is.attribute("oiio:RawColor", 1);
    const auto input = ImageInput::create(wanted.format);
    if (!input) return reason = geterror(), false;
    ImageSpec spec;
    if (!input->open(wanted.path, spec, as_it_is)) return reason = input->geterror(), false;
    if (reason = objection(spec, wanted); !reason.empty()) return false;
    picture = {spec.width, spec.height, spec.nchannels, {}, 32};
    bool whole = false;
    if (spec.format == TypeDesc::UINT8) {
        picture.bits = 8;
        whole = read_values<std::uint8_t>(*input, spec, 255, picture);
    } else if (spec.format == TypeDesc::UINT16) {
        picture.bits = 16;
        whole = read_values<std::uint16_t>(*input, spec, 65535, picture);
    } else if (spec.format == TypeDesc::DOUBLE) {
        whole = read_values<double>(*input, spec, 1, picture);
    } else {
        whole = read_values<float>(*input, spec, 1, picture);
    }
    if (!whole) reason = input->geterror();
    return whole;
}

/// Catches all exceptions, of OpenImageIO and of allocations: none may leave the module.
template <class Work>
bool guarded(std::string& reason, Work work) {
    try {
        const bool done = work();
        if (!done && reason.empty()) reason = "the picture library gives no reason";
        return done;
    } catch (const std::bad_alloc&) {
        reason = "out of memory";  // so short that it takes none
        return false;
    } catch (const std::exception& error) {
        reason = error.what();
        return false;
    }
}

}  // namespace

bool strahl_decode_picture(const strahl::Wanted& wanted, strahl::Picture& picture, std::string& reason) {
    return guarded(reason, [&] { return decode(wanted, picture, reason); });
}

// The only file that includes OpenImageIO: linking it costs 0.2 s at every start, so it is a module loaded when needed.
#include "image/picture_module.h"
#include "image/recognise.h"

// In one file only: these headers compile the fmt library into every file that includes them.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace OIIO;

/// Numbers of the channels that a picture has in its file, in the order R, G, B, A or Y, A.
using Channels = std::vector<int>;

/// Reads the values in the file's own type, so that only the division by `max` rounds. Reads a few rows at a time, so
/// that memory is written only for values that the file really holds, whatever its header promises.
template <class T>
bool read_values(ImageInput& input, const ImageSpec& spec, const Channels& channels, double max,
                 strahl::Picture& picture) {
    const TypeDesc type = BaseTypeFromC<T>::value;
    const bool tiled = spec.tile_width > 0;
    const int all = spec.nchannels;
    const std::size_t row = std::size_t(picture.width) * static_cast<unsigned>(all);
    const int step = tiled ? spec.tile_height : static_cast<int>(std::max<std::size_t>(1, (1 << 20) / row));
    picture.values.reserve(std::size_t(picture.width) * channels.size() * static_cast<unsigned>(picture.height));
    std::vector<T> codes;
    for (int y = 0; y < picture.height;) {
        const int rows = std::min(step, picture.height - y), first = spec.y + y, x = spec.x;
        codes.resize(row * static_cast<unsigned>(rows));
        if (!(tiled ? input.read_tiles(0, 0, x, x + picture.width, first, first + rows, spec.z, spec.z + 1, 0, all,
                                       type, codes.data())
                    : input.read_scanlines(0, 0, first, first + rows, spec.z, 0, all, type, codes.data())))
            return false;
        for (std::size_t pixel = 0; pixel < codes.size(); pixel += static_cast<unsigned>(all))
            for (const int channel : channels)
                picture.values.push_back(static_cast<double>(codes[pixel + static_cast<unsigned>(channel)]) / max);
        y += rows;
    }
    return true;
}

/// Finds channels by their names, in capitals or not: R, G and B or Y, and A. Those of the only layer that has colours
/// are taken if none of these stand outside layers. Returns why there are none, or "". All other channels, such as
/// depth, are ignored. OpenEXR's names: openexr.com/en/latest/TechnicalIntroduction.html, "Channel Names".
std::string find_channels(const ImageSpec& spec, Channels& channels) {
    const auto find = [&](const std::string& layer, const char* letter) {
        const auto same = [&](const std::string& name) { return Strutil::iequals(name, layer + letter); };
        const auto found = std::find_if(spec.channelnames.begin(), spec.channelnames.end(), same);
        return found == spec.channelnames.end() ? -1 : static_cast<int>(found - spec.channelnames.begin());
    };
    const auto has = [&](const std::string& layer, const char* letter) { return find(layer, letter) >= 0; };
    const auto colours = [&](const std::string& layer) {
        return (has(layer, "R") && has(layer, "G") && has(layer, "B")) ||
               (has(layer, "Y") && !has(layer, "RY") && !has(layer, "BY") && !has(layer, "X"));  // X and Y: a vector
    };
    std::vector<std::string> layers;
    for (const std::string& name : spec.channelnames) {
        const std::string layer = name.substr(0, name.rfind('.') + 1);  // with the dot; "" outside layers
        if (colours(layer) && std::find(layers.begin(), layers.end(), layer) == layers.end()) layers.push_back(layer);
    }
    const bool some = has("", "R") || has("", "G") || has("", "B") || has("", "Y");
    if (colours("")) layers = {""};
    if (layers.empty() || (some && !layers[0].empty()))
        return "its channels are " + Strutil::join(spec.channelnames, ", ") + "; colours need R, G and B, or Y alone";
    if (layers.size() > 1)
        return "its colours are in several layers (" + Strutil::join(layers, ", ") +
               "); save one of them as a picture of its own";
    for (const char* letter : {"R", "G", "B"}) channels.push_back(find(layers[0], letter));
    if (std::find(channels.begin(), channels.end(), -1) != channels.end()) channels = {find(layers[0], "Y")};
    if (has(layers[0], "A")) channels.push_back(find(layers[0], "A"));
    for (const int channel : channels)
        if (spec.channelformat(channel) == TypeDesc::UINT32)
            return "its channel " + spec.channelnames[static_cast<unsigned>(channel)] +
                   " holds whole numbers, as names of things do, not colours";
    return "";
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
    strahl::DecodedSize size{unsigned(spec.width), unsigned(spec.height), unsigned(spec.nchannels), spec.format.size()};
    if (const std::string fault = size_fault(size, wanted.most_values, wanted.memory); !fault.empty()) return fault;
    const auto tile = std::uint64_t(std::max(1, spec.tile_width)) * std::uint64_t(std::max(1, spec.tile_height));
    return tile > wanted.most_values / size.channels ? "its tiles have more pixels than fit into such a file" : "";
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
    Channels channels(static_cast<unsigned>(spec.nchannels));
    std::iota(channels.begin(), channels.end(), 0);
    if (std::string_view(wanted.format) == "openexr") channels.clear(), reason = find_channels(spec, channels);
    if (!reason.empty()) return false;
    picture = {spec.width, spec.height, static_cast<int>(channels.size()), {}, 32};
    bool whole = false;
    if (spec.format == TypeDesc::UINT8) {
        picture.bits = 8;
        whole = read_values<std::uint8_t>(*input, spec, channels, 255, picture);
    } else if (spec.format == TypeDesc::DOUBLE) {
        whole = read_values<double>(*input, spec, channels, 1, picture);
    } else {
        whole = read_values<float>(*input, spec, channels, 1, picture);
    }
    if (!whole || input->has_error()) reason = input->geterror();
    return whole;
}

bool draw_text(const std::string& text, int size, strahl::Picture& picture, std::string& reason) {
    for (const char* font : {"DejaVuSans", "LiberationSans-Regular"}) {
        const ROI around = ImageBufAlgo::text_size(text, size, font);
        if (!around.defined()) continue;
        ImageBuf drawn(ImageSpec(around.width(), around.height(), 1, TypeDesc::FLOAT));
        ImageBufAlgo::zero(drawn);
        if (!ImageBufAlgo::render_text(drawn, -around.xbegin, -around.ybegin, text, size, font, {1.f}))
            return reason = drawn.geterror(), false;
        picture = {around.width(), around.height(), 1, std::vector<double>(drawn.spec().image_pixels())};
        return drawn.get_pixels(ROI::All(), TypeDesc::DOUBLE, picture.values.data());
    }
    return reason = "there is no font; on Debian: apt install fonts-dejavu-core", false;
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

bool strahl_draw_text(const std::string& text, int size, strahl::Picture& picture, std::string& reason) {
    return guarded(reason, [&] { return draw_text(text, size, picture, reason); });
}

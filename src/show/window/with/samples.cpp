// Decodes by libvorbisfile (xiph.org/vorbis/doc/vorbisfile).
#include "show/window/with/samples.h"

#include <vorbis/vorbisfile.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>

namespace strahl {

std::vector<float> peaks_of(const Samples& samples) {
    const std::size_t block = std::size_t(samples.channels) * std::max<std::size_t>(std::size_t(samples.rate) / 100, 1);
    std::vector<float> peaks;
    for (std::size_t i = 0; 2 * i + 1 < samples.bytes.size(); ++i) {
        std::int16_t value = 0;
        std::memcpy(&value, &samples.bytes[2 * i], sizeof value);
        if (i % block == 0) peaks.push_back(0);
        peaks.back() = std::max(peaks.back(), std::abs(float(value)) / 32768);
    }
    return peaks;
}

Samples decode_ogg(std::FILE* file, const std::string& name, const std::atomic<bool>& stop) {
    OggVorbis_File opened;
    if (!file) return {{}, 0, 0, name + " cannot be opened"};
    if (::ov_open_callbacks(file, &opened, nullptr, 0, OV_CALLBACKS_DEFAULT) != 0)
        return std::fclose(file), Samples{{}, 0, 0, name + " is not an Ogg Vorbis file"};
    const std::unique_ptr<OggVorbis_File, int (*)(OggVorbis_File*)> closer(&opened, ::ov_clear);
    const vorbis_info first = *::ov_info(&opened, -1);
    Samples samples{{}, first.channels, static_cast<int>(first.rate), ""};
    constexpr std::size_t most = std::size_t(1) << 30;
    int holes = 1 << 20;  // places without sound; each reading yields samples or one of these, so that it ends
    std::array<char, 1 << 16> block;
    for (int part = 0; !stop;) {
        const int big_endian = std::endian::native == std::endian::big;
        const long got = ::ov_read(&opened, block.data(), static_cast<int>(block.size()), big_endian, 2, 1, &part);
        const vorbis_info* const now = ::ov_info(&opened, -1);
        if (got == OV_HOLE && --holes > 0) continue;
        if (got < 0) return {{}, 0, 0, name + " is damaged"};
        if (got == 0) break;
        if (now->channels != first.channels || now->rate != first.rate || first.channels > 2)
            return {{}, 0, 0, name + " must be mono or stereo, and the same throughout"};
        samples.bytes.insert(samples.bytes.end(), block.data(), block.data() + got);
        if (samples.bytes.size() > most) return {{}, 0, 0, name + " is longer than a gigabyte of samples"};
    }
    if (samples.bytes.empty()) samples.fault = name + " holds no sound";
    return samples;
}

}  // namespace strahl

#include "image/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace strahl {
namespace {

bool has_alpha(const Picture& picture) { return picture.channels == 2 || picture.channels == 4; }

std::string size_of(const Picture& picture) {
    return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

/// The number of channels that both have, without an alpha channel that only one has.
int common_channels(const Picture& a, const Picture& b) {
    if (a.width != b.width || a.height != b.height)
        throw FileError("pictures of different sizes cannot be compared: " + size_of(a) + " and " + size_of(b));
    if (a.channels == b.channels) return a.channels;
    const int colors_a = a.channels - has_alpha(a), colors_b = b.channels - has_alpha(b);
    if (colors_a != colors_b)
        throw FileError("pictures of different channels cannot be compared: " + std::to_string(a.channels) + " and " +
                        std::to_string(b.channels));
    return colors_a;
}

double distance(double a, double b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0;  // equal infinities too, whose difference is NaN
    return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::infinity() : std::abs(a - b);
}

/// Neighbouring codes k/255 and (k+1)/255 are 1/255 apart up to rounding, which must not count as more.
bool beyond(double difference, double tolerance) { return difference > tolerance * (1 + 1e-9); }

std::array<double, 3> heat(double difference) {
    if (!(difference > 0)) return {0, 0, 0};
    static constexpr std::array<std::array<double, 3>, 6> ramp{
        {{.05, .1, .45}, {.1, .35, .8}, {.75, .2, .65}, {.95, .25, .1}, {1, .8, .1}, {1, 1, 1}}};
    const double place = std::clamp(1 + std::log(difference) / std::log(65535.), 0., 1.) * (ramp.size() - 1);
    const std::size_t below = std::min<std::size_t>(static_cast<std::size_t>(place), ramp.size() - 2);
    const double part = place - static_cast<double>(below);
    std::array<double, 3> color;
    for (std::size_t c = 0; c < 3; ++c) color[c] = (1 - part) * ramp[below][c] + part * ramp[below + 1][c];
    return color;
}

}  // namespace

PictureDifference compare(const Picture& a, const Picture& b, double tolerance) {
    const int channels = common_channels(a, b);
    PictureDifference result;
    result.max = -1;
    result.pixels = static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height);
    double sum = 0, squares = 0;
    std::size_t seen = 0, outside = 0;
    for (std::size_t pixel = 0; pixel < result.pixels; ++pixel) {
        double worst = 0;
        for (int c = 0; c < channels; ++c) {
            const double va = a.values[pixel * a.channels + c], vb = b.values[pixel * b.channels + c];
            const double d = distance(va, vb);
            sum += d, squares += d * d, worst = std::max(worst, d);
            if (d <= result.max) continue;
            const auto width = static_cast<std::size_t>(a.width);
            result.max = d, result.value_a = va, result.value_b = vb, result.channel = c;
            result.x = static_cast<int>(pixel % width), result.y = static_cast<int>(pixel / width);
        }
        seen += beyond(worst, 1 / 255.), outside += beyond(worst, tolerance);
    }
    result.max = std::max(result.max, 0.);
    const double pixels = std::max(1., static_cast<double>(result.pixels)), values = pixels * channels;
    result.mean = sum / values;
    result.rms = std::sqrt(squares / values);
    result.psnr = -20 * std::log10(result.rms);
    result.share_beyond_8bit = static_cast<double>(seen) / pixels;
    result.share_beyond = static_cast<double>(outside) / pixels;
    return result;
}

std::string report(const PictureDifference& d, double tolerance) {
    const auto line = [](const char* format, auto... values) {
        std::array<char, 256> text;
        std::snprintf(text.data(), text.size(), format, values...);
        return std::string(text.data()) + "\n";
    };
    const auto share = [&](const char* what, double limit, double part) {
        return line("pixels %s %.6g: %.0f of %zu (%.4g %%)", what, limit, part * static_cast<double>(d.pixels),
                    d.pixels, 100 * part);
    };
    std::string text = line("maximum difference: %.9g", d.max) + line("mean difference: %.9g", d.mean) +
                       line("RMS difference: %.9g", d.rms) + line("PSNR: %.2f dB", d.psnr) +
                       share("beyond 1/255 =", 1 / 255., d.share_beyond_8bit) +
                       share("beyond the tolerance", tolerance, d.share_beyond);
    if (d.max > 0)
        text += line("worst at x %d, y %d, channel %d: %.9g and %.9g", d.x, d.y, d.channel, d.value_a, d.value_b);
    return text;
}

Picture heatmap(const Picture& a, const Picture& b) {
    const int channels = common_channels(a, b);
    Picture map{a.width, a.height, 3, {}, 8};
    const auto pixels = static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height);
    map.values.reserve(3 * pixels);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        double worst = 0;
        for (int c = 0; c < channels; ++c)
            worst = std::max(worst, distance(a.values[pixel * a.channels + c], b.values[pixel * b.channels + c]));
        for (const double v : heat(worst)) map.values.push_back(v);
    }
    return map;
}

Picture beside(const std::vector<Picture>& pictures, int gap) {
    Picture sheet{0, 0, 3, {}, 8};
    for (const Picture& picture : pictures) {
        sheet.width += picture.width + (&picture == pictures.data() ? 0 : gap);
        sheet.height = std::max(sheet.height, picture.height);
    }
    sheet.values.assign(std::size_t(3) * sheet.width * sheet.height, .5);
    int left = 0;
    for (const Picture& picture : pictures) {
        const bool grey = picture.channels < 3;
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                for (int c = 0; c < 3; ++c)
                    sheet.values[(std::size_t(y) * sheet.width + left + x) * 3 + c] =
                        picture.values[(std::size_t(y) * picture.width + x) * picture.channels + (grey ? 0 : c)];
        left += picture.width + gap;
    }
    return sheet;
}

}  // namespace strahl

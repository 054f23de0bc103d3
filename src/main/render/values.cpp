// Option values: from text to numbers, with error messages that show an example.
#include "main/render/values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numeric>
#include <optional>

#include "files/error.h"
#include "text/reading/messages.h"

namespace strahl {
namespace {

constexpr int longest_side = 1'000'000;
constexpr int largest_grid = 256;
constexpr int last_frame = 999'999'999;
constexpr int most_shares = 1'000'000;

/// Reads whole numbers with one separator between them and nothing else.
template <std::size_t count>
std::optional<std::array<int, count>> numbers(std::string_view text, char separator) {
    std::array<int, count> values{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && (at == end || *at++ != separator)) return {};
        if (at != end && *at == '-') return {};
        const auto [next, error] = std::from_chars(at, end, values[i]);
        if (error != std::errc{}) return {};
        at = next;
    }
    if (at != end) return {};
    return values;
}

std::string padded(int number, std::size_t digits) {
    const std::string text = std::to_string(number);
    return text.size() < digits ? std::string(digits - text.size(), '0') + text : text;
}

/// Reads one of the ranges of a list.
std::optional<FrameRange> parse_range(std::string_view text) {
    FrameRange range;
    const std::size_t mark = text.find_first_of(":x");
    if (mark != text.npos) {
        const auto step = numbers<1>(text.substr(mark + 1), '-');
        if (!step || (*step)[0] < 1 || (*step)[0] > last_frame) return {};
        range.step = (*step)[0];
        text = text.substr(0, mark);
    }
    if (const auto one = numbers<1>(text, '-'))
        range.first = range.last = (*one)[0];
    else if (const auto two = numbers<2>(text, '-'))
        range.first = (*two)[0], range.last = (*two)[1];
    else
        return {};
    if (range.last > last_frame) return {};
    return range;
}

constexpr const char* as_fraction = "; write it as a fraction, such as 60000/1001, of numbers up to 2147483647";

/// Returns the fraction in lowest terms. Throws UsageError if it does not fit.
FrameRate reduced(std::int64_t frames, std::int64_t seconds) {
    const std::int64_t common = std::gcd(frames, seconds);
    frames /= common, seconds /= common;
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    if (frames > most || seconds > most) throw UsageError(std::string("--fps has too many digits") + as_fraction);
    return {static_cast<int>(frames), static_cast<int>(seconds)};
}

}  // namespace

PictureSize parse_size(std::string_view text) {
    const auto n = numbers<2>(text, 'x');
    if (!n) throw UsageError("--size is width x height in pixels, such as 1920x1080, not " + quoted(text));
    const auto [width, height] = *n;
    if (width < 1 || height < 1 || width > longest_side || height > longest_side)
        throw UsageError("--size " + std::string(text) + ": each side is 1 to " + std::to_string(longest_side));
    return {width, height};
}

Lattice parse_crop(std::string_view text) {
    const auto n = numbers<4>(text, ',');
    if (!n)
        throw UsageError(
            "--crop is X,Y,W,H in pixels of the whole picture, counted from its top left corner, such as "
            "100,50,320,200, not " +
            quoted(text));
    const auto [x, y, width, height] = *n;
    if (width < 1 || height < 1) throw UsageError("--crop " + std::string(text) + " is empty");
    return {x, y, width, height};
}

Sampling parse_samples(std::string_view text) {
    if (text == "1") return {.grid = 1};
    const bool centre = text.ends_with("+1");
    const auto n = numbers<2>(text.substr(0, text.size() - (centre ? 2 : 0)), 'x');
    if (!n || (*n)[0] != (*n)[1]) throw UsageError("--samples is 1, or a square grid such as 4x4, not " + quoted(text));
    if ((*n)[0] < 1 || (*n)[0] > largest_grid)
        throw UsageError("--samples " + std::string(text) + ": grids are 1x1 to " +
                         size_text(largest_grid, largest_grid));
    return {.grid = (*n)[0], .centre = centre};
}

Share parse_share(std::string_view text) {
    const auto n = numbers<2>(text, '/');
    if (!n || (*n)[0] < 1 || (*n)[1] < (*n)[0] || (*n)[1] > most_shares)
        throw UsageError("--part is a number and that of all parts, 1/16 to 16/16 for instance, not " + quoted(text));
    return {(*n)[0], (*n)[1]};
}

FrameRate parse_rate(std::string_view text) {
    const auto require = [&](bool fits) {
        if (!fits)
            throw UsageError(
                "--fps is a number of frames in each second from 0.001 to 1000000, such as 25, 59.94 or "
                "60000/1001, not " +
                quoted(text));
    };
    if (const std::size_t stroke = text.find_first_of("/:"); stroke != text.npos) {
        const auto fraction = numbers<2>(text, text[stroke]);
        require(fraction && (*fraction)[0] > 0 && (*fraction)[1] > 0);
        const FrameRate rate = reduced((*fraction)[0], (*fraction)[1]);
        require(rate.per_second() >= .001 && rate.per_second() <= 1e6);
        return rate;
    }
    const std::size_t point = std::min(text.find('.'), text.size());
    const std::string digits = std::string(text.substr(0, point)).append(text.substr(std::min(point + 1, text.size())));
    require(!digits.empty() && std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; }));
    if (digits.size() > 15) throw UsageError(std::string("--fps has too many digits") + as_fraction);
    const std::int64_t value = std::stoll(digits);
    std::int64_t unit = 1;
    for (std::size_t i = point + 1; i < text.size(); ++i) unit *= 10;
    require(double(value) / double(unit) >= .001 && double(value) / double(unit) <= 1e6);
    // Video counts 1000/1001 of 24 or 30 frames in each second, of multiples of these, or of halves (Poynton, Digital
    // Video and HD, chapter on frame rates). One decimal is too few to tell.
    for (const std::int64_t whole : {value / unit, value / unit + 1})
        if (unit >= 100 && value % unit != 0 && (whole % 12 == 0 || whole % 15 == 0)) {
            const std::int64_t thousands = 1000 * whole * unit;  // 1001 of the decimals' units
            if (value == thousands / 1001 || value == (2 * thousands + 1001) / 2002)
                return {static_cast<int>(1000 * whole), 1001};
        }
    return reduced(value, unit);
}

FrameList parse_frames(std::string_view text) {
    FrameList list;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        const std::string_view part = rest.substr(0, comma);
        const auto range = parse_range(part);
        if (!range)
            throw UsageError("--frames is a list of frames such as 0-99, 1-3,5,7-20:2 or 1-100x2, not " + quoted(text));
        if (range->first > range->last)
            throw UsageError("--frames " + std::string(part) + " is empty: the first frame comes after the last");
        list.ranges.push_back(*range);
        if (comma == rest.npos) return list;
        rest = rest.substr(comma + 1);
    }
}

Layers parse_layers(std::string_view text) {
    Layers layers;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        const std::string_view name = rest.substr(0, comma);
        const auto known = std::ranges::find(layer_kinds, name, &LayerKind::name);
        if (known == layer_kinds.end()) {
            std::string names;
            for (const LayerKind& kind : layer_kinds) names.append(names.empty() ? "" : ", ").append(kind.name);
            throw UsageError("--layers has no " + quoted(name) + "; layers are " + names);
        }
        layers.*known->wanted = true;
        if (comma == rest.npos) return layers;
        rest = rest.substr(comma + 1);
    }
}

bool FrameList::has(int frame) const {
    return std::ranges::any_of(ranges, [&](const FrameRange& range) { return range.has(frame); });
}

bool FrameList::each(const std::function<bool(int)>& visit) const {
    for (auto range = ranges.begin(); range != ranges.end(); ++range)
        for (std::int64_t frame = range->first; frame <= range->last; frame += range->step) {
            const int number = static_cast<int>(frame);
            const auto had = [&](const FrameRange& other) { return other.has(number); };
            if (std::none_of(ranges.begin(), range, had) && !visit(number)) return false;
        }
    return true;
}

void require_within(const Lattice& crop, PictureSize picture) {
    if (crop.x <= picture.width - crop.columns && crop.y <= picture.height - crop.rows) return;
    throw UsageError("--crop asks for " + size_text(crop.columns, crop.rows) + " pixels from column " +
                     std::to_string(crop.x) + " and row " + std::to_string(crop.y) + " of a picture that is only " +
                     size_text(picture.width, picture.height) + "; its size is set with --size");
}

std::string before_ending(const std::string& path, std::string_view insertion) {
    const std::string ending = std::filesystem::path(path).extension().string();
    return path.substr(0, path.size() - ending.size()) + std::string(insertion) + ending;
}

std::string part_path(const std::string& path, Share share) {
    return path + ".part-" + std::to_string(share.part) + "-of-" + std::to_string(share.parts);
}

std::string numbered(const std::string& path, int frame) {
    for (std::size_t i = path.find('%'); i != path.npos; i = path.find('%', i + 1)) {
        std::size_t end = i + 1;
        int digits = 0;
        while (end < path.size() && end < i + 3 && path[end] >= '0' && path[end] <= '9')
            digits = 10 * digits + (path[end++] - '0');
        if (end < path.size() && path[end] == 'd')
            return path.substr(0, i) + padded(frame, static_cast<std::size_t>(digits)) + path.substr(end + 1);
    }
    return before_ending(path, std::string("-").append(padded(frame, 4)));
}

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

std::string bytes_in_words(double bytes) {
    constexpr std::array units{"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
    std::size_t unit = 0;
    while (bytes >= 1000 && unit + 1 < units.size()) bytes /= 1000, ++unit;
    char text[32];
    std::snprintf(text, sizeof text, bytes < 10 && unit > 0 ? "%.1f %s" : "%.0f %s", bytes, units[unit]);
    return text;
}

}  // namespace strahl

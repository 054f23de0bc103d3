#include "povref/compare/verdict.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "image/transfer.h"
#include "num/thread_pool.h"
#include "povref/compare/run_povray.h"
#include "trace/measure/edge_pixels.h"

namespace strahl {
namespace {

/// Edges are searched for so many pixels at once.
constexpr std::size_t together = 128;

using Values = std::span<const double>;

/// Returns how many steps pixel i of two pictures is apart, which have this number of channels.
int steps_apart(Values a, int channels_a, Values b, int channels_b, std::size_t i) {
    const auto step = [](double value) { return int(quantise(value, false, 65535)); };
    int apart = 0;
    for (std::size_t c = 0; c < 3; ++c)
        apart = std::max(apart, std::abs(step(a[channels_a * i + c]) - step(b[channels_b * i + c])));
    return apart;
}

/// How many pixels on each side of those in question are rendered again as well.
constexpr int margin = 16;

/// The comparison of two pictures, ours and theirs, of which pixel i differs by apart[i] steps.
struct Disagreement {
    const Picture& theirs;
    const std::vector<int>& apart;

    /// Is this so large a part of all pixels that the pictures are not the same?
    bool many(std::size_t off) const { return off * 50 >= apart.size(); }
    int between(const Picture& other, std::size_t i) const {
        return steps_apart(theirs.values, theirs.channels, other.values, other.channels, i);
    }
    /// Returns the smallest part with all these pixels and the margin around them.
    PicturePart part_around(std::span<const std::size_t> pixels) const {
        PicturePart part{theirs.width, theirs.height, 0, 0};
        for (const std::size_t i : pixels) {
            const int x = int(i % theirs.width), y = int(i / theirs.width);
            part.left = std::min(part.left, std::max(x - margin, 0));
            part.top = std::min(part.top, std::max(y - margin, 0));
            part.right = std::max(part.right, std::min(x + margin, theirs.width - 1));
            part.bottom = std::max(part.bottom, std::min(y + margin, theirs.height - 1));
        }
        return part;
    }
    /// Among the pixels of a part in which our picture equals POV-Ray's, does `other` equal it in most? A camera that
    /// cannot be moved would show another view.
    bool same_view(const Picture& other, const PicturePart& part) const {
        std::size_t same = 0, all = 0;
        for (int y = part.top; y <= part.bottom; ++y)
            for (int x = part.left; x <= part.right; ++x) {
                const std::size_t i = std::size_t(y) * theirs.width + x;
                if (apart[i] <= 1) ++all, same += between(other, i) <= 1;
            }
        return 2 * same > all;
    }
    /// Removes from `off` the pixels in which POV-Ray's picture made again differs by half as much as ours.
    void remove_unsure(std::vector<std::size_t>& off, const Again& again) const {
        const auto enough = [&] { return many(off.size()) ? 1 : 4; };
        int in_vain = 0;
        for (int k = 0; again && k < most_again && in_vain < enough() && !off.empty(); ++k) {
            const PicturePart part = part_around(off);
            const Picture other = again(k, part);
            const std::size_t before = off.size();
            if (same_view(other, part))
                std::erase_if(off, [&](std::size_t i) {
                    const int moved = between(other, i);
                    return moved > 2 && 2 * moved >= apart[i];
                });
            in_vain = off.size() == before ? in_vain + 1 : 0;
        }
    }
};

/// A tracer with a view, which it is asked about.
struct Asked {
    Tracer& tracer;
    const View& view;
    const std::atomic<bool>* stop;
    ThreadPool alone{1};

    std::vector<bool> edges(std::span<const Pixel> pixels, double radius) {
        std::vector<bool> found = on_edges(tracer, view, alone, pixels, radius, 1. / 65535, stop);
        if (stop && *stop) throw Stopped{};
        return found;
    }
    /// Are three in four of a pixel's neighbours on edges? Where one rounding in 20 goes astray, 25 rays find most.
    bool amid_edges(Pixel pixel) {
        std::vector<Pixel> others;
        for (int y = std::max(pixel.y - 1, 0); y <= std::min(pixel.y + 1, view.height - 1); ++y)
            for (int x = std::max(pixel.x - 1, 0); x <= std::min(pixel.x + 1, view.width - 1); ++x)
                if (x != pixel.x || y != pixel.y) others.push_back({x, y});
        const std::size_t all = others.size();
        for (const double part : {1., .7, .4}) {
            const std::vector<bool> found = edges(others, part * edge_radius);
            std::size_t k = 0;
            std::erase_if(others, [&](const Pixel&) { return found[k++]; });
        }
        return all > 0 && 4 * (all - others.size()) >= 3 * all;
    }
};

/// Returns those pixels that have more than `most_amid` of them within eight pixels to each side, themselves included.
std::vector<std::size_t> crowded(std::vector<std::size_t> pixels, int width) {
    const std::vector<std::size_t> all = pixels;
    const auto apart = [&](std::size_t a, std::size_t b) {
        const int columns = std::abs(int(a % width) - int(b % width)), rows = std::abs(int(a / width) - int(b / width));
        return std::max(columns, rows);
    };
    std::erase_if(pixels, [&](std::size_t i) {
        return std::ranges::count_if(all, [&](std::size_t other) { return apart(i, other) <= 8; }) <= most_amid;
    });
    return pixels;
}

}  // namespace

Verdict judge(Tracer& tracer, const View& view, const Frame& ours, const Picture& theirs, const std::atomic<bool>* stop,
              const Again& again) {
    if (theirs.width != ours.width || theirs.height != ours.height || theirs.channels < 3)
        throw FileError("POV-Ray's picture has another size");
    Asked ask{tracer, view, stop};
    Verdict verdict{.pixels = std::size_t(ours.width) * ours.height};
    std::vector<int> apart(verdict.pixels);
    std::vector<std::size_t> beyond;
    for (std::size_t i = 0; i < verdict.pixels; ++i) {
        apart[i] = steps_apart(ours.rgb, 3, theirs.values, theirs.channels, i);
        if (apart[i] > 1)
            beyond.push_back(i);
        else
            verdict.worst_off_edges = std::max(verdict.worst_off_edges, apart[i]);
    }
    const auto pixel = [&](std::size_t i) { return Pixel{int(i % ours.width), int(i / ours.width)}; };
    std::vector<std::size_t> off;   // pixels asked about that are on no edge
    std::vector<std::size_t> amid;  // pixels asked about on edges among other edges
    const Disagreement compared{theirs, apart};
    const auto decided = [&] { return compared.many(off.size()); };
    std::size_t asked = 0;
    while (asked < beyond.size() && !decided()) {
        const auto some = std::span(beyond).subspan(asked, std::min(together, beyond.size() - asked));
        std::vector<Pixel> pixels;
        for (const std::size_t i : some) pixels.push_back(pixel(i));
        const std::vector<bool> edges = ask.edges(pixels, edge_radius);
        for (std::size_t k = 0; k < some.size(); ++k) {
            if (!edges[k])
                off.push_back(some[k]);
            else if (ask.amid_edges(pixels[k]))
                amid.push_back(some[k]);
        }
        asked += some.size();
        if (asked < beyond.size() && !decided()) continue;
        const std::size_t differing = off.size();
        compared.remove_unsure(off, again);
        verdict.unsure += differing - off.size();
    }
    std::vector<std::size_t> areas = crowded(std::move(amid), ours.width);
    const std::size_t excused = areas.size();
    compared.remove_unsure(areas, again);
    verdict.in_areas = areas.size(), verdict.unsure += excused - areas.size();
    off.insert(off.end(), areas.begin(), areas.end());
    verdict.beyond_on_edges = asked - off.size() - verdict.unsure;
    for (const std::size_t i : off)
        if (apart[i] > verdict.worst_off_edges)
            verdict.worst_off_edges = apart[i], verdict.x = pixel(i).x, verdict.y = pixel(i).y;
    off.insert(off.end(), beyond.begin() + std::ptrdiff_t(asked), beyond.end());
    verdict.beyond_off_edges = off.size();
    for (const std::size_t i : off) verdict.places.push_back({pixel(i).x, pixel(i).y});
    return verdict;
}

}  // namespace strahl

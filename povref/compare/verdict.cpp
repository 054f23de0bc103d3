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

/// POV-Ray's pictures of the same view.
class Repeated {
  public:
    Repeated(const Picture& first, const Again& more) : theirs(first), again(more) {}
    /// Removes from `off` the pixels in which these pictures differ, of which ours differ by `apart` of theirs.
    void remove_unsure(std::vector<std::size_t>& off, const std::vector<int>& apart) {
        constexpr int enough = 4;
        int in_vain = 0;
        for (std::size_t k = 0; again && k < most_again && in_vain < enough && !off.empty(); ++k) {
            const bool made = k == pictures.size();
            if (made) pictures.push_back(again(int(k)));
            const std::size_t before = off.size();
            if (same_view(pictures[k], apart))
                std::erase_if(off, [&](std::size_t i) {
                    const int moved = between(pictures[k], i);
                    return moved > 1 && 2 * moved >= apart[i];
                });
            if (made) in_vain = off.size() == before ? in_vain + 1 : 0;
        }
    }

  private:
    int between(const Picture& other, std::size_t i) const {
        return steps_apart(theirs.values, theirs.channels, other.values, other.channels, i);
    }
    /// Are most pixels the same of those in which ours is? A camera that cannot be moved would show another view.
    bool same_view(const Picture& other, const std::vector<int>& apart) const {
        std::size_t same = 0, all = 0;
        for (std::size_t i = 0; i < apart.size(); ++i)
            if (apart[i] <= 1) ++all, same += between(other, i) <= 1;
        return 2 * same > all;
    }

    const Picture& theirs;
    const Again& again;
    std::vector<Picture> pictures;
};

}  // namespace

Verdict judge(Tracer& tracer, const View& view, const Frame& ours, const Picture& theirs, const std::atomic<bool>* stop,
              const Again& again) {
    if (theirs.width != ours.width || theirs.height != ours.height || theirs.channels < 3)
        throw FileError("POV-Ray's picture has another size");
    ThreadPool alone(1);
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
    Repeated repeated(theirs, again);
    for (std::size_t first = 0; first < beyond.size(); first += together) {
        const auto some = std::span(beyond).subspan(first, std::min(together, beyond.size() - first));
        std::vector<Pixel> pixels;
        for (const std::size_t i : some) pixels.push_back(pixel(i));
        const auto decided = [&] { return verdict.beyond_off_edges * 50 >= verdict.pixels; };
        std::vector<bool> edges(some.size());
        if (!decided()) edges = on_edges(tracer, view, alone, pixels, edge_radius, 1. / 65535, stop);
        if (stop && *stop) throw Stopped{};
        std::vector<std::size_t> off;
        for (std::size_t k = 0; k < some.size(); ++k)
            if (!edges[k]) off.push_back(some[k]);
        const std::size_t differing = off.size();
        if (!decided()) repeated.remove_unsure(off, apart);
        verdict.unsure += differing - off.size();
        verdict.beyond_on_edges += some.size() - differing;
        for (const std::size_t i : off) {
            if (!decided() && apart[i] > verdict.worst_off_edges)
                verdict.worst_off_edges = apart[i], verdict.x = pixel(i).x, verdict.y = pixel(i).y;
            ++verdict.beyond_off_edges;
            verdict.places.push_back({pixel(i).x, pixel(i).y});
        }
    }
    return verdict;
}

}  // namespace strahl

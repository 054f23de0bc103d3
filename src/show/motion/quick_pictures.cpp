#include "show/motion/quick_pictures.h"

#include <algorithm>
#include <cstdlib>

namespace strahl {
namespace {

/// Multiplies the light that finished pictures may lack by pruning, to about .2 of white. Bounds are far above what is
/// lost: an RMS of .04 to .6 steps of 1/255 (tests/bench/motion_quality.md).
constexpr double pruned_more = 100;

/// Returns the quotient of steps with which neighbours differ as much in rows as in columns, given a picture traced
/// with these steps. Floors, and what mirrors show of them, are far more detailed from row to row than from column to
/// column.
double suited_aspect(const ScreenImage& traced, Steps steps) {
    const auto green = [](std::uint32_t color) { return static_cast<int>(color >> 8 & 255); };
    std::int64_t across = 1, down = 1;  // sums of differences; no quotient is 0 or infinite
    for (int y = 1; y < traced.height; y += 2) {
        const std::uint32_t *const above = &traced.pixels[std::size_t(y - 1) * traced.width], *const row =
                                                                                                  above + traced.width;
        for (int x = 1; x < traced.width; ++x) {
            across += std::abs(green(row[x]) - green(row[x - 1]));
            down += std::abs(green(row[x]) - green(above[x]));
        }
    }
    return std::clamp(double(steps.x) / steps.y * down / across, .25, 4.);
}

}  // namespace

int QuickPictures::choose(int width, int height, const Wish& wish) {
    return resolution.choose(width, height, wish.budget, wish.finest,
                             wish.sharpened_until > 0 ? Sharpener::first_share : 1);
}

Counts QuickPictures::trace(Tracer& tracer, const Job& order, const TransferTable& table, const Wish& wish, int level,
                            const std::function<double()>& clock, bool learns, ScreenImage& picture) {
    Job job = order;
    job.view.error *= pruned_more;
    const View& view = job.view;
    const Steps steps = steps_of(level, aspect);
    const Lattice pixels = pixels_of(steps, view.width, view.height);
    ScreenImage& traced = level == finest_level ? picture : coarse;
    traced.resize(pixels.columns, pixels.rows);
    const auto encode = [&](const double* rgb) { return table.pixel(rgb); };
    Counts rays = tracer.trace(job, FilledLattice{pixels, wish.contrast, encode, traced.pixels.data(),
                                                  wish.averages ? averaged_side(steps) : 0});
    if (learns) resolution.observe(count(pixels), clock());  // a stopped one would have taken even longer
    if (job.stopped()) return rays;
    if (level != finest_level) {
        picture.resize(view.width, view.height);
        expand(coarse, steps, picture, job.pool);
        aspect = suited_aspect(coarse, steps);
    }
    if (const double left = wish.sharpened_until - clock(); left > 0)
        rays += sharpener.sharpen(tracer, job, table, coarse, steps, left, clock, picture);
    return rays;
}

}  // namespace strahl

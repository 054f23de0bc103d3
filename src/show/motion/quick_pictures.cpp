#include "show/motion/quick_pictures.h"

namespace strahl {
namespace {

/// Multiplies the light that finished pictures may lack by pruning, to about .2 of white. Bounds are far above what is
/// lost: an RMS of .04 to .6 steps of 1/255 (tests/bench/motion_quality.md).
constexpr double pruned_more = 100;

}  // namespace

int QuickPictures::choose(int width, int height, const Wish& wish) {
    return resolution.choose(width, height, wish.budget, wish.finest,
                             wish.sharpened_until > 0 ? Sharpener::first_share : 1);
}

Counts QuickPictures::trace(Tracer& tracer, const Job& order, const TransferTable& table, const Wish& wish,
                            int level, const std::function<double()>& clock, bool learns, ScreenImage& picture) {
    Job job = order;
    job.view.error *= pruned_more;
    const View& view = job.view;
    const Steps steps = steps_of(level);
    const Lattice pixels = pixels_of(level, view.width, view.height);
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
    }
    if (const double left = wish.sharpened_until - clock(); left > 0)
        rays += sharpener.sharpen(tracer, job, table, coarse, steps, left, clock, picture);
    return rays;
}

}  // namespace strahl

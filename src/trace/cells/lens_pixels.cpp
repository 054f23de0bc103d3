#include "trace/cells/lens_pixels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "num/scrambled_net.h"
#include "trace/cells/cells.h"

namespace strahl {
namespace {

constexpr std::uint32_t first_rays = 32, most_rays = 16384;
constexpr std::size_t most_targets = 8;  // where more bodies are seen, rays that are not aimed find enough of them

/// Returns the largest standard deviation of eight independent nets that a pixel may have. One net of all their points
/// is better, by how much depends on the world; the factor was found by experiment (tests/bench/lens.md).
double allowed_deviation(double error) { return 2.2 * error; }

/// Returns the most light that a pixel may lack where the first rays in it and those around it miss what a share of
/// them would meet.
double most_missed(double light, double share) {
    constexpr double rays = 9 * first_rays;
    return light * share * std::exp(-rays / 2 * share);
}

/// Returns whether rays through the lens are to be aimed at a body that a share of a pixel's rays meets: whether it
/// gives the mean of the first rays too large a deviation. How many of them meet it does not tell enough: pixels in
/// which few do stop early, and would lack light on average.
bool spreads(double light, double share, double error) {
    constexpr double most_share = .5;
    return share < most_share && light * std::sqrt(share / first_rays) > 4 * error;
}

double variance_of(const std::array<LensLight, LensPixels::eighths>& parts) {
    double light = 0, alpha = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        double mean = 0, squares = 0;
        for (const LensLight& part : parts) mean += part[c] / LensPixels::eighths;
        for (const LensLight& part : parts) squares += (part[c] - mean) * (part[c] - mean);
        const double variance = squares / (LensPixels::eighths * (LensPixels::eighths - 1));
        c < 3 ? light += variance / 3 : alpha = variance;
    }
    return std::max(light, alpha);
}

/// Returns whether a place, relative to its radius, is on the lens.
bool on_lens(const Camera& camera, double across, double below) {
    if (!camera.blades) return across * across + below * below <= 1;
    const double side = 2 * std::numbers::pi / std::round(*camera.blades);
    const double angle = std::atan2(across, -below), middle = (std::floor(angle / side) + .5) * side;
    return across * std::sin(middle) - below * std::cos(middle) <= std::cos(side / 2);
}

/// Is a ball so far out of focus that places on the lens are chosen for those in the pixel?
bool is_wide(const SeenBall& ball) {
    constexpr double enough = .5;
    return std::min(std::abs(ball.blur_x), std::abs(ball.blur_y)) > enough;
}

/// Returns the area of the lens for a radius of 1.
double area_of_lens(const Camera& camera) {
    if (!camera.blades) return std::numbers::pi;
    const double corners = std::round(*camera.blades);
    return corners / 2 * std::sin(2 * std::numbers::pi / corners);
}

/// Returns the area that a disc of radius 1 shares with one of another radius, whose middle is `apart` from its own.
double shared_area(double radius, double apart) {
    if (apart >= 1 + radius) return 0;
    if (apart <= std::abs(1 - radius)) return std::numbers::pi * std::min(1., radius * radius);
    const double to_chord = (apart * apart + 1 - radius * radius) / (2 * apart), other = apart - to_chord;
    const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1., 1.)); };
    return angle(to_chord) + radius * radius * angle(other / radius) -
           apart * std::sqrt(std::max(1 - to_chord * to_chord, 0.));
}

/// Returns what is in [from, to) of the stretch around `middle`.
std::array<double, 2> stretch_around(double middle, double half, double from, double to) {
    return {std::clamp(middle - half, from, to), std::clamp(middle + half, from, to)};
}

}  // namespace

void LensPixels::begin(int x, int y, int own_columns, int own_rows, double error, const Camera& own_camera,
                       int own_moments, const BrightSpots* spots) {
    left = x, top = y, columns = own_columns, rows = own_rows, moments = own_moments;
    aim = error, bright = spots;
    camera = own_camera, lens = has_lens(camera);
    const auto count = static_cast<std::size_t>(columns) * rows;
    pixels.assign(count, {});
    means.assign(3 * count, 0);
    open.resize(count);
    for (std::size_t i = 0; i < count; ++i) open[i] = static_cast<int>(i);
    if (bright) find_targets();
}

void LensPixels::NetSums::make_room() {
    for (std::size_t k = 0; k < eighths; ++k) {
        const bool known = 2 * k < eighths;
        for (std::size_t c = 0; c < 4; ++c) light[k][c] = known ? light[2 * k][c] + light[2 * k + 1][c] : 0;
        weights[k] = known ? weights[2 * k] + weights[2 * k + 1] : 0;
    }
}

LensLight LensPixels::NetSums::mean() const {
    LensLight sum{};
    double all = 0;
    for (std::size_t k = 0; k < eighths; ++k) {
        for (std::size_t c = 0; c < 4; ++c) sum[c] += light[k][c];
        all += weights[k];
    }
    for (double& value : sum) value = all > 0 ? value / all : 0;
    return sum;
}

LensLight LensPixels::NetSums::mean(int eighth) const {
    const auto k = static_cast<std::size_t>(eighth);
    if (!(weights[k] > 0)) return mean();
    LensLight part = light[k];
    for (double& value : part) value /= weights[k];
    return part;
}

template <class... Eighth>
LensLight LensPixels::light_of(const LensPixel& pixel, const PixelSums& sums, Eighth... eighth) const {
    LensLight all = sums.own.mean(eighth...);
    double rest = 1;
    for (const Target& target : pixel.targets) rest -= target.share;
    for (double& value : all) value *= rest;
    for (std::size_t k = 0; k < pixel.targets.size(); ++k) {
        const LensLight part = sums.targets[k].mean(eighth...);
        for (std::size_t c = 0; c < 4; ++c) all[c] += pixel.targets[k].share * part[c];
    }
    return all;
}

/// Finds the spots that rays of pixels are to be aimed at, the brightest first.
void LensPixels::find_targets() {
    const std::vector<BrightSpot>& spots = bright->spots();
    const auto light_at = [&](const Target& target) {
        return spots[static_cast<std::size_t>(target.spot)].light * target.share;
    };
    std::vector<int> seen;  // pixels that see the spot
    for (std::size_t i = 0; i < spots.size(); ++i) {
        const int count = static_cast<int>(spots[i].seen.size());
        for (int moment = 0; moment < count; ++moment) {
            const SeenBall& ball = spots[i].seen[static_cast<std::size_t>(moment)];
            if (!(ball.half_x > 0)) continue;
            const auto [from_x, to_x] =
                stretch_around(ball.x - left + .5, ball.half_x + std::abs(ball.blur_x), 0, columns);
            const auto [from_y, to_y] = stretch_around(ball.y - top + .5, ball.half_y + std::abs(ball.blur_y), 0, rows);
            for (int y = static_cast<int>(from_y); y < to_y; ++y)
                for (int x = static_cast<int>(from_x); x < to_x; ++x) {
                    std::vector<Target>& targets = pixels[static_cast<std::size_t>(y * columns + x)].targets;
                    if (targets.empty() || targets.back().spot != static_cast<int>(i)) {
                        targets.push_back({static_cast<int>(i), moment, moment});
                        seen.push_back(y * columns + x);
                    }
                    targets.back().last = moment + 1;
                    targets.back().share += ball.share() / count;
                }
        }
        for (const int pixel : seen) {
            std::vector<Target>& targets = pixels[static_cast<std::size_t>(pixel)].targets;
            const double light = spots[i].light, share = targets.back().share;
            if (!(lens ? spreads(light, share, aim) : most_missed(light, share) > 4 * aim)) {
                targets.pop_back();
                continue;
            }
            for (std::size_t k = targets.size(); --k > 0 && light_at(targets[k]) > light_at(targets[k - 1]);)
                std::swap(targets[k], targets[k - 1]);
            if (targets.size() > most_targets) targets.pop_back();
        }
        seen.clear();
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        pixels[i].sums.targets.resize(pixels[i].targets.size());
        for (std::size_t k = 0; k < pixels[i].targets.size(); ++k)
            pixels[i].targets[k].share = share_of(static_cast<int>(i), k, 0);
    }
}

bool LensPixels::meets(const LensPixel& pixel, std::size_t targets, const LensRay& ray, int moment) const {
    return std::any_of(pixel.targets.begin(), pixel.targets.begin() + std::ptrdiff_t(targets), [&](const Target& own) {
        const SeenBall& ball =
            bright->spots()[static_cast<std::size_t>(own.spot)].seen[static_cast<std::size_t>(moment)];
        return own.first <= moment && moment < own.last && ball.meets(ray.x, ray.y, ray.across, ray.below);
    });
}

LensPixels::AimedRay LensPixels::aimed(int number, std::size_t target, const std::array<double, 5>& point) const {
    const LensPixel& pixel = pixels[static_cast<std::size_t>(number)];
    const Target& own = pixel.targets[target];
    const int moment = own.first + static_cast<int>(point[4] * (own.last - own.first));
    const SeenBall& ball = bright->spots()[static_cast<std::size_t>(own.spot)].seen[static_cast<std::size_t>(moment)];
    const double x = left + number % columns - .5, y = top + number / columns - .5;
    LensRay ray{x + point[0], y + point[1], 0, 0, double(own.last - own.first) / std::max(moments, 1)};
    if (lens) {
        const auto [across, below] = lens_place(camera, point[2], point[3]);
        ray.across = across, ray.below = below;
    }
    // Chooses the place on the lens for one in the pixel, or the other way round in the plane in focus.
    const auto choose = [&](double& place, double share, double middle, double half, double from, double to) {
        const auto [low, high] = stretch_around(middle, half, from, to);
        place = std::min(low + share * (high - low), std::nextafter(to, from));
        ray.weight *= high - low;
    };
    if (is_wide(ball)) {
        choose(ray.across, point[2], (ball.x - ray.x) / ball.blur_x, ball.half_x / std::abs(ball.blur_x), -1, 1);
        choose(ray.below, point[3], (ball.y - ray.y) / ball.blur_y, ball.half_y / std::abs(ball.blur_y), -1, 1);
        ray.weight = on_lens(camera, ray.across, ray.below) ? ray.weight / area_of_lens(camera) : 0;
    } else {
        choose(ray.x, point[0], ball.x - ball.blur_x * ray.across, ball.half_x, x, x + 1);
        choose(ray.y, point[1], ball.y - ball.blur_y * ray.below, ball.half_y, y, y + 1);
    }
    if (!ball.meets(ray.x, ray.y, ray.across, ray.below) || meets(pixel, target, ray, moment)) ray.weight = 0;
    return {ray, moment};
}

/// Finds the share of a target by many places in the pixel, without tracing. The part of a round lens that sees a ball
/// out of focus from a place is what two discs share; else many places on the lens are tried too.
double LensPixels::share_of(int pixel, std::size_t target, std::uint32_t seed) const {
    constexpr double root = 1.1347241384015194;  // of x^6 = x + 1 (the sequence R5 of M. Roberts, 2018)
    const Target& own = pixels[static_cast<std::size_t>(pixel)].targets[target];
    const auto balls =
        std::span(bright->spots()[static_cast<std::size_t>(own.spot)].seen)
            .subspan(static_cast<std::size_t>(own.first), static_cast<std::size_t>(own.last - own.first));
    const bool discs = lens && !camera.blades && target == 0 && std::ranges::all_of(balls, is_wide);
    const auto share_at = [&](const std::array<double, 5>& point) {
        if (!discs) return aimed(pixel, target, point).ray.weight;
        const SeenBall& ball = balls[static_cast<std::size_t>(point[4] * double(balls.size()))];
        const double x = (ball.x - (left + pixel % columns - .5 + point[0])) / ball.blur_x;
        const double y = (ball.y - (top + pixel / columns - .5 + point[1])) / ball.blur_y;
        return double(balls.size()) / std::max(moments, 1) / std::numbers::pi *
               shared_area(ball.half_x / std::abs(ball.blur_x), std::hypot(x, y));
    };
    const int points = discs ? 2048 : 4096;
    std::array<double, 5> point{.5, .5, .5, .5, .5};
    for (double& at : point)
        if (seed > 0) seed = ScrambledNet::mix(seed), at = seed * 0x1p-32;
    double sum = 0;
    for (int i = 0; i < points; ++i) {
        double step = 1;
        for (double& at : point) step /= root, at += step, at -= std::floor(at);
        sum += share_at(point);
    }
    return sum / points;
}

std::uint32_t LensPixels::seed_of(int pixel) const {
    const int x = left + pixel % columns, y = top + pixel / columns;
    return ScrambledNet::mix(static_cast<std::uint32_t>(y) * 65536u + static_cast<std::uint32_t>(x));
}

/// Collects rays by their moments, and traces many at once.
class LensPixels::Rays {
  public:
    Rays(const LensPixels& pixels, const TraceLensRays& own_trace, bool own_check)
        : tile(pixels), trace(own_trace), check(own_check), buckets(pixels.moments + 1) {}
    /// Adds the light of the ray to `sum` later, by its weight.
    void add(const LensRay& ray, int moment, double* sum) {
        buckets[moment].rays.push_back(ray), buckets[moment].to.push_back(sum), ++count;
    }
    /// To be called between pixels, so that sums do not depend on the tile.
    void flush_if_many() {
        if (count >= 128 * std::max<std::size_t>(32, tile.moments)) flush();
    }
    void flush() {
        for (int moment = 0; moment <= tile.moments; ++moment) {
            auto& [rays, to] = buckets[moment];
            if (rays.empty()) continue;
            light.assign(rays.size(), {});
            trace(moment, rays, light, check);
            for (std::size_t i = 0; i < rays.size(); ++i)
                for (int c = 0; c < 4; ++c) to[i][c] += rays[i].weight * light[i][c];
            rays.clear(), to.clear();
        }
        count = 0;
    }

  private:
    struct Bucket {
        std::vector<LensRay> rays;
        std::vector<double*> to;  // of each ray
    };
    const LensPixels& tile;
    const TraceLensRays& trace;
    const bool check;
    std::vector<Bucket> buckets;  // by moment
    std::vector<LensLight> light;
    std::size_t count = 0;
};

void LensPixels::trace_nets(std::span<const NetPart> parts, const TraceLensRays& trace, bool check) const {
    Rays rays(*this, trace, check);
    for (const NetPart& part : parts) {
        const LensPixel& pixel = pixels[static_cast<std::size_t>(part.pixel)];
        const double x = left + part.pixel % columns - .5, y = top + part.pixel / columns - .5;
        double rest = 1;  // the share of the pixel's rays that meet no target
        for (const Target& target : pixel.targets) rest -= target.share;
        std::vector<std::pair<AimedRay, std::uint32_t>> found;  // with the numbers of their points
        // Adds what was found, so weighted that it counts in the pixel by this share: also in layers, which are
        // averaged over all rays.
        const auto add_found = [&](NetSums& sums, double share) {
            double all = 0;
            for (const auto& [own, i] : found) all += own.ray.weight;
            for (auto& [own, i] : found) {
                if (!pixel.targets.empty()) own.ray.weight *= share * (part.last - part.first) / all;
                const std::uint64_t eighth = std::uint64_t(i) * eighths / part.last;
                rays.add(own.ray, own.moment, sums.light[eighth].data());
                sums.weights[eighth] += own.ray.weight;
            }
            found.clear();
        };
        const auto add_own = [&](const LensRay& ray, double time, std::uint32_t i) {
            const int moment = static_cast<int>(time * moments);
            if (!meets(pixel, pixel.targets.size(), ray, moment)) found.push_back({{ray, moment}, i});
        };
        const ScrambledNet net(part.seed);
        for (std::uint32_t i = part.first; i < part.last; ++i) {
            if (!lens) {
                const auto [u, v, time] = net.point<3>(i);
                add_own({x + u, y + v, 0, 0}, time, i);
                continue;
            }
            const auto through = [&](double u, double v, double s, double t) {
                const auto [across, below] = lens_place(camera, s, t);
                return LensRay{x + u, y + v, across, below};
            };
            if (moments > 0) {
                const auto [u, v, s, t, time] = net.point<5>(i);
                add_own(through(u, v, s, t), time, i);
            } else {
                const auto [u, v, s, t] = net.point(i);
                add_own(through(u, v, s, t), 0, i);
            }
        }
        add_found(part.sums->own, rest);
        for (std::size_t k = 0; k < pixel.targets.size(); ++k) {
            const ScrambledNet other(ScrambledNet::mix(part.seed + 8 + static_cast<std::uint32_t>(k)));
            for (std::uint32_t i = part.first; i < part.last; ++i) {
                const AimedRay ray = aimed(part.pixel, k, other.point<5>(i));
                if (ray.ray.weight > 0) found.push_back({ray, i});
            }
            add_found(part.sums->targets[k], pixel.targets[k].share);
        }
        rays.flush_if_many();
    }
    rays.flush();
}

void LensPixels::keep_still(std::span<const double> values, std::span<const std::uint32_t> counts,
                            const TraceLensRays& trace) {
    constexpr std::uint32_t tests = 2 * coarsest_cell * coarsest_cell;
    const double unseen = aim / 4;
    struct StillSquare {
        int x, y, columns, rows;
        std::array<std::array<LensLight, 2>, tests> light{};  // at a moment, and at the view's time
    };
    std::vector<StillSquare> squares;
    for (int y = 0; y < rows; y += coarsest_cell)
        for (int x = 0; x < columns; x += coarsest_cell)
            squares.push_back({x, y, std::min(coarsest_cell, columns - x), std::min(coarsest_cell, rows - y)});
    Rays rays(*this, trace, false);
    for (StillSquare& square : squares) {
        const ScrambledNet net(ScrambledNet::mix(seed_of(square.y * columns + square.x) + 4));
        for (std::uint32_t i = 0; i < tests; ++i) {
            const auto [u, v, time] = net.point<3>(i);
            const double x = left + square.x + u * square.columns - .5, y = top + square.y + v * square.rows - .5;
            rays.add({x, y, 0, 0}, static_cast<int>(time * moments), square.light[i][0].data());
            rays.add({x, y, 0, 0}, moments, square.light[i][1].data());
        }
        rays.flush_if_many();
    }
    rays.flush();
    const auto changes = [&](const auto& pair) {
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(pair[0][c] - pair[1][c]) <= unseen)) return true;
        return false;
    };
    open.clear();
    for (const StillSquare& square : squares) {
        bool moving = std::ranges::any_of(square.light, changes);
        for (int y = square.y; y < square.y + square.rows; ++y)
            for (int x = square.x; x < square.x + square.columns; ++x)
                moving |= !pixels[static_cast<std::size_t>(y * columns + x)].targets.empty();
        for (int y = square.y; y < square.y + square.rows; ++y)
            for (int x = square.x; x < square.x + square.columns; ++x) {
                const int number = y * columns + x;
                if (moving) {
                    open.push_back(number);
                    continue;
                }
                pixels[number].taken = counts[number];
                std::copy_n(&values[std::size_t(3) * number], 3, &means[std::size_t(3) * number]);
            }
    }
}

void LensPixels::take(std::uint32_t rays, const TraceLensRays& trace) {
    std::vector<NetPart> parts;
    for (const int number : open) {
        LensPixel& pixel = pixels[number];
        if (pixel.taken > 0) {
            pixel.sums.own.make_room();
            for (NetSums& sums : pixel.sums.targets) sums.make_room();
        }
        parts.push_back({number, seed_of(number), pixel.taken, std::max(rays, 2 * pixel.taken), &pixel.sums});
        pixel.taken = parts.back().last;
    }
    trace_nets(parts, trace, false);
    for (const int number : open) {
        LensPixel& pixel = pixels[number];
        std::array<LensLight, eighths> light;
        for (int k = 0; k < eighths; ++k) light[static_cast<std::size_t>(k)] = light_of(pixel, pixel.sums, k);
        pixel.variance = variance_of(light);
        std::copy_n(light_of(pixel, pixel.sums).begin(), 3, &means[std::size_t(3) * number]);
    }
}

void LensPixels::refine(bool all, const TraceLensRays& trace) {
    do {
        take(first_rays, trace);
        settle();
    } while (all && !open.empty());
}

/// Finds the pixels that need more rays. Few rays may all have missed what a neighbour has found.
void LensPixels::settle() {
    const double limit = allowed_deviation(aim) * allowed_deviation(aim);
    open.clear();
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const int number = y * columns + x;
            if (pixels[number].taken >= most_rays) continue;
            const auto from = [](int at) { return std::max(at / coarsest_cell * coarsest_cell, at - 1); };
            const auto to = [](int at, int end) {
                return std::min({at / coarsest_cell * coarsest_cell + coarsest_cell, at + 2, end});
            };
            double sum = 0;
            int count = 0;
            for (int v = from(y); v < to(y, rows); ++v)
                for (int u = from(x); u < to(x, columns); ++u, ++count) sum += pixels[v * columns + u].variance;
            if (std::max(pixels[number].variance, sum / count) > limit) open.push_back(number);
        }
}

std::vector<std::uint32_t> LensPixels::counts() const {
    std::vector<std::uint32_t> all;
    for (const LensPixel& pixel : pixels) all.push_back(pixel.taken);
    return all;
}

MeasuredError LensPixels::measured(double chance, const TraceLensRays& trace) const {
    const auto checks = [&](int pixel) { return 2 * std::max(pixels[pixel].taken, first_rays); };
    std::vector<int> chosen;
    for (int i = 0; i < columns * rows; ++i)
        if (ScrambledNet::mix(seed_of(i) + 1) * 0x1p-32 < chance) chosen.push_back(i);
    std::vector<std::array<PixelSums, 2>> sums(chosen.size());
    std::vector<NetPart> parts;
    for (std::size_t k = 0; k < chosen.size(); ++k)
        for (std::uint32_t half = 0; half < 2; ++half) {
            sums[k][half].targets.resize(pixels[chosen[k]].targets.size());
            parts.push_back(
                {chosen[k], ScrambledNet::mix(seed_of(chosen[k]) + 2 + half), 0, checks(chosen[k]), &sums[k][half]});
        }
    trace_nets(parts, trace, true);
    MeasuredError error{.checked = chosen.size()};
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        // The shares of the pixel are not exact: checks have others, so that the estimate contains their errors.
        LensPixel pixel = pixels[static_cast<std::size_t>(chosen[k])];
        const auto checked = [&](std::uint32_t half) {
            for (std::size_t t = 0; t < pixel.targets.size(); ++t)
                pixel.targets[t].share = share_of(chosen[k], t, seed_of(chosen[k]) + 2 + half);
            return light_of(pixel, sums[k][half]);
        };
        const LensLight first = checked(0), second = checked(1);
        double product = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double own = means[std::size_t(3) * chosen[k] + c];
            product += (first[c] - own) * (second[c] - own) / 3;
        }
        error.squares += product / chance, error.variance += product / chance * (product / chance);
    }
    return error;
}

}  // namespace strahl

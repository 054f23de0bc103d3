#include "pov/things/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "num/vec_math.h"

namespace strahl::pov {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

double wrapped(double value, double size) {
    const double rest = std::fmod(value, size), own = rest < 0 ? rest + size : rest;
    return own >= size ? 0 : own;
}

/// Returns the angle around the y axis, from x towards z, as a share of a turn.
double turn(double x, double z) {
    const double angle = std::atan2(z, x) / whole_turn;
    return angle < 0 ? angle + 1 : angle;
}

double encoded(double light, double encoding) {
    if (encoding != 0) return std::pow(light, 1 / encoding);
    return light <= .0031308 ? light * 12.92 : 1.055 * std::pow(light, 1 / 2.4) - .055;
}

/// Returns a picture's values as values of the scene. Those of files of 8 and 16 bits are computed once each.
std::vector<float> scene_values_of(const std::vector<float>& given, double encoding, double working) {
    const auto value_of = [&](double own) { return static_cast<float>(encoded(decoded(own, encoding), working)); };
    std::vector<float> known(65536, -1), values;
    for (const float own : given) {
        const double code = static_cast<double>(own) * 65535, whole = std::round(code);
        if (!(whole >= 0 && whole <= 65535 && std::fabs(code - whole) < .01)) {
            values.push_back(value_of(static_cast<double>(own)));
            continue;
        }
        float& value = known[static_cast<std::size_t>(whole)];
        if (value < 0) value = value_of(whole / 65535);
        values.push_back(value);
    }
    return values;
}

/// Returns one value as POV-Ray computes it in single precision; gammas that differ by a hundredth are the same there.
float single_value_of(float value, double encoding, double working) {
    const auto same = [](double a, double b) { return std::fabs(1 - a / b) <= .01; };
    const auto power = [](float base, double exponent) { return std::pow(base, static_cast<float>(exponent)); };
    if (encoding != 0 && working != 0) return same(working, encoding) ? value : power(value, encoding / working);
    if (encoding == working) return value;
    if (encoding != 0) {
        const float light = power(value, encoding);
        return light <= .0031308f ? light * 12.92f : 1.055f * power(light, 1 / 2.4) - .055f;
    }
    const float light = value < .04045f ? value / 12.92f : power((value + .055f) / 1.055f, 2.4);
    return same(working, 1) ? light : power(light, 1 / working);
}

struct PictureColors : FunctionThing {
    explicit PictureColors(const ImageThing& given) : image(given), pixels(*given.pixels) {
        results = 5;
        if (!image.encoding || *image.encoding == image.working) {
            all = {image.pixels, &pixels.values};
        } else {
            all = image.facts->decoded[{*image.encoding, image.working}];
            if (!all)
                all = std::make_shared<const std::vector<float>>(
                    scene_values_of(pixels.values, *image.encoding, image.working));
            image.facts->decoded[{*image.encoding, image.working}] = all;
        }
    }
    void evaluate(const double* given, double* result) const override {
        if (const auto place = place_of({given[0], given[1], given[2]})) return color_at(*place, result);
        result[0] = result[1] = result[2] = result[4] = 1, result[3] = 0;
    }
    /// Finds the colour at a place in pixels.
    void color_at(const Point2& place, double* result) const {
        std::fill_n(result, 5, 0.);
        result[3] = image.filter_all.value_or(0), result[4] = image.transmit_all.value_or(0);
        const auto add = [&](double x, double y, double weight) {
            const auto at = [&](double own, int size) {
                return std::size_t(image.once ? std::clamp(own, 0., size - 1.) : wrapped(own, size));
            };
            const std::size_t i = at(y, pixels.height) * std::size_t(pixels.width) + at(x, pixels.width);
            for (std::size_t c = 0; c < 3; ++c) result[c] += weight * static_cast<double>((*all)[3 * i + c]);
            if (!pixels.opacity.empty()) result[4] += weight * (1 - static_cast<double>(pixels.opacity[i]));
        };
        auto [x, y] = place;
        if (image.interpolate < 2) return add(x, y, 1);
        // Places between the middles of pixels: p and q of the way from the one at (x - 1, y - 1).
        const double p = x + .5 - std::floor(x + .5), q = y + .5 - std::floor(y + .5);
        x = std::floor(x + .5), y = std::floor(y + .5);
        if (image.interpolate == 3) {
            const auto cubic = [](double t) {
                const double s = 1 - t;
                return std::array{-.5 * t * s * s, .5 * s * (s * (3 * t + 1) + 1), .5 * t * (t * (3 * s + 1) + 1),
                                  -.5 * s * t * t};
            };
            const auto across = cubic(p), down = cubic(q);
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < 4; ++j) add(x + double(i) - 2, y + double(j) - 2, across[i] * down[j]);
            return;
        }
        double weights[4]{p * q, (1 - p) * q, p * (1 - q), (1 - p) * (1 - q)};
        if (image.interpolate == 4) {  // by the inverses of squared distances
            const double r = 1 - p, s = 1 - q;
            const double squares[4]{r * r + s * s, p * p + s * s, r * r + q * q, p * p + q * q};
            double sum = 0;
            for (int i = 0; i < 4; ++i) sum += weights[i] = 1 / std::max(squares[i], 1e-300);
            for (double& own : weights) own /= sum;
        }
        add(x, y, weights[0]), add(x - 1, y, weights[1]), add(x, y - 1, weights[2]), add(x - 1, y - 1, weights[3]);
    }
    /// Returns the place of a point in pixels from the upper left corner; none beside a picture that is shown once.
    std::optional<Point2> place_of(const DVec3& p) const {
        constexpr double nearly = 1e-10;  // POV-Ray's EPSILON
        const double size = length(p), away = std::hypot(p.x, p.z);
        double u = p.x, v = p.y;
        switch (image.map_type) {
            case 1:
                if (size == 0) return {};
                u = turn(p.x, p.z), v = .5 + 2 * std::asin(p.y / size) / whole_turn;
                break;
            case 2:
                if (away == 0) return {};
                u = turn(p.x, p.z);
                break;
            case 5: {
                if (away == 0) return {};
                const double around =
                    std::acos(std::clamp((1 - away) / std::hypot(away - 1, p.y), -1., 1.)) / whole_turn;
                u = turn(p.x, p.z), v = p.y > 0 ? 1 - around : around;
                break;
            }
            default:
                if (image.once && !(u >= 0 && u <= 1)) return {};
        }
        if (image.once && (image.map_type == 0 || image.map_type == 2) && !(v >= 0 && v <= 1)) return {};
        const double width = pixels.width, height = pixels.height;
        const double x = std::fmod(u * image.repeat[0] * width, width) - image.offset[0] * width + nearly;
        const double y = std::fmod(v * image.repeat[1] * height, height) - image.offset[1] * height + nearly;
        if (!std::isfinite(x) || !std::isfinite(y)) return {};
        if (image.once && !(x >= 0 && x < width && y >= 0 && y < height)) return {};
        return Point2{wrapped(x, width), wrapped(-y, height)};
    }
    const ImageThing image;
    const FilePixels& pixels;
    std::shared_ptr<const std::vector<float>> all;  // as values of the scene
};

double bright(const double (&c)[5]) { return brightness[0] * c[0] + brightness[1] * c[1] + brightness[2] * c[2]; }

/// Bends normals as the plane through the heights of three places a pixel apart, where y is the normal.
struct PictureBends : SolidFunction {
    PictureBends(const ImageThing& image, double amount) : colors(image), amount(amount) {}
    double value_at(const DVec3&) const override { return 0; }
    std::optional<DVec3> bend_at(const DVec3& point, const DVec3& normal) const override {
        const auto place = colors.place_of(point);
        if (!place) return DVec3(0);
        const auto height = [&](double across, double down) {
            const double width = colors.pixels.width, height = colors.pixels.height;
            double c[5];
            colors.color_at({wrapped((*place)[0] + across, width), wrapped((*place)[1] + down, height)}, c);
            return amount * bright(c);
        };
        const double own = height(0, 0), left = height(-1, 1), right = height(1, 1);
        const DVec3 bend = normalize(DVec3(left - right, 2, 2 * own - left - right));
        const DVec3 side = cross_product(normal, DVec3(0, 1, 0));
        const bool upright = length(side) < 1e-10;
        const DVec3 x = upright ? DVec3(1, 0, 0) : normalize(side);
        const DVec3 y = upright ? DVec3(0, normal.y > 0 ? 1 : -1, 0) : normal;
        return bend.x * x + bend.y * y - bend.z * cross_product(x, y) - normal;
    }
    const PictureColors colors;
    const double amount;
};

struct PictureValues : SolidFunction {
    explicit PictureValues(const ImageThing& image) : colors(image), by_alpha(image.use_alpha) {}
    double value_at(const DVec3& point) const override {
        const auto place = colors.place_of(point);
        if (!place) return 0;
        double c[5];
        colors.color_at(*place, c);
        return std::clamp(!by_alpha ? bright(c) : colors.pixels.opacity.empty() ? c[0] : c[4], 0., 1.);
    }
    const PictureColors colors;
    const bool by_alpha;
};

}  // namespace

double decoded(double value, double encoding) {
    if (encoding != 0) return std::pow(value, encoding);
    return value <= .04045 ? value / 12.92 : std::pow((value + .055) / 1.055, 2.4);
}

std::shared_ptr<const FunctionThing> colors_of(const ImageThing& image) {
    if (!image.pixels) return nullptr;
    if (!image.colors) image.colors = std::make_shared<const PictureColors>(image);
    return image.colors;
}

std::shared_ptr<const FilePixels> grey_values_of(const ImageThing& image) {
    auto made = std::make_shared<FilePixels>(*image.pixels);
    made->largest = Color(0);
    for (float& value : made->values) {
        const float own = image.encoding ? single_value_of(value, *image.encoding, image.working) : value;
        const float grey = own * .297f + own * .589f + own * .114f;
        value = std::floor(std::min(grey, 1.f) * 255.f) / 255.f;
        made->largest = max(made->largest, Color(double(value)));
    }
    return made;
}

std::shared_ptr<const Pixels> shown_pixels(const ImageThing& image, double gamma) {
    const bool linear = image.pixels->linear;
    const bool same = gamma == 0 ? !image.encoding || *image.encoding == image.working
                                 : image.encoding == std::optional(linear ? 1. : 0.) && image.working == gamma;
    if (same) return image.pixels;
    std::shared_ptr<const Pixels>& known = image.facts->shown[{image.encoding.value_or(-1), image.working}];
    if (known) return known;
    auto made = std::make_shared<Pixels>(*image.pixels);
    if (image.encoding) made->values = scene_values_of(made->values, *image.encoding, image.working);
    made->largest = Color(0);
    for (std::size_t i = 0; i < made->values.size(); ++i) {
        float& own = made->values[i];
        const double light = std::pow(static_cast<double>(own), gamma);
        if (gamma != 0) own = static_cast<float>(linear ? light : encoded(light, 0));
        double& largest = made->largest[static_cast<int>(i % 3)];
        largest = std::max(largest, static_cast<double>(own));
    }
    return known = made;
}

std::shared_ptr<const SolidFunction> bends_of(const ImageThing& image, double amount) {
    return image.pixels ? std::make_shared<const PictureBends>(image, amount) : nullptr;
}

std::shared_ptr<const SolidFunction> values_of(const ImageThing& image) {
    if (!image.pixels) return nullptr;
    return std::make_shared<const PictureValues>(image);
}

}  // namespace strahl::pov

#include "pov/meaning/pigments.h"

#include <algorithm>
#include <numbers>

#include "files/words.h"
#include "num/vec_math.h"
#include "scene/error.h"

namespace strahl::pov {
namespace {

std::string word_text(std::uint16_t code) { return std::string(reserved_words[code - first_word_code]); }

/// The exchange of y and z: POV-Ray's pictures have their poles on the y axis, those of scenes on the z axis.
const MatrixStep poles{glm::dmat4(1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1)};

/// Returns the pattern's value after its wave. `v` is from 0 to 1.
double waved(Wave wave, double v) {
    const double turn = 2 * std::numbers::pi * v;
    switch (wave) {
        case Wave::triangle:
            return v < .5 ? 2 * v : 2 - 2 * v;
        case Wave::sine:
            return (1 + std::sin(turn)) / 2;
        case Wave::scallop:
            return std::fabs(std::sin(turn / 2));
        case Wave::cubic:
            return v * v * (3 - 2 * v);
        default:
            return v;
    }
}

/// The colour of a map at a value.
Color color_at(const std::vector<ColorStop>& stops, double v) {
    if (v <= stops.front().at) return stops.front().color;
    for (std::size_t i = 1; i < stops.size(); ++i)
        if (v <= stops[i].at) {
            const double share = (v - stops[i - 1].at) / (stops[i].at - stops[i - 1].at);
            return stops[i - 1].color + share * (stops[i].color - stops[i - 1].color);
        }
    return stops.back().color;
}

/// Returns the map that shows at a value what `stops` shows at its wave.
std::vector<ColorStop> with_wave(const std::vector<ColorStop>& stops, Wave wave) {
    std::vector<ColorStop> all;
    if (wave == Wave::triangle) {
        for (const ColorStop& stop : stops) all.push_back({stop.at / 2, stop.color});
        for (auto stop = stops.rbegin(); stop != stops.rend(); ++stop) all.push_back({1 - stop->at / 2, stop->color});
    } else {
        constexpr int steps = 64;
        for (int i = 0; i <= steps; ++i)
            all.push_back({double(i) / steps, color_at(stops, waved(wave, double(i) / steps))});
    }
    return all;
}

}  // namespace

PigmentMaker::Mean PigmentMaker::mean_of(const MapEntry& entry) {
    if (const auto* const pigment = dynamic_cast<const PigmentThing*>(entry.thing.get())) return mean_of(*pigment);
    return {color_of(entry.color), decimal(entry.color.filter), decimal(entry.color.transmit)};
}

PigmentMaker::Mean PigmentMaker::mean_of(const PigmentThing& pigment) {
    if (!pigment.blend) return mean_of(MapEntry{.color = pigment.color, .thing = nullptr});
    if (pigment.blend.image) {
        const ImageThing& image = *pigment.blend.image;
        const auto pixels = pixels_of(pigment.blend);
        Color sum(pixels ? 0 : .5);
        if (pixels)
            for (std::size_t i = 0; i + 2 < pixels->values.size(); i += 3)
                for (int c = 0; c < 3; ++c) sum[c] += double(pixels->values[i + std::size_t(c)]);
        if (pixels) sum = sum / (double(pixels->values.size()) / 3);
        return {sum, image.filter_all.value_or(0), image.transmit_all.value_or(0)};
    }
    if (!pigment.blend.map) return {Color(.5)};
    const std::uint16_t own = pigment.blend.word;
    return mean_of(*pigment.blend.map, own == word("checker") || own == word("brick") || own == word("hexagon") ||
                                           own == word("square") || own == word("average"));
}

/// Returns the mean of a list, or of what a map shows at values from 0 to 1.
PigmentMaker::Mean PigmentMaker::mean_of(const MapThing& map, bool list) {
    Mean sum;
    const auto add = [&](const Mean& own, double weight) {
        sum.color += weight * own.color, sum.filter += weight * own.filter, sum.transmit += weight * own.transmit;
    };
    const auto& entries = map.entries;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double before = i > 0 ? (entries[i - 1].at + entries[i].at) / 2 : 0;
        const double behind = i + 1 < entries.size() ? (entries[i].at + entries[i + 1].at) / 2 : 1;
        add(mean_of(entries[i]),
            list ? 1. / double(entries.size()) : std::clamp(behind, 0., 1.) - std::clamp(before, 0., 1.));
    }
    return sum;
}

std::vector<ColorStop> PigmentMaker::stops_of(const Blend& blend) {
    if (!blend.map) return {{0, Color(0)}, {1, Color(1)}};
    std::vector<ColorStop> stops;
    bool mixed = false;
    for (const MapEntry& entry : blend.map->entries) {
        const double at = std::clamp(decimal(static_cast<float>(entry.at)), stops.empty() ? 0 : stops.back().at, 1.);
        stops.push_back({at, mean_of(entry).color});
        const auto* const nested = dynamic_cast<const PigmentThing*>(entry.thing.get());
        mixed |= nested && nested->blend;
    }
    if (mixed) notes.approximated(blend.place, "patterns in a pigment_map are their mean colours");
    return stops;
}

std::shared_ptr<const Pixels> PigmentMaker::pixels_of(const Blend& blend) {
    const std::string& path = blend.image->path;
    const auto known = pictures.find(path);
    if (known != pictures.end()) return known->second;
    std::shared_ptr<const Pixels> pixels;
    try {
        if (!path.empty() && read_pixels) pixels = std::make_shared<const Pixels>(read_pixels(path));
    } catch (const FileError& error) {
        notes.left_out(blend.place, std::string("a picture: ") + error.what());
    }
    return pictures[path] = pixels;
}

/// Returns the transformations of a pattern, from the space of the scene's own pattern into that of the body.
std::vector<Transformation> PigmentMaker::space_of(const Blend& blend, const Steps& way, const Steps& first) const {
    Steps steps = first;
    append(steps, blend.steps);
    if (!blend.uv) append(steps, way);
    return transformations_of(steps, mirrored);
}

/// Sets the kind of a pattern that has values, and where it is. Folds waves into the map if `fold`. Returns false if
/// the scene has no such pattern.
bool PigmentMaker::set_kind(const Blend& blend, Pattern& pattern, bool fold) {
    const std::uint16_t own = blend.word;
    const bool turbulent = blend.turbulence != DVec3(0);
    const double strength =
        std::max({std::fabs(blend.turbulence.x), std::fabs(blend.turbulence.y), std::fabs(blend.turbulence.z)});
    const auto layers = [&](auto kind, double turbulence) {
        if (turbulent) {
            kind.turbulence = turbulence;
            kind.octaves = std::clamp(std::floor(blend.octaves), 1., 10.);
            kind.omega = std::clamp(blend.omega, 0., 1.), kind.lambda = std::clamp(blend.lambda, 1e-9, 1e9);
            notes.approximated(blend.place, "the turbulence of '" + word_text(own) + "' is another noise");
        }
        pattern.kind = kind;
    };
    const auto ramp = [&](const DVec3& axis, Wave usual) {
        pattern.kind = Gradient{mirror(axis, mirrored)};
        if (fold && blend.wave.value_or(usual) != Wave::ramp)
            pattern.colors = with_wave(pattern.colors, blend.wave.value_or(usual));
        if (turbulent) notes.approximated(blend.place, strahl::quoted(word_text(own)) + " without turbulence");
    };
    switch (own) {
        case word("gradient"):
            ramp(blend.axis, Wave::ramp);
            return true;
        case word("marble"):
            if (blend.wave && *blend.wave != Wave::triangle) return ramp(DVec3(1, 0, 0), Wave::triangle), true;
            return layers(Marble(), std::fabs(blend.turbulence.x)), true;
        case word("wood"):
            layers(Wood(), strength);
            if (blend.wave && *blend.wave != Wave::triangle)
                notes.approximated(blend.place, "'wood' has a triangle_wave");
            return true;
        case word("planar"):
            // 1 - |y| up to 1 from the plane, repeated far away.
            pattern.kind = Gradient{DVec3(0, 1, 0)};
            if (turbulent) notes.approximated(blend.place, "'planar' without turbulence");
            return fold;
        case word("bozo"):
        case word("spotted"):
        case word("bumps"):
        case word("dents"):
        case word("crackle"):
        case word("cells"):
        case word("leopard"):
        case word("granite"):
        case word("wrinkles"):
        case word("agate"): {
            const bool plain = own == word("bozo") || own == word("spotted") || own == word("bumps");
            Noise noise;
            noise.octaves = plain ? turbulent ? 3 : 1 : own == word("dents") || own == word("leopard") ? 1 : 6;
            pattern.kind = noise;
            notes.approximated(
                blend.place, plain ? "'" + word_text(own) + "' is another noise" : "'" + word_text(own) + "' is noise");
            return true;
        }
        default:
            return false;
    }
}

Look PigmentMaker::look_of(const PigmentThing& pigment, const Steps& way, bool mapped) {
    const Mean mean = mean_of(pigment);
    Look look{Pigment(mean.color), mean.filter, mean.transmit};
    const Blend& blend = pigment.blend;
    if (!blend) return look;
    const auto as_mean = [&](const std::string& why) {
        notes.approximated(blend.place, why + " is its mean colour");
        return look;
    };
    if (blend.uv && !mapped) return as_mean("a pigment by uv of a body that is no mesh");
    if (blend.map && !blend.map->entries.empty()) {
        bool varies = false;
        const Mean first = mean_of(blend.map->entries[0]);
        for (const MapEntry& entry : blend.map->entries) {
            const Mean own = mean_of(entry);
            varies |= own.filter != first.filter || own.transmit != first.transmit;
        }
        if (varies) notes.approximated(blend.place, "transparency that varies in a pattern is its mean");
    }
    if (blend.warped) notes.approximated(blend.place, "a pattern without its warps");
    Pattern pattern{.kind = Checker{}, .colors = {}, .transformations = {}, .by_uv = blend.uv};
    if (blend.word == word("checker") || blend.word == word("brick")) {
        const bool brick = blend.word == word("brick");
        std::array<Color, 2> colors{brick ? Color(.5) : Color(0, 0, 1), brick ? Color(.6, .15, .15) : Color(0, 1, 0)};
        // A colour that is missing is the usual one; a pigment that is missing is black.
        if (blend.map && blend.map->entries[0].thing) colors[1] = Color(0);
        for (std::size_t i = 0; blend.map && i < std::min<std::size_t>(blend.map->entries.size(), 2); ++i) {
            const auto* const nested = dynamic_cast<const PigmentThing*>(blend.map->entries[i].thing.get());
            colors[i] = mean_of(blend.map->entries[i]).color;
            if (nested && nested->blend) notes.approximated(blend.place, "patterns in a list are their mean colours");
        }
        if (blend.turbulence != DVec3(0))
            notes.approximated(blend.place, "'" + word_text(blend.word) + "' without turbulence");
        if (brick) pattern.kind = Brick{blend.brick_size, blend.mortar};
        pattern.colors = {{0, colors[0]}, {1, colors[1]}};
        // All that is mirrored is the argument of the pattern.
        pattern.transformations = space_of(blend, way, {});
        if (mirrored) pattern.transformations.insert(pattern.transformations.begin(), Scale{{1, 1, -1}});
        look.pigment = Pigment(std::move(pattern));
        return look;
    }
    if (blend.word == word("image_map")) {
        const auto pixels = pixels_of(blend);
        const ImageThing& image = *blend.image;
        if (!pixels) return look;
        if (image.map_type > 2) return as_mean("a picture of this map_type");
        if (image.interpolate == 0 || image.interpolate == 4)
            notes.approximated(blend.place, "the pixels of a picture are interpolated");
        if (image.single_colors) notes.left_out(blend.place, "transparency of single colours of a picture");
        if (image.once) notes.approximated(blend.place, "beside a picture that is shown once its body is black");
        if (blend.turbulence != DVec3(0)) notes.approximated(blend.place, "a picture without turbulence");
        ImagePattern own{
            .file = image.path, .pixels = pixels, .map = static_cast<ImageMap>(image.map_type), .once = {}};
        if (image.once) own.once = Color(0);
        pattern.kind = own;
        pattern.colors.clear();
        Steps first;
        Blend moved = blend;
        if (image.map_type != 0) {
            const auto* const turn = moved.steps.empty() ? nullptr : std::get_if<MatrixStep>(&moved.steps[0]);
            if (turn && *turn == poles && !mirrored)
                moved.steps.erase(moved.steps.begin());
            else if (mirrored)
                first = {Rotate{{90, 0, 0}}};
            else
                first = {Scale{{1, -1, 1}}, Rotate{{-90, 0, 0}}};
        }
        pattern.transformations = space_of(moved, way, first);
        look.pigment = Pigment(std::move(pattern));
        return look;
    }
    pattern.colors = stops_of(blend);
    if (!set_kind(blend, pattern, true)) return as_mean("the pattern '" + word_text(blend.word) + "'");
    Steps first;
    if (blend.word == word("planar")) {
        constexpr double period = 200;
        std::vector<ColorStop> stops;
        const auto add = [&](double y, const Color& color) { stops.push_back({(y + period / 2) / period, color}); };
        for (const ColorStop& stop : pattern.colors) add(stop.at - 1, stop.color);
        for (auto stop = pattern.colors.rbegin(); stop != pattern.colors.rend(); ++stop) add(1 - stop->at, stop->color);
        pattern.colors = std::move(stops);
        first = {Translate{{0, -.5, 0}}, Scale{DVec3(period)}};
    }
    const bool ramp = std::holds_alternative<Gradient>(pattern.kind) && blend.word != word("planar");
    const DVec3 axis = blend.word == word("gradient") ? normalize(blend.axis) : DVec3(1, 0, 0);
    if (blend.phase != 0 && (ramp || blend.word == word("marble"))) first.push_back(Translate{-blend.phase * axis});
    if (blend.frequency != 1 && blend.frequency != 0 && blend.word != word("planar"))
        first.push_back(Scale{DVec3(1 / blend.frequency)});
    pattern.transformations = space_of(blend, way, first);
    look.pigment = Pigment(std::move(pattern));
    return look;
}

Bump PigmentMaker::bump_of(const NormalThing& normal, const Steps& way, bool mapped) {
    Bump bump;
    const Blend& blend = normal.blend;
    if (!blend || normal.amount == 0) return bump;
    const auto none = [&](const std::string& what) {
        notes.left_out(blend.place, what + " on the surface");
        return Bump();
    };
    if (blend.uv && !mapped) return none("bumps by uv of a body that is no mesh");
    Pattern pattern{.kind = Noise{}, .colors = {}, .transformations = {}, .by_uv = blend.uv};
    if (blend.image && blend.word == word("bump_map")) {
        const auto pixels = pixels_of(blend);
        if (!pixels || blend.image->map_type != 0) return none("a bump_map");
        pattern.kind = ImagePattern{.file = blend.image->path, .pixels = pixels, .map = ImageMap::planar, .once = {}};
        if (blend.image->once) std::get<ImagePattern>(pattern.kind).once = Color(0);
        bump.height = normal.amount / pixels->width;
        notes.approximated(blend.place, "a bump_map bends normals a little differently");
    } else if (blend.map || !set_kind(blend, pattern, false)) {
        return none("'" + word_text(blend.word) + "'");
    } else {
        // POV-Ray's amount of 1 is .1 / accuracy of the differences that scene/pattern.h describes.
        bump.height = normal.amount * (blend.word == word("gradient") || blend.word == word("marble") ? .1333 : .5);
        notes.approximated(blend.place, "'" + word_text(blend.word) + "' bends normals differently");
    }
    pattern.transformations = space_of(
        blend, way, blend.frequency > 0 && blend.frequency != 1 ? Steps{Scale{DVec3(1 / blend.frequency)}} : Steps{});
    bump.pattern = std::make_shared<const Pattern>(std::move(pattern));
    return bump;
}

}  // namespace strahl::pov

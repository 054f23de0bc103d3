#include "pov/meaning/pigments.h"

#include <algorithm>
#include <bit>

#include "files/error.h"
#include "files/words.h"
#include "num/vec_math.h"
#include "pov/things/outlines.h"
#include "pov/things/pattern_values.h"
#include "pov/things/pictures.h"
#include "pov/things/solids.h"

namespace strahl::pov {
namespace {

std::string word_text(std::uint16_t code) { return std::string(reserved_words[code - first_word_code]); }

/// The exchange of y and z: POV-Ray's pictures have their poles on the y axis, those of scenes on the z axis.
const MatrixStep poles{glm::dmat4(1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1)};

/// Returns the colours between two, as a stop at `at`.
ColorStop between(const ColorStop& a, const ColorStop& b, double share, double at) {
    const auto mixed = [&](const auto& x, const auto& y) { return x + share * (y - x); };
    return {at, mixed(a.color, b.color), mixed(a.filter, b.filter), mixed(a.transmit, b.transmit)};
}

}  // namespace

PigmentMaker::Mean PigmentMaker::mean_of(const MapEntry& entry) {
    if (const auto* const pigment = dynamic_cast<const PigmentThing*>(entry.thing.get())) {
        const auto known = means.find(entry.thing);
        return known != means.end() ? known->second : means[entry.thing] = mean_of(*pigment);
    }
    return {color_of(entry.color), decimal(entry.color.filter), decimal(entry.color.transmit)};
}

PigmentMaker::Mean PigmentMaker::mean_of(const PigmentThing& pigment) {
    if (!pigment.blend) return mean_of(MapEntry{.color = pigment.color, .thing = nullptr});
    if (pigment.blend.word == word("image_map")) {
        const ImageThing& image = *pigment.blend.image;
        const auto pixels = pixels_of(pigment.blend);
        const double transmit = image.transmit_all.value_or(0);
        if (!pixels) return {Color(.5), image.filter_all.value_or(0), transmit};
        PictureFacts& facts = *image.facts;
        if (!facts.mean) {
            facts.mean = Color(0);
            const double count = double(pixels->values.size()) / 3;
            for (std::size_t i = 0; i + 2 < pixels->values.size(); i += 3)
                for (int c = 0; c < 3; ++c) (*facts.mean)[c] += double(pixels->values[i + std::size_t(c)]) / count;
            for (const float opacity : pixels->opacity) facts.clear += (1 - double(opacity)) / count;
        }
        return {*facts.mean, image.filter_all.value_or(0), transmit + facts.clear};
    }
    if (!pigment.blend.map) return {Color(.5)};
    const std::uint16_t own = pigment.blend.word;
    return mean_of(*pigment.blend.map, listed_colors(own) > 0 || own == word("average"));
}

/// Returns the mean of a list, or of what a map shows at values from 0 to 1.
PigmentMaker::Mean PigmentMaker::mean_of(const MapThing& map, bool list) {
    Mean sum;
    const auto add = [&](const Mean& own, double weight) {
        sum.color += weight * own.color, sum.filter += weight * own.filter, sum.transmit += weight * own.transmit;
    };
    const auto entries = list ? map.entries : in_order(map.entries);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double before = i > 0 ? (entries[i - 1].at + entries[i].at) / 2 : 0;
        const double behind = i + 1 < entries.size() ? (entries[i].at + entries[i + 1].at) / 2 : 1;
        add(mean_of(entries[i]),
            list ? 1. / double(entries.size()) : std::clamp(behind, 0., 1.) - std::clamp(before, 0., 1.));
    }
    return sum;
}

std::vector<ColorStop> PigmentMaker::stops_of(const Blend& blend) {
    if (listed_colors(blend.word) > 0) return listed_stops(blend);
    std::vector<ColorStop> stops;
    double before = 0;
    for (const MapEntry& entry : in_order(blend.map ? blend.map->entries : usual_entries(blend))) {
        const double own = kept(entry.at, notes.in.options.as_text);
        if (!stops.empty() && before >= 1 && own > before) break;
        ColorStop stop = stop_of(blend, entry, std::clamp(own, stops.empty() ? 0 : stops.back().at, 1.));
        // Cuts an interval that reaches beyond 0 or 1, and takes the colours that it has there.
        if (!stops.empty() && own > before && !stop.pattern && !stops.back().pattern) {
            const ColorStop first = stops.back(), last = stop;
            if (before < 0 && own > 0) stops.back() = between(first, last, -before / (own - before), 0);
            if (own > 1) stop = between(first, last, (1 - before) / (own - before), 1);
        }
        stops.push_back(stop);
        before = own;
    }
    return stops;
}

/// Returns the stops of a list, in which colours that are missing are the usual ones, and pigments black.
std::vector<ColorStop> PigmentMaker::listed_stops(const Blend& blend) {
    const std::vector<MapEntry>& usual = usual_entries(blend);
    const bool pigments = blend.map && blend.map->entries[0].thing;
    std::vector<ColorStop> stops;
    for (std::size_t i = 0; i < usual.size(); ++i) {
        const bool given = blend.map && i < blend.map->entries.size();
        stops.push_back(given      ? stop_of(blend, blend.map->entries[i], usual[i].at)
                        : pigments ? ColorStop{usual[i].at}
                                   : stop_of(blend, usual[i], usual[i].at));
    }
    return stops;
}

/// Returns the moves by which patterns inside this one find their points in the space around it, or in its own if
/// transformations lead there.
Moves PigmentMaker::moves_inside(const Blend& blend) const {
    Moves own = moves_of(blend, !around.empty());
    if (around.empty() && blend.warps.empty() && !moves_points(blend)) return {};
    own.insert(own.begin(), around.begin(), around.end());
    return own;
}

/// Makes a pattern whose colour is the mean of a map's entries: two colours are blended, each of which may be blended
/// of two in turn. Returns false if the weights have no mean.
bool PigmentMaker::add_mean(const Blend& blend, Pattern& pattern) {
    const auto& entries = blend.map->entries;
    if (std::ranges::any_of(entries, [](const MapEntry& entry) { return !(entry.at > 0); })) return false;
    const int levels = std::bit_width(std::max<std::size_t>(entries.size(), 2) - 1);
    patterns_around += levels - 1;
    const auto blend_range = [&](const auto& self, std::size_t first, std::size_t last, Pattern& own) -> double {
        const std::size_t middle = first + (last - first + 1) / 2;
        double weights[2]{0, 0};
        own.colors.clear();
        for (const int side : {0, 1}) {
            const std::size_t from = side == 0 ? first : middle, to = side == 0 ? middle : last;
            if (from == to) continue;
            if (to - from == 1) {
                own.colors.push_back(stop_of(blend, entries[from], side));
                weights[side] = entries[from].at;
                continue;
            }
            Pattern half{.kind = SolidPattern(), .colors = {}, .transformations = {}};
            weights[side] = self(self, from, to, half);
            own.colors.push_back({double(side), Color(0), 0, 0, std::make_shared<const Pattern>(std::move(half))});
        }
        own.kind = SolidPattern{.solid = Solid::uniform, .phase = weights[1] / (weights[0] + weights[1])};
        return weights[0] + weights[1];
    };
    blend_range(blend_range, 0, entries.size(), pattern);
    patterns_around -= levels - 1;
    return true;
}

/// Returns the stop of a map's or a list's entry. A pattern there is in the space of the pattern around it.
ColorStop PigmentMaker::stop_of(const Blend& blend, const MapEntry& entry, double at) {
    const Mean mean = mean_of(entry);
    ColorStop stop{at, mean.color, mean.filter, mean.transmit};
    const auto* const nested = dynamic_cast<const PigmentThing*>(entry.thing.get());
    if (!nested || !nested->blend) return stop;
    if (blend.uv && notes.in.options.as_text) {
        notes.approximated(blend.place, "patterns among colours by uv are their mean colours");
        return stop;
    }
    if (patterns_around == most_nested) {
        too_deep = true;
        return stop;
    }
    Moves inside = moves_inside(blend);
    const auto place = std::pair(entry.thing, patterns_around);
    if (const auto known = inside.empty() ? made_stops.find(place) : made_stops.end(); known != made_stops.end()) {
        stop = known->second.stop, stop.at = at;
        too_deep |= known->second.too_deep;
        return stop;
    }
    const bool alike = inside.empty();  // wherever the pattern around it is
    const bool others_too_deep = std::exchange(too_deep, false);
    ++patterns_around;
    std::swap(around, inside);
    const Look look = look_of(*nested, {}, {});
    std::swap(around, inside);
    --patterns_around;
    if (look.pigment.pattern) {
        Pattern inner = *look.pigment.pattern;
        // The space of the pattern around it is POV-Ray's.
        if (mirrored) inner.transformations.push_back(Scale{{1, 1, -1}});
        stop = {at, Color(0), 0, 0, std::make_shared<const Pattern>(std::move(inner))};
    } else {
        stop = {at, look.pigment.color, look.filter, look.transmit};
    }
    if (alike) made_stops[place] = {stop, too_deep};
    too_deep |= others_too_deep;
    return stop;
}

std::shared_ptr<const FilePixels> PigmentMaker::pixels_of(const Blend& blend) const {
    if (!blend.image->fault.empty()) notes.left_out(blend.place, "a picture: " + blend.image->fault);
    return blend.image->pixels;
}

/// Returns the transformations of a pattern, from the space of the scene's own pattern into that of the body.
std::vector<Transformation> PigmentMaker::space_of(const Blend& blend, const Steps& way) const {
    Steps steps;
    if (around.empty()) append(steps, blend.steps);
    if (!blend.uv) append(steps, way);
    return transformations_of(steps, mirrored);
}

/// Returns the space of a pattern of which nothing is mirrored but its argument.
std::vector<Transformation> PigmentMaker::space_of_argument(const Blend& blend, const Steps& way) const {
    std::vector<Transformation> space = space_of(blend, way);
    if (mirrored) space.insert(space.begin(), Scale{{1, 1, -1}});
    return space;
}

/// Returns the scene's solid pattern for POV-Ray's, if it has one. `bends`: it bends normals.
std::optional<SolidPattern> PigmentMaker::solid_of(const Blend& blend, bool bends) const {
    std::optional<SolidPattern> solid = pov::solid_of(blend, bends, notes.in.noise_generator);
    if (!solid) return solid;
    if (!around.empty()) {
        Moves moves = around;
        if (!blend.steps.empty()) moves.push_back(glm::inverse(matrix_of(blend.steps)));
        solid = of_function(moved_values(std::move(moves), *solid));
    }
    if (solid->function && notes.in.options.as_text) return std::nullopt;
    if (solid->function) value_at(*solid, DVec3(0));  // calls functions in it that may be constants to be told of
    return solid;
}

namespace {

Pattern opaque_of(Pattern pattern) {
    for (ColorStop& stop : pattern.colors) {
        stop.filter = stop.transmit = 0;
        if (stop.pattern) stop.pattern = std::make_shared<const Pattern>(opaque_of(*stop.pattern));
    }
    return pattern;
}

}  // namespace

Pigment Look::clear() const {
    Pigment own = pigment;
    if (!pigment.pattern) own.filter = filter, own.transmit = transmit;
    return own;
}
Pigment Look::opaque() const {
    if (!pigment.clear()) return pigment;
    return Pigment(opaque_of(*pigment.pattern));
}

/// Tells what is not shown of a pattern.
void PigmentMaker::tell_ignored(const Blend& blend) const {
    if (blend.ignored != end_code)
        notes.approximated(blend.place, strahl::quoted(word_text(blend.ignored)) + " of a pattern has no effect");
}

/// Does a picture of the scene show this one? The scene's is opaque and still.
bool PigmentMaker::is_shown(const Blend& blend) const {
    const ImageThing& own = *blend.image;
    const bool still = around.empty() && blend.warps.empty() && blend.turbulence == DVec3(0);
    const bool plain = own.pixels->opacity.empty() && !own.once && own.filter_all.value_or(0) == 0 &&
                       own.transmit_all.value_or(0) == 0 && own.repeat == Point2{1, 1} && own.offset == Point2{0, 0};
    return still && plain && !own.path.empty() && own.map_type <= 2 && (own.interpolate == 0 || own.interpolate == 2);
}

namespace {

/// A channel of a picture, from 0 to 1 where that is from 0 to `most`.
struct Channel : FunctionThing {
    Channel(std::shared_ptr<const FunctionThing> colors, int number, double most)
        : colors(std::move(colors)), number(number), most(most) {}
    void evaluate(const double* given, double* result) const override {
        double own[5];
        colors->evaluate(given, own);
        *result = std::clamp(own[number] / most, 0., 1.);
    }
    const std::shared_ptr<const FunctionThing> colors;
    const int number;
    const double most;
};

}  // namespace

/// Makes a pattern whose colours are those of a function in the space of `blend` within its warps: the mean of four,
/// of which each has four times as much of one channel; filter and transmit share the fourth. Returns false if the
/// scene cannot have it.
bool PigmentMaker::set_channels(const std::shared_ptr<const FunctionThing>& colors, const Blend& blend,
                                const Brightest& most, Pattern& pattern) {
    if (!colors || notes.in.options.as_text || patterns_around + (most.filters ? 3 : 2) > most_nested) return false;
    Blend own = blend;
    own.word = word("function"), own.image = nullptr, own.pigment = nullptr, own.values = nullptr;
    own.frequency = own.phase = 0, own.wave = std::nullopt;
    const auto part = [](Pattern shown) {
        return ColorStop{0, Color(0), 0, 0, std::make_shared<const Pattern>(std::move(shown))};
    };
    const auto channel = [&](int number, double limit, const ColorStop& full) {
        own.function = std::make_shared<const Channel>(colors, number, limit);
        return part({.kind = *solid_of(own, false), .colors = {{0, Color(0)}, full}, .transformations = {}});
    };
    const auto mean = [](ColorStop a, ColorStop b) {
        a.at = 0, b.at = 1;
        return Pattern{
            .kind = SolidPattern{.solid = Solid::uniform, .phase = .5}, .colors = {a, b}, .transformations = {}};
    };
    const double full = 4 * most.value;
    ColorStop clear;
    if (most.filters)
        clear = part(mean(channel(3, 1, {1, Color(0), 8, 0}), channel(4, 1, {1, Color(0), 0, 8})));
    else if (most.transmits)
        clear = channel(4, 1, {1, Color(0), 0, 4});
    const auto color = [&](int number) {
        Color own(0);
        own[number] = full;
        return channel(number, most.value, {1, own});
    };
    const Pattern whole = mean(part(mean(color(0), color(1))), part(mean(color(2), clear)));
    pattern.kind = whole.kind, pattern.colors = whole.colors;
    return true;
}

Pigment PigmentMaker::Brightest::of(Pattern pattern) const {
    Pigment own(std::move(pattern));
    own.color = Color(value), own.filter = filters, own.transmit = transmits;
    return own;
}

/// Returns the largest value of a pigment's colours, at least 1, and whether any lets light through.
PigmentMaker::Brightest PigmentMaker::brightest_of(const PigmentThing& pigment) {
    Brightest most;
    const auto add = [&](const FilterColor& own) {
        most.value = std::max({most.value, double(own.red), double(own.green), double(own.blue)});
        most.filters |= own.filter != 0, most.transmits |= own.transmit != 0;
    };
    const Blend& blend = pigment.blend;
    if (pigment.colors) {
        most.value = std::max(most.value, pigment.most);
    } else if (blend.word == word("image_map") && blend.image->pixels) {
        const ImageThing& image = *blend.image;
        const Color& largest = image.pixels->largest;
        most.value = (image.interpolate == 3 ? 1.5 : 1) * std::max({largest.x, largest.y, largest.z, 1.});
        most.filters = image.filter_all.value_or(0) != 0;
        most.transmits = image.once || !image.pixels->opacity.empty() || image.transmit_all.value_or(0) != 0;
    } else if (!blend) {
        add(pigment.color);
    } else if (blend.map) {
        for (const MapEntry& entry : blend.map->entries) {
            add(entry.color);
            const auto* const nested = dynamic_cast<const PigmentThing*>(entry.thing.get());
            if (!nested) continue;
            const Brightest own = brightest_of(*nested);
            most.value = std::max(most.value, own.value);
            most.filters |= own.filters, most.transmits |= own.transmits;
        }
    }
    return most;
}

namespace {

/// Lets a pattern by uv find its places by moves of points.
void place(Blend& blend, Moves moves) {
    blend.uv = false, blend.values = nullptr;
    const Warp warp = PlaceWarp{std::make_shared<const PlaceMoves>(PlaceMoves{std::move(moves)})};
    blend.warps.push_back({std::exchange(blend.steps, {}), warp});
}

/// Returns a pigment by uv whose places are found from points of a body. A picture around a ball stays a picture.
PigmentThing placed(PigmentThing pigment, const UvMapping::Places& found) {
    Blend& blend = pigment.blend;
    const bool still = blend.warps.empty() && blend.steps.empty() && blend.turbulence == DVec3(0);
    if (found.ball_centre && still && blend.word == word("image_map") && blend.image->map_type == 0) {
        auto image = std::make_shared<ImageThing>(*blend.image);
        image->map_type = 1, image->colors = nullptr;
        blend.image = std::move(image), blend.uv = false;
        if (*found.ball_centre != DVec3(0)) blend.steps = {Translate{*found.ball_centre}};
    } else {
        place(blend, found.moves);
    }
    return pigment;
}

/// Makes the patterns among a pattern's colours patterns by uv, as it is one.
void spread_uv(Pattern& pattern) {
    for (ColorStop& stop : pattern.colors) {
        if (!stop.pattern) continue;
        Pattern inner = *stop.pattern;
        inner.by_uv = true;
        inner.transformations.insert(inner.transformations.end(), pattern.transformations.begin(),
                                     pattern.transformations.end());
        spread_uv(inner);
        stop.pattern = std::make_shared<const Pattern>(std::move(inner));
    }
}

}  // namespace

Look PigmentMaker::look_of(const PigmentThing& pigment, const Steps& way, const UvMapping& uv) {
    if (pigment.blend.uv && uv.found && !uv.mesh) return look_of(placed(pigment, *uv.found), {}, {});
    Look look = shown_look_of(pigment, way, uv);
    if (patterns_around == 0 && std::exchange(too_deep, false)) {
        Pattern pattern{.kind = Checker{}, .colors = {}, .transformations = {}};
        const Brightest most = brightest_of(pigment);
        if (pigment.blend.uv ||
            !set_channels(colors_of(pigment, notes.in.noise_generator, &made_colors), {}, most, pattern)) {
            notes.approximated(pigment.blend.place, "patterns that are nested deeply are their mean colours");
        } else {
            pattern.transformations = space_of_argument({}, way);
            look.pigment = most.of(std::move(pattern));
            look.varies = look.pigment.clear();
        }
    }
    if (!look.pigment.pattern || !look.pigment.pattern->by_uv || !look.pigment.pattern->nests()) return look;
    Pattern own = *look.pigment.pattern;
    spread_uv(own);
    look.pigment = Pigment(std::move(own));
    return look;
}

Look PigmentMaker::shown_look_of(const PigmentThing& pigment, const Steps& way, const UvMapping& uv) {
    const Mean mean = mean_of(pigment);
    Look look{Pigment(mean.color), mean.filter, mean.transmit};
    const Blend& blend = pigment.blend;
    if (pigment.colors) {
        Pattern pattern{.kind = Checker{}, .colors = {}, .transformations = {}};
        if (const Brightest most = brightest_of(pigment); set_channels(pigment.colors, {}, most, pattern)) {
            pattern.transformations = space_of_argument({}, way);
            look.pigment = most.of(std::move(pattern));
        } else {
            notes.approximated(blend.place, "colours that parts of a blob blend are their mean");
        }
        return look;
    }
    if (!blend) return look;
    const auto as_mean = [&](const std::string& why) {
        notes.approximated(blend.place, why + " is its mean colour");
        return look;
    };
    if (blend.uv && !uv.mesh) return as_mean("a pigment by uv of a flat box, or within another pigment,");
    if (blend.map && !blend.map->entries.empty()) {
        const Mean first = mean_of(blend.map->entries[0]);
        for (const MapEntry& entry : blend.map->entries) {
            const Mean own = mean_of(entry);
            look.varies |= own.filter != first.filter || own.transmit != first.transmit ||
                           (own.filter != 0 && own.color != first.color);
        }
    }
    tell_ignored(blend);
    Pattern pattern{.kind = Checker{}, .colors = {}, .transformations = {}, .by_uv = blend.uv};
    const bool still = around.empty() && blend.warps.empty() && blend.turbulence == DVec3(0);
    if (still && (blend.word == word("checker") || blend.word == word("brick"))) {
        if (blend.word == word("brick")) pattern.kind = Brick{blend.brick_size, blend.mortar};
        pattern.colors = listed_stops(blend);
        for (const ColorStop& stop : pattern.colors) look.varies |= stop.pattern && Pigment(*stop.pattern).clear();
        pattern.transformations = space_of_argument(blend, way);
        look.pigment = Pigment(std::move(pattern));
        return look;
    }
    if (blend.word == word("image_map")) {
        const auto pixels = pixels_of(blend);
        const ImageThing& image = *blend.image;
        if (!pixels) return look;
        if (image.single_colors) notes.left_out(blend.place, "transparency of single colours of a picture");
        const bool shown = is_shown(blend);
        if (const Brightest most = brightest_of(pigment);
            !shown && set_channels(colors_of(image), blend, most, pattern)) {
            pattern.transformations = space_of_argument(blend, way);
            look.pigment = most.of(std::move(pattern));
            look.varies = look.pigment.clear();
            return look;
        }
        if (!shown && patterns_around > 0 && !notes.in.options.as_text) return too_deep = true, look;
        if (image.map_type > 2 || image.path.empty()) return as_mean("this picture");
        if (!shown) notes.approximated(blend.place, "a picture is opaque and still");
        const Interpreter& in = notes.in;
        const bool by_version = in.version_given() && in.version() >= 3.7;
        const double gamma = in.assumed_gamma && image.working == 0 ? 0 : in.assumed_gamma.value_or(by_version ? 1 : 0);
        std::shared_ptr<const Pixels> own_pixels = shown_pixels(image, gamma);
        if (own_pixels != pixels && in.options.as_text) {
            notes.approximated(blend.place, "the colours of a picture are sRGB-encoded, or linear light if floats");
            own_pixels = pixels;
        }
        ImagePattern own{.file = image.path,
                         .pixels = own_pixels,
                         .map = static_cast<ImageMap>(image.map_type),
                         .once = {},
                         .sharp = image.interpolate == 0};
        if (image.once) own.once = Color(0);
        pattern.kind = own;
        pattern.colors.clear();
        Steps first;
        Blend moved = blend;
        for (auto own = blend.warps.rbegin(); own != blend.warps.rend(); ++own)
            moved.steps.insert(moved.steps.begin(), own->before.begin(), own->before.end());
        if (image.map_type != 0) {
            const auto* const turn = moved.steps.empty() ? nullptr : std::get_if<MatrixStep>(&moved.steps[0]);
            if (turn && *turn == poles && !mirrored)
                moved.steps.erase(moved.steps.begin());
            else if (mirrored)
                first = {Rotate{{90, 0, 0}}};
            else
                first = {Scale{{1, -1, 1}}, Rotate{{-90, 0, 0}}};
        }
        append(first, moved.steps);
        if (!blend.uv) append(first, way);
        pattern.transformations = transformations_of(first, mirrored);
        look.pigment = Pigment(std::move(pattern));
        return look;
    }
    const bool average = blend.word == word("average") && blend.map;
    if (average && !add_mean(blend, pattern)) return as_mean("this average");
    if (!average) pattern.colors = stops_of(blend);
    for (const ColorStop& stop : pattern.colors) look.varies |= stop.pattern && Pigment(*stop.pattern).clear();
    if (!average) {
        const std::optional<SolidPattern> solid = solid_of(blend, false);
        if (!solid) return as_mean("the pattern '" + word_text(blend.word) + "'");
        pattern.kind = *solid;
    }
    pattern.transformations = space_of_argument(blend, way);
    look.pigment = Pigment(std::move(pattern));
    return look;
}

Bump PigmentMaker::bump_of(const NormalThing& normal, const Steps& way, const UvMapping& uv) {
    Bump bump;
    const Blend& blend = normal.blend;
    if (!blend || normal.amount == 0) return bump;
    const auto none = [&](const std::string& what) {
        notes.left_out(blend.place, what + " on the surface");
        return Bump();
    };
    Steps from;  // the space of directions by uv, into that of the body
    if (blend.uv && uv.found) {
        from = blend.moved_by_uv ? *blend.moved_by_uv : inverse(uv.found->to_scene);
        if (blend.moved_by_uv) append(from, way);
    }
    if (blend.uv && uv.found && !uv.mesh) {
        Moves moves = uv.found->moves;
        moves.insert(moves.begin(), matrix_of(from));
        NormalThing placed = normal;
        place(placed.blend, std::move(moves));
        return bump_of(placed, from, {});
    }
    if (blend.uv && !uv.mesh) return none("bumps by uv of a flat box");
    tell_ignored(blend);
    Pattern pattern{.kind = Noise{}, .colors = {}, .transformations = {}, .by_uv = blend.uv};
    const bool picture = blend.image && blend.word == word("bump_map"), facets = blend.word == word("facets");
    const auto own_bends = [&]() -> std::shared_ptr<const SolidFunction> {
        if ((!blend.map && !picture && !facets && !blend.uv) || notes.in.options.as_text) return nullptr;
        if (!blend.uv) return bends_of(normal, notes.in.noise_generator);
        NormalThing own = normal;
        own.blend.uv = false;
        auto bends = bends_of(own, notes.in.noise_generator);
        if (uv.found) append(from, uv.found->to_scene);
        return bends && blend.moved_by_uv ? turned_bends(glm::inverse(matrix_of(from)), std::move(bends)) : bends;
    };
    auto bends = own_bends();
    if (picture && !bends) {
        const auto pixels = pixels_of(blend);
        if (!pixels || blend.image->map_type != 0) return none("a bump_map");
        pattern.kind = ImagePattern{.file = blend.image->path, .pixels = pixels, .map = ImageMap::planar, .once = {}};
        if (blend.image->once) std::get<ImagePattern>(pattern.kind).once = Color(0);
        bump.height = normal.amount / pixels->width;
        notes.approximated(blend.place, "a bump_map bends normals a little differently");
    } else {
        std::optional<SolidPattern> solid;
        const bool weighed = bends || blend.map || picture || facets;
        if (bends)
            solid = of_function(std::move(bends));
        else if (!blend.map)
            solid = solid_of(blend, true);
        if (!solid) return none("'" + word_text(blend.word) + "'");
        pattern.kind = *solid;
        bump.height = weighed ? 1 : kept(normal.amount, notes.in.options.as_text);
        if (blend.uv && !weighed) notes.approximated(blend.place, "bumps by uv bend normals along u and v");
    }
    pattern.transformations = space_of(blend, way);
    if (mirrored && std::holds_alternative<SolidPattern>(pattern.kind))
        pattern.transformations.insert(pattern.transformations.begin(), Scale{{1, 1, -1}});
    bump.pattern = std::make_shared<const Pattern>(std::move(pattern));
    return bump;
}

}  // namespace strahl::pov

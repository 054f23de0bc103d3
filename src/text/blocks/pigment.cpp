// Reads and writes colours, the patterns that may stand in their place, and reliefs.
#include "text/blocks/pigment.h"

#include <algorithm>

#include "files/error.h"
#include "num/decimal.h"
#include "text/blocks/blocks.h"
#include "text/blocks/transformations.h"
#include "text/reading/opacity.h"
#include "text/reading/reader.h"

namespace strahl {
namespace {

constexpr int most_nested = 4;  // patterns in each other

/// Counts a pattern as around those that are read while this lives.
struct Within {
    explicit Within(int& count) : count(count) { ++count; }
    ~Within() { --count; }
    Within(const Within&) = delete;
    int& count;
};

/// The purpose of a pattern.
enum class Use { color, bump, normal };

class PatternBlock {
  public:
    /// `colors` is the range of colours, or of the height.
    PatternBlock(BlockReader& reader, const NumberRange& colors) : reader(reader), colors(colors) {}

    /// Reads the pattern that `word` begins in the block `outer`: one with colours, or one with a height.
    template <Use use = Use::color>
    Pattern read(std::string_view word, Block& outer) {
        const auto read_kinds = [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
            ((word == Kinds::name && (kind < Kinds, can_bend<Kinds> ? use : Use::color > (word, outer), true)) || ...);
        };
        read_kinds(std::type_identity<PatternKind>{});
        return std::move(pattern);
    }
    std::optional<double> height;
    std::shared_ptr<const Opacity> opacity;  // of an image that says how opaque it is

  private:
    template <class Kind, Use use>
    void kind(std::string_view word, Block& outer) {
        Kind kind;
        Block block{word};
        auto parameters = field_parameters(kind);
        std::string_view colors_at, last;
        reader.block(
            block, parameters, words<Kind, use>(), [&] { arguments(kind, block); },
            [&](std::string_view inner) {
                if (use != Use::color && inner == "height") return read_height(inner, block), true;
                if (use == Use::color && inner == "colors" && has_map<Kind>) return map(inner, colors_at, block), true;
                if (inner == "map") return read_map(kind, inner, block), true;
                if (inner == "once" && read_once(kind, inner, block)) return true;
                if constexpr (std::is_same_v<Kind, ImagePattern>)
                    if (inner == "wrap") return read_wrap(kind, inner, block), true;
                if (use == Use::color && inner == "sharp" && read_sharp(kind, inner, block)) return true;
                if constexpr (std::is_same_v<Kind, ImagePattern>)
                    if (use == Use::color && contains(opacity_words, inner)) return read_opacity(inner, block), true;
                if (!contains(transformation_words, inner)) return false;
                pattern.transformations.push_back(read_transformation(reader, inner, block));
                last = inner;
                return true;
            });
        if (use == Use::bump)
            reader.require(block, {}, {{height.has_value(), "'height'"}});
        else if (use == Use::color)
            reader.require(block, {}, {{!has_map<Kind> || colors_at.data(), "'colors'"}});
        check(kind, word, last, block);
        if constexpr (std::is_same_v<Kind, ImagePattern>) finish(kind, block);
        outer.absorb(block);
        pattern.kind = kind;
    }
    /// The words that may stand in the block besides its parameters.
    template <class Kind, Use use>
    static auto words() {
        const auto all = [](auto... first) {
            return joined(std::array<std::string_view, sizeof...(first)>{first...}, transformation_words);
        };
        constexpr bool image = std::is_same_v<Kind, ImagePattern>;
        if constexpr (use != Use::color && image)
            return all("height", "map", "once", "wrap");
        else if constexpr (use != Use::color)
            return all("height", "map");
        else if constexpr (has_map<Kind>)
            return all("colors", "map");
        else if constexpr (image)
            return joined(opacity_words, all("map", "once", "wrap", "sharp"));
        else
            return all("map");
    }
    template <class Kind>
    void arguments(Kind& kind, Block& block) {
        if constexpr (two_colored<Kind>)
            for (const double at : {0., 1.}) {
                if (at == 1) reader.lexer.accept(',');
                ColorStop stop{at};
                read_color(stop, Kind::colors[static_cast<std::size_t>(at)], block);
                pattern.colors.push_back(stop);
            }
        else if constexpr (requires { kind.solid; })
            solid(kind, block);
        else if constexpr (!has_map<Kind>)
            file(kind, block);
    }
    void solid(SolidPattern& own, Block& block) {
        const std::string_view name = reader.lexer.word();
        if (name.empty()) reader.lexer.fail("the name of a solid pattern, such as 'granite', expected");
        const auto found = std::ranges::find(solid_names, name);
        if (found != solid_names.end()) return void(own.solid = static_cast<Solid>(found - solid_names.begin()));
        reader.fault(block, name, unknown_word(name, solid_names, " after 'solid {'"));
    }
    void file(ImagePattern& image, Block& block) {
        reader.file(block, "picture", [&](std::string_view name) {
            image.pixels = picture = reader.files.pixels(name);
            image.file = file_at = name;
        });
    }
    void read_opacity(std::string_view word, Block& block) {
        const auto which = static_cast<std::size_t>(std::ranges::find(opacity_words, word) - opacity_words.begin());
        block.bad |= !reader.once(opacity_at[which], word);
        if (word == "opacity_of")
            reader.file(block, "picture", [&](std::string_view name) {
                other_picture = reader.files.pixels(name);
                other_file = name;
            });
        else
            reader.read(word == "mask" ? mask : share, shares, word, block);
    }
    /// Makes the opacity of an image if its words ask for one, and demands an opaque picture if they do not.
    void finish(ImagePattern& image, Block& block) {
        if (!picture) return;
        const bool any = std::ranges::any_of(opacity_at, &std::string_view::data);
        const auto clear = std::ranges::find_if(picture->opacity, [](float o) { return o != 1; });
        if (any && image.map != ImageMap::planar) {
            const std::string_view at = *std::ranges::find_if(opacity_at, &std::string_view::data);
            reader.fault(block, at, "only the maps planar and uv show places that are not opaque");
        } else if (any && block.good()) {
            Opacity own(other_picture ? *other_picture : *picture, other_picture != nullptr);
            own.file = other_file, own.factor = share, own.limit = mask;
            own.once = image.once.has_value(), own.wrap = image.wrap;
            opacity = std::make_shared<const Opacity>(std::move(own));
        } else if (!any && clear != picture->opacity.end()) {
            const auto i = clear - picture->opacity.begin();
            reader.fault(block, file_at,
                         "'" + image.file + "' has pixels that are not opaque, the first at column " +
                             std::to_string(i % picture->width) + ", row " + std::to_string(i / picture->width) +
                             "; 'opacity 1' behind its name lets light through them");
        }
    }
    template <class Kind>
    void read_map(Kind& kind, std::string_view word, Block& block) {
        block.bad |= !reader.once(map_at, word);
        const std::string_view name = reader.lexer.word();
        if (name.empty()) reader.lexer.fail("a word such as 'uv' expected after 'map'");
        if (name == uv_map) return void(pattern.by_uv = true);
        const auto known = maps_of(kind);
        const auto found = std::ranges::find(known, name);
        if constexpr (requires { kind.map; })
            if (found != known.end()) return void(kind.map = static_cast<ImageMap>(found - known.begin()));
        reader.fault(block, name, unknown_word(name, known, " after 'map'"));
    }
    template <class Kind>
    bool read_once(Kind& kind, std::string_view word, Block& block) {
        if constexpr (requires { kind.once; }) {
            block.bad |= !reader.once(once_at, word);
            reader.read(kind.once.emplace(), colors, word, block);
            return true;
        }
        return false;
    }
    /// Reads what is beyond the picture along u, and along v if that is something else.
    void read_wrap(ImagePattern& image, std::string_view word, Block& block) {
        block.bad |= !reader.once(wrap_at, word);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const std::string_view name = reader.lexer.word();
            const auto found = std::ranges::find(image_wraps, name);
            if (found != image_wraps.end()) {
                image.wrap[axis] = static_cast<ImageWrap>(found - image_wraps.begin());
                if (axis == 0) image.wrap[1] = image.wrap[0];
                continue;
            }
            if (axis == 1) return name.empty() ? void() : reader.lexer.rewind(name);
            if (name.empty()) reader.lexer.fail("a word such as 'clamp' expected after 'wrap'");
            return reader.fault(block, name, unknown_word(name, image_wraps, " after 'wrap'"));
        }
    }
    template <class Kind>
    bool read_sharp(Kind& kind, std::string_view word, Block& block) {
        if constexpr (requires { kind.sharp; }) {
            block.bad |= !reader.once(sharp_at, word);
            return kind.sharp = true;
        }
        return false;
    }
    void read_height(std::string_view word, Block& block) {
        block.bad |= !reader.once(height_at, word);
        reader.read(height.emplace(), colors, word, block);
    }
    void map(std::string_view word, std::string_view& first, Block& outer) {
        const bool again = !reader.once(first, word);
        Block block{word};
        std::vector<ColorStop> stops;
        reader.block(
            block, {},
            [&] {
                while (reader.lexer.peek() != '}') add_stop(stops, block), reader.lexer.accept(',');
            },
            [](std::string_view) { return false; });
        if (stops.empty() && block.good())
            reader.fault(block, word, "'colors' has no stops; a stop is, for example, '0 <1, 1, 1>'");
        outer.absorb(block);
        if (!again) pattern.colors = std::move(stops);
    }
    /// Reads the colour of a stop, or an opaque pattern in its place.
    void read_color(ColorStop& stop, std::string_view name, Block& block) {
        const std::string_view word = reader.lexer.token();
        reader.lexer.rewind(word);
        if (!contains(pattern_words, word))
            return reader.read_clear(stop.color, stop.filter, stop.transmit, colors, name, block);
        if (reader.patterns_around == most_nested) {
            reader.diagnostics.add(word, "patterns in patterns are at most " + std::to_string(most_nested) + " deep");
            throw ParseAbort{};
        }
        Pigment own(Color(0));
        const Within within(reader.patterns_around);
        reader.read(own, colors, name, block);
        stop.pattern = own.pattern;
        if (own.pattern && own.pattern->by_uv)
            reader.fault(block, word, "a pattern among colours cannot be mapped by uv");
        if (opacity_of(own)) reader.fault(block, word, "a picture among colours must be opaque");
    }
    void add_stop(std::vector<ColorStop>& stops, Block& block) {
        const std::string_view at = reader.lexer.token();
        reader.lexer.rewind(at);
        ColorStop stop;
        reader.read(stop.at, shares, "stop", block);
        reader.lexer.accept(',');
        read_color(stop, "colour", block);
        if (block.good() && !stops.empty() && stop.at < stops.back().at)
            reader.fault(block, at, "stops must not fall: the one before is at " + text_of(stops.back().at));
        if (stops.size() < most_stops)
            stops.push_back(stop);
        else if (block.good())
            reader.fault(block, at, "more than " + std::to_string(most_stops) + " stops");
    }
    template <class Kind>
    void check(const Kind& kind, std::string_view word, std::string_view last, Block& block) {
        if (!block.good()) return;
        if (pattern.by_uv && pattern.nests())
            reader.fault(block, word, "a pattern that is mapped by uv cannot have patterns among its colours");
        const std::string invalid = "invalid " + std::string(word) + ": ";
        if constexpr (requires { kind.axis; })
            if (kind.axis == DVec3(0)) reader.fault(block, word, invalid + "its axis has no direction");
        const std::string why = transformations_fault(matrix(pattern.transformations));
        if (!why.empty()) reader.fault(block, last, invalid + "the transformations up to here " + why);
    }

    BlockReader& reader;
    const NumberRange& colors;
    Pattern pattern;
    std::string_view map_at, once_at, wrap_at, sharp_at, height_at, file_at;
    std::array<std::string_view, 3> opacity_at;  // where each of `opacity_words` stands
    std::shared_ptr<const FilePixels> picture, other_picture;
    std::string other_file;
    double share = 1, mask = 0;
};

/// Was it read without an error that leaves it without colours?
bool whole(const Pattern& pattern) {
    const ImagePattern* const image = std::get_if<ImagePattern>(&pattern.kind);
    return image ? image->pixels != nullptr : !pattern.colors.empty();
}
/// `map` with its word, unless that is the default.
template <class Kind>
std::string map_text(const Kind& kind, bool by_uv) {
    std::string_view word = by_uv ? uv_map : "";
    if constexpr (requires { kind.map; })
        if (!by_uv && kind.map != ImageMap::planar) word = image_maps[static_cast<std::size_t>(kind.map)];
    return word.empty() ? "" : "map " + std::string(word);
}
/// `wrap` with its words, unless they are the default.
std::string wrap_text(const std::array<ImageWrap, 2>& wrap) {
    if (wrap == std::array<ImageWrap, 2>{}) return "";
    const auto name = [](ImageWrap own) { return " " + std::string(image_wraps[static_cast<std::size_t>(own)]); };
    return "wrap" + name(wrap[0]) + (wrap[1] == wrap[0] ? "" : name(wrap[1]));
}

}  // namespace

void BlockReader::read(Pigment& value, const NumberRange& range, std::string_view name, Block& block) {
    if (lexer.peek() == '<') {
        Pigment own(Color(0));
        read_clear(own.color, own.filter, own.transmit, range, name, block);
        value = own;
        return;
    }
    const std::string_view word = lexer.word();
    if (word.empty())
        lexer.fail("a vector <x, y, z> or a pattern expected for " + quoted(name) + " of " + quoted(block.name));
    if (!contains(pattern_words, word) || lexer.peek() != '{') {
        if (contains(pattern_words, word)) lexer.fail("'{' expected after " + quoted(word));
        diagnostics.add(word, unknown_word(word, pattern_words, " for " + quoted(name) + " of " + quoted(block.name)));
        throw ParseAbort{};
    }
    PatternBlock reading(*this, range);
    Pattern pattern = reading.read(word, block);
    if (!whole(pattern)) return;
    if (!reading.opacity) return void(value = Pigment(std::move(pattern)));
    std::vector<Transformation> steps = pattern.transformations;
    const bool by_uv = pattern.by_uv;
    if (!by_uv) pattern.transformations.clear();
    value = partly_clear(Pigment(std::move(pattern)), std::move(reading.opacity), std::move(steps), by_uv);
}

namespace {

/// Reads a relief whose pattern begins with one of these words, or `none`.
template <Use use, class Own, std::size_t size>
void read_relief(BlockReader& reader, Own& value, const std::array<std::string_view, size>& words,
                 const NumberRange& range, std::string_view name, Block& block) {
    const std::string_view word = reader.lexer.word();
    const auto of = [&] { return quoted(name) + " of " + quoted(block.name); };
    if (word == "none") return void(value = {});
    if (word.empty()) reader.lexer.fail("a pattern or 'none' expected for " + of());
    if (!contains(words, word)) {
        const auto known = joined(words, std::array<std::string_view, 1>{"none"});
        reader.diagnostics.add(word, unknown_word(word, known, " for " + of()));
        throw ParseAbort{};
    }
    PatternBlock reading(reader, range);
    Pattern pattern = reading.template read<use>(word, block);
    const ImagePattern* const image = std::get_if<ImagePattern>(&pattern.kind);
    if (image && !image->pixels) return;
    value.pattern = std::make_shared<const Pattern>(std::move(pattern));
    value.height = reading.height.value_or(Own().height);
}

}  // namespace

void BlockReader::read(Bump& value, const NumberRange& range, std::string_view name, Block& block) {
    read_relief<Use::bump>(*this, value, bump_words, range, name, block);
}
void BlockReader::read(NormalMap& value, const NumberRange& range, std::string_view name, Block& block) {
    read_relief<Use::normal>(*this, value, std::array<std::string_view, 1>{ImagePattern::name}, range, name, block);
}

namespace {

std::string block_text(const Pattern& pattern, const std::string& first);

/// <r, g, b>, or <r, g, b, filter, transmit> if light comes through; or the block of a pattern.
std::string color_text(const ColorStop& own) {
    if (own.pattern) return block_text(*own.pattern, "");
    std::string text = text_of(own.color);
    if (own.filter == 0 && own.transmit == 0) return text;
    text.back() = ',';
    return text + " " + text_of(own.filter) + ", " + text_of(own.transmit) + ">";
}

/// The block of a pattern. `first` stands before the other parameters.
std::string block_text(const Pattern& pattern, const std::string& first) {
    const auto& [kind, colors, transformations, by_uv] = pattern;
    std::string text = std::visit(
        [&]<class Kind>(const Kind& own) {
            std::string words(Kind::name);
            words += " {";
            const auto put = [&](const std::string& more) {
                if (!more.empty()) words += (words.back() == '{' ? " " : "  ") + more;
            };
            if constexpr (two_colored<Kind>) put(color_text(colors[0]) + ", " + color_text(colors[1]));
            if constexpr (requires { own.solid; }) put(std::string(solid_names[static_cast<std::size_t>(own.solid)]));
            if constexpr (requires { own.file; }) put("\"" + own.file + "\"");
            put(map_text(own, by_uv));
            if constexpr (requires { own.once; })
                if (own.once) put("once " + text_of(*own.once));
            if constexpr (requires { own.wrap; }) put(wrap_text(own.wrap));
            if constexpr (requires { own.sharp; })
                if (own.sharp) put("sharp");
            put(first);
            const auto add = [&](const auto& field) {
                if (own.*field.member != Kind().*field.member)
                    put(std::string(field.name) + " " + text_of(own.*field.member));
            };
            std::apply([&](const auto&... field) { (add(field), ...); }, Kind::fields);
            return words;
        },
        kind);
    if (!colors.empty() && std::visit([]<class Kind>(const Kind&) { return has_map<Kind>; }, kind)) {
        text += text.back() == '{' ? " colors {" : "  colors {";
        for (const ColorStop& stop : colors)
            text += std::string(&stop == &colors[0] ? " " : "  ") + text_of(stop.at) + " " + color_text(stop);
        text += " }";
    }
    for (const Transformation& step : transformations) text += "  " + text_of(step);
    return text + " }";
}

}  // namespace

std::string text_of(const Pigment& pigment) {
    if (const Opacity* const own = opacity_of(pigment)) {
        Pattern shown = *opaque_part(pigment).pattern;
        shown.transformations = pigment.pattern->transformations;
        std::string words = own->limit == 0 || own->factor != 1 ? "opacity " + text_of(own->factor) : "";
        if (own->limit > 0) words += (words.empty() ? "mask " : "  mask ") + text_of(own->limit);
        if (!own->file.empty()) words += "  opacity_of \"" + own->file + "\"";
        return block_text(shown, words);
    }
    return pigment.pattern ? block_text(*pigment.pattern, "")
                           : color_text({0, pigment.color, pigment.filter, pigment.transmit});
}
std::string text_of(const Bump& bump) {
    return bump.pattern ? block_text(*bump.pattern, "height " + text_of(bump.height)) : "none";
}
std::string text_of(const NormalMap& map) {
    const std::string height = map.height == NormalMap().height ? "" : "height " + text_of(map.height);
    return map.pattern ? block_text(*map.pattern, height) : "none";
}

}  // namespace strahl

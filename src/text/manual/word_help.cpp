#include "text/manual/word_help.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#include "num/decimal.h"
#include "text/blocks/blocks.h"

namespace strahl {
namespace {

using Rows = std::vector<WordHelp>;

std::string code(std::string_view word) { return std::string("`").append(word).append("`"); }

/// Describes words that no list of parameters does, or not alone.
constexpr std::array<std::pair<std::string_view, const char*>, 43> meanings{{
    {"camera", "where the eye is, and how it looks; a scene has exactly one"},
    {"light", "a point, a spotlight, parallel light or a rectangle of light"},
    {"material", "changes the parameters that it names of the material in force; `material NAME` is one by `define`"},
    {"defaultmaterial", "the material of all bodies after it"},
    {"coat", "a layer upon the material, with the same parameters; `coat none` removes those of the default material"},
    {"background", "what rays see that hit nothing; black by default"},
    {"fog", "lies between all bodies and hides the background"},
    {"global_settings", "settings of the whole scene"},
    {"flythrough", "a path of the camera: two or more keys, each a `key { ... }`"},
    {"motion", "a transformation that changes with time: two or more keys, each a `key { ... }`"},
    {"key", "a moment of a flythrough or of a motion"},
    {"define", "names a material or a body: `define NAME material { ... }`, `define NAME sphere { ... }`"},
    {"music", "beats and rows, which tracks follow"},
    {"track", "in place of a number: `track \"NAME\" 1` follows a track, and is 1 if that has no keys"},
    {"spot", "limits the light to a cone"},
    {"edges", "makes the light a rectangle around its position: `edges <u>, <v>`"},
    {"grid", "replaces the rectangle of `edges` by points: `grid columns, rows`; of a `soft` light, for its shadows"},
    {"rotate", "turns by degrees about the x axis, then y, then z, counter-clockwise seen from the tip of the axis"},
    {"translate", "moves"},
    {"scale", "scales about the origin; a factor may be negative, which mirrors, but not 0"},
    {"height", "by how much white, or a value of 1, raises the surface"},
    {"uv_vectors", "places of the corners in a picture: `uv_vectors <0, 0>, <1, 0>, <0, 1>`"},
    {"prism", "what lies between two heights over a figure in the plane of x and y"},
    {"lathe", "what contours in the plane of x and y make when they turn about the y axis"},
    {"superellipsoid", "a ball, a box with round edges, a double cone or something between, from -1 to 1 each way"},
    {"contour",
     "a line around the figure of a prism, or one that turns: `contour { <0, 0>  line <2, 0>  curve <2, 2>, <0, 2> }`"},
    {"line", "goes on along a straight line: `line <end>`"},
    {"curve", "goes on along a curve of Bezier's, which has one or two control points: `curve <control point>, <end>`"},
    {"blob", "lumps that melt into each other: all points where the fields of these add up to more than a threshold"},
    {"lump", "a ball or what is around a line: `lump { <from>, <to>, radius, strength }`"},
    {"sphere_sweep", "what a ball fills on its way along a curve, which four or more balls lead"},
    {"through", "a ball that the curve goes through, but for the first and the last: `through { <centre>, radius }`"},
    {"towards", "a ball that the curve only comes near to: `towards { <centre>, radius }`"},
    {"julia_fractal", "the points that stay near the origin when they are squared, or the like, and moved many times"},
    {"quaternion", "its numbers of four parts are multiplied as quaternions, unless it says otherwise"},
    {"hypercomplex", "they are multiplied as two complex numbers side by side"},
    {"mesh", "a body made of triangles"},
    {"file", "a PLY, OBJ or STL file of triangles, relative to the scene's folder: `file \"NAME\"`"},
    {"triangle", "a flat triangle"},
    {"smooth_triangle", "a flat triangle with normals that bend between its corners"},
    {"cylinder", "a body, closed at both ends"},
    {"cone", "a body, closed at both ends; one radius may be 0"},
    {"plane", "an endless plane, solid on the side from which its three points are clockwise"},
}};

/// The default of a parameter in words; `instead_of` is the parameter that it can replace, or empty.
std::string default_of(const Parameter& parameter, std::string_view instead_of) {
    if (!instead_of.empty()) return "in place of " + code(instead_of);
    if (!parameter.otherwise.empty()) return std::string(parameter.otherwise);
    return std::visit(
        [](const auto* value) -> std::string {
            if constexpr (requires { text_of(*value); })
                return code(text_of(*value));
            else
                return "none";
        },
        parameter.value);
}

Rows parameter_rows(std::span<const Parameter> parameters) {
    Rows rows;
    std::string_view before, offers;  // the parameter above and its alternative
    for (const Parameter& p : parameters) {
        const bool word_alone = std::holds_alternative<bool*>(p.value);
        rows.push_back({code(p.name), default_of(p, p.name == offers ? before : ""),
                        word_alone ? "the word alone" : p.range.words, p.help});
        before = p.name, offers = p.alternative;
    }
    return rows;
}

template <class Kind>
Rows body_rows() {
    if constexpr (std::is_same_v<Kind, Mesh>) {
        return {{"file \"NAME\"", "", "a path, relative to the scene's folder", "a PLY, OBJ or STL file of triangles"},
                {"triangle, smooth_triangle", "", "blocks with the arguments above",
                 "any number of them, in place of a file"}};
    } else if constexpr (is_composite<Kind>) {
        const char* const what = Kind::operation == Operation::unite       ? "all points in at least one of them"
                                 : Kind::operation == Operation::intersect ? "all points in all of them"
                                                                           : "all points in the first and in no other";
        return {{"bodies", "", "blocks of closed bodies", what}};
    } else {
        Rows rows;
        const auto add = [&](const auto& field) {
            const std::string name(field.name);
            rows.push_back({field.given == Given::optional ? "[" + name + "]" : name, "",
                            argument_range(field.range).words, field.help});
        };
        std::apply([&](const auto&... field) { (add(field), ...); }, Kind::fields);
        if constexpr (has_contours<Kind>)
            rows.push_back(
                {"contour", "", "blocks of a start, then `line`s and `curve`s", "its contours, one or more"});
        const auto add_part = [&](const std::string& word, const auto& fields) {
            const auto add_field = [&](const auto& field) {
                const std::string own = word + ": " + field.name;
                rows.push_back({field.given == Given::optional ? "[" + own + "]" : own, "",
                                argument_range(field.range).words, field.help});
            };
            std::apply([&](const auto&... field) { (add_field(field), ...); }, fields);
        };
        if constexpr (std::is_same_v<Kind, Blob>) add_part("lump", Lump::fields);
        if constexpr (std::is_same_v<Kind, SphereSweep>) add_part("through or towards", SweptBall::fields);
        return rows;
    }
}

template <class Kind>
Rows pattern_rows() {
    Kind kind;
    Rows rows;
    std::vector<std::string> wraps;
    for (const std::string_view wrap : image_wraps) wraps.push_back(code(wrap));
    if constexpr (two_colored<Kind>)
        rows = {{"two colours", "required", not_negative.words, Kind::help}};
    else if constexpr (requires { kind.solid; })
        rows = {{"its name", "required", "see above", Kind::help},
                {"`colors`", "required", "see above", "the colours"}};
    else if constexpr (has_map<Kind>)
        rows = {{"`colors`", "required", "see above", Kind::help}};
    else
        rows = {
            {"\"NAME\"", "required", "a path, relative to the scene's folder", Kind::help},
            {"`once`", "it repeats", not_negative.words, "the picture is there once, with this colour around it"},
            {"`wrap`", code(image_wraps[0]), listed(wraps),
             "what is beyond its edges: the picture again, the colours of the edge, or its mirror image; a second word "
             "is "
             "for v"},
            {"`sharp`", "colours change between pixels", "the word alone", "each pixel is a rectangle of its colour"},
            {"`opacity`", "the picture must be opaque", shares.words,
             "lets light through where the alpha channel, multiplied by this, is below 1"},
            {"`mask`", "values are kept", shares.words, "is opaque where that is at least this, and clear elsewhere"},
            {"`opacity_of`", "the same picture", "a path, relative to the scene's folder",
             "takes the alpha channel of another picture, or its brightness if it has none"}};
    std::vector<std::string> maps;
    for (const std::string_view map : maps_of(kind)) maps.push_back(code(map));
    rows.push_back({"`map`", maps.size() == 1 ? "the body's points" : code(image_maps[0]), listed(maps),
                    "how the pattern is laid onto the body"});
    if constexpr (std::tuple_size_v < decltype(Kind::fields) >> 0)
        for (WordHelp& row : parameter_rows(field_parameters(kind))) rows.push_back(std::move(row));
    return rows;
}

/// The rows about a body or a pattern.
template <class... Kinds>
Rows kind_rows(std::string_view name, std::type_identity<std::variant<Kinds...>>) {
    Rows rows;
    const auto make = [&]<class Kind>(std::type_identity<Kind>) {
        if constexpr (requires { Kind::help; })
            rows = pattern_rows<Kind>();
        else
            rows = body_rows<Kind>();
    };
    ((name == Kinds::name ? make(std::type_identity<Kinds>()) : void()), ...);
    return rows;
}

/// The word of a parameter, empty for an argument.
std::string_view word_of(const WordHelp& row) {
    const std::string_view name = row.name;
    return name.starts_with('`') ? name.substr(1, name.find('`', 1) - 1) : "";
}

/// Returns the block whose help a block shows: `coat` that of `material`, a `key` in a motion that of `motion`.
std::string_view own_block(std::string_view block, std::string_view outer) {
    if (block == "key" && outer == "motion") return "motion";
    return block == "defaultmaterial" || block == "coat" ? "material" : block;
}

}  // namespace

std::vector<WordHelp> help_on_block(std::string_view block) {
    Rows rows = kind_rows(block, std::type_identity<Shape>());
    if (rows.empty()) rows = kind_rows(block, std::type_identity<PatternKind>());
    each_block([&](const char* word, const auto& parameters) {
        if (block == word) rows = parameter_rows(parameters);
    });
    if (block == "music")
        rows.push_back({code(music_words[0]) + " \"NAME\"", "none", "a path, relative to the scene's folder",
                        "an Ogg Vorbis file, mono or stereo"});
    return rows;
}

std::vector<std::string> words_in(std::string_view block, std::string_view outer) {
    std::vector<std::string> words;
    const auto add = [&](const auto& more) { words.insert(words.end(), more.begin(), more.end()); };
    const bool pattern = contains(pattern_words, block), known = !help_on_block(own_block(block, outer)).empty();
    if (block != "motion")
        for (const WordHelp& row : help_on_block(own_block(block, outer)))
            if (!word_of(row).empty()) words.emplace_back(word_of(row));
    if (block.empty()) add(block_words);
    if (block == "flythrough" || block == "motion") words.emplace_back("key");
    if (block == "light") add(light_words);
    if (own_block(block, outer) == "material") words.emplace_back("coat");
    if (block == Mesh::name) add(mesh_words);
    if (block == Prism::name || block == Lathe::name) add(figure_words);
    if (block == Blob::name) add(blob_words);
    if (block == SphereSweep::name) add(sweep_words);
    if (block == JuliaFractal::name) add(julia_set_words);
    if (block == figure_words[0]) return add(contour_words), words;
    if (outer == Mesh::name) return add(triangle_words), words;
    if (pattern && contains(bump_words, block)) words.emplace_back("height");
    if (pattern) add(transformation_words);
    if (block == "union" || block == "intersection" || block == "difference") add(body_words);
    if (contains(body_words, block) || (!known && !block.empty() && block != "colors")) add(shape_words);
    return words;
}

std::vector<std::string> words_after(std::string_view word) {
    const auto all = [](const auto& words) { return std::vector<std::string>(words.begin(), words.end()); };
    if (word == "rgb" || word == "color") return all(pattern_words);
    if (word == "bump") return all(bump_words);
    if (word == "normal") return {ImagePattern::name};
    if (word == "map") return all(maps_of(ImagePattern()));
    if (word == "wrap") return all(image_wraps);
    if (word == "solid") return all(solid_names);
    return {};
}

std::string help_on_word(std::string_view word, std::string_view block, std::string_view outer) {
    const auto found = std::ranges::find(meanings, word, [](const auto& own) { return own.first; });
    std::string text = found != meanings.end() ? found->second : "";
    if (block == JuliaFractal::name && contains(julia_words, word)) text = "the step that is taken again and again";
    for (const WordHelp& row : help_on_block(own_block(block, outer)))
        if (word_of(row) == word)
            text = row.meaning + "\n\n" + row.values + "; " + (row.otherwise.starts_with('`') ? "default " : "") +
                   row.otherwise;
    std::string rows;
    for (const WordHelp& row : help_on_block(own_block(word, block))) {
        const std::string otherwise = row.otherwise.empty() ? "" : "; " + row.otherwise;
        rows += "\n- " + row.name + ": " + row.meaning + " (" + row.values + otherwise + ")";
    }
    if (text.empty() && rows.empty()) return "";
    return "**" + std::string(word) + "**" + (text.empty() ? "" : ": " + text) + (rows.empty() ? "" : "\n" + rows);
}

}  // namespace strahl

// Parses the blocks of the scene language.
#include <array>
#include <optional>
#include <utility>

#include "files/utf8.h"
#include "text/blocks/blocks.h"
#include "text/blocks/bodies.h"
#include "text/blocks/camera_blocks.h"
#include "text/blocks/definitions.h"
#include "text/blocks/light_block.h"
#include "text/blocks/mesh_block.h"
#include "text/blocks/motion_block.h"
#include "text/blocks/settings_block.h"
#include "text/parse.h"
#include "text/reading/other_files.h"
#include "text/reading/reader.h"

namespace strahl {
namespace {

/// Most levels of bodies in bodies, which are read by recursion.
constexpr int most_levels = 32;

/// The words that may stand in the block of a body.
template <class Kind>
constexpr auto words_in = shape_words;
template <>
constexpr auto words_in<Mesh> = joined(mesh_words, shape_words);
template <>
constexpr auto words_in<Prism> = joined(figure_words, shape_words);
template <>
constexpr auto words_in<Lathe> = words_in<Prism>;
template <>
constexpr auto words_in<Blob> = joined(blob_words, shape_words);
template <>
constexpr auto words_in<SphereSweep> = joined(sweep_words, shape_words);
template <>
constexpr auto words_in<JuliaFractal> = joined(julia_set_words, shape_words);
template <Operation operation>
constexpr auto words_in<Composite<operation>> = composite_words;

constexpr std::array<std::string_view, 1> coat_word{"coat"};
constexpr std::size_t most_coats = 7;

class Parser {
  public:
    Parser(std::string_view text, Diagnostics& diagnostics, SceneFiles& files, const TextLimits& limits)
        : limits(limits),
          text(text),
          diagnostics(diagnostics),
          reader(text, diagnostics, block_words, files),
          cameras(reader, limits) {}
    Scene parse();

  private:
    /// Words that follow the arguments of a body: `material`, and its last transformation.
    struct Ending {
        std::string_view material, last;
    };

    void top_block(std::string_view word);
    void define(std::string_view word);
    bool use(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth);
    bool finish(std::string_view word, Primitive& primitive, Block& block, Ending& ending);
    void background(std::string_view word);
    Block material(std::string_view word, MaterialText& target);
    bool coat(std::string_view word, MaterialText& target, Block& outer);
    bool body(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth);
    template <class Kind>
    void shape(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth);
    template <class Kind>
    void check(const Kind& shape, const Primitive& primitive, Block& block, std::string_view word, const Ending& ending,
               int depth);

    const TextLimits& limits;
    std::string_view text;
    Diagnostics& diagnostics;
    BlockReader reader;
    CameraBlocks cameras;
    Scene scene;
    Materials materials;
    Definitions definitions;
    Material default_material;
    std::size_t bodies_read = 0, points = 0;                        // points of lights
    std::vector<MaterialText> written;                              // materials of the body being read and its parts
    std::string_view background_at, settings_at, fog_at, music_at;  // the first words of these blocks
};

Scene Parser::parse() {
    reader.blocks_to_end("sphere { ... }", [&](std::string_view word) { top_block(word); });
    cameras.check(text.substr(text.size()));
    diagnostics.check();
    scene.camera = cameras.the_camera;
    scene.flythrough = std::move(cameras.path);
    scene.camera_follows = std::move(cameras.follows);
    if (reader.any_track) scene.tracks = reader.files.tracks();
    scene.materials = std::move(materials.list);
    return std::move(scene);
}

void Parser::top_block(std::string_view word) {
    Block own{word};
    written.clear();
    if (body(word, scene.primitives, own, 0) || use(word, scene.primitives, own, 0)) {
        materials.settle(scene.primitives.back(), default_material, written);
        if (!own.good()) return;
        const Primitive& read = scene.primitives.back();
        for (const std::string& fault : {crowd_fault(read, materials.list), place_fault(read, materials.list)})
            if (!fault.empty()) diagnostics.add(word, "invalid " + std::string(word) + ": " + fault);
        return;
    }
    if (word == "light") {
        scene.lights.push_back(read_light(reader, limits, word));
        points += points_of(scene.lights.back());
        return reader.limit(points - 1, limits.lights, word, "lights");
    }
    if (word == "define") return define(word);
    if (MaterialText changes; word == "defaultmaterial")
        return material(word, changes), void(default_material = changes.on(default_material));
    if (word == "camera") return cameras.camera(word);
    if (word == "background") return background(word);
    if (word == "flythrough") return cameras.flythrough(word);
    if (word == "fog") return reader.once(fog_at, word), void(scene.fog = read_fog(reader, word));
    if (word == "global_settings")
        return reader.once(settings_at, word), void(scene.settings = read_settings(reader, word));
    if (word == "music")
        return reader.once(music_at, word), void(reader.music = scene.music = read_music(reader, word));
    diagnostics.add(word, unknown_word(word, definitions.with_bodies(block_words), ""));
    throw ParseAbort{};
}

void Parser::background(std::string_view word) {
    reader.once(background_at, word);
    Block block{word, false, false, &scene.background_follows};
    auto parameters = background_parameters(scene.background);
    reader.block(
        block, parameters, coat_word, [] {},
        [&](std::string_view inner) {
            if (inner != coat_word[0]) return false;
            reader.limit(scene.background_coats.size(), most_coats, inner, "coats");
            reader.read(scene.background_coats.emplace_back(Color(0)), not_negative, inner, block);
            return true;
        });
    reader.require(block, parameters);
    const auto by_uv = [](const Pigment& own) { return own.pattern && own.pattern->by_uv; };
    if (by_uv(scene.background) || std::ranges::any_of(scene.background_coats, by_uv))
        diagnostics.add(word, "invalid background: its pattern is mapped by uv, which only meshes have");
}

/// Reads `material { ... }`, `material NAME` or `material NAME { ... }`.
Block Parser::material(std::string_view word, MaterialText& target) {
    Block block{word};
    const std::string_view name = reader.lexer.word();
    if (!name.empty()) target.add(definitions.material(name, diagnostics));
    if (!name.empty() && reader.lexer.peek() != '{') return block;
    MaterialText own;
    auto parameters = field_parameters(own.values);
    block.follows = &own.values.follows;
    reader.block(
        block, parameters, coat_word, [] {}, [&](std::string_view inner) { return coat(inner, own, block); });
    block.follows = nullptr;
    for (std::size_t i = 0; i < parameters.size(); ++i) own.named[i] = parameters[i].given();
    target.add(own);
    return block;
}

/// Reads `coat { ... }`, a layer above those before, or `coat none`.
bool Parser::coat(std::string_view word, MaterialText& target, Block& outer) {
    if (word != coat_word[0]) return false;
    target.coated = true;
    if (reader.lexer.peek() != '{') {
        const std::string_view name = reader.lexer.word();
        if (name != "none") reader.fault(outer, name.empty() ? word : name, "'{' or 'none' expected after 'coat'");
        return target.values.coats.clear(), true;
    }
    Block block{word};
    Material own = coat_base();
    auto parameters = field_parameters(own);
    reader.block(block, parameters);
    outer.absorb(block);
    reader.limit(target.values.coats.size(), most_coats, word, "coats");
    target.values.coats.push_back(std::move(own));
    return true;
}

/// Reads `define NAME material { ... }` or `define NAME BODY { ... }`.
void Parser::define(std::string_view) {
    const std::string_view name = reader.lexer.word();
    if (name.empty()) reader.lexer.fail("a name expected after 'define'");
    const std::string_view word = reader.lexer.word();
    if (word == "material") {
        MaterialText text;
        material(word, text);
        return definitions.add(name, text, diagnostics);
    }
    const std::size_t before = bodies_read;
    std::vector<Primitive> own;
    Block block{word};
    if (!body(word, own, block, 0) && !use(word, own, block, 0)) {
        constexpr auto known = joined(std::array<std::string_view, 1>{"material"}, body_words);
        if (word.empty()) {
            const std::string form = ", as in define " + std::string(name) + " material { ... }";
            reader.lexer.fail("'material' or a body expected after " + quoted(name) + (name == "material" ? "" : form));
        }
        const std::string where = " after 'define " + std::string(name) + "'";
        diagnostics.add(word, unknown_word(word, definitions.with_bodies(known), where));
        throw ParseAbort{};
    }
    if (!block.good()) own.back() = {}, written.resize(1);  // else bodies with too many parts could go on growing
    const std::size_t bodies = block.good() ? bodies_read - before : 1;
    definitions.add(name, {std::move(own.back()), written, bodies, block.good()}, diagnostics);
}

/// Reads a body by its name.
bool Parser::use(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth) {
    const Definitions::NamedBody* const defined = definitions.body(word);
    if (!defined) return false;
    reader.limit(bodies_read += defined->bodies, limits.primitives, word, "primitives");
    reader.limit(depth + defined->levels, most_levels, word, "levels of bodies in bodies");
    Primitive primitive = Definitions::renumbered(defined->primitive, static_cast<int>(written.size()));
    written.insert(written.end(), defined->written.begin(), defined->written.end());
    Block block{word};
    block.bad = !defined->good;
    Ending ending;
    reader.block(
        block, shape_words, [] {}, [&](std::string_view inner) { return finish(inner, primitive, block, ending); });
    const auto look = [&](const auto& shape) { check(shape, primitive, block, word, ending, depth); };
    if (block.good()) std::visit(look, primitive.shape);
    outer.absorb(block);
    bodies.push_back(std::move(primitive));
    return true;
}

/// Reads what may follow the arguments of any body.
bool Parser::finish(std::string_view word, Primitive& primitive, Block& block, Ending& ending) {
    if (word == "material") {
        reader.once(ending.material, word);
        block.absorb(material(word, written[primitive.material]));
        return true;
    }
    if (!contains(shape_words, word)) return false;
    reader.limit(primitive.transformations.size(), limits.transformations, word, "transformations of one primitive");
    primitive.transformations.push_back(word == "motion" ? read_motion(reader, limits, word, block)
                                                         : read_transformation(reader, word, block, true));
    ending.last = word;
    return true;
}

/// Reads a body of the block `outer`, if `word` begins one, and appends it to `bodies`. Its material stays a number
/// among `written`.
bool Parser::body(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth) {
    const auto read = [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        return ((word == Kinds::name && (shape<Kinds>(word, bodies, outer, depth), true)) || ...);
    };
    return read(std::type_identity<Shape>{});
}

/// Reads the block of a body: its arguments, then material, transformations and, in a composite, parts in any order.
template <class Kind>
void Parser::shape(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth) {
    reader.limit(bodies_read++, limits.primitives, word, "primitives");
    reader.limit(depth, most_levels, word, "levels of bodies in bodies");
    Kind kind;
    Primitive primitive{{}, static_cast<int>(written.size()), {}};
    written.emplace_back();
    Block block{word};
    Ending ending;
    constexpr bool is_mesh = std::is_same_v<Kind, Mesh>;
    std::optional<MeshBlock> mesh;  // costs more than most bodies
    if (is_mesh) mesh.emplace(reader);
    std::vector<Primitive> parts;
    std::vector<Contour> contours;
    std::vector<Lump> lumps;
    std::vector<SweptBall> balls;
    reader.block(
        block, words_in<Kind>, [&] { read_arguments(reader, kind, block); },
        [&](std::string_view inner) {
            if (is_mesh && mesh->part(inner, block)) return true;
            if (has_contours<Kind> && inner == figure_words[0])
                return contours.push_back(read_contour(reader, inner, block)), true;
            if (std::is_same_v<Kind, Blob> && inner == blob_words[0])
                return lumps.push_back(read_part<Lump>(reader, inner, block)), true;
            if (std::is_same_v<Kind, SphereSweep> && contains(sweep_words, inner)) {
                balls.push_back(read_part<SweptBall>(reader, inner, block));
                balls.back().through = inner == sweep_words[0];
                return true;
            }
            if constexpr (std::is_same_v<Kind, JuliaFractal>)
                if (kind.take_word(inner)) return true;
            if (is_composite<Kind> && (body(inner, parts, block, depth + 1) || use(inner, parts, block, depth + 1)))
                return true;
            return finish(inner, primitive, block, ending);
        });
    if constexpr (is_mesh) kind = mesh->take(word, block);
    if constexpr (has_contours<Kind>)
        kind.data = std::make_shared<const ContourData>(std::move(contours), std::is_same_v<Kind, Lathe>);
    if constexpr (std::is_same_v<Kind, Blob>) kind.data = std::make_shared<const BlobData>(std::move(lumps));
    if constexpr (std::is_same_v<Kind, SphereSweep>) kind.data = std::make_shared<const SweepData>(std::move(balls));
    if constexpr (is_composite<Kind>) kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
    if (block.good()) check(kind, primitive, block, word, ending, depth);
    outer.absorb(block);
    primitive.shape = std::move(kind);
    bodies.push_back(std::move(primitive));
}

/// Reports why a body is invalid: its arguments, its transformations, or that it cannot be a part.
template <class Kind>
void Parser::check(const Kind& shape, const Primitive& primitive, Block& block, std::string_view word,
                   const Ending& ending, int depth) {
    const std::string invalid = "invalid " + std::string(word) + ": ";
    if (const char* const why = shape.fault()) return reader.fault(block, word, invalid + why);
    if (!ending.last.empty()) {
        const std::string why = moved_fault(shape, primitive.transformations);
        if (!why.empty()) return reader.fault(block, ending.last, invalid + "the transformations up to here " + why);
    }
    if (const std::string why = depth > 0 ? fault_as_part(shape, word) : ""; !why.empty())
        reader.fault(block, word, why);
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view file, const TextLimits& limits, const ReadPixels& read_pixels,
                  FilesRead* read, std::span<const TextOrigin> origins) {
    text = utf8_text(text, file);
    refuse_other_files(text, file);
    refuse_other_scenes(text, file);
    Diagnostics diagnostics(text, file, origins);
    diagnostics.check_encoding();
    SceneFiles files(file, read_pixels);
    Scene scene = Parser(text, diagnostics, files, limits).parse();
    if (read) *read = files.read;
    return scene;
}

}  // namespace strahl

// The parser: the blocks of the scene language.
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "num/decimal.h"
#include "text/blocks.h"
#include "text/bodies.h"
#include "text/camera_blocks.h"
#include "text/materials.h"
#include "text/mesh_block.h"
#include "text/parse.h"
#include "text/reader.h"
#include "text/utf8.h"

namespace strahl {
namespace {

/// Most levels of bodies in bodies, which are read by recursion.
constexpr int most_levels = 32;

/// The words that may stand in the block of a body.
template <class Kind>
constexpr auto words_in = shape_words;
template <>
constexpr auto words_in<Mesh> = joined(mesh_words, shape_words);
template <Operation operation>
constexpr auto words_in<Composite<operation>> = composite_words;

class Parser {
  public:
    Parser(std::string_view text, std::string_view file, Diagnostics& diagnostics, const TextLimits& limits)
        : limits(limits),
          folder(std::filesystem::path(file).parent_path().string()),
          text(text),
          diagnostics(diagnostics),
          reader(text, diagnostics, block_words),
          cameras(reader, limits) {}
    Scene parse();

  private:
    void top_block(std::string_view word);
    void light(std::string_view word);
    Spot spot(std::string_view word, Block& outer);
    void check_light(const Light& light, std::string_view direction_at, std::string_view spot_at);
    void background(std::string_view word);
    void global_settings(std::string_view word);
    Block material(std::string_view word, MaterialText& target);
    bool body(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth);
    template <class Kind>
    void shape(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth);
    void settle(Primitive& primitive, const Material& base);
    template <class Kind>
    std::string fault(const Kind& shape, const Primitive& primitive, std::string_view& at, std::string_view last);
    void limit(std::size_t count, std::size_t most, std::string_view at, const char* what);

    const TextLimits& limits;
    const std::string folder;
    std::string_view text;
    Diagnostics& diagnostics;
    Reader reader;
    CameraBlocks cameras;
    Scene scene;
    Materials materials;
    MeshFiles mesh_files;
    Material default_material;
    std::size_t bodies_read = 0;
    std::vector<MaterialText> written;            // of the body being read and its parts
    std::string_view background_at, settings_at;  // where these blocks are, of which a scene has one
};

Scene Parser::parse() {
    Lexer& lexer = reader.lexer;
    while (!lexer.at_end()) {
        const std::string_view word = lexer.word();
        try {
            if (!word.empty())
                top_block(word);
            else if (!(diagnostics.any() && lexer.accept('}')))  // one too many may follow from an earlier error
                lexer.fail("a block expected, such as 'sphere { ... }'");
        } catch (const ParseAbort&) {
            const bool inside = lexer.accept('{');
            lexer.skip_to(block_words, block_words);
            if (inside) lexer.accept('}');
        }
    }
    cameras.check(text.substr(text.size()));
    diagnostics.check();
    scene.camera = cameras.the_camera;
    scene.flythrough = std::move(cameras.path);
    scene.materials = std::move(materials.list);
    return std::move(scene);
}

void Parser::top_block(std::string_view word) {
    Block own{word};
    written.clear();
    if (body(word, scene.primitives, own, 0)) return settle(scene.primitives.back(), default_material);
    if (word == "light") return light(word);
    if (word == "defaultmaterial") {
        MaterialText changes;
        material(word, changes);
        default_material = changes.on(default_material);
        return;
    }
    if (word == "camera") return cameras.camera(word);
    if (word == "background") return background(word);
    if (word == "global_settings") return global_settings(word);
    if (word == "flythrough") return cameras.flythrough(word);
    diagnostics.add(word, unknown_word(word, block_words, ""));
    throw ParseAbort{};
}

void Parser::limit(std::size_t count, std::size_t most, std::string_view at, const char* what) {
    if (count < most) return;
    diagnostics.add(at, "more than " + std::to_string(most) + " " + what);
    diagnostics.check();
}

void Parser::light(std::string_view word) {
    limit(scene.lights.size(), limits.lights, word, "lights");
    Light light;
    Block block{word};
    auto parameters = light_parameters(light);
    std::string_view spot_at;
    constexpr std::array<std::string_view, 1> other{"spot"};
    reader.block(
        block, parameters, other, [] {},
        [&](std::string_view inner) {
            if (inner != "spot") return false;
            const bool first = reader.once(spot_at, inner);
            const Spot own = spot(inner, block);
            if (first) light.spot = own;
            return true;
        });
    reader.require(block, parameters);
    if (block.good()) check_light(light, parameters[1].at, spot_at);
    scene.lights.push_back(light);
}

Spot Parser::spot(std::string_view word, Block& outer) {
    Spot spot;
    Block block{word};
    auto parameters = spot_parameters(spot);
    reader.block(block, parameters);
    reader.require(block, parameters);
    if (block.good() && spot.falloff < spot.radius) {
        diagnostics.add(word, "the falloff of this spot, " + text_of(spot.falloff) + ", is below its radius, " +
                                  text_of(spot.radius));
        block.bad = true;
    }
    outer.absorb(block);
    return spot;
}

void Parser::check_light(const Light& light, std::string_view direction_at, std::string_view spot_at) {
    if (light.direction && *light.direction == DVec3(0))
        diagnostics.add(direction_at, "this 'direction' of 'light' has no direction");
    if (!light.spot) return;
    if (light.direction)
        diagnostics.add(spot_at, "parallel light has no place from which a spot could shine; give it a 'position'");
    else if (light.spot->look_at == light.position)
        diagnostics.add(spot_at, "this spot shines nowhere: 'look_at' is the light's own position");
}

void Parser::background(std::string_view word) {
    reader.once(background_at, word);
    Block block{word};
    auto parameters = background_parameters(scene.background);
    reader.block(block, parameters);
    reader.require(block, parameters);
}

void Parser::global_settings(std::string_view word) {
    reader.once(settings_at, word);
    Block block{word};
    SettingsText settings;
    auto parameters = settings_parameters(settings);
    reader.block(block, parameters);
    if (!block.good()) return;
    scene.settings = {settings.ambient_light, static_cast<int>(settings.max_trace_level),
                      settings.assumed_gamma.has_value()};
}

Block Parser::material(std::string_view word, MaterialText& target) {
    Block block{word};
    auto parameters = material_parameters(target.values);
    reader.block(block, parameters);
    for (std::size_t i = 0; i < parameters.size(); ++i) target.named[i] = parameters[i].given();
    return block;
}

/// Reads a body to the end of `bodies`, if `word` begins one, which is in the block `outer`. Its material stays a
/// number among `written`.
bool Parser::body(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth) {
    const auto read = [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        return ((word == Kinds::name && (shape<Kinds>(word, bodies, outer, depth), true)) || ...);
    };
    return read(std::type_identity<Shape>{});
}

/// The block of a body: the arguments that its field table lists, then material, transformations and, in a composite,
/// parts in any order.
template <class Kind>
void Parser::shape(std::string_view word, std::vector<Primitive>& bodies, Block& outer, int depth) {
    limit(bodies_read++, limits.primitives, word, "primitives");
    limit(depth, most_levels, word, "levels of bodies in bodies");
    Kind kind;
    Primitive primitive{{}, static_cast<int>(written.size()), {}};
    written.emplace_back();
    Block block{word};
    std::string_view material_at, last;
    constexpr bool is_mesh = std::is_same_v<Kind, Mesh>;
    std::optional<MeshBlock> mesh;  // costs more than most bodies
    if (is_mesh) mesh.emplace(reader, folder, mesh_files);
    std::vector<Primitive> parts;
    reader.block(
        block, words_in<Kind>, [&] { read_arguments(reader, kind, block); },
        [&](std::string_view inner) {
            if (inner == "material") {
                reader.once(material_at, inner);
                block.absorb(material(inner, written[primitive.material]));
                return true;
            }
            if (is_mesh && mesh->part(inner, block)) return true;
            if (is_composite<Kind> && body(inner, parts, block, depth + 1)) return true;
            if (!contains(shape_words, inner)) return false;
            limit(primitive.transformations.size(), limits.transformations, inner, "transformations of one primitive");
            primitive.transformations.push_back(read_transformation(reader, inner, block));
            last = inner;
            return true;
        });
    if constexpr (is_mesh) kind = mesh->take(word, block);
    if constexpr (is_composite<Kind>) kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
    if (block.good()) {
        std::string_view at = word;
        std::string message = fault(kind, primitive, at, last);
        if (message.empty() && depth > 0 && !can_be_part<Kind>)
            message = "a " + std::string(word) + " can't be part of a body: only closed ones but meshes can";
        block.bad = !message.empty();
        if (block.bad) diagnostics.add(at, message);
    }
    outer.absorb(block);
    primitive.shape = std::move(kind);
    bodies.push_back(std::move(primitive));
}

/// Works out what material a body that was read has, and its parts: they start from that of their composite, wherever
/// it stands in the text. A composite is numbered before its parts.
void Parser::settle(Primitive& primitive, const Material& base) {
    const Material own = written[primitive.material].on(base);
    primitive.material = materials.number(own);
    const auto settle_parts = [&]<class Kind>(Kind& kind) {
        if constexpr (is_composite<Kind>) {
            std::vector<Primitive> parts = *kind.parts;
            for (Primitive& part : parts) settle(part, own);
            kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
        }
    };
    std::visit(settle_parts, primitive.shape);
}

/// Why a body is invalid, by its arguments, or by its transformations, the last of which is at `last`; or "".
template <class Kind>
std::string Parser::fault(const Kind& shape, const Primitive& primitive, std::string_view& at, std::string_view last) {
    const std::string name = Kind::name;
    if (const char* const fault = shape.fault()) return "this " + name + " is none: " + fault;
    if (primitive.transformations.empty()) return "";
    const std::string fault = transformed_fault(shape, matrix(primitive.transformations));
    at = last;
    return fault.empty() ? "" : "up to here the transformations of this " + name + " " + fault;
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view file, const TextLimits& limits) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    Diagnostics diagnostics(text, file);
    if (const std::size_t i = find_invalid(text); i != text.npos) {
        diagnostics.add(text.substr(i, 1), text[i] == '\0' ? "a byte 0 in the text; is this a scene file?"
                                                           : "not UTF-8; save the file in that encoding");
        diagnostics.check();
    }
    return Parser(text, file, diagnostics, limits).parse();
}

}  // namespace strahl

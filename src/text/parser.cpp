// The parser: the blocks of the scene language.
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

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
    void background(std::string_view word);
    void global_settings(std::string_view word);
    Block material(std::string_view word, Material& target);
    template <class Kind>
    bool shape(std::string_view word);
    Transformation transformation(std::string_view word, Block& block);
    template <class Kind>
    void check(const Kind& shape, const Primitive& primitive, std::string_view word, std::string_view last);
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
    const auto is_shape = [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        return ((word == Kinds::name && shape<Kinds>(word)) || ...);
    };
    if (is_shape(std::type_identity<Shape>{})) return;
    if (word == "light") return light(word);
    if (word == "defaultmaterial") return void(material(word, default_material));
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
    reader.block(block, parameters);
    reader.require(block, parameters);
    scene.lights.push_back(light);
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
    const double depth = settings.max_trace_level;
    if (depth != std::floor(depth))
        diagnostics.add(parameters[1].at, std::string("'max_trace_level' must be ") + depths.words);
    scene.settings = {settings.ambient_light, static_cast<int>(depth), settings.assumed_gamma.has_value()};
}

/// Changes the parameters that the block names.
Block Parser::material(std::string_view word, Material& target) {
    Block block{word};
    auto parameters = material_parameters(target);
    reader.block(block, parameters);
    return block;
}

Transformation Parser::transformation(std::string_view word, Block& block) {
    DVec3 v{0};
    if (word == "rotate") return reader.read(v, anything, word, block), Rotate{v};
    if (word == "translate") return reader.read(v, coordinates, word, block), Translate{v};
    const std::string_view at = (reader.lexer.peek(), reader.lexer.token());
    if (reader.lexer.peek() == '<')
        reader.read(v, anything, word, block);
    else
        reader.read(v.x, anything, word, block), v.y = v.z = v.x;
    if (v.x == 0 || v.y == 0 || v.z == 0) {
        diagnostics.add(
            at, "'scale' of " + quoted(block.name) + " is 0, which would leave nothing of it; 1 changes nothing");
        block.bad = true;
    }
    return Scale{v};
}

/// The block of a body: the arguments that its field table lists, then material and transformations in any order.
template <class Kind>
bool Parser::shape(std::string_view word) {
    limit(scene.primitives.size(), limits.primitives, word, "primitives");
    Kind kind;
    Primitive primitive;
    Material own = default_material;
    Block block{word};
    std::string_view material_at, last;
    constexpr bool is_mesh = std::is_same_v<Kind, Mesh>;
    MeshBlock mesh(reader, folder, mesh_files);
    constexpr auto words = [] {
        if constexpr (is_mesh)
            return joined(mesh_words, shape_words);
        else
            return shape_words;
    }();
    reader.block(
        block, words, [&] { read_arguments(reader, kind, block); },
        [&](std::string_view inner) {
            if (inner == "material") {
                reader.once(material_at, inner);
                block.absorb(material(inner, own));
                return true;
            }
            if (is_mesh && mesh.part(inner, block)) return true;
            if (!contains(shape_words, inner)) return false;
            limit(primitive.transformations.size(), limits.transformations, inner, "transformations of one primitive");
            primitive.transformations.push_back(transformation(inner, block));
            last = inner;
            return true;
        });
    if constexpr (is_mesh) kind = mesh.take(word, block);
    if (block.good()) check(kind, primitive, word, last);
    primitive.shape = kind;
    primitive.material = materials.number(own);
    scene.primitives.push_back(std::move(primitive));
    return true;
}

/// Reports a body that is invalid by its arguments or by its transformations, the last of which is at `last`.
template <class Kind>
void Parser::check(const Kind& shape, const Primitive& primitive, std::string_view word, std::string_view last) {
    const std::string name(word);
    if (const char* const fault = shape.fault()) return diagnostics.add(word, "this " + name + " is none: " + fault);
    if (primitive.transformations.empty()) return;
    const std::string fault = transformed_fault(shape, primitive.transformations);
    if (!fault.empty()) diagnostics.add(last, "up to here the transformations of this " + name + " " + fault);
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

#include "povref/convert/bodies.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "num/decimal.h"
#include "povref/convert/layout.h"
#include "povref/convert/sentences.h"
#include "scene/leaves.h"

namespace strahl {
namespace {

using Items = std::vector<std::string>;

/// Returns the material of all surfaces of a body, if they share one and its pattern continues through all of them.
std::optional<int> only_material(const Scene& scene, const Primitive& primitive) {
    std::optional<int> first;
    bool same = true;
    const glm::dmat4 whole = matrix(primitive.transformations);
    for_each_leaf_placed(primitive, [&](const Primitive& leaf, const LeafMatrices& matrices) {
        if (!first) first = leaf.material;
        same &= leaf.material == *first;
        same &= !scene.materials[leaf.material].patterned() || matrices.material == whole;
    });
    return same ? first : std::nullopt;
}

/// Returns a body without its closing brace. POV-Ray's own word `union` keeps the surfaces inside; `dress(material)`
/// returns the words that give a part of a composite a material of its own; its pattern then has the whole's space.
template <class Dress>
std::string head_of(const Primitive& primitive, PovMotions& motions, const Dress& dress,
                    const std::string& indent = "") {
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (is_composite<Kind>) {
                std::string text = Kind::operation == Operation::unite ? "merge {" : std::string(Kind::name) + " {";
                const std::string inner = indent + "  ";
                for (const Primitive& part : *kind.parts) {
                    Items items = statements(part.transformations, motions);
                    if (part.material != primitive.material) items.insert(items.begin(), dress(part.material));
                    std::erase(items, "");
                    text += "\n" + inner + block(head_of(part, motions, dress, inner), items, inner);
                    text.pop_back();
                }
                return text;
            } else {
                return sentence(primitive.shape);
            }
        },
        primitive.shape);
}

class BodyWriter {
  public:
    explicit BodyWriter(const PovBodies& how) : how(how) {}
    void add(const Scene& scene, const Primitive& primitive);
    std::string text() const;

  private:
    void add_mixed(const Primitive& primitive, bool clear_one);
    void add_clear(const Primitive& primitive, const std::string& head, const PovMaterial& material, Items items);

    /// Returns the material of a visible body, or of the copy that casts its shadow.
    std::string dressed(int number, bool copy) const {
        const PovMaterial& material = how.materials[number];
        if (copy && material.own_shadow) return "texture { " + material.name + "_Shadow }";
        return (material.transparent ? "material { " : "texture { ") + material.name + " }";
    }

    const PovBodies& how;
    std::string solid, clear, declared, shadows, seen;
    std::map<std::string, int> count;
};

void BodyWriter::add(const Scene& scene, const Primitive& primitive) {
    const std::optional<int> number = only_material(scene, primitive);
    if (!number) return add_mixed(primitive, transparent(scene, primitive));
    const PovMaterial& material = how.materials[*number];
    Items items = statements(primitive.transformations, how.motions);
    if (how.scaled) items.push_back("scale Unit");
    const std::string head = head_of(primitive, how.motions, [](int) { return ""; });
    if (material.transparent && how.shadow_copies) return add_clear(primitive, head, material, items);
    items.insert(items.begin(), dressed(*number, false));
    if (how.hollow && !material.transparent) items.push_back("hollow");
    (material.transparent ? clear : solid) += block(head, items);
}

/// Adds a composite whose parts have materials of their own.
void BodyWriter::add_mixed(const Primitive& primitive, bool clear_one) {
    Items items = statements(primitive.transformations, how.motions);
    if (how.scaled) items.push_back("scale Unit");
    const auto text = [&](bool copy, std::initializer_list<const char*> more) {
        Items all{dressed(primitive.material, copy)};
        all.insert(all.end(), items.begin(), items.end());
        all.insert(all.end(), more.begin(), more.end());
        return block(head_of(primitive, how.motions, [&](int number) { return dressed(number, copy); }), all);
    };
    if (!clear_one) {
        solid += how.hollow ? text(false, {"hollow"}) : text(false, {});
    } else if (!how.shadow_copies) {
        clear += text(false, {});
    } else {
        shadows += text(true, {"no_image", "no_reflection"});
        seen += text(false, {"no_shadow"});
    }
}

void BodyWriter::add_clear(const Primitive& primitive, const std::string& head, const PovMaterial& material,
                           Items items) {
    std::string kind = std::visit([](const auto& shape) { return std::string(shape.name); }, primitive.shape);
    kind[0] = static_cast<char>(kind[0] - 'a' + 'A');
    const std::string name = kind + "_" + std::to_string(++count[kind]);
    declared += block("#declare " + name + " = " + head, items);
    std::string moved;  // a pattern moves with its body
    if (material.patterned)
        for (const std::string& item : items) moved += " " + item;
    if (material.own_shadow)
        shadows += block("object { " + name, {"texture { " + material.name + "_Shadow" + moved + " }", "no_image",
                                              "no_reflection"});
    seen += block("object { " + name, {"material { " + material.name + moved + " }"});
    if (material.own_shadow) seen.insert(seen.size() - 3, " no_shadow");
}

std::string BodyWriter::text() const {
    std::string text;
    if (!solid.empty()) text += heading("Opaque bodies") + solid;
    if (!clear.empty()) text += heading("Transparent bodies") + clear;
    if (!seen.empty())
        text += heading("Transparent bodies") + declared + "\n" +
                comment(
                    "Light seen through a body keeps its colour, and its shadow has the body's colour. POV-Ray has one "
                    "pigment for both, so invisible copies cast the shadows.") +
                shadows + "\n" + seen;
    return text;
}

}  // namespace

bool mixed(const Scene& scene, const Primitive& primitive) {
    const std::optional<int> number = only_material(scene, primitive);
    return !number || scene.materials[*number].ior != scene.materials[primitive.material].ior;
}

std::string body_sections(const Scene& scene, const PovBodies& how) {
    BodyWriter writer(how);
    for (const Primitive& primitive : scene.primitives) writer.add(scene, primitive);
    return writer.text();
}

}  // namespace strahl

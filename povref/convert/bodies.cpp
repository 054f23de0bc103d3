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

/// Returns the material whose index of refraction the body has as a whole: its own, or that of its first glass part.
int medium_of(const Scene& scene, const Primitive& primitive) {
    int medium = primitive.material;
    for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
        if (!scene.materials[medium].transmits() && scene.materials[leaf.material].transmits()) medium = leaf.material;
    });
    return medium;
}

/// Returns whether all transformations certainly keep angles.
bool keeps_angles(const std::vector<Transformation>& steps) {
    const auto moves = [](const Transformation& step) { return std::holds_alternative<Motion>(step); };
    return similarity(steps) > 0 && std::ranges::none_of(steps, moves);
}

/// Returns whether the normals of all corners are on one side of the triangle's plane.
bool faces_one_side(const SmoothTriangle& smooth) {
    const DVec3 across = cross_product(smooth.b - smooth.a, smooth.c - smooth.a);
    const double a = dot_product(across, smooth.normal_a), b = dot_product(across, smooth.normal_b),
                 c = dot_product(across, smooth.normal_c);
    return std::min({a, b, c}) > 0 || std::max({a, b, c}) < 0;
}

/// Returns a torus without its closing brace. One whose hole is closed is solid; POV-Ray also sees the sheet inside it,
/// which a ball between the points where it ends on the axis lies over.
std::string torus_text(const Torus& torus) {
    const std::string tube = sentence(torus);
    if (torus.major >= torus.minor) return tube;
    const double radius = std::sqrt((torus.minor - torus.major) * (torus.minor + torus.major));
    return "merge { " + tube + " } sphere { " + text_of(torus.centre) + ", " + text_of(radius) + " }";
}

/// Returns a simple body without its closing brace. Some smooth triangles become a mesh of one: POV-Ray drops those
/// whose normals are on both sides, and makes the normals of others unit vectors once it has transformed them, which
/// changes how they bend between the corners. In a mesh it keeps all, and transforms what it interpolated.
std::string leaf_text(const Primitive& leaf) {
    if (const Torus* const torus = std::get_if<Torus>(&leaf.shape)) return torus_text(*torus);
    const SmoothTriangle* const smooth = std::get_if<SmoothTriangle>(&leaf.shape);
    if (!smooth || (keeps_angles(leaf.transformations) && faces_one_side(*smooth))) return sentence(leaf.shape);
    const auto& [a, b, c, normal_a, normal_b, normal_c] = *smooth;
    const MeshData alone{{a, b, c}, {normal_a, normal_b, normal_c}, {{0, 1, 2}}, {{0, 1, 2}}};
    return sentence(Mesh{std::make_shared<const MeshData>(alone), ""});
}

/// Returns a body without its closing brace, which will have the material `whole`. POV-Ray's own word `union` keeps the
/// surfaces inside; `dress(material, indent)` returns the words that give a part of a composite a material of its own.
template <class Dress>
std::string head_of(const Primitive& primitive, int whole, PovMotions& motions, const Dress& dress,
                    const std::string& indent = "") {
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (is_composite<Kind>) {
                std::string text = Kind::operation == Operation::unite ? "merge {" : std::string(Kind::name) + " {";
                const std::string inner = indent + "  ";
                for (const Primitive& part : *kind.parts) {
                    Items items = statements(part.transformations, motions);
                    if (part.material != whole) items.insert(items.begin(), dress(part.material, inner + "  "));
                    text += "\n" + inner + block(head_of(part, part.material, motions, dress, inner), items, inner);
                    text.pop_back();
                }
                return text;
            } else {
                return leaf_text(primitive);
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
    void add_mixed(const Scene& scene, const Primitive& primitive);
    void add_clear(const Scene& scene, const Primitive& primitive, int number, const std::string& head, Items items);

    std::string dressed(int number) const {
        const PovMaterial& material = how.materials[number];
        return (material.transparent ? "material { " : "texture { ") + material.name + " }";
    }

    /// Returns a body with the lights of its group.
    std::string in_group(const Scene& scene, int number, const std::string& body) const {
        const Material& own = scene.materials[number];
        if (!how.materials[number].grouped) return body;
        const bool any = std::ranges::count(scene.lights, own.group, &Light::group) > 0 && own.group > 0;
        return "light_group {\n" + (any ? group_name(own.group) + "()\n" : "") + body +
               (own.common > 0 ? "global_lights on\n}\n" : "}\n");
    }

    /// Returns the words of a copy that only casts a shadow. The eye may be in it.
    Items copy_items(const std::string& texture = "") const {
        return {texture, "no_image", "no_reflection", how.hollow ? "hollow" : ""};
    }

    const PovBodies& how;
    std::string solid, clear, declared, shadows, seen;
    std::map<std::string, int> count;
};

void BodyWriter::add(const Scene& scene, const Primitive& primitive) {
    const std::optional<int> number = only_material(scene, primitive);
    if (!number || scene.materials[*number].ior != scene.materials[medium_of(scene, primitive)].ior)
        return add_mixed(scene, primitive);
    const PovMaterial& material = how.materials[*number];
    Items items = statements(primitive.transformations, how.motions);
    if (how.scaled) items.push_back("scale Unit");
    const std::string head =
        head_of(primitive, primitive.material, how.motions, [](int, const std::string&) { return ""; });
    if (material.transparent && how.shadow_copies) return add_clear(scene, primitive, *number, head, items);
    items.insert(items.end(), material.hides.begin(), material.hides.end());
    items.insert(items.begin(), dressed(*number));
    if (how.hollow && !material.transparent) items.push_back("hollow");
    (material.transparent ? clear : solid) += in_group(scene, *number, block(head, items));
}

/// Adds a composite whose parts have materials of their own. A transparent one has one interior, as POV-Ray knows by it
/// what a ray is in: a part that had another could be entered, and never left.
void BodyWriter::add_mixed(const Scene& scene, const Primitive& primitive) {
    Items items = statements(primitive.transformations, how.motions);
    if (how.scaled) items.push_back("scale Unit");
    const Items& hides = how.materials[primitive.material].hides;
    items.insert(items.end(), hides.begin(), hides.end());
    const int medium_number = medium_of(scene, primitive);
    // POV-Ray looks first for the shadow of the body that was in the way of a light last, if its own texture, not those
    // of its parts, is opaque; and dims light by its transparent parts once more afterwards. A pattern of the whole
    // must continue through the parts.
    const int whole = scene.materials[primitive.material].patterned() ? primitive.material : medium_number;
    const auto text = [&](const auto& dress, const Items& more) {
        Items all = items;
        all.insert(all.begin(), dress(whole, std::string("  ")));
        all.insert(all.end(), more.begin(), more.end());
        return in_group(scene, primitive.material, block(head_of(primitive, whole, how.motions, dress), all));
    };
    if (!transparent(scene, primitive)) {
        solid += text([&](int number, const std::string&) { return dressed(number); },
                      how.hollow ? Items{"hollow"} : Items{});
        return;
    }
    const PovMaterial& medium = how.materials[medium_number];
    bool weighs = false;
    for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
        weighs |= !how.materials[leaf.material].weight.empty();
    });
    const std::string weight = !weighs ? "" : medium.weight.empty() ? "1" : medium.weight;
    const auto seen_dress = [&](int number, const std::string& indent) {
        return part_texture(scene.materials[number], weight, indent);
    };
    const auto shadow_dress = [&](int number, const std::string& indent) {
        return how.materials[number].transparent ? shadow_texture(scene.materials[number], indent) : dressed(number);
    };
    Items more{"interior { ior " + medium.ior + " }"};
    if (how.shadow_copies) {
        shadows += text(shadow_dress, copy_items());
        more.push_back("no_shadow");
    }
    (how.shadow_copies ? seen : clear) += text(seen_dress, more);
}

void BodyWriter::add_clear(const Scene& scene, const Primitive& primitive, int number, const std::string& head,
                           Items items) {
    const PovMaterial& material = how.materials[number];
    std::string kind = std::visit([](const auto& shape) { return std::string(shape.name); }, primitive.shape);
    kind[0] = static_cast<char>(kind[0] - 'a' + 'A');
    const std::string name = kind + "_" + std::to_string(++count[kind]);
    declared += block("#declare " + name + " = " + head, items);
    std::string moved;  // a pattern moves with its body
    if (material.patterned)
        for (const std::string& item : items) moved += " " + item;
    if (material.own_shadow)
        shadows += block("object { " + name, copy_items("texture { " + material.name + "_Shadow" + moved + " }"));
    Items shown{"material { " + material.name + moved + " }"};
    shown.insert(shown.end(), material.hides.begin(), material.hides.end());
    seen += in_group(scene, number, block("object { " + name, shown));
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

std::string group_name(double number) {
    std::string name = "Lights_" + text_of(number);
    std::ranges::replace_if(
        name, [](char c) { return c == '.' || c == '-' || c == '+'; }, '_');
    return name;
}

bool weighs_unevenly(const Scene& scene, const Primitive& primitive) {
    const Material& medium = scene.materials[medium_of(scene, primitive)];
    bool uneven = false;
    for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
        const Material& own = scene.materials[leaf.material];
        uneven |= own.refraction > 0 && own.reflection + own.refraction != medium.reflection + medium.refraction;
    });
    return uneven && medium.ior != 1;
}

std::string body_sections(const Scene& scene, const PovBodies& how) {
    BodyWriter writer(how);
    for (const Primitive& primitive : scene.primitives) writer.add(scene, primitive);
    return writer.text();
}

}  // namespace strahl

#include "text/blocks/definitions.h"

#include <algorithm>
#include <utility>

#include "text/blocks/blocks.h"
#include "text/reading/lexer.h"

namespace strahl {
namespace {

int levels_in(const Primitive& primitive) {
    int most = 0;
    each_part(primitive, [&](const Primitive& part) { most = std::max(most, 1 + levels_in(part)); });
    return most;
}

}  // namespace

bool Definitions::can_add(std::string_view name, Diagnostics& diagnostics) const {
    if (contains(block_words, name) || contains(shape_words, name)) {
        diagnostics.add(name, quoted(name) + " is a word of the language; choose another name");
        return false;
    }
    const auto material = materials.find(name);
    const auto body = bodies.find(name);
    if (material == materials.end() && body == bodies.end()) return true;
    const std::string_view first = material != materials.end() ? material->first : body->first;
    diagnostics.add(name, "a second " + quoted(name) + "; the first is in " + diagnostics.line(first));
    return false;
}

void Definitions::add(std::string_view name, const MaterialText& material, Diagnostics& diagnostics) {
    if (can_add(name, diagnostics)) materials.emplace(name, material);
}
void Definitions::add(std::string_view name, NamedBody body, Diagnostics& diagnostics) {
    body.levels = levels_in(body.primitive);
    if (can_add(name, diagnostics)) bodies.emplace(name, std::move(body));
}

const MaterialText& Definitions::material(std::string_view name, Diagnostics& diagnostics) const {
    if (const auto found = materials.find(name); found != materials.end()) return found->second;
    std::vector<std::string_view> known;
    for (const auto& [own, text] : materials) known.push_back(own);
    diagnostics.add(name, known.empty() ? "unknown material " + quoted(name) + ": define it above, by define " +
                                              std::string(name) + " material { ... }"
                                        : unknown_word(name, known, " for 'material'"));
    throw ParseAbort{};
}

const Definitions::NamedBody* Definitions::body(std::string_view name) const {
    const auto found = bodies.find(name);
    return found == bodies.end() ? nullptr : &found->second;
}

std::vector<std::string_view> Definitions::with_bodies(std::span<const std::string_view> words) const {
    std::vector<std::string_view> all(words.begin(), words.end());
    for (const auto& [name, body] : bodies) all.push_back(name);
    return all;
}

Primitive Definitions::renumbered(Primitive primitive, int by) {
    primitive.material += by;
    change_parts(primitive, [by](Primitive& part) { part = renumbered(std::move(part), by); });
    return primitive;
}

}  // namespace strahl

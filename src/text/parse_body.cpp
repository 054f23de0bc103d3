#include "text/parse_body.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "files/error.h"
#include "scene/leaves.h"
#include "text/parse.h"

namespace strahl {
namespace {

/// Finds the numbers that a body's materials have in the scene from those of the body in its place. False if the two do
/// not have as many materials and parts.
bool match_materials(const Primitive& before, const Primitive& now, std::vector<int>& numbers) {
    int& number = numbers[std::size_t(now.material)];
    if (number < 0 && std::ranges::find(numbers, before.material) == numbers.end()) number = before.material;
    if (number != before.material || before.shape.index() != now.shape.index()) return false;
    std::vector<const Primitive*> old_parts, parts;
    each_part(before, [&](const Primitive& part) { old_parts.push_back(&part); });
    each_part(now, [&](const Primitive& part) { parts.push_back(&part); });
    if (parts.size() != old_parts.size()) return false;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (!match_materials(*old_parts[i], *parts[i], numbers)) return false;
    return true;
}

bool uses(const Primitive& body, int material) {
    bool found = body.material == material;
    each_part(body, [&](const Primitive& part) { found = found || uses(part, material); });
    return found;
}

void renumber(Primitive& body, const std::vector<int>& numbers) {
    body.material = numbers[std::size_t(body.material)];
    change_parts(body, [&](Primitive& part) { renumber(part, numbers); });
}

}  // namespace

std::optional<Scene> with_body(const Scene& scene, int body, const std::string& context, const std::string& block,
                               std::string_view file, const ReadPixels& read_pixels) try {
    for (const char* word : {"track", "beat", "#"})
        if (block.find(word) != block.npos || context.find(word) != context.npos) return std::nullopt;
    Scene own = parse_scene(std::string(stand_in_camera) + context + block, file, {}, read_pixels);
    if (own.primitives.size() != 1) return std::nullopt;
    const auto place = static_cast<std::size_t>(body);
    std::vector<int> numbers(own.materials.size(), -1);
    if (!match_materials(scene.primitives[place], own.primitives[0], numbers)) return std::nullopt;
    Scene changed = scene;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] < 0) return std::nullopt;
        Material& material = changed.materials[std::size_t(numbers[i])];
        if (material == own.materials[i]) continue;
        // Materials are listed without duplicates.
        if (std::ranges::find(scene.materials, own.materials[i]) != scene.materials.end()) return std::nullopt;
        for (std::size_t k = 0; k < scene.primitives.size(); ++k)
            if (k != place && uses(scene.primitives[k], numbers[i])) return std::nullopt;
        material = std::move(own.materials[i]);
    }
    renumber(own.primitives[0], numbers);
    changed.primitives[place] = std::move(own.primitives[0]);
    return changed;
} catch (const FileError&) {
    return std::nullopt;
}

}  // namespace strahl

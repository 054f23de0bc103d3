#include "povref/convert/material_names.h"

#include <algorithm>
#include <map>

namespace strahl {
namespace {

/// The common name of a colour.
std::string name_of(const Color& c) {
    const double high = std::max({c.x, c.y, c.z}), low = std::min({c.x, c.y, c.z}), span = high - low;
    if (span < 0.25 * high || high == 0)
        return high > 0.85 ? "White" : high > 0.6 ? "Pale" : high > 0.1 ? "Grey" : "Black";
    const double sixth = high == c.x   ? (c.y - c.z) / span
                         : high == c.y ? 2 + (c.z - c.x) / span
                                       : 4 + (c.x - c.y) / span;
    const double degrees = 60 * (sixth < 0 ? sixth + 6 : sixth);
    const struct {
        double below;
        const char* name;
    } hues[] = {{15, "Red"},   {42, "Orange"},  {70, "Yellow"},   {165, "Green"}, {195, "Cyan"},
                {255, "Blue"}, {290, "Violet"}, {345, "Magenta"}, {361, "Red"}};
    for (const auto& hue : hues)
        if (degrees < hue.below) return hue.name;
    return "Red";
}

/// Returns the name of a colour, or of the kind of a pattern.
std::string name_of(const Pigment& pigment) {
    if (!pigment.pattern) return name_of(pigment.color);
    std::string name = std::visit([](const auto& kind) { return std::string(kind.name); }, pigment.pattern->kind);
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
    return name;
}

std::string name_of(const Material& m) {
    const bool seen = m.diffuse > 0 || m.ambient > 0;
    if (m.refraction > 0) return (name_of(m.rgb) == "White" ? "Clear" : name_of(m.rgb)) + std::string("_Glass");
    if (m.reflection >= 0.4) return seen ? name_of(m.rgb) + "_Mirror" : "Plain_Mirror";
    if (!seen && m.specular > 0) return "Highlight_Only";
    return name_of(m.rgb) + (m.specular > 0 || m.reflection > 0 ? "_Gloss" : "_Matt");
}

}  // namespace

std::vector<std::string> material_names(const std::vector<Material>& materials) {
    std::vector<std::string> names;
    std::map<std::string, int> used;
    for (const Material& material : materials) {
        const std::string name = name_of(material);
        const int count = ++used[name];
        names.push_back(count == 1 ? name : name + "_" + std::to_string(count));
    }
    return names;
}

}  // namespace strahl

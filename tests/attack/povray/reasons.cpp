#include "tests/attack/povray/reasons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "image/transfer.h"
#include "povref/convert/scale.h"
#include "tests/referee/referee.h"

namespace strahl {
namespace {

void round_meshes(std::vector<Primitive>& bodies) {
    const auto rounded = [](const DVec3& p) { return DVec3(float(p.x), float(p.y), float(p.z)); };
    const auto change = [&]<class Kind>(Kind& kind) {
        if constexpr (is_composite<Kind>) {
            std::vector<Primitive> parts = *kind.parts;
            round_meshes(parts);
            kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
        } else if constexpr (std::is_same_v<Kind, Mesh>) {
            MeshData data = *kind.data;
            for (DVec3& point : data.points) point = rounded(point);
            for (DVec3& normal : data.normals) normal = rounded(normal);
            kind.data = std::make_shared<const MeshData>(std::move(data));
        }
    };
    for (Primitive& body : bodies) std::visit(change, body.shape);
}

/// Returns the scene with the numbers that POV-Ray keeps in single precision.
Scene in_single_precision(Scene scene) {
    for (Material& material : scene.materials) material.ior = float(material.ior == 1 ? 1.00000012 : material.ior);
    round_meshes(scene.primitives);
    return scene;
}

using Steps = std::array<int, 3>;
int apart(const Steps& a, const Steps& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

}  // namespace

Reasons reasons_of(const Scene& scene, const View& view, const Verdict& verdict, const Picture& theirs) {
    const double unit = scale_for(scene, {view.camera}).factor;
    const OtherRules lengths{.nearest = 1e-4 / unit, .farthest = 1e7 / unit, .shadow = 1e-3 / unit};
    OtherRules all = lengths;
    all.bent_side = all.one_share = all.straight_is_free = true;
    const auto referee = [&](const Scene& own, const OtherRules& rules) {
        return Referee<long double>(own, view.camera, view.width, view.height, view.depth, rules);
    };
    const Scene single = in_single_precision(scene);
    struct Rule {
        const char* name;
        Referee<long double> referee;
    };
    const Rule rules[]{
        {"lengths", referee(scene, lengths)},
        {"hits nearer than 1e-4 alone", referee(scene, {.nearest = lengths.nearest, .farthest = lengths.farthest})},
        {"light behind bumps", referee(scene, {.bent_side = true})},
        {"one share of total reflection", referee(scene, {.one_share = true})},
        {"single precision", referee(single, {})},
        {"unrefracted rays are no generation", referee(single, {.straight_is_free = true})},
        {"several of these", referee(single, all)}};
    const Referee<long double> exact = referee(scene, {}), all_but_rounded = referee(scene, all);
    const Referee<long double>&rounded = rules[4].referee, &all_rounded = std::end(rules)[-1].referee;

    Reasons found;
    const std::size_t step = (verdict.places.size() + 39) / 40;
    for (std::size_t i = 0; i < verdict.places.size(); i += step) {
        const auto [x, y] = verdict.places[i];
        Steps wanted;
        for (int c = 0; c < 3; ++c)
            wanted[c] = int(quantise(theirs.values[theirs.channels * (y * view.width + x) + c], false, 65535));
        const auto seen = [x = x, y = y](const Referee<long double>& by) {
            const Sample sample = by.at(x + .5, y + .5);
            Steps steps;
            for (int c = 0; c < 3; ++c) steps[c] = int(quantise(double(sample.rgb[c]), false, 65535));
            return steps;
        };
        const auto rule =
            std::ranges::find_if(rules, [&](const auto& r) { return apart(seen(r.referee), wanted) <= 1; });
        const int off = apart(seen(exact), wanted);
        if (rule != std::end(rules))
            ++found.pixels[rule->name];
        else if (2 * apart(seen(rounded), seen(exact)) >= off ||
                 2 * apart(seen(all_rounded), seen(all_but_rounded)) >= apart(seen(all_but_rounded), wanted))
            ++found.pixels["single precision, magnified"];
        else
            ++found.unexplained, found.worst = std::max(found.worst, off);
    }
    return found;
}

}  // namespace strahl

#include "show/panels/hidden_bodies.h"

#include <utility>

namespace strahl {

void HiddenBodies::apply(const OutlinerInput& input, const std::shared_ptr<const Scene>& scene) {
    const std::set<int> before = hidden;
    if (input.hide && hidden.erase(input.hide->number) == 0) hidden.insert(input.hide->number);
    if (input.alone) {
        hidden.clear();
        for (int i = 0; i < std::ssize(scene->primitives); ++i)
            if (i != input.alone->number) hidden.insert(i);
        if (hidden == before) hidden.clear();
    }
    if (input.show_all) hidden.clear();
    if (hidden != before) whole = hidden.empty() ? nullptr : scene, rest = nullptr;
}

std::shared_ptr<const Scene> HiddenBodies::scene_without(const std::shared_ptr<const Scene>& scene) {
    if (whole && whole->primitives.size() != scene->primitives.size()) show_all();
    if (hidden.empty()) return scene;
    if (rest && whole == scene) return rest;
    Scene without = *(whole = scene);
    without.primitives.clear();
    for (int i = 0; i < std::ssize(whole->primitives); ++i)
        if (!hidden.contains(i)) without.primitives.push_back(whole->primitives[std::size_t(i)]);
    return rest = std::make_shared<const Scene>(std::move(without));
}

}  // namespace strahl

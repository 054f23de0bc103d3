#include "text/motion_text.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "num/decimal.h"
#include "scene/motion/motion.h"
#include "text/text_changes.h"
#include "text/text_items.h"

namespace strahl {
namespace {

constexpr std::size_t most_motions = 100;
constexpr double least_gap = .01;  // seconds between keys

/// The block of a motion in a text, and its keys.
struct MotionItems {
    TextItem block;
    std::vector<const TextItem*> keys;
};
MotionItems find_motion(const std::string& text, const SceneMotion& motion) {
    MotionItems found;
    TextItem whole =
        motion.what == TopBlock::light ? item_of_light(text, motion.number) : items_of_body(text, motion.number).body;
    std::erase_if(whole.items, [](const TextItem& item) { return item.word != "motion"; });
    if (motion.from_last >= std::ssize(whole.items)) return found;
    found.block = std::move(whole.items[whole.items.size() - 1 - std::size_t(motion.from_last)]);
    for (const TextItem& item : found.block.items)
        if (item.word == "key") found.keys.push_back(&item);
    if (found.keys.size() != motion.times.size()) found.keys.clear();
    return found;
}

/// Returns the motion in a scene.
const Motion& motion_in(const Scene& scene, const SceneMotion& sought) {
    if (sought.what == TopBlock::light) return *scene.lights[std::size_t(sought.number)].motion;
    const auto& steps = scene.primitives[std::size_t(sought.number)].transformations;
    int left = sought.from_last;
    for (std::size_t i = steps.size(); i-- > 0;)
        if (const auto* const motion = std::get_if<Motion>(&steps[i]); motion && left-- == 0) return *motion;
    static const Motion none;
    return none;
}

double in_hundredths(double value) { return std::round(100 * value) / 100; }

}  // namespace

std::vector<SceneMotion> motions_of(const Scene& scene) {
    std::vector<SceneMotion> all;
    const auto add = [&](TopBlock what, std::size_t number, int from_last, const std::string& kind, const Motion& own) {
        if (own.keys.size() < 2 || all.size() == most_motions) return;
        all.push_back({what, static_cast<int>(number), from_last, kind + " " + std::to_string(number + 1)});
        for (const MotionKey& key : own.keys) all.back().times.push_back(key.time);
    };
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (const auto& motion = scene.lights[i].motion) add(TopBlock::light, i, 0, "light", *motion);
    for (std::size_t i = 0; i < scene.primitives.size() && all.size() < most_motions; ++i) {
        const Primitive& body = scene.primitives[i];
        auto left = static_cast<int>(std::ranges::count_if(
            body.transformations, [](const auto& step) { return std::holds_alternative<Motion>(step); }));
        if (left == 0) continue;
        const char* const kind = std::visit([]<class Kind>(const Kind&) { return Kind::name; }, body.shape);
        for (const Transformation& step : body.transformations)
            if (const auto* const motion = std::get_if<Motion>(&step)) add(TopBlock::body, i, --left, kind, *motion);
    }
    return all;
}

std::string with_key_time(const std::string& text, const Scene& scene, const SceneMotion& motion, std::size_t key,
                          double seconds) {
    const MotionItems found = find_motion(text, motion);
    if (key >= found.keys.size()) return text;
    const double low = key > 0 ? motion.times[key - 1] + least_gap : 0;
    const double high = key + 1 < motion.times.size() ? motion.times[key + 1] - least_gap : 1e9;
    if (!(low <= high)) return text;
    seconds = std::clamp(in_hundredths(seconds), low, high);
    const TextItem* const time = found.keys[key]->item("time");
    const TextItem* const given = time ? time : found.keys[key]->item("beat");
    if (!given || given->numbers.empty()) return text;
    const double beat = std::max((seconds - scene.music.offset) * scene.music.bpm / 60, 0.);
    return with_changes(text, {{slice_of(text, given->numbers[0]), text_of(time ? seconds : in_hundredths(beat))}});
}

std::string with_motion_key(const std::string& text, const Scene& scene, const SceneMotion& motion, double seconds) {
    const MotionItems found = find_motion(text, motion);
    seconds = std::max(in_hundredths(seconds), 0.);
    const auto behind = std::ranges::upper_bound(motion.times, seconds);
    const bool beside =
        std::ranges::any_of(motion.times, [&](double time) { return std::abs(time - seconds) < least_gap / 2; });
    if (found.keys.empty() || beside) return text;
    const MotionKey now = key_at(motion_in(scene, motion), seconds);
    std::string key = "key { time " + text_of(seconds);
    const auto add = [&](const char* word, const DVec3& value, const DVec3& none) {
        const DVec3 shown = rounded(value, none, 4);
        if (shown != none) key += std::string("  ") + word + " " + text_of(shown);
    };
    add("scale", now.scale, DVec3(1)), add("rotate", now.rotate, DVec3(0)), add("translate", now.translate, DVec3(0));
    key += " }";
    // Stands before the key that follows it, or behind the last one, on a line of its own if that does.
    const auto next = std::size_t(behind - motion.times.begin());
    const TextItem& beside_it = *found.keys[std::min(next, found.keys.size() - 1)];
    const TextSlice whole = slice_of(text, whole_block(beside_it));
    const TextSlice spaced = with_space(text, whole);
    const std::string space = text.substr(spaced.begin, whole.begin - spaced.begin);
    if (next < found.keys.size())
        return with_changes(text, {{{whole.begin, whole.begin}, key + (space.empty() ? " " : space)}});
    return with_changes(text, {{{whole.end, whole.end}, (space.empty() ? " " : space) + key}});
}

std::string without_motion_key(const std::string& text, const SceneMotion& motion, std::size_t key) {
    const MotionItems found = find_motion(text, motion);
    if (found.keys.size() <= 2 || key >= found.keys.size()) return text;
    return with_changes(text, {{with_space(text, slice_of(text, whole_block(*found.keys[key]))), ""}});
}

}  // namespace strahl

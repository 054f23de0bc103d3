#include "text/blocks/motion_block.h"

#include "text/blocks/blocks.h"

namespace strahl {
namespace {

/// Where words of a key are.
struct KeyPlace {
    std::string_view key, time, scale;
};

bool changes_sign(const DVec3& a, const DVec3& b) {
    for (int c = 0; c < 3; ++c)
        if ((a[c] < 0) != (b[c] < 0)) return true;
    return false;
}

void check(Reader& reader, const Motion& motion, std::span<const KeyPlace> places, Block& block) {
    for (std::size_t i = 1; i < motion.keys.size(); ++i) {
        const MotionKey &before = motion.keys[i - 1], &key = motion.keys[i];
        const KeyPlace& place = places[i];
        if (!(key.time > before.time)) block.bad = true;
        require_rising(reader.diagnostics, before.time, key.time, places[i - 1].time, place.time);
        if (!changes_sign(before.scale, key.scale)) continue;
        block.bad = true;
        reader.diagnostics.add(place.scale.data() ? place.scale : place.key,
                               "on the way to this key 'scale' would be 0: its sign must be that in the key before, "
                               "in " + reader.diagnostics.line(places[i - 1].key));
    }
}

}  // namespace

void require_rising(Diagnostics& diagnostics, double before, double time, std::string_view before_at,
                    std::string_view at) {
    if (!(time > before))
        diagnostics.add(at, "times must rise: the key before, in " + diagnostics.line(before_at) +
                                ", is not earlier than this one");
}

Motion read_motion(Reader& reader, const TextLimits& limits, std::string_view word, Block& outer) {
    Motion motion;
    std::vector<KeyPlace> places;
    const auto read_key = [&](std::string_view inner, Block& block) {
        if (motion.keys.size() >= limits.keys) {
            reader.diagnostics.add(inner, "more than " + std::to_string(limits.keys) + " keys");
            reader.diagnostics.check();
        }
        Block own{inner};
        MotionKeyText text;
        auto parameters = motion_parameters(text);
        reader.block(own, parameters);
        reader.require(own, parameters);
        reader.set_time(text.when.time, text.when.beat, parameters[1].at, own);
        block.absorb(own);
        motion.keys.push_back({text.when.time, text.translate, text.rotate, text.scale.by});
        places.push_back({inner, parameters[text.when.beat ? 1 : 0].at, parameters[2].at});
    };
    Block block{word};
    constexpr std::array<std::string_view, 1> words{"key"};
    reader.block(
        block, words, [] {},
        [&](std::string_view inner) { return inner == "key" && (read_key(inner, block), true); });
    reader.require(block, {}, {{motion.keys.size() >= 2, "keys: it takes 2 to move"}});
    if (block.good()) check(reader, motion, places, block);
    outer.absorb(block);
    return motion;
}

}  // namespace strahl

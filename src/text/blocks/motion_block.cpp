#include "text/blocks/motion_block.h"

#include "text/blocks/blocks.h"

namespace strahl {
namespace {

bool changes_sign(const DVec3& a, const DVec3& b) {
    for (int c = 0; c < 3; ++c)
        if ((a[c] < 0) != (b[c] < 0)) return true;
    return false;
}

void check(BlockReader& reader, const Motion& motion, std::span<const KeyWords> words, Block& block) {
    for (std::size_t i = 1; i < motion.keys.size(); ++i) {
        const MotionKey &before = motion.keys[i - 1], &key = motion.keys[i];
        if (!(key.time > before.time)) block.bad = true;
        require_rising(reader.diagnostics, before.time, key.time, words[i - 1].time, words[i].time);
        if (!changes_sign(before.scale, key.scale)) continue;
        reader.fault(block, words[i].scale.data() ? words[i].scale : words[i].key,
                     "'scale' would pass 0 on the way to this key: give it the sign of the key before, in " +
                         reader.diagnostics.line(words[i - 1].key));
    }
}

}  // namespace

void require_rising(Diagnostics& diagnostics, double before, double time, std::string_view before_at,
                    std::string_view at) {
    if (!(time > before))
        diagnostics.add(at, "times must increase: the key before, in " + diagnostics.line(before_at) +
                                ", is not earlier than this one");
}

Motion read_motion(BlockReader& reader, const TextLimits& limits, std::string_view word, Block& outer) {
    Motion motion;
    std::vector<KeyWords> words;
    const auto read_key = [&](std::string_view inner, Block& block) {
        reader.limit(motion.keys.size(), limits.keys, inner, "keys");
        Block own{inner};
        MotionKeyText text;
        auto parameters = motion_parameters(text);
        reader.block(own, parameters);
        reader.require(own, parameters);
        reader.set_time(text.when.time, text.when.beat, parameters[1].at, own);
        block.absorb(own);
        motion.keys.push_back({text.when.time, text.translate, text.rotate, text.scale.by, {}, text.ease});
        words.push_back({inner, parameters[text.when.beat ? 1 : 0].at, parameters[2].at});
    };
    Block block{word};
    constexpr std::array<std::string_view, 1> key_word{"key"};
    reader.block(
        block, key_word, [] {},
        [&](std::string_view inner) { return inner == "key" && (read_key(inner, block), true); });
    reader.require(block, {}, {{motion.keys.size() >= 2, "keys: a motion needs at least 2"}});
    if (block.good()) check(reader, motion, words, block);
    outer.absorb(block);
    return motion;
}

}  // namespace strahl

#include "text/blocks/settings_block.h"

#include "text/blocks/blocks.h"

namespace strahl {

Settings read_settings(BlockReader& reader, std::string_view word) {
    Block block{word};
    SettingsText settings;
    auto parameters = settings_parameters(settings);
    reader.block(block, parameters);
    if (!block.good()) return {};
    return {settings.ambient_light, static_cast<int>(settings.max_trace_level), settings.assumed_gamma.value_or(0),
            settings.adc_bailout};
}

Fog read_fog(BlockReader& reader, std::string_view word) {
    Fog fog;
    Block block{word, false, false, &fog.follows};
    auto parameters = fog_parameters(fog);
    reader.block(block, parameters);
    reader.require(block, parameters);
    sort(fog.follows);
    return fog;
}

Music read_music(BlockReader& reader, std::string_view word) {
    Block block{word};
    Music music;
    auto parameters = music_parameters(music);
    std::string_view sound_at;
    reader.block(
        block, parameters, music_words, [] {},
        [&](std::string_view inner) {
            if (inner != music_words[0]) return false;
            const bool first = reader.once(sound_at, inner);
            reader.file(block, "file", [&](std::string_view name) {
                if (first) reader.files.sound(music.sound = name);
            });
            return true;
        });
    return music;
}

}  // namespace strahl

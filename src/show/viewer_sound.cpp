// Sound and picture of a flight together.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "show/viewer.h"
#include "text/parse.h"

namespace strahl {

/// That of the scene, if it is not that already.
void Viewer::load_sound() {
    const std::string& name = session.scene->music.sound;
    const std::string file = name.empty() ? "" : path_beside(path, name);
    if (file == sound_file) return;
    sound_file = file;
    sound.reset(), sound_told = false;
    if (!file.empty()) sound = std::make_unique<Sound>(file, glfwPostEmptyEvent);
}

/// The sound begins where the flight does, and where it jumps to. From there on the clock of the flight follows the
/// device, of which no other runs as evenly; so that the picture which is on the screen, and not the one that is being
/// traced, is that of the moment heard.
void Viewer::follow_sound() {
    if (!sound || sound->loading()) return;
    if (!std::exchange(sound_told, true)) {
        draws_due = std::max(draws_due, 1);
        if (const std::string why = sound->fault(); !why.empty()) log_line("no sound: " + why);
    }
    const double moment = now();
    if (!session.under_way() || !session.at_own_speed()) {
        sound->pause();
        sound_clock.reset();
        return;
    }
    constexpr double jump = .05, gain = 6;  // seconds; share of the error that is put right in one
    const double seconds = session.flight_time(moment);
    const double passed = sound_clock ? moment - sound_clock->now : 0;
    if (!sound_clock || std::abs(seconds - sound_clock->flight - passed) > jump) {
        sound->play(std::max(seconds - picture_delay, 0.));
    } else if (const auto heard = sound->heard()) {
        const double error = *heard + picture_delay - seconds;
        session.shift(std::abs(error) > 1 ? error : error * std::min(gain * passed, 1.), moment);
    }
    sound_clock = SoundClock{moment, session.flight_time(moment)};
}

/// A picture of the flight is on the screen, that was ordered for the moment `shown` of the flight.
void Viewer::picture_shown(double shown) {
    if (!session.under_way()) return;
    const double moment = now();
    picture_delay += .1 * (std::clamp(session.flight_time(moment) - shown, 0., .5) - picture_delay);
    if (const auto heard = sound ? sound->heard() : std::nullopt) sound_log.push_back(shown - *heard);
}

/// How far pictures were before the sound: in the middle, and what 95 of 100 were within.
std::string Viewer::sound_report() {
    std::vector<double> ahead;
    std::swap(ahead, sound_log);
    if (ahead.empty()) return "";
    std::ranges::sort(ahead);
    const auto at = [&](double share) { return 1000 * ahead[std::size_t(share * double(ahead.size() - 1))]; };
    char text[120];
    std::snprintf(text, sizeof text, "; %zu with sound, before it by %.1f ms in the middle, %.1f to %.1f ms",
                  ahead.size(), at(.5), at(.025), at(.975));
    return text;
}

}  // namespace strahl

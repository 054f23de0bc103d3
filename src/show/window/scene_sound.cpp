#include "show/window/scene_sound.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace strahl {

void SceneSound::load(const std::shared_ptr<const Scene>& scene, const std::string& scene_path,
                      const std::function<void()>& notify) {
    if (std::exchange(known, scene) == scene) return;
    const std::string& name = scene->music.sound;
    const std::string path = name.empty() ? "" : path_beside(scene_path, name);
    if (path == file) return;
    file = path;
    sound.reset(), last.reset(), told = false;
    if (!file.empty()) sound = std::make_unique<Sound>(file, notify);
}

const std::vector<float>& SceneSound::peaks() const {
    static const std::vector<float> none;
    return sound ? sound->peaks() : none;
}

void SceneSound::follow(Session& session) {
    if (!sound || sound->loading()) return;
    if (!std::exchange(told, true)) {
        pace.redraw(1);
        if (const std::string why = sound->fault(); !why.empty()) notes.fail("no sound: " + why);
    }
    const double moment = pace.now();
    if (!session.flight.under_way() || !session.flight.at_own_speed()) {
        sound->pause();
        last.reset();
        return;
    }
    constexpr double jump = .05, gain = 6;  // seconds; share of the error that is corrected in a second
    const double seconds = session.flight.time(moment);
    const double passed = last ? moment - last->now : 0;
    if (!last || std::abs(seconds - last->flight - passed) > jump) {
        sound->play(std::max(seconds - delay, 0.));
    } else if (const auto heard = sound->heard()) {
        const double error = *heard + delay - seconds;
        session.flight.shift(std::abs(error) > 1 ? error : error * std::min(gain * passed, 1.), moment);
    }
    last = Compared{moment, session.flight.time(moment)};
}

void SceneSound::picture_shown(const Session& session, double ordered) {
    if (!session.flight.under_way()) return;
    delay += .1 * (std::clamp(session.flight.time(pace.now()) - ordered, 0., .5) - delay);
    const auto heard = sound ? sound->heard() : std::nullopt;
    if (!heard) return;
    constexpr std::ptrdiff_t most = 10000;
    if (std::ssize(ahead) == most) ahead.erase(ahead.begin(), ahead.begin() + most / 2);
    ahead.push_back(ordered - *heard);
}

std::string SceneSound::report() {
    std::vector<double> sorted = std::exchange(ahead, {});
    if (sorted.empty()) return "";
    std::ranges::sort(sorted);
    const auto at = [&](double share) { return 1000 * sorted[std::size_t(share * double(sorted.size() - 1))]; };
    char text[120];
    std::snprintf(text, sizeof text, "; %zu with sound, ahead of it by %.1f ms (median), %.1f to %.1f ms (95 %%)",
                  sorted.size(), at(.5), at(.025), at(.975));
    return text;
}

}  // namespace strahl

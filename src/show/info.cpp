#include "show/info.h"

#include <cmath>
#include <cstdio>

namespace strahl {
namespace {

template <class... Values>
std::string formatted(const char* form, Values... values) {
    char text[160];
    std::snprintf(text, sizeof text, form, values...);
    return text;
}

std::string short_text(const DVec3& v) { return formatted("<%.5g, %.5g, %.5g>", v.x, v.y, v.z); }

}  // namespace

std::vector<std::pair<std::string, std::string>> info_lines(const Session& session, const Pace& pace,
                                                            const WindowPicture& picture) {
    const Refinement& state = picture.state();
    const double now = pace.now();
    std::vector<std::pair<std::string, std::string>> lines;
    const auto add = [&](const char* name, std::string value) { lines.emplace_back(name, std::move(value)); };
    add("rate", pace.moving() ? formatted("%.0f pictures/s of %.0f", pace.motion.rate(now), 1 / pace.frame_seconds())
                              : "at rest");
    add("picture", formatted("%dx%d, ", state.view.width, state.view.height) + resolution_text(state.level));
    add("traced in", formatted("%.1f ms, %.0f %% refined", 1000 * state.seconds,
                               state.finished() ? 100 : std::floor(99.9 * state.share)));
    const auto rays = [&](std::uint64_t n) {
        return formatted("%.1f", state.seconds > 0 ? static_cast<double>(n) / state.seconds / 1e6 : 0);
    };
    add("Mrays/s",
        rays(state.rays.total()) + "  camera " + rays(state.rays.camera) + ", shadow " + rays(state.rays.shadow));
    add("", "reflected " + rays(state.rays.reflected) + ", refracted " + rays(state.rays.refracted));
    add("depth", std::to_string(session.depth()));
    if (session.exposure) add("exposure", exposure_text(session.exposure));
    add("precision", formatted("%s, %d lanes (%s)", name(Precision::float32), lanes(Precision::float32, best_simd()),
                               name(best_simd())));
    add("threads", std::to_string(picture.threads()));
    add("position", short_text(session.camera.position));
    add("look_at", short_text(session.camera.look_at));
    const char* const way = session.flight.circling() ? "around the scene"
                            : session.bound()  ? session.flight.path()->keys.empty() ? "by tracks" : "along the path"
                            : session.orbiting ? "orbit"
                                               : "free flight";
    add("moving", way +
                      (!session.bound()             ? formatted(", speed %.3g", session.speed)
                       : session.flight.rate() == 1 ? ""
                                                    : formatted(", %.3g times its speed", session.flight.rate())) +
                      (session.finest < finest_level ? ", at most " + resolution_text(session.finest) : ""));
    if (session.flight.flying())
        add("flight", formatted("%.2f s of %g", session.flight.time(now), session.flight.path()->duration) +
                          (session.flight.paused() ? ", paused" : ""));
    return lines;
}

}  // namespace strahl

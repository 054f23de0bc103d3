// The text of the window's overlay.
#include <cmath>
#include <cstdio>

#include "show/viewer.h"

namespace strahl {
namespace {

template <class... Values>
std::string format(const char* form, Values... values) {
    char text[160];
    std::snprintf(text, sizeof text, form, values...);
    return text;
}

std::string short_text(const DVec3& v) { return format("<%.5g, %.5g, %.5g>", v.x, v.y, v.z); }

}  // namespace

std::vector<std::pair<std::string, std::string>> Viewer::info() const {
    std::vector<std::pair<std::string, std::string>> lines;
    const auto add = [&](const char* name, std::string value) { lines.emplace_back(name, std::move(value)); };
    add("rate", moving ? format("%.0f pictures/s of %.0f", motion.rate(now()), options.fps) : "at rest");
    add("picture", format("%dx%d, ", state.width, state.height) + resolution_text(state.level));
    add("traced in", format("%.1f ms, %.0f %% refined", 1000 * state.seconds,
                            state.finished() ? 100 : std::floor(99.9 * state.share)));
    const auto rays = [&](std::uint64_t n) {
        return format("%.1f", state.seconds > 0 ? static_cast<double>(n) / state.seconds / 1e6 : 0);
    };
    add("Mrays/s",
        rays(state.rays.total()) + "  camera " + rays(state.rays.camera) + ", shadow " + rays(state.rays.shadow));
    add("", "reflected " + rays(state.rays.reflected) + ", refracted " + rays(state.rays.refracted));
    add("depth", std::to_string(session.depth()));
    add("precision", format("%s, %d lanes (%s)", name(Precision::float32), lanes(Precision::float32, best_simd()),
                            name(best_simd())));
    add("threads", std::to_string(tracing.threads()));
    add("position", short_text(session.camera.position));
    add("look_at", short_text(session.camera.look_at));
    add("moving", (session.orbiting ? "orbit, " : "free flight, ") + format("speed %.3g", session.speed) +
                      (session.finest < finest_level ? ", at most " + resolution_text(session.finest) : ""));
    if (session.flying())
        add("flight", format("%.2f s of %g", session.flight_time(now()), session.flight_path()->duration) +
                          (session.paused() ? ", paused" : ""));
    return lines;
}

Overlay Viewer::overlay() {
    Overlay overlay;
    overlay.marks = marks, overlay.width = state.width, overlay.height = state.height, overlay.area = screen.area();
    if (quiet) return overlay;
    if (with_timeline) overlay.reserved = timeline.height();
    overlay.help = help, overlay.share = state.share, overlay.fault = fault;
    overlay.fault_title = waiting ? "The scene is shown once this is mended"
                                  : "The scene file has an error; this is the previous picture";
    if (with_info) overlay.info = info();
    if (session.recording()) overlay.notes.push_back("recording; K ends it");
    for (const Note& n : notes) overlay.notes.push_back(n.text);
    if (const int pending = stills.pending(); pending > 0) {
        const double share = stills.progress();
        overlay.progress.push_back({format("%s still: %.0f %%", quitting ? "Finishing the" : "A", 100 * share) +
                                        (pending > 1 ? format(", %d more waiting", pending - 1) : "") +
                                        (quitting ? "; Esc drops it" : ""),
                                    share});
    }
    if (stability.under_way())
        overlay.progress.push_back({"This view in float, double, long double and with bounds", stability.progress()});
    return overlay;
}

}  // namespace strahl

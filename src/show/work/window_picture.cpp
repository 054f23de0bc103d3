#include "show/work/window_picture.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "show/session/framing.h"

namespace strahl {

void WindowPicture::order(const Session& session, std::shared_ptr<const Scene> scene, int width, int height) {
    if (width == 0 || height == 0) return;
    const View view = session.view(width, height);
    const bool same = wanted.scene == scene && same_picture(wanted.view, view) && wanted.exposure == session.exposure;
    if (same && wanted.moving == pace.moving()) return;
    if (!same && check.active()) toggle_marks();
    wanted = {wanted.number + (same ? 0 : 1),
              std::move(scene),
              view,
              pace.moving(),
              pace.budget(),
              session.finest,
              session.exposure};
    tracing.want(wanted);
}

bool WindowPicture::take(const TraceThread::Upload& upload) {
    const auto update = tracing.take(upload);
    if (update) progress = *update;
    return update.has_value();
}

void WindowPicture::log_finished() {
    if (pace.moving() || !progress.finished() || !newest() || progress.number == logged) return;
    logged = progress.number;
    char text[120];
    std::snprintf(text, sizeof text, "finished %dx%d: traced in %.4f s, %.3f million rays", progress.view.width,
                  progress.view.height, progress.seconds, static_cast<double>(progress.rays.total()) / 1e6);
    notes.log(text);
}

void WindowPicture::toggle_marks() {
    pace.redraw();
    if (check.active()) return check.cancel();
    if (pace.moving())
        return notes.note("rounding is checked in a picture at rest: " + notes.key(Action::pause) + " pauses");
    if (!wanted.scene) return;
    View exact = wanted.view;
    exact.error = 0;
    check.start(wanted.scene, exact);
}

void WindowPicture::tell_marks() {
    if (check.under_way()) pace.redraw(1);
    if (!check.take()) return;
    const std::vector<Mark>& marks = check.found().marks;
    const auto in_double = std::ranges::count(marks, true, &Mark::in_double);
    char proved[40] = "; this program was built without proofs";
    if (const auto share = check.found().proved)
        std::snprintf(proved, sizeof proved, "; %.6g %% are proved", 100 * *share);
    notes.note("rounding changes " + std::to_string(marks.size()) + " pixels in float, " + std::to_string(in_double) +
               " in double" + proved);
}

}  // namespace strahl

#include "show/work/still_requests.h"

#include <filesystem>
#include <optional>
#include <utility>

namespace strahl {

StillRequests::StillRequests(const ViewOptions& options, Notes& notes, Pace& pace, std::function<void()> notify)
    : options(options), notes(notes), pace(pace), stills(options.threads, std::move(notify)) {
    if (options.still_folder.empty()) return;
    if (const std::string why = folder_fault(options.still_folder); !why.empty()) notes.fail(why);
}

void StillRequests::add(const Session& session, const std::string& scene_path, View view, const std::string& ending) {
    if (finishing) return notes.note("the window is closing, and makes no more stills");
    if (const auto& size = options.still_size) view.width = size->width, view.height = size->height;
    const bool in_flight = session.flight.flying() || session.time != 0;
    const std::string name =
        (std::filesystem::path(options.still_folder) /
         still_name(scene_path, in_flight ? std::optional(rounded_time(session.time)) : std::nullopt))
            .string();
    if (const std::string why = folder_fault(options.still_folder); !why.empty()) {
        any_failed = true;
        return notes.fail(why);
    }
    stills.add({session.scene, view, name, ending, session.exposure});
    log_line("still queued: " + name + ", " + std::to_string(view.width) + "x" + std::to_string(view.height));
    told = pace.now();
    pace.redraw();
}

void StillRequests::tell_done() {
    for (const Stills::Outcome& outcome : stills.outcomes()) {
        any_failed |= !outcome.fault.empty();
        if (outcome.fault.empty())
            notes.announce("still saved: " + outcome.path);
        else
            notes.fail(outcome.fault);
    }
    const int pending = stills.pending();
    if (pending == 0 || pace.now() - told <= 2) return;
    told = pace.now();
    log_line("still: " + std::to_string(int(100 * stills.progress())) + " %, " + std::to_string(pending) + " waiting");
}

void StillRequests::finish() {
    if (!std::exchange(finishing, true) && stills.pending() > 0) {
        log_line("waiting for " + std::to_string(stills.pending()) + " still(s); " + notes.key(Action::back) +
                 " or a signal drops them");
        return pace.redraw();
    }
    for (const std::string& name : stills.drop()) log_line("still dropped: " + name);
}

std::string StillRequests::progress_text() const {
    const int pending = stills.pending();
    if (pending == 0) return "";
    std::string text = finishing ? "Finishing the still: " : "A still: ";
    text += std::to_string(int(100 * stills.progress() + .5)) + " %";
    if (pending > 1) text += ", " + std::to_string(pending - 1) + " more waiting";
    return text + (finishing ? "; " + notes.key(Action::back) + " drops it" : "");
}

}  // namespace strahl
